/* Owns the interface of prompt_commands.c: what the prompt's own commands do. */
#ifndef VS_CLI_PROMPT_PROMPT_COMMANDS_H
#define VS_CLI_PROMPT_PROMPT_COMMANDS_H

#include "cli/prompt/prompt.h"

/* NAME VALUE: a parameter of the model, which then runs again. */
void cli_prompt_set(cli_session *c, char *rest);
/* rest: what stands behind the comma, NUL-terminated; it is changed. */
void cli_prompt_command(cli_session *c, cli_prompt *p, char *line);
void cli_command_names(void (*each)(void *context, const char *name), void *context);
/* Writes a line of help where the prompt has a command of this name, else nothing. */
void cli_command_advise(const char *name, FILE *to);

#endif
