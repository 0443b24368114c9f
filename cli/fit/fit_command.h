/* Declares the command `vs fit MODEL SCAN`, which fits parameters of a model to a scan. */
#ifndef VS_CLI_FIT_FIT_COMMAND_H
#define VS_CLI_FIT_FIT_COMMAND_H

#include "cli/command.h"

/* Fits the model to the scan, prints the result on standard output, and writes the pictures of -o. Also prints the best
 * result of a fit that was interrupted or is doubtful; the returned outcome distinguishes these cases. */
vs_outcome cli_fit(cli_session *c);

#endif
