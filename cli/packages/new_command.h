/* Declares `vs new NAME`. */
#ifndef VS_CLI_PACKAGES_NEW_COMMAND_H
#define VS_CLI_PACKAGES_NEW_COMMAND_H

#include "cli/options.h"

/* Makes the folder NAME with a model, a library and its checks. */
vs_outcome cli_new_command(const cli_options *o);

/* Makes the model `path` for `vs view`, if its name ends in .vs and no file of this name exists, and says so. Otherwise
 * changes nothing: reading the file then gives the message. */
void cli_new_model(const char *path);

#endif
