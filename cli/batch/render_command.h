/* Declares `vs render`, which makes pictures of many models, views and sets of parameters. */
#ifndef VS_CLI_BATCH_RENDER_COMMAND_H
#define VS_CLI_BATCH_RENDER_COMMAND_H

#include <signal.h>

#include "cli/options.h"

/* Makes all pictures of the command line. The command ends when a signal sets *ended. Returns the outcome of the first
 * picture that failed, or VS_OUTCOME_DONE. */
vs_outcome cli_render_command(const cli_options *o, const volatile sig_atomic_t *ended);

#endif
