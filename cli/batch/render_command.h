/* Owns `vs render`: pictures of many models, views and sets of parameters. */
#ifndef VS_CLI_BATCH_RENDER_COMMAND_H
#define VS_CLI_BATCH_RENDER_COMMAND_H

#include <signal.h>

#include "cli/options.h"

/* ended: not 0 when the command must end. Returns the outcome of the first picture that failed. */
vs_outcome cli_render_command(const cli_options *o, const volatile sig_atomic_t *ended);

#endif
