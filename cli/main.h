/* Declares the functions of main.c that the prompt and other commands use. */
#ifndef VS_CLI_MAIN_H
#define VS_CLI_MAIN_H

#include "cli/command.h"

/* Calls vs_eval_text, while the time limit is watched (limits.h). */
vs_outcome cli_session_eval(cli_session *c, const char *name, unsigned first_line, const char *text, size_t length,
                            unsigned flags);
/* Restarts the interpreter, which deletes definitions and drawing. Then runs the programs of the command line, or
 * c->model, and prints the summary. */
vs_outcome cli_session_run(cli_session *c);
/* Writes the drawing to the target. */
vs_outcome cli_session_write(cli_session *c, const cli_target *t);

#endif
