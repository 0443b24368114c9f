/* Declares the check of a command's files. */
#ifndef VS_CLI_USAGE_COMMAND_FILES_H
#define VS_CLI_USAGE_COMMAND_FILES_H

#include "cli/options.h"

/* Returns true if the command has the files that it requires, and no -o unless it writes a file. Otherwise prints a
 * message on standard error. */
bool cli_command_files(const cli_options *o, unsigned takes);

#endif
