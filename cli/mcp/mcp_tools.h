/* Declares the tools that `vs mcp` offers to an assistant. */
#ifndef VS_CLI_MCP_MCP_TOOLS_H
#define VS_CLI_MCP_MCP_TOOLS_H

#include "cli/mcp/mcp_process.h"

typedef struct {
  mcp_process process;       /* the server's standard input, and the function that runs commands */
  const cli_options *options;
  char *folder;              /* path of a private folder, which contains the program and its pictures */
  char *model;               /* the file of the last program, in `folder` or in the folder of vs mcp; NULL: none yet */
  bool own;                  /* whether the last program's file is in the private folder */
} mcp_desk;

/* Makes the private folder. Returns false after a message on standard error if it cannot be made. */
bool mcp_desk_open(mcp_desk *d, const cli_options *o);
void mcp_desk_close(mcp_desk *d);

/* Writes the list of the tools as JSON. */
void mcp_list_tools(FILE *to);
/* Calls the tool, and writes its result as JSON. Returns false, and writes nothing, if there is no such tool. */
bool mcp_call_tool(mcp_desk *d, const char *name, cli_data arguments, FILE *to);

#endif
