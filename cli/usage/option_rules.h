/* Declares the check of a whole command line. */
#ifndef VS_CLI_USAGE_OPTION_RULES_H
#define VS_CLI_USAGE_OPTION_RULES_H

#include "cli/options.h"

/* Returns true if the options, the files and the command go together; completes *o with formats, folders of libraries
 * and the words of the program. argv: the words of the command line. Otherwise prints a message on standard error. */
bool cli_options_fit(cli_options *o, char **argv);

#endif
