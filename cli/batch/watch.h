/* Declares --watch: a command that runs again when a file that it has read changes. */
#ifndef VS_CLI_BATCH_WATCH_H
#define VS_CLI_BATCH_WATCH_H

#include <signal.h>

#include "cli/options.h"

/* Runs the command without --watch, in a process that calls `run`. Repeats this after each change of a file that the
 * run has read, until *ended is set. Returns the exit code. */
int cli_watch_files(const cli_options *o, const volatile sig_atomic_t *ended, char **words,
                    int (*run)(int argc, char **argv));

#endif
