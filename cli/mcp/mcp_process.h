/* Declares the run of a command in a process of its own, while further messages of the client may arrive. */
#ifndef VS_CLI_MCP_MCP_PROCESS_H
#define VS_CLI_MCP_MCP_PROCESS_H

#include <signal.h>

#include "cli/json_data.h"
#include "cli/options.h"

enum { MCP_CANCELLED = -1, MCP_NO_PROCESS = -2, MCP_CRASHED = -3, MCP_TOO_LONG = -4 };

typedef struct {
  int (*run)(int argc, char **argv); /* a function that runs a command of vs and returns its exit code */
  cli_data_reader *json;
  char *input; size_t input_count, input_room, input_taken; /* bytes of standard input that are not handled yet */
  bool ended;             /* whether standard input has ended */
  const volatile sig_atomic_t *interrupts; /* not 0 after a signal that asks the server to end */
  cli_data id;            /* the id of the request that is being answered */
} mcp_process;

/* Returns the next line of standard input without its end, or NULL at the end of the input or when memory is out. The
 * line is valid until the next call. */
char *mcp_next_line(mcp_process *p, size_t *length);

/* The words of a command, and the text that it prints. */
typedef struct {
  const char *words[128]; size_t count;
  const char *folder;     /* the folder in which the command runs; NULL: the folder in which vs mcp runs */
  bool reads_only;        /* whether the command may only read files in `folder`; otherwise the option --untrusted
                           * confines it */
  char *said; size_t said_count, said_room;
} mcp_command;

void mcp_word(mcp_command *c, const char *word);
/* Runs the command, and reads the output of both of its streams. Returns its exit code, or one of the negative
 * numbers above. A notice of the client that cancels the request ends the command. */
int mcp_run_command(mcp_process *p, mcp_command *c);
void mcp_command_free(mcp_command *c);

#endif
