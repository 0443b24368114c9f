/* Owns the prompt's loop, for the command (main.c), and what its own commands ask of it. */
#ifndef VS_CLI_PROMPT_REPL_H
#define VS_CLI_PROMPT_REPL_H

#include "cli/prompt/prompt.h"

/* The prompt, until the end of input or ,quit. */
vs_outcome cli_repl(cli_session *c);
/* A line for the program while the prompt runs; see vs_host.input. */
const char *cli_repl_line(cli_session *c, size_t *length);

/* Opens the live view on the session's drawing, or tells where it is. */
void cli_prompt_view(cli_session *c, cli_prompt *p);
/* Evaluates a text that was typed; when it works it becomes an entry. */
vs_outcome cli_prompt_evaluate(cli_session *c, cli_prompt *p, const char *text, size_t length, unsigned first_line);
/* With `extra` flags besides; (break) stops it. */
vs_outcome cli_prompt_evaluate_with(cli_session *c, cli_prompt *p, const char *text, size_t length,
    unsigned first_line, unsigned extra);
/* Goes on with what is stopped, and tells where it stops next. */
void cli_prompt_resume(cli_session *c, cli_prompt *p, vs_resume_way way);
/* Tells where what was just run is stopped, and keeps it (entry, which is handed over) until it has ended. Returns how
 * it ended where it did after all. */
vs_outcome cli_prompt_stopped(cli_session *c, cli_prompt *p, cli_entry entry);
/* How many values have a number: $1, $2 ... */
unsigned cli_prompt_results(cli_session *c, cli_prompt *p);
/* Gives up what was stopped last. */
void cli_prompt_drop(cli_session *c, cli_prompt *p);
/* The interpreter has begun anew: nothing is stopped any more. */
void cli_prompt_forget_stopped(cli_prompt *p);
/* Is the text a definition? */
bool cli_is_definition(const char *text);
void cli_prompt_free(cli_prompt *p);

#endif
