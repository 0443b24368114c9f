/* Owns the commands on EXR pictures. */
#ifndef VS_CLI_LIGHT_EXR_COMMANDS_H
#define VS_CLI_LIGHT_EXR_COMMANDS_H

#include "cli/options.h"

/* Runs vs tone, vs falsecolor, vs pick, vs compare or vs denoise, by o->command. Returns the exit code. */
vs_outcome cli_exr_command(const cli_options *o);

#endif
