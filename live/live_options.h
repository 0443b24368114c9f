/* Owns what a live view is opened with. */
#ifndef VS_LIVE_LIVE_OPTIONS_H
#define VS_LIVE_LIVE_OPTIONS_H

#include <signal.h>
#include <stdio.h>

#include "visualscheme.h"

typedef struct live_options {
  const char *model;                    /* the file that is shown */
  vs_options interpreter;               /* its host is replaced by the view's own */
  vs_output_options output;             /* tolerance, segments, passes of what is shown */
  const char *const *parameters;        /* NAME=VALUE, set before the first run */
  size_t parameter_count;
  /* Writes what looks wrong in a text that stands in place of the model's, as vs check --json does; called by any
   * thread. NULL: nobody checks. False: out of memory. */
  bool (*check)(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to);
  bool open_browser;
  FILE *told;                           /* gets the address, a line */
  const volatile sig_atomic_t *ended;   /* not 0: end */
  /* told of the interpreter, so that a signal can interrupt it; NULL at the end; may be NULL itself */
  void (*running)(vs_scheme *scheme);
} live_options;

#endif
