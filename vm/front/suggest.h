/* Owns the advice for unknown names: similar names, words of other programs, libraries that define a name. */
#ifndef VS_VM_FRONT_SUGGEST_H
#define VS_VM_FRONT_SUGGEST_H

#include "vm/values/text.h"

/* Appends to t the advice for a name that is not defined: " (did you mean make-box?)", "; unite is the name here:
 * (unite a b ...)". Appends nothing if it finds none. */
bool vs_suggest(vs_scheme *vm, vs_value env, vs_value symbol, vs_text *t);
/* Notes, for vs_suggest, the local variable of env with the name most similar to the symbol, which is not defined
 * there. */
bool vs_suggest_local(vs_scheme *vm, vs_value env, vs_value symbol);
/* Notes the symbol itself: a let binds it, but it has no meaning in the let's values. */
bool vs_suggest_let_star(vs_scheme *vm, vs_value symbol);
bool vs_is_foreign_word(vs_value symbol); /* of foreign.def */
/* Appends to t "; make-box is the name here: (make-box ...)" if the word belongs to another program. */
bool vs_foreign_advice(const char *word, vs_text *t);
/* Does the same for a keyword that the called procedure does not have. */
bool vs_keyword_advice(const char *word, vs_text *t);

/* Returns the word among nth(0), nth(1) ... to the first NULL that is most similar to the wanted one, by the measure
 * for names that are not defined; NULL if none is. */
const char *vs_nearest_word(const char *wanted, const char *(*nth)(size_t i));

#endif
