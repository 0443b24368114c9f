/* Owns the reaction to a standard output that cannot be written: one message, and the exit code of a file that cannot
 * be written. */
#ifndef VS_CLI_PROMPT_STANDARD_OUTPUT_H
#define VS_CLI_PROMPT_STANDARD_OUTPUT_H

#include "cli/command.h"

void cli_output_fails(cli_session *c); /* errno has the reason */
/* Writes the pending output. */
void cli_output_flush(cli_session *c);
/* Ends standard output. Returns the exit code: 2 if output was lost, even if the model then failed because of it, or if
 * the two models of `vs diff` differ. told: standard error has reported it already. A reader that has gone gets no
 * message. */
int cli_output_end(int code, bool told);

#endif
