/* Owns the connections without a whole request. A client that sends a byte each second is never silent, so some dozens
 * of them would use up all connections. When more than WAITING_MOST wait, the table shuts the one that has waited
 * longest. */
#ifndef VS_LIVE_WAITING_H
#define VS_LIVE_WAITING_H

#include <pthread.h>
#include <stdbool.h>

enum { WAITING_MOST = 12, WAITING_SLOTS = 64 }; /* slots: more than the most connections */

/* since: its turn among those that wait; 0: it does not wait */
typedef struct { int socket; bool used; unsigned long since; } live_waiter;
typedef struct { pthread_mutex_t lock; unsigned long turn; live_waiter slots[WAITING_SLOTS]; } live_waiting;

void live_waiting_open(live_waiting *w);
void live_waiting_close(live_waiting *w); /* after the last connection */

/* Returns a place for a connection that waits, valid until live_waiter_end; NULL if no slot is free, so that it has no
 * limit. The functions below accept c NULL. */
live_waiter *live_waiter_begin(live_waiting *w, int socket);
void live_waiter_end(live_waiting *w, live_waiter *c);   /* before the socket is closed */
void live_waiter_asked(live_waiting *w, live_waiter *c); /* a whole request has arrived */
void live_waiter_waits(live_waiting *w, live_waiter *c); /* its request is answered */

#endif
