/* Owns `vs diff A B`. */
#ifndef VS_CLI_DIFFERENCE_H
#define VS_CLI_DIFFERENCE_H

#include "cli/command.h"

/* Runs both models of the command line in one interpreter, and prints the differences: parameters, parts, volume,
 * bounds. Returns VS_OUTCOME_DONE; the session's exit code is then 0 if there are none, else 1. Later outputs may show
 * the change (vs_output_options.change, which this sets). */
vs_outcome cli_difference(cli_session *c);
/* Prints the line of a part that differs. */
void cli_difference_print(vs_part_difference what, const vs_part_info *before, const vs_part_info *after);

#endif
