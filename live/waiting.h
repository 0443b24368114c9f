/* Owns which connections have no whole request: a client that sends a byte a second is never silent, and some dozens of
 * them would leave no connection to anybody else. When more than WAITING_MOST wait, the one that has waited longest
 * is shut. */
#ifndef VS_LIVE_WAITING_H
#define VS_LIVE_WAITING_H

#include <pthread.h>
#include <stdbool.h>

enum { WAITING_MOST = 12, WAITING_SLOTS = 64 }; /* slots: more than there may be connections */

/* since: its turn among those that wait; 0: it does not */
typedef struct { int socket; bool used; unsigned long since; } live_waiter;
typedef struct { pthread_mutex_t lock; unsigned long turn; live_waiter slots[WAITING_SLOTS]; } live_waiting;

void live_waiting_open(live_waiting *w);
void live_waiting_close(live_waiting *w); /* when no connection is left */

/* Returns a connection that waits, until live_waiter_end; NULL where no slot is left, and it is not bound.
 * c may be NULL in the others. */
live_waiter *live_waiter_begin(live_waiting *w, int socket);
void live_waiter_end(live_waiting *w, live_waiter *c);   /* before the socket is closed */
void live_waiter_asked(live_waiting *w, live_waiter *c); /* a whole request has come */
void live_waiter_waits(live_waiting *w, live_waiter *c); /* its request was answered */

#endif
