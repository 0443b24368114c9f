/* Owns a run of the command: the interpreter, its options, its console. main.c (batch) and repl.c (the prompt) share
 * it. */
#ifndef VS_CLI_COMMAND_H
#define VS_CLI_COMMAND_H

#include <signal.h>

#include "cli/limits.h"
#include "cli/options.h"
#include "cli/untrusted.h"
#include "cli/messages.h"

struct cli_editor; /* repl.c: line editing */
struct live_follower; /* live/live.h */

typedef struct {
  cli_options *options;
  vs_scheme *scheme;
  cli_reporter reporter;
  cli_untrusted untrusted;    /* with --untrusted */
  cli_watch watch;            /* for limits that the library cannot enforce */
  FILE *output;               /* for the program's output */
  bool output_failed;         /* reported once */
  bool midline;               /* the last output did not end a line */
  int exit_code;              /* of (exit n); 0 */
  char *line; size_t line_room; /* standard input, line by line */
  const volatile sig_atomic_t *ended; /* not 0: the system asks the command to end */
  char *model;                /* the file of ,run; NULL: the command line's */
  struct cli_editor *editor;  /* NULL: there is no prompt */
  struct live_follower *view; /* opened by ,view, or NULL */
  bool drawn;                 /* some code has run since the view showed the drawing */
  unsigned stops;             /* VS_EVAL_STOP: (break) pauses the files that run; VS_EVAL_PASS: it does nothing; 0: it
                               * warns */
  long frame;                 /* of --frames, from 1; 0: none */
  int told;                   /* the list for the batch of this run (batch/inputs_told.h); -1: none */
  unsigned results;           /* the number of printed values since the program began: the last one's name is
                               * $results */
} cli_session;

#endif
