/* Owns the manual that the command carries: the text of manual/, looked up by word. */
#ifndef VS_CLI_PROMPT_MANUAL_H
#define VS_CLI_PROMPT_MANUAL_H

#include <stdbool.h>
#include <stdio.h>

/* Prints what the manual has on the word: its meaning, if a beginner may not know it, the entry of a name of the
 * language, a page, or else the section whose heading has it. False: nothing. */
bool cli_manual_print(const char *word, FILE *to);
/* Finds the text on `vs WORD`: the page of that name, else the section whose heading has the command. False:
 * nothing. */
bool cli_manual_command(const char *word, FILE *to);
/* Prints where else the manual speaks of it: the headings, a line each. */
void cli_manual_mentions(const char *word, FILE *to);
void cli_manual_topics(FILE *to); /* the pages there are */

#endif
