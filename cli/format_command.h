/* Declares `vs format FILE...`. */
#ifndef VS_CLI_FORMAT_COMMAND_H
#define VS_CLI_FORMAT_COMMAND_H

#include "cli/options.h"

/* Rewrites the files in one style, or, with --check, prints the names of files that differ from it. Returns the first
 * failure; a file that differs is VS_OUTCOME_MODEL. */
vs_outcome cli_format_command(const cli_options *o);

#endif
