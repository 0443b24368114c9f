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
  bool tells;          /* whether the side sends the messages of an output to the windows, as the event "messages" */
  bool writing;        /* whether an output is being written, so that new messages concern this output */
  live_said messages;  /* messages of the output, if the member `tells` is true */
  vs_scheme *scheme;   /* interpreter of the side, made at the first request */
  live_wish *now;
  live_text said;      /* text of the first error in the current run of the model */
  pthread_t thread;
  bool started;
} live_aside;

/* Starts the thread; the members options, publish and queue must be set. If there is no thread, prints a message on
 * standard error and returns false. */
bool live_aside_open(live_aside *a);
/* Makes the output for the next request. Returns false if no request arrives within wait_ms milliseconds. The side's
 * thread calls this function; in a view without threads, the session calls it. */
bool live_aside_turn(live_aside *a, long wait_ms);
/* Sets the members of *o that the text describes, a picture: "WIDTHxHEIGHT QUALITY EYE TARGET LENS". Items at the end
 * may be missing. */
void live_aside_picture(const char *text, vs_output_options *o);
void live_aside_close(live_aside *a); /* Ends the thread. The caller must first set publish->ended. */

#endif
