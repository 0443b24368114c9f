/* Declares the command `vs cure MODEL`, which finds parameters with which a model meets its rules. */
#ifndef VS_CLI_CURE_CURE_COMMAND_H
#define VS_CLI_CURE_CURE_COMMAND_H

#include "cli/command.h"

/* A function that writes the drawing to a target. */
typedef vs_outcome cure_write(cli_session *c, const cli_target *t);

/* Prints each broken rule, the parameters that cure it, and the changed line of the source. Writes the outputs of -o
 * twice, before and after. Returns VS_OUTCOME_MODEL if no values are found. */
vs_outcome cli_cure(cli_session *c, cure_write *write);

#endif
