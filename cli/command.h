/* Owns one run of the command: the interpreter, its options, its console. Shared by main.c (batch) and repl.c (the
   prompt). */
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
  cli_watch watch;            /* over limits that the library cannot hold */
  FILE *output;               /* where the program prints */
  bool output_failed;         /* said once */
  bool midline;               /* what was printed last did not end a line */
  int exit_code;              /* of (exit n); 0 */
  char *line; size_t line_room; /* standard input, line by line */
  const volatile sig_atomic_t *ended; /* not 0: the system wants the command to end */
  char *model;                /* the file that ,run was given; NULL: what the command line named */
  struct cli_editor *editor;  /* NULL: no prompt is being shown */
  struct live_follower *view; /* what ,view opened, or NULL */
  bool drawn;                 /* something was run since the view showed the drawing */
  unsigned stops;             /* VS_EVAL_STOP: the files that are run may stop; VS_EVAL_PASS: they do not; 0:
      they warn */
  long frame;                 /* of --frames, from 1; 0: there are none */
  int told;                   /* where the batch that this run is of hears what was read (batch/inputs_told.h); -1 */
  unsigned results;           /* values shown since the program began: the last one's name is $results */
} cli_session;

#endif
