/* Owns the interface of show.c: ,show. */
#ifndef VS_CLI_PROMPT_SHOW_H
#define VS_CLI_PROMPT_SHOW_H

#include "cli/command.h"

/* Prints the drawing as a picture on the terminal. size: "WxH" in characters, or "". */
void cli_show(cli_session *c, const char *size);

#endif
