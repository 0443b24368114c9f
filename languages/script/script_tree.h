/* Owns the way from a script in JavaScript to nodes. */
#ifndef VS_LANGUAGES_SCRIPT_SCRIPT_TREE_H
#define VS_LANGUAGES_SCRIPT_SCRIPT_TREE_H

#include "languages/analysis/analysis.h"

/* Reads the text of k->files[file] as a script, and leaves its statements as the nodes of a program: what binds and
 * assigns has the words js:define, js:lambda and js:set!, everything else is a list of its parts behind a word that
 * begins with js: . Variables are defined at the beginning of their function, where the text declares them deeper
 * within. root: the LIST of them. False: trouble. */
bool know_read_script(knowledge *k, uint32_t file, know_index *root);
/* Is the word one of these? *row: that of the language's form which is walked the same way. */
bool know_script_word(const char *name, uint16_t *row);

#endif
