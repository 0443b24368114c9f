/* Owns the prompt's loop, for the command (main.c), and the functions that its own commands need. */
#ifndef VS_CLI_PROMPT_REPL_H
#define VS_CLI_PROMPT_REPL_H

#include "cli/prompt/prompt.h"

/* Runs the prompt until the end of input or ,quit. */
vs_outcome cli_repl(cli_session *c);
/* Returns a line for the program while the prompt runs; see vs_host.input. */
const char *cli_repl_line(cli_session *c, size_t *length);

/* Opens the live view on the session's drawing, or prints its address. */
void cli_prompt_view(cli_session *c, cli_prompt *p);
/* Evaluates a typed text; if it succeeds, it becomes an entry. */
vs_outcome cli_prompt_evaluate(cli_session *c, cli_prompt *p, const char *text, size_t length, unsigned first_line);
/* Does the same with additional flags; (break) pauses it. */
vs_outcome cli_prompt_evaluate_with(cli_session *c, cli_prompt *p, const char *text, size_t length,
    unsigned first_line, unsigned extra);
/* Continues the paused program, and prints the place of its next pause. */
void cli_prompt_resume(cli_session *c, cli_prompt *p, vs_resume_way way);
/* Prints the place where the program has paused, and keeps the entry, which it takes over, until the program has ended.
 * Returns the outcome if it has ended already. */
vs_outcome cli_prompt_stopped(cli_session *c, cli_prompt *p, cli_entry entry);
/* Returns the number of numbered values: $1, $2 ... */
unsigned cli_prompt_results(cli_session *c, cli_prompt *p);
/* Drops the program that paused last. */
void cli_prompt_drop(cli_session *c, cli_prompt *p);
/* Forgets all paused programs after a restart of the interpreter. */
void cli_prompt_forget_stopped(cli_prompt *p);
/* Returns true if the text is a definition. */
bool cli_is_definition(const char *text);
void cli_prompt_free(cli_prompt *p);

#endif
