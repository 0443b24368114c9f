/* Declares the command `vs help WORD...`, and its part for `,help WORD`. */
#ifndef VS_CLI_HELP_COMMAND_H
#define VS_CLI_HELP_COMMAND_H

#include "visualscheme.h"

/* Prints the manual's text on a phrase, such as `spiral stair`, or on each of the words. Returns the exit code:
 * VS_OUTCOME_USAGE if the manual does not contain one of them. */
int cli_help_command(int count, char **words);
/* Prints the name here of a word of another program, which the scheme knows, and the manual's text on a word. `how` is
 * "vs help" or ",help". Returns false, and prints nothing, if the manual does not contain the word. */
bool cli_help_word(vs_scheme *scheme, const char *word, const char *how);

#endif
