/* Declares `vs lsp`. */
#ifndef VS_CLI_LSP_LANGUAGE_SERVER_H
#define VS_CLI_LSP_LANGUAGE_SERVER_H

#include "cli/options.h"

/* Answers the messages of an editor on standard input until it says `exit`, or until the input ends. run: runs a
 * command of vs, and returns its exit code. */
vs_outcome cli_language_server(const cli_options *o, int (*run)(int argc, char **argv));

#endif
