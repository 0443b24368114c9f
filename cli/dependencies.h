/* Declares the option -d, which writes the files that the outputs depend on as a rule for make. */
#ifndef VS_CLI_DEPENDENCIES_H
#define VS_CLI_DEPENDENCIES_H

#include "cli/command.h"

/* Records the path of an output of the run. Returns false after a message when memory is out. */
bool cli_dependencies_add(cli_session *c, const char *output);
/* Writes the rule into the file of -d: the recorded outputs depend on all files that the interpreter has read. Does
 * nothing without -d. Returns false after a message. */
bool cli_dependencies_write(cli_session *c);
void cli_dependencies_free(cli_session *c);

#endif
