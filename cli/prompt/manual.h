/* Declares the search in the manual, whose text is part of the command. */
#ifndef VS_CLI_PROMPT_MANUAL_H
#define VS_CLI_PROMPT_MANUAL_H

#include <stdbool.h>
#include <stdio.h>

/* Prints the manual's text on a word or phrase, and returns true. Returns false if there is none. Prints the
 * explanation for beginners, the entry of a name of the language, the page with that name, and the sections to which
 * the index links. If none of these exists, prints a section whose heading contains the word or its stem. how:
 * beginning of the commands that it prints, "vs help", or ",help" at the prompt. */
bool cli_manual_print(const char *word, const char *how, FILE *to);
/* Writes the word of the index that is most similar to a misspelt word. Returns false if none is similar. */
bool cli_manual_near(const char *word, char *room, size_t size);
/* Returns true if the manual has an entry or a page of that name. */
bool cli_manual_describes(const char *word);
/* Prints commands `vs help ...`, each on a line, for the sections to which the index links the word. */
void cli_manual_see_also(const char *word, FILE *to);
/* Prints the manual's text on the command `vs WORD`: the page with this name or, if there is none, the section whose
 * heading contains the command. Returns false if there is neither. */
bool cli_manual_command(const char *word, FILE *to);
/* Prints the headings of up to 12 sections that contain the word or its stem, each on a line. Returns their number. */
size_t cli_manual_mentions(const char *word, FILE *to);
void cli_manual_topics(FILE *to); /* Prints the names of the pages. */

#endif
