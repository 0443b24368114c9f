/* Owns the interface of main.c: the command `vs`. */
#ifndef VS_CLI_MAIN_H
#define VS_CLI_MAIN_H

#include "cli/command.h"

/* Calls vs_eval_text, with the watch. */
vs_outcome cli_session_eval(cli_session *c, const char *name, unsigned first_line, const char *text, size_t length,
                            unsigned flags);
/* Runs the programs of the command line, or the model, from the start: forgets definitions, drawing and the rest first.
 * Then prints the summary. */
vs_outcome cli_session_run(cli_session *c);
/* Writes the drawing to the target. */
vs_outcome cli_session_write(cli_session *c, const cli_target *t);

#endif
