/* Owns the interface of test_command.c: `vs test FILE...`. */
#ifndef VS_CLI_TEST_COMMAND_H
#define VS_CLI_TEST_COMMAND_H

#include "cli/command.h"

/* Runs each file by `run`, which returns its exit code, in a separate process; prints how many checks passed and
 * failed. Returns 0 if none failed, else 1; 2 if a file could not be read, 130 after an interrupt. */
int cli_test_command(cli_options *o, const volatile sig_atomic_t *interrupts, int (*run)(cli_options *o));
/* In that process: runs the file and its checks, and prints results on standard output. */
vs_outcome cli_test_run(cli_session *c, vs_outcome (*run_file)(cli_session *c, const char *path, unsigned flags));

#endif
