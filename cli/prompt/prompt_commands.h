/* Declares the commands of the prompt, which prompt_commands.c implements. */
#ifndef VS_CLI_PROMPT_PROMPT_COMMANDS_H
#define VS_CLI_PROMPT_PROMPT_COMMANDS_H

#include "cli/prompt/prompt.h"

/* Sets a parameter from the text `rest`, "NAME VALUE", and runs the model again. */
void cli_prompt_set(cli_session *c, char *rest);
/* Runs a command of the prompt. `line` is the text after the comma, ending in NUL; the function modifies it. */
void cli_prompt_command(cli_session *c, cli_prompt *p, char *line);
void cli_command_names(void (*each)(void *context, const char *name), void *context);
/* Writes a line of help if the name is that of a command of the prompt. */
void cli_command_advise(const char *name, FILE *to);

#endif
