/* Declares functions that append to cli_options.library_path. */
#ifndef VS_CLI_USAGE_LIBRARY_FOLDERS_H
#define VS_CLI_USAGE_LIBRARY_FOLDERS_H

#include "cli/options.h"

/* Appends folders, separated by ':', to o->library_path. Returns false after a message when memory is out. */
bool cli_add_folders(cli_options *o, const char *folders);
/* Appends the folder of packages that belongs to the first program. Returns false after a message if a package differs
 * from its record in vs.lock. */
bool cli_add_packages(cli_options *o);

#endif
