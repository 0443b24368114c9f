/* Declares functions for a standard output that cannot be written. The command then prints one message, and has the
 * exit status of an unwritable file. */
#ifndef VS_CLI_PROMPT_STANDARD_OUTPUT_H
#define VS_CLI_PROMPT_STANDARD_OUTPUT_H

#include "cli/command.h"

void cli_output_fails(cli_session *c); /* Reports that standard output cannot be written, once for a session; errno is
                                        * the reason. */
/* Writes the buffered standard output; reports a failure. */
void cli_output_flush(cli_session *c);
/* Closes standard output, and returns the exit status. It is 2 if output was lost, even if `code` is 1 because the
 * model failed or the models of `vs diff` differ. Otherwise it is `code`. The parameter told: the loss was already
 * reported. No message is printed if the reader has closed standard output. */
int cli_output_end(int code, bool told);

#endif
