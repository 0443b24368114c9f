/* Declares how words of a command line are written for a shell. */
#ifndef VS_CLI_USAGE_SHELL_WORDS_H
#define VS_CLI_USAGE_SHELL_WORDS_H

#include <stdio.h>

/* Writes the word in quotes, so that a shell reads it as one word. */
void cli_put_quoted(FILE *to, const char *word);
/* Writes the word: in quotes if a shell would otherwise change or divide it. */
void cli_put_word(FILE *to, const char *word);

#endif
