/* Declares `vs profile FILE`. */
#ifndef VS_CLI_PROFILE_PROFILE_COMMAND_H
#define VS_CLI_PROFILE_PROFILE_COMMAND_H

#include "cli/command.h"

/* Starts the profiler, and with --coverage the counting of forms. */
void cli_profile_begin(cli_session *c);
/* Prints the samples or the counts of the run that has ended, as a table or as JSON. Writes the flame graph that -o
 * names. whole: whether the run went to the end of the program. */
vs_outcome cli_profile(cli_session *c, bool whole);

#endif
