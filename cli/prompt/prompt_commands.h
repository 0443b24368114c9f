/* Owns the interface of prompt_commands.c: the prompt's own commands. */
#ifndef VS_CLI_PROMPT_PROMPT_COMMANDS_H
#define VS_CLI_PROMPT_PROMPT_COMMANDS_H

#include "cli/prompt/prompt.h"

/* Sets a parameter, NAME VALUE, and runs the model again. */
void cli_prompt_set(cli_session *c, char *rest);
/* line: the text after the comma, NUL-terminated; the function changes it. */
void cli_prompt_command(cli_session *c, cli_prompt *p, char *line);
void cli_command_names(void (*each)(void *context, const char *name), void *context);
/* Writes a line of help if the prompt has a command of this name. */
void cli_command_advise(const char *name, FILE *to);

#endif
