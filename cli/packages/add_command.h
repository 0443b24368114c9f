/* Declares `vs add`. */
#ifndef VS_CLI_PACKAGES_ADD_COMMAND_H
#define VS_CLI_PACKAGES_ADD_COMMAND_H

#include "cli/options.h"

/* Adds the packages that the command line names to the present folder, with those that they need; without names,
 * fetches those of vs.lock that are missing or have changed. */
vs_outcome cli_add_command(const cli_options *o);

#endif
