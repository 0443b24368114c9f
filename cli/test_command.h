/* Declares the command `vs test FILE...`, which runs the checks of programs. */
#ifndef VS_CLI_TEST_COMMAND_H
#define VS_CLI_TEST_COMMAND_H

#include "cli/command.h"

/* Calls `run`, which returns an exit status, for each file in a separate process. Prints the numbers of checks that
 * passed and failed. Returns 0 if none failed, otherwise 1. Returns 2 if a file could not be read, and 130 after an
 * interrupt. */
int cli_test_command(cli_options *o, const volatile sig_atomic_t *interrupts, int (*run)(cli_options *o));
/* Called in the process of a file: runs the file and its checks, and prints the results on standard output. */
vs_outcome cli_test_run(cli_session *c, vs_outcome (*run_file)(cli_session *c, const char *path, unsigned flags));

#endif
