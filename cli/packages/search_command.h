/* Declares `vs search WORD`. */
#ifndef VS_CLI_PACKAGES_SEARCH_COMMAND_H
#define VS_CLI_PACKAGES_SEARCH_COMMAND_H

#include "cli/options.h"

/* Prints the packages of the index whose names or descriptions contain all words of the command line. */
vs_outcome cli_search_command(const cli_options *o);

#endif
