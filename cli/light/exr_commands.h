/* Declares the commands on EXR pictures. */
#ifndef VS_CLI_LIGHT_EXR_COMMANDS_H
#define VS_CLI_LIGHT_EXR_COMMANDS_H

#include "cli/options.h"

/* Runs the command o->command: vs tone, falsecolor, pick, compare or denoise. Returns the exit code. */
vs_outcome cli_exr_command(const cli_options *o);

#endif
