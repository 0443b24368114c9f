/* Owns the command's messages about a run on standard error: diagnostics, the progress line, the summary,
 * statistics. */
#ifndef VS_CLI_MESSAGES_H
#define VS_CLI_MESSAGES_H

#include <stdio.h>

#include "visualscheme.h"

typedef struct {
  bool progress;      /* show the line: standard error is a terminal, and the options are not quiet */
  bool shown;         /* a progress line is on the terminal, and must be removed before other output */
  char line[200];     /* that line: the same is not printed again */
  char phase[32];     /* of the line, and its start, in seconds of a monotonic clock */
  double begun;
  size_t errors, warnings;
} cli_reporter;

void cli_report_diagnostic(cli_reporter *r, const vs_diagnostic *d);
void cli_report_progress(cli_reporter *r, const vs_progress *p);
void cli_report_settle(cli_reporter *r); /* removes the progress line */
/* Prints the place where a program is paused: the variables in scope, the line with the expression marked, and after it
 * the next call with the values of its arguments. For a value: the expression and its value. */
void cli_report_stop(cli_reporter *r, vs_scheme *scheme, const vs_stop_info *stop);
/* Prints the calls that the last error ended, innermost first, each with its parameters, a line for each call. Returns
 * false if there were none. The interpreter keeps them if vs_options.keep_calls is set. */
bool cli_report_calls(vs_scheme *scheme, FILE *to);
/* prints "house.vs: 3 solids, 4 x 5.5 x 2 m, from (0 0 0) to (4 5.5 2)" */
void cli_report_summary(const char *title, const vs_summary *s);
void cli_report_parameters(FILE *to, vs_scheme *s); /* JSON */

#endif
