/* Owns what a batch and its runs tell each other: the runs, which files they read (names that end in NUL, in a file
 * without a name that they inherit); the batch, which options were typed (in the environment). */
#ifndef VS_CLI_BATCH_INPUTS_TOLD_H
#define VS_CLI_BATCH_INPUTS_TOLD_H

#include "visualscheme.h"

/* Makes the list, which the processes that are started from here on inherit; the caller closes it. -1: the system
 * refuses, and nothing will be told. */
int cli_inputs_begin(void);
/* Notes in s what the runs have told so far. */
void cli_inputs_hear(int list, vs_scheme *s);

/* Before a run is started, in its process: what --set said, and the parameter of --frames; either may be NULL. */
void cli_inputs_say_typed(const char *set, const char *frames);

/* Of a run: the option that gave the parameter its value, as it was typed: "--set r=4", "--frames" or "-D r". */
void cli_inputs_typed(const char *parameter, char *to, size_t room);
/* Of a run: the list of the batch that started it, or -1. Before --untrusted empties the environment. */
int cli_inputs_find(void);
/* Tells what the interpreter has read, where there is a list. */
void cli_inputs_tell(int list, const vs_scheme *s);

#endif
