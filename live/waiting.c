/* Implements the table of the connections that wait for their clients. */
#include "live/waiting.h"

#include <stddef.h>
#include <sys/socket.h>

void live_waiting_open(live_waiting *w) {
  *w = (live_waiting){ 0 };
  pthread_mutex_init(&w->lock, NULL);
}

void live_waiting_close(live_waiting *w) { pthread_mutex_destroy(&w->lock); }

static void waits(live_waiting *w, live_waiter *c) { /* Records that connection c waits for its client. The caller must
                                                      * hold the lock. */
  live_waiter *longest = c;
  int count = 0;
  c->since = ++w->turn;
  for (int i = 0; i < WAITING_SLOTS; i++) {
    if (w->slots[i].since == 0) continue;
    count++;
    if (w->slots[i].since < longest->since) longest = &w->slots[i];
  }
  if (count <= WAITING_MOST) return;
  longest->since = 0;
  shutdown(longest->socket, SHUT_RDWR); /* shuts down the connection that has waited longest; the thread of that
                                         * connection then reads an end of the stream, and closes the connection */
}

live_waiter *live_waiter_begin(live_waiting *w, int socket) {
  live_waiter *c = NULL;
  pthread_mutex_lock(&w->lock);
  for (int i = 0; i < WAITING_SLOTS && c == NULL; i++)
    if (!w->slots[i].used) c = &w->slots[i];
  if (c != NULL) {
    *c = (live_waiter){ .socket = socket, .used = true };
    waits(w, c);
  }
  pthread_mutex_unlock(&w->lock);
  return c;
}

void live_waiter_end(live_waiting *w, live_waiter *c) {
  if (c == NULL) return;
  pthread_mutex_lock(&w->lock);
  *c = (live_waiter){ 0 };
  pthread_mutex_unlock(&w->lock);
}

void live_waiter_asked(live_waiting *w, live_waiter *c) {
  if (c == NULL) return;
  pthread_mutex_lock(&w->lock);
  c->since = 0;
  pthread_mutex_unlock(&w->lock);
}

void live_waiter_waits(live_waiting *w, live_waiter *c) {
  if (c == NULL) return;
  pthread_mutex_lock(&w->lock);
  waits(w, c);
  pthread_mutex_unlock(&w->lock);
}
