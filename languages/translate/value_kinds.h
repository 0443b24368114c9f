/* Owns what kind of value each expression of a lowered tree has, and so which row of translated_words.def it takes. */
#ifndef VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H
#define VS_LANGUAGES_TRANSLATE_VALUE_KINDS_H

#include "languages/translate/core_tree.h"

/* Finds types, who draws and which rows fit, and brings the arguments of calls into the order of the parameters. A
 * call without a row is complained of. False: trouble. */
bool tr_find_kinds(translation *t);
/* May the argument stand where a row asks for the letter? */
bool tr_kind_fits(const translation *t, tr_index argument, char letter);
static inline bool tr_is_solid(const translation *t, tr_index node) { return t->nodes[node].type == TR_A_SOLID; }

#endif
