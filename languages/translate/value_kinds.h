/* Owns the kind of value of each expression of a lowered tree, and so its row of translated_words.def. */
#ifndef VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H
#define VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H

#include "languages/translate/core_tree.h"

/* Finds types, the expressions that draw, and the rows that fit, and puts the arguments of calls in the order of the
 * parameters. Complains of calls without a row. Returns false on trouble. */
bool tr_find_kinds(translation *t);
/* Returns true if the argument fits the letter of a row. */
bool tr_kind_fits(const translation *t, tr_index argument, char letter);
static inline bool tr_is_solid(const translation *t, tr_index node) { return t->nodes[node].type == TR_A_SOLID; }

#endif
