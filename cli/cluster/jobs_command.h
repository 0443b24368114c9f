/* Declares `vs jobs`, which lists, cancels, repeats and joins batches that run elsewhere (--on). */
#ifndef VS_CLI_CLUSTER_JOBS_COMMAND_H
#define VS_CLI_CLUSTER_JOBS_COMMAND_H

#include <signal.h>

#include "cli/options.h"

vs_outcome cli_jobs_command(const cli_options *o, const volatile sig_atomic_t *ended);

#endif
