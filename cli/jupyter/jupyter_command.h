/* Declares `vs jupyter`. */
#ifndef VS_CLI_JUPYTER_JUPYTER_COMMAND_H
#define VS_CLI_JUPYTER_JUPYTER_COMMAND_H

#include <signal.h>

#include "cli/options.h"

/* With a connection file: runs the kernel of a notebook. Without one: describes the kernel to Jupyter, in the user's
 * folder of kernels. */
vs_outcome cli_jupyter_command(const cli_options *o, const volatile sig_atomic_t *interrupts,
                               const volatile sig_atomic_t *ended);

#endif
