/* Owns the live view's interface: one call that serves a model until it is ended. A client of visualscheme.h alone.
 *
 * live.c: the session, which evaluates in the calling thread; aside.c: a second interpreter in a thread of its own, for outputs with
 * other values; publish.c: what windows are told, under one lock; serve.c: HTTP, a thread a
 * connection; http.c: libmicrohttpd, loaded when the first view opens; chunks.c: a scene in pieces, so that only what changed travels;
 * scene_host.c: the program's scene, its frames and gizmos; files.c: reading, watching and writing the model's files. */
#ifndef VS_LIVE_H
#define VS_LIVE_H

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
  void (*running)(vs_scheme *scheme);          /* told of the interpreter, so that a signal can interrupt it; NULL at the end; may be NULL itself */
} live_options;

/* Shows the model until *ended is set. Returns VS_OUTCOME_DONE then; VS_OUTCOME_USAGE: the model cannot be read; VS_OUTCOME_WORKER: no libmicrohttpd;
 * VS_OUTCOME_MACHINE: no memory or no port. What failed has been said on standard error. */
vs_outcome live_view(const live_options *o);

#endif
