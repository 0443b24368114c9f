/* Declares the options of a live view. */
#ifndef VS_LIVE_LIVE_OPTIONS_H
#define VS_LIVE_LIVE_OPTIONS_H

#include <signal.h>
#include <stdio.h>

#include "visualscheme.h"

typedef struct live_options {
  const char *model;                    /* path of the file to show */
  vs_options interpreter;               /* options of the interpreter; the view replaces the callbacks in their member
                                         * host */
  vs_output_options output;             /* tolerance, segments and passes of the view */
  const char *const *parameters;        /* array of parameter_count texts NAME=VALUE, set before the first run */
  size_t parameter_count;
  /* Writes the findings of a check in a text that replaces the model's, as vs check --json does. Any thread may call
   * this function. It returns false if memory is out. NULL: texts are not checked. */
  bool (*check)(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to);
  bool open_browser;
  FILE *told;                           /* stream that receives a line with the view's address */
  const volatile sig_atomic_t *ended;   /* a value other than 0 ends the view */
  /* For a view without threads: sends the events to the window. The view calls this function during a run, too. May be
   * NULL. */
  void (*send)(void);
  /* Receives the interpreter when it is made, so that a signal can interrupt it, and NULL at the end. May be NULL. */
  void (*running)(vs_scheme *scheme);
} live_options;

#endif
