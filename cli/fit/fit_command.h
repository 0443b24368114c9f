/* Owns `vs fit MODEL SCAN`. */
#ifndef VS_CLI_FIT_FIT_COMMAND_H
#define VS_CLI_FIT_FIT_COMMAND_H

#include "cli/command.h"

/* Fits the model to the scan, prints the result on standard output, and writes the maps of -o. Also prints the best
 * result of an interrupted or untrusted fit; the outcome tells which. */
vs_outcome cli_fit(cli_session *c);

#endif
