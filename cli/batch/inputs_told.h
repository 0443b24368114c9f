/* Declares the messages between `vs render` (the batch) and the processes in which it runs models. A run sends the
 * names of the files that it has read, each ending in NUL, in an inherited file without a name. The batch sends its
 * options as the user typed them, in the environment. */
#ifndef VS_CLI_BATCH_INPUTS_TOLD_H
#define VS_CLI_BATCH_INPUTS_TOLD_H

#include "visualscheme.h"

/* Creates the file for names, which processes started from now on inherit; the caller closes it. Returns -1 if the
 * system refuses; the runs then send no names. */
int cli_inputs_begin(void);
/* Records in s, as files that were read, the files whose names the runs have sent so far. */
void cli_inputs_hear(int list, vs_scheme *s);

/* Sends the text of --set and the parameter of --frames to a run; either may be NULL. Call it in the run's process
 * before the program starts. */
void cli_inputs_say_typed(const char *set, const char *frames);

/* In a run: writes the option that set the parameter, as typed: "--set r=4", "--frames" or "-D r". */
void cli_inputs_typed(const char *parameter, char *to, size_t room);
/* In a run: returns the descriptor of the file in which the batch receives names of files, or -1 if no batch started
 * the run. Call it before --untrusted empties the environment. */
int cli_inputs_find(void);
/* In a run: sends the names of the files that the interpreter has read, unless list is -1. */
void cli_inputs_tell(int list, const vs_scheme *s);

#endif
