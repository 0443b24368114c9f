/* Owns the manual inside the command: the text of manual/, searched by word. */
#ifndef VS_CLI_PROMPT_MANUAL_H
#define VS_CLI_PROMPT_MANUAL_H

#include <stdbool.h>
#include <stdio.h>

/* Prints the manual's text on the word: its meaning, if it is a word for beginners; the entry of a name of the
 * language; a page; or else the section whose heading contains it. Returns false if there is none. */
bool cli_manual_print(const char *word, FILE *to);
/* Finds the text on `vs WORD`: the page of that name, else the section whose heading contains the command. Returns
 * false if there is none. */
bool cli_manual_command(const char *word, FILE *to);
/* Prints the headings of other sections that mention it, a line each. */
void cli_manual_mentions(const char *word, FILE *to);
void cli_manual_topics(FILE *to); /* prints the names of the pages */

#endif
