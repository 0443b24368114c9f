/* Declares `vs add`. */
#ifndef VS_CLI_PACKAGES_ADD_COMMAND_H
#define VS_CLI_PACKAGES_ADD_COMMAND_H

#include "cli/options.h"

/* Adds the packages of the command line, and the packages that they need, to the current folder. Without names, fetches
 * the packages of vs.lock that are missing or have changed. */
vs_outcome cli_add_command(const cli_options *o);

#endif
