/* Declares a side of a live view: a thread with its own interpreter. While the session continues, one side makes
 * outputs of the model with other parameter values, and pictures that take minutes; another exports the current
 * model. */
#ifndef VS_LIVE_ASIDE_H
#define VS_LIVE_ASIDE_H

#include <pthread.h>

#include "live/live_options.h"
#include "live/published.h"
#include "live/said.h"

typedef struct {
  const live_options *options;
  live_publish *publish;
  live_queue *queue;   /* the requests that this side handles: a member of publish */
  bool tells;          /* whether windows receive the messages of an output, as the event "messages" */
  bool writing;        /* whether the side is writing an output, so that messages are about the output */
  live_said messages;  /* messages of the output, if the side tells them */
  vs_scheme *scheme;   /* interpreter of the side, made at the first request */
  live_wish *now;
  live_text said;      /* text of the first error of the current run */
  pthread_t thread;
  bool started;
} live_aside;

/* Starts the thread; the members options, publish and queue must be set. If there is no thread, prints a message on
 * standard error and returns false. */
bool live_aside_open(live_aside *a);
/* Makes the output of the next request, which arrives within wait_ms milliseconds. Returns false if there is none. The
 * thread calls this function; without a thread the session does. */
bool live_aside_turn(live_aside *a, long wait_ms);
void live_aside_close(live_aside *a); /* Ends the thread. The caller must first set publish->ended. */

#endif
