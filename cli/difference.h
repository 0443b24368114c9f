/* Owns `vs diff A B`. */
#ifndef VS_CLI_DIFFERENCE_H
#define VS_CLI_DIFFERENCE_H

#include "cli/command.h"

/* Runs both models that the command line names, in one interpreter, and prints what differs between them: parameters,
 * parts, volume, bounds. Returns VS_OUTCOME_DONE; the session's exit code is then 0 where nothing differs and 1 where
 * something does. Outputs that are written next may show the change (vs_output_options.change, which it sets). */
vs_outcome cli_difference(cli_session *c);
/* The line of a part that differs, on standard output. */
void cli_difference_print(vs_part_difference what, const vs_part_info *before, const vs_part_info *after);

#endif
