/* Declares the command `vs help WORD...`, and its part for `,help WORD`. */
#ifndef VS_CLI_HELP_COMMAND_H
#define VS_CLI_HELP_COMMAND_H

#include "visualscheme.h"

/* Prints the manual's text on a phrase, such as `spiral stair`, or on each of the words. Returns the exit code:
 * VS_OUTCOME_USAGE if the manual does not contain a word. */
int cli_help_command(int count, char **words);
/* Prints the manual's text on a word. If the word belongs to another program, first prints its name in this language,
 * found by `scheme`. `how` is "vs help" or ",help". Returns false, and prints nothing, if there is no text for the
 * word. */
bool cli_help_word(vs_scheme *scheme, const char *word, const char *how);

#endif
