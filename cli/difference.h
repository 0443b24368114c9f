/* Declares `vs diff A B`, which compares two models. */
#ifndef VS_CLI_DIFFERENCE_H
#define VS_CLI_DIFFERENCE_H

#include "cli/command.h"

/* Runs both models of the command line in one interpreter. Prints their differences in parameters, parts, volume and
 * bounds. Returns VS_OUTCOME_DONE if that succeeded; the session's exit code is then 0 if there are no differences,
 * otherwise 1. Sets vs_output_options.change, so that later outputs show the differences. */
vs_outcome cli_difference(cli_session *c);
/* Prints the line of a part that differs. */
void cli_difference_print(vs_part_difference what, const vs_part_info *before, const vs_part_info *after);

#endif
