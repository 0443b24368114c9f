/* Declares `vs new NAME`. */
#ifndef VS_CLI_PACKAGES_NEW_COMMAND_H
#define VS_CLI_PACKAGES_NEW_COMMAND_H

#include "cli/options.h"

/* Makes the folder NAME with a model, a library and its checks. */
vs_outcome cli_new_command(const cli_options *o);

#endif
