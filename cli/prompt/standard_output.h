/* Owns what happens where standard output cannot be written: it is said once, and the exit code is that of a file that
 * cannot be written. */
#ifndef VS_CLI_PROMPT_STANDARD_OUTPUT_H
#define VS_CLI_PROMPT_STANDARD_OUTPUT_H

#include "cli/command.h"

void cli_output_fails(cli_session *c); /* errno says why */
/* Hands on what was printed so far. */
void cli_output_flush(cli_session *c);
/* Ends standard output, whatever was printed there. Returns the exit code: 2 where something was lost, also where the
 * model then failed for it, or the two models of `vs diff` differ. told: standard error says it already. A reader that
 * went knows why, and is not told. */
int cli_output_end(int code, bool told);

#endif
