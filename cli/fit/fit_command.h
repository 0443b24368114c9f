/* Owns `vs fit MODEL SCAN`. */
#ifndef VS_CLI_FIT_FIT_COMMAND_H
#define VS_CLI_FIT_FIT_COMMAND_H

#include "cli/command.h"

/* Fits the model to the scan, prints what was found on standard output, and writes the maps of -o. The best so far of a
 * fit that was stopped, or of one that is none, is printed too, and the outcome says which. */
vs_outcome cli_fit(cli_session *c);

#endif
