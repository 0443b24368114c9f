/* Declares the conversion of a script in JavaScript to nodes. */
#ifndef VS_LANGUAGES_SCRIPT_SCRIPT_TREE_H
#define VS_LANGUAGES_SCRIPT_SCRIPT_TREE_H

#include "languages/analysis/analysis.h"

/* Reads the text of k->files[file] as a script, and makes its statements the nodes of a program. Bindings and
 * assignments have the words js:define, js:lambda and js:set!. Everything else is a list that begins with a word such
 * as js:if, followed by its parts. Variables are defined at the beginning of their function, even if the text declares
 * them deeper. *root is the LIST of the statements. Returns false on failure. */
bool know_read_script(knowledge *k, uint32_t file, know_index *root);
/* Returns true if the name is a word of scripts such as js:define. *row: row of binding_forms.def of the language's
 * form that is walked in the same way. */
bool know_script_word(const char *name, uint16_t *row);

#endif
