/* Declares the options of a live view. */
#ifndef VS_LIVE_LIVE_OPTIONS_H
#define VS_LIVE_LIVE_OPTIONS_H

#include <signal.h>
#include <stdio.h>

#include "visualscheme.h"

/* The callbacks of a view of an untrusted model. Members as in vs_host; NULL: the view reads from the file system. */
typedef struct {
  void *context;
  bool (*read_file)(void *context, const char *path, char **text, size_t *length, const char **why);
  bool (*list_folder)(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                      void *to, const char **why);
  /* Confines the process, and sets limits in the interpreter's options. Called once, when the server's socket is open
   * and the browser is started, before a thread is started and before the model runs. Returns false after a message on
   * standard error. */
  bool (*confine)(void *context, vs_options *interpreter);
} live_confinement;

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
  /* Whether windows may only look: they set parameters and export, but neither change the text nor run another, and
   * start no external program. */
  bool read_only;
  live_confinement confined;
  bool open_browser;
  FILE *told;                           /* stream that receives a line with the view's address */
  const volatile sig_atomic_t *ended;   /* a value other than 0 ends the view */
  /* For a view without threads: sends the events to the window. The view calls this function during a run, too. May be
   * NULL. */
  void (*send)(void);
  /* Receives the interpreter when it is made, so that a signal can interrupt it, and NULL at the end. May be NULL. */
  void (*running)(vs_scheme *scheme);
} live_options;

/* Reads a file by the options' callback, or from the file system, as vs_host.read_file does. */
bool live_options_read(const live_options *o, const char *path, char **text, size_t *length, const char **why);
/* Lists a folder in the same way, as vs_host.list_folder does. */
bool live_options_list(const live_options *o, const char *path, bool (*take)(void *to, const char *name, size_t length),
                       void *to, const char **why);

#endif
