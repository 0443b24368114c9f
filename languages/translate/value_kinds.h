/* Declares the types of the expressions of a lowered tree, and their rows of translated_words.def. */
#ifndef VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H
#define VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H

#include "languages/translate/core_tree.h"

/* Determines types, the expressions that draw, and the rows that fit. Puts the arguments of calls in the order of the
 * parameters. Complains about calls without a row. Returns false on failure. */
bool tr_find_kinds(translation *t);
/* Returns true if the argument has the type that the letter of a row requires. */
bool tr_kind_fits(const translation *t, tr_index argument, char letter);
static inline bool tr_is_solid(const translation *t, tr_index node) { return t->nodes[node].type == TR_A_SOLID; }

#endif
