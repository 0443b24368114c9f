/* Declares `vs mcp`. */
#ifndef VS_CLI_MCP_MCP_SERVER_H
#define VS_CLI_MCP_MCP_SERVER_H

#include <signal.h>

#include "cli/options.h"

/* Answers the messages of an assistant on standard input until the input ends, or until *interrupts is set. run: runs a
 * command of vs, and returns its exit code. */
vs_outcome cli_mcp_server(const cli_options *o, const volatile sig_atomic_t *interrupts,
                          int (*run)(int argc, char **argv));

#endif
