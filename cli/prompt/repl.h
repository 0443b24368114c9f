/* Declares the prompt for main.c, and its functions for the commands of the prompt. */
#ifndef VS_CLI_PROMPT_REPL_H
#define VS_CLI_PROMPT_REPL_H

#include "cli/prompt/prompt.h"

/* Runs the prompt until the end of input or ,quit. */
vs_outcome cli_repl(cli_session *c);
/* Returns a line of input for a program that reads while the prompt runs; see vs_host.input. */
const char *cli_repl_line(cli_session *c, size_t *length);

/* Opens the live view of the session's drawing. If the view is already open, prints its address. */
void cli_prompt_view(cli_session *c, cli_prompt *p);
/* Evaluates a typed text. If this succeeds, the text becomes an entry. */
vs_outcome cli_prompt_evaluate(cli_session *c, cli_prompt *p, const char *text, size_t length, unsigned first_line);
/* Evaluates a typed text as cli_prompt_evaluate does, with the additional flags `extra`. (break) pauses the program. */
vs_outcome cli_prompt_evaluate_with(cli_session *c, cli_prompt *p, const char *text, size_t length,
    unsigned first_line, unsigned extra);
/* Continues the paused program, and prints the place where it pauses next. */
void cli_prompt_resume(cli_session *c, cli_prompt *p, vs_resume_way way);
/* Prints the place where the program has paused. Takes over the entry with its text until the program has ended.
 * Returns the outcome if the program has already ended. */
vs_outcome cli_prompt_stopped(cli_session *c, cli_prompt *p, cli_entry entry);
/* Returns the number of values that have names $1, $2 ... */
unsigned cli_prompt_results(cli_session *c, cli_prompt *p);
/* Ends the program that paused last. */
void cli_prompt_drop(cli_session *c, cli_prompt *p);
/* Deletes all paused programs, since the interpreter was restarted. */
void cli_prompt_forget_stopped(cli_prompt *p);
/* Returns true if the text is a definition. */
bool cli_is_definition(const char *text);
void cli_prompt_free(cli_prompt *p);

#endif
