/* Declares the search in the manual, whose text is part of the command. */
#ifndef VS_CLI_PROMPT_MANUAL_H
#define VS_CLI_PROMPT_MANUAL_H

#include <stdbool.h>
#include <stdio.h>

/* Prints the manual's text on the word and returns true, or returns false if there is none. In this order, it is: the
 * explanation for beginners, the entry of a name of the language, a page, a section whose heading contains the word. */
bool cli_manual_print(const char *word, FILE *to);
/* Prints the manual's text on the command `vs WORD`: the page of that name, else the section whose heading contains the
 * command. Returns false if there is none. */
bool cli_manual_command(const char *word, FILE *to);
/* Prints the headings of other sections that contain the word, each on a line. */
void cli_manual_mentions(const char *word, FILE *to);
void cli_manual_topics(FILE *to); /* Prints the names of the pages. */

#endif
