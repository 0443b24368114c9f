/* Owns the side of a live view: a thread with its own interpreter. It makes outputs of the model with other parameter
 * values, and pictures that take minutes, while the session continues. */
#ifndef VS_LIVE_ASIDE_H
#define VS_LIVE_ASIDE_H

#include <pthread.h>

#include "live/live_options.h"
#include "live/published.h"

typedef struct {
  const live_options *options;
  live_publish *publish;
  vs_scheme *scheme;   /* made at the first request */
  live_wish *now;
  live_text said;      /* the first error of the current run */
  pthread_t thread;
  bool started;
} live_aside;

bool live_aside_open(live_aside *a);  /* Needs options and publish set. Returns false, after a message on standard
                                       * error, if there is no thread. */
void live_aside_close(live_aside *a); /* The caller sets publish->ended first. */

#endif
