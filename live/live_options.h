/* Declares the options of a live view. */
#ifndef VS_LIVE_LIVE_OPTIONS_H
#define VS_LIVE_LIVE_OPTIONS_H

#include <signal.h>
#include <stdio.h>

#include "visualscheme.h"

/* The callbacks for a view of an untrusted model. The members for files have the meaning that they have in vs_host; if
 * they are NULL, the view reads from the file system. */
typedef struct {
  void *context;
  bool (*read_file)(void *context, const char *path, char **text, size_t *length, const char **why);
  bool (*list_folder)(void *context, const char *path, bool (*take)(void *to, const char *name, size_t length),
                      void *to, const char **why);
  /* Restricts the process's rights, and sets limits in the interpreter's options. The view calls it once, when the
   * server's socket is open and the browser is started, before it starts threads or runs the model. Returns false after
   * a message on standard error. */
  bool (*confine)(void *context, vs_options *interpreter);
} live_confinement;

typedef struct live_options {
  const char *model;                    /* path of the file to show */
  vs_options interpreter;               /* options of the interpreter; the view replaces the callbacks in their member
                                         * host */
  vs_output_options output;             /* tolerance, segments and passes of the view */
  const char *const *parameters;        /* array of parameter_count texts NAME=VALUE, set before the first run */
  size_t parameter_count;
  /* Checks a text that replaces the model's text, and writes the findings as `vs check --json` does. Any thread may
   * call this function. It returns false if memory is out. If it is NULL, texts are not checked. */
  bool (*check)(const vs_options *interpreter, const char *path, const char *text, size_t length, FILE *to);
  /* Whether windows cannot edit the model. They can set parameters and export, but cannot change the model's text, run
   * another text, or start an external program. */
  bool read_only;
  live_confinement confined;
  bool open_browser;
  FILE *told;                           /* stream to which the view prints its address */
  const volatile sig_atomic_t *ended;   /* a value other than 0 ends the view */
  /* For a view without threads: sends the events to the window. The view calls this function during a run, too. May be
   * NULL. */
  void (*send)(void);
  /* Called with the interpreter when it is made, so that a signal handler can interrupt it, and with NULL at the end of
   * the view. May be NULL. */
  void (*running)(vs_scheme *scheme);
} live_options;

/* Reads a file with the options' callback if there is one, otherwise from the file system. The results are those of
 * vs_host.read_file. */
bool live_options_read(const live_options *o, const char *path, char **text, size_t *length, const char **why);
/* Lists a folder with the options' callback if there is one, otherwise from the file system. The results are those of
 * vs_host.list_folder. */
bool live_options_list(const live_options *o, const char *path, bool (*take)(void *to, const char *name, size_t length),
                       void *to, const char **why);

#endif
