/* Declares the command ,show of the prompt. */
#ifndef VS_CLI_PROMPT_SHOW_H
#define VS_CLI_PROMPT_SHOW_H

#include "cli/command.h"

/* Prints the drawing as a picture on the terminal. size: "WxH" in characters, or "". */
void cli_show(cli_session *c, const char *size);

#endif
