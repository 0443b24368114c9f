/* Owns the interface of main.c: the command `vs`: runs what the command line names, then writes what it asks for. */
#ifndef VS_CLI_MAIN_H
#define VS_CLI_MAIN_H

#include "cli/command.h"

/* vs_eval_text, watched. */
vs_outcome cli_session_eval(cli_session *c, const char *name, unsigned first_line, const char *text, size_t length,
                            unsigned flags);
/* Runs what the command line named, or model, from the start: definitions, drawing and the rest are forgotten first.
   Then the summary. */
vs_outcome cli_session_run(cli_session *c);
/* Writes the drawing as the target says. */
vs_outcome cli_session_write(cli_session *c, const cli_target *t);

#endif
