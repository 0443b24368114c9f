/* Declares `vs format FILE...`. */
#ifndef VS_CLI_FORMAT_COMMAND_H
#define VS_CLI_FORMAT_COMMAND_H

#include "cli/options.h"

/* Rewrites the files in one style. With --check, only prints the names of files that are not in this style. Returns the
 * first failure; for a file that is not in this style, VS_OUTCOME_MODEL. */
vs_outcome cli_format_command(const cli_options *o);

#endif
