/* Declares `vs sweep`, which runs a model with many sets of parameters. */
#ifndef VS_CLI_SWEEP_SWEEP_COMMAND_H
#define VS_CLI_SWEEP_SWEEP_COMMAND_H

#include <signal.h>

#include "cli/options.h"

/* Runs the model for each set, each in a process that calls `run`. *ended is not 0 when the command must end. Returns
 * the outcome of the first part that failed, or VS_OUTCOME_DONE. */
vs_outcome cli_sweep_command(const cli_options *o, const volatile sig_atomic_t *ended, int (*run)(cli_options *o));

/* In the process of a part: sends the numbers that the model reported. */
void cli_sweep_tell(int to, const vs_scheme *s);
/* In the process of a part: sends that the model lacks a parameter of the set. Other parts would have this error,
 * too. */
void cli_sweep_tell_unknown(int to);

#endif
