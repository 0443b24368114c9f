/* Declares the table of connections whose request is incomplete. A client that sends one byte each second never exceeds
 * a time limit for silence, so a few dozen such clients could occupy all connections. When more than WAITING_MOST
 * connections wait, the table shuts down the connection that has waited longest. */
#ifndef VS_LIVE_WAITING_H
#define VS_LIVE_WAITING_H

#include <pthread.h>
#include <stdbool.h>

enum { WAITING_MOST = 12, WAITING_SLOTS = 64 }; /* WAITING_MOST: greatest number of waiting connections; WAITING_SLOTS:
                                                 * number of entries of the table, more than the greatest number of open
                                                 * connections */

/* An entry of the table. since: number that grows with each connection that begins to wait, so the smallest has waited
 * longest; 0: the connection does not wait */
typedef struct { int socket; bool used; unsigned long since; } live_waiter;
typedef struct { pthread_mutex_t lock; unsigned long turn; live_waiter slots[WAITING_SLOTS]; } live_waiting;

void live_waiting_open(live_waiting *w);
void live_waiting_close(live_waiting *w); /* frees the table; called after the last connection has ended */

/* Returns an entry for a new connection, recorded as waiting. It is valid until live_waiter_end. Returns NULL if no
 * entry is free; the table then never shuts down the connection. The functions below accept NULL for c. */
live_waiter *live_waiter_begin(live_waiting *w, int socket);
void live_waiter_end(live_waiting *w, live_waiter *c);   /* frees the entry c of a connection; must be called before the
                                                          * connection's socket is closed */
void live_waiter_asked(live_waiting *w, live_waiter *c); /* records that a complete request has arrived */
void live_waiter_waits(live_waiting *w, live_waiter *c); /* records that the request is answered, so that the connection
                                                          * waits again */

#endif
