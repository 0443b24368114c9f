/* Declares the types of the expressions of a lowered tree, and their rows of translated_words.def. */
#ifndef VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H
#define VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H

#include "languages/translate/core_tree.h"

/* Determines the type of each node, whether it draws, and the row of translated_words.def that fits. Puts the
 * arguments of calls in the order of the parameters. Complains about calls of primitives without a row. Returns
 * false on failure. */
bool tr_find_kinds(translation *t);
/* Returns true if the argument has the type that the letter in a row of translated_words.def requires. */
bool tr_kind_fits(const translation *t, tr_index argument, char letter);
static inline bool tr_is_solid(const translation *t, tr_index node) { return t->nodes[node].type == TR_A_SOLID; }

#endif
