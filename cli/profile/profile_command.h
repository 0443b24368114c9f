/* Declares `vs profile FILE`. */
#ifndef VS_CLI_PROFILE_PROFILE_COMMAND_H
#define VS_CLI_PROFILE_PROFILE_COMMAND_H

#include "cli/command.h"

/* Prints the samples of the run that has ended, as a table or as JSON, and writes the flame graph that -o names. */
vs_outcome cli_profile(cli_session *c);

#endif
