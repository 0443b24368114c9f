/* Owns the side of a live view: a thread with an interpreter of its own, which makes outputs of the model with other
 * values of its parameters, and pictures that take minutes, while the session goes on. */
#ifndef VS_LIVE_ASIDE_H
#define VS_LIVE_ASIDE_H

#include <pthread.h>

#include "live/live_options.h"
#include "live/published.h"

typedef struct {
  const live_options *options;
  live_publish *publish;
  vs_scheme *scheme;   /* made when it is first wanted */
  live_wish *now;
  live_text said;      /* the first error of what runs */
  pthread_t thread;
  bool started;
} live_aside;

bool live_aside_open(live_aside *a);  /* options and publish are set; false: no thread, standard error has been told */
void live_aside_close(live_aside *a); /* publish->ended is set before */

#endif
