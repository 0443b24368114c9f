/* Declares the command `vs sunstudy`, which computes the hours of sun on a model. */
#ifndef VS_CLI_LIGHT_SUN_COMMAND_H
#define VS_CLI_LIGHT_SUN_COMMAND_H

#include "cli/command.h"

/* Computes the study for the drawing of the model, which has run. Returns the exit code. */
vs_outcome cli_sun_command(cli_session *c);
/* Reads the place, the date and the hours from the command line. Returns false after a message on standard error. */
bool cli_sun_options(const cli_options *o, vs_sun_span *out);

#endif
