/* Declares the messages about a run on standard error: errors and warnings, the progress line, the summary,
 * statistics. */
#ifndef VS_CLI_MESSAGES_H
#define VS_CLI_MESSAGES_H

#include <stdio.h>

#include "visualscheme.h"

typedef struct {
  bool progress;      /* whether to show a progress line: standard error is a terminal, and the options are not quiet */
  bool quiet;         /* whether to omit notes */
  bool shown;         /* whether the terminal shows a progress line, which must be removed before other output */
  char line[200];     /* text of the shown progress line; an equal line is not printed again */
  char phase[32];     /* name of the current phase, and its start in seconds of monotonic time */
  double begun;
  size_t errors, warnings;
} cli_reporter;

void cli_report_diagnostic(cli_reporter *r, const vs_diagnostic *d);
void cli_report_progress(cli_reporter *r, const vs_progress *p);
void cli_report_settle(cli_reporter *r); /* Removes the progress line from the terminal. */
/* Prints the place where a program is paused: the variables in scope, and the line with the expression marked. Then
 * prints the next call with the values of its arguments, or the value of the expression. */
void cli_report_stop(cli_reporter *r, vs_scheme *scheme, const vs_stop_info *stop);
/* Prints the calls that led to the last error, innermost first, each on a line with its arguments. Returns false if
 * there are none. The interpreter records them only if vs_options.keep_calls is set. */
bool cli_report_calls(vs_scheme *scheme, FILE *to);
/* Prints a summary of the drawing, such as "house.vs: 3 solids, 4 x 5.5 x 2 m, from (0 0 0) to (4 5.5 2)". */
void cli_report_summary(const char *title, const vs_summary *s);
void cli_report_parameters(FILE *to, vs_scheme *s); /* Prints the parameters as JSON. */

#endif
