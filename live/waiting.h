/* Declares the table of the connections whose request is incomplete. A client that sends a byte each second is never
 * silent, so a few dozen such clients would use up all connections. When more than WAITING_MOST wait, the table shuts
 * down the connection that has waited longest. */
#ifndef VS_LIVE_WAITING_H
#define VS_LIVE_WAITING_H

#include <pthread.h>
#include <stdbool.h>

enum { WAITING_MOST = 12, WAITING_SLOTS = 64 }; /* WAITING_MOST: greatest number of connections that may wait;
                                                 * WAITING_SLOTS: number of entries, more than the greatest number of
                                                 * connections */

/* An entry of the table. since: number of the turn in which the connection began to wait; 0: it does not wait */
typedef struct { int socket; bool used; unsigned long since; } live_waiter;
typedef struct { pthread_mutex_t lock; unsigned long turn; live_waiter slots[WAITING_SLOTS]; } live_waiting;

void live_waiting_open(live_waiting *w);
void live_waiting_close(live_waiting *w); /* frees the table; called after the last connection has ended */

/* Returns an entry for a connection that waits, valid until live_waiter_end. Returns NULL if no entry is free; the
 * connection then has no limit. The functions below accept NULL for c. */
live_waiter *live_waiter_begin(live_waiting *w, int socket);
void live_waiter_end(live_waiting *w, live_waiter *c);   /* ends the entry; call it before the socket is closed */
void live_waiter_asked(live_waiting *w, live_waiter *c); /* records that a complete request has arrived */
void live_waiter_waits(live_waiting *w, live_waiter *c); /* records that the request is answered, so that the connection
                                                          * waits again */

#endif
