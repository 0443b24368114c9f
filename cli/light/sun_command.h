/* Owns `vs sunstudy`. */
#ifndef VS_CLI_LIGHT_SUN_COMMAND_H
#define VS_CLI_LIGHT_SUN_COMMAND_H

#include "cli/command.h"

/* Studies the drawing of the model, which has run. Returns the exit code. */
vs_outcome cli_sun_command(cli_session *c);
/* Reads the command line's place, day and hours. Returns false after a message on standard error. */
bool cli_sun_options(const cli_options *o, vs_sun_span *out);

#endif
