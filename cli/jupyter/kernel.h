/* Declares the kernel of a notebook. */
#ifndef VS_CLI_JUPYTER_KERNEL_H
#define VS_CLI_JUPYTER_KERNEL_H

#include <signal.h>

#include "cli/options.h"

/* Runs cells until the notebook ends the kernel. *interrupts counts the user's interrupts; *ended is set by a signal
 * that ends the kernel. */
vs_outcome kernel_run(const cli_options *o, const char *connection_file, const volatile sig_atomic_t *interrupts,
                      const volatile sig_atomic_t *ended);

#endif
