/* Declares --watch: a command that runs again when a file that it has read changes. */
#ifndef VS_CLI_BATCH_WATCH_H
#define VS_CLI_BATCH_WATCH_H

#include <signal.h>

#include "cli/options.h"

/* Runs the words, without --watch, in a process that calls `run`; and again after each change of a file that the run
 * has read, until *ended is set. Returns the exit code: that of the run if it has read no file. */
int cli_watch_files(const cli_options *o, const volatile sig_atomic_t *ended, char **words,
                    int (*run)(int argc, char **argv));

#endif
