/* Owns the messages between a batch and its runs. The runs send the files they read: names that end in NUL, in an
 * inherited file without a name. The batch sends the options as typed, in the environment. */
#ifndef VS_CLI_BATCH_INPUTS_TOLD_H
#define VS_CLI_BATCH_INPUTS_TOLD_H

#include "visualscheme.h"

/* Makes the list, which processes started from now on inherit; the caller closes it. -1: the system refuses, and no run
 * sends its files. */
int cli_inputs_begin(void);
/* Records in s the files that the runs have sent so far. */
void cli_inputs_hear(int list, vs_scheme *s);

/* Sends the text of --set and the parameter of --frames to a run; call it in the run's process before the start. Either
 * may be NULL. */
void cli_inputs_say_typed(const char *set, const char *frames);

/* In a run: writes the option that set the parameter, as typed: "--set r=4", "--frames" or "-D r". */
void cli_inputs_typed(const char *parameter, char *to, size_t room);
/* In a run: returns the list of the batch that started it, or -1. Call it before --untrusted empties the
 * environment. */
int cli_inputs_find(void);
/* Sends the files that the interpreter has read, if there is a list. */
void cli_inputs_tell(int list, const vs_scheme *s);

#endif
