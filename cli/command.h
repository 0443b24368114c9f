/* Declares the state of a run of the command: the interpreter, its options and its console. main.c (batch) and repl.c
 * (the prompt) share it. */
#ifndef VS_CLI_COMMAND_H
#define VS_CLI_COMMAND_H

#include <signal.h>

#include "cli/batch/replaced.h"
#include "cli/limits.h"
#include "cli/options.h"
#include "cli/untrusted.h"
#include "cli/messages.h"

struct cli_editor; /* editor of typed lines (prompt/editor.h) */
struct live_follower; /* live view in a browser (live/live.h) */

typedef struct {
  cli_options *options;
  vs_scheme *scheme;
  cli_reporter reporter;
  cli_untrusted untrusted;    /* state of the option --untrusted */
  cli_watch watch;            /* thread that enforces the time limits which the library cannot enforce (limits.h) */
  FILE *output;               /* stream to which the program prints */
  bool output_failed;         /* whether a failure to write the output was already reported */
  bool midline;               /* whether the last printed text did not end with a line end */
  int exit_code;              /* exit code of (exit n), else 0 */
  char *line; size_t line_room; /* line of standard input that was read last */
  volatile sig_atomic_t *interrupts;  /* number of times that Ctrl-C was typed since the prompt last waited; several
                                       * times end the process */
  const volatile sig_atomic_t *ended; /* not 0 after a signal that asks the command to end */
  char *model;                /* file that the command ,run of the prompt has run; NULL: the files of the command
                               * line */
  struct cli_editor *editor;  /* line editor of the prompt, or NULL */
  struct live_follower *view; /* live view opened by ,view, or NULL */
  bool muted;                 /* whether output and messages of the program are dropped, as in trial runs */
  bool drawn;                 /* whether code has run at the prompt since the live view last showed the drawing */
  unsigned stops;             /* effect of (break) in files. VS_EVAL_STOP: the program pauses; VS_EVAL_PASS: no effect;
                               * 0: a warning */
  long frame;                 /* number of the current frame from 1; 0 without --frames */
  cli_replaced replaced;      /* files that earlier frames have replaced */
  char **outputs; size_t output_count, output_room; /* with -d: the paths of the outputs (dependencies.h) */
  int told;                   /* descriptor of the file for the names of files that this run reads, if `vs render` has
                               * started it (batch/inputs_told.h); otherwise -1 */
  unsigned results;           /* number of values printed since the program began; $results is the name of the last
                               * value */
} cli_session;

#endif
