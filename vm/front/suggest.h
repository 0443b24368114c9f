/* Declares advice for unknown names: similar names, words of other programs, libraries that define a name. */
#ifndef VS_VM_FRONT_SUGGEST_H
#define VS_VM_FRONT_SUGGEST_H

#include "vm/values/text.h"

/* Appends advice for an undefined name to t, such as " (did you mean make-box?)" or "; unite is the name here: (unite a
 * b ...)". Appends nothing if there is no advice. */
bool vs_suggest(vs_scheme *vm, vs_value env, vs_value symbol, vs_text *t);
/* Stores the local variable of env whose name is most similar to the undefined symbol, for vs_suggest. */
bool vs_suggest_local(vs_scheme *vm, vs_value env, vs_value symbol);
/* Records for vs_suggest that a let binds the symbol, but a value of this let uses it, so that let* is needed. */
bool vs_suggest_let_star(vs_scheme *vm, vs_value symbol);
bool vs_is_foreign_word(vs_value symbol); /* Returns true if foreign.def, the table of words of other programs, contains
                                           * the word. */
bool vs_is_foreign_name(const char *name); /* Returns true if foreign.def, the table of words of other programs,
                                            * contains the name. */
/* Appends advice such as "; make-box is the name here: (make-box ...)" to t if foreign.def, the table of words of other
 * programs, has the word. */
bool vs_foreign_advice(const char *word, vs_text *t);
/* Appends advice to t for a keyword that foreign.def lists as a word of another program, and that the called procedure
 * does not have. */
bool vs_keyword_advice(const char *word, vs_text *t);

/* Returns the word most similar to `wanted` among nth(0), nth(1) and so on, up to the first NULL that nth returns.
 * Returns NULL if no word is similar enough. */
const char *vs_nearest_word(const char *wanted, const char *(*nth)(size_t i));

#endif
