/* Owns the advice for unknown names: names that are near, words of other programs, libraries that bring a name. */
#ifndef VS_VM_FRONT_SUGGEST_H
#define VS_VM_FRONT_SUGGEST_H

#include "vm/values/text.h"

/* Appends to t the advice for a name that is not defined: " (did you mean make-box?)", "; unite is the name here:
   (unite a b ...)". Nothing if nothing comes to mind. */
bool vs_suggest(vs_scheme *vm, vs_value env, vs_value symbol, vs_text *t);
/* Remembers, for vs_suggest, the name among the local variables of env that looks most like the symbol, which is not
   defined there. */
bool vs_suggest_local(vs_scheme *vm, vs_value env, vs_value symbol);
/* ... the symbol itself: a let binds it, and nothing does where the let's values stand. */
bool vs_suggest_let_star(vs_scheme *vm, vs_value symbol);
bool vs_is_foreign_word(vs_value symbol); /* of foreign.def */
/* "; make-box is the name here: (make-box ...)" appended to t, where the word is one of another program's. */
bool vs_foreign_advice(const char *word, vs_text *t);
/* the same for a keyword that the called procedure does not have */
bool vs_keyword_advice(const char *word, vs_text *t);

/* Of the words nth(0), nth(1) ... to the first NULL, the one that is most like the wanted one, as in advice for names
   that are not defined; NULL: none is. */
const char *vs_nearest_word(const char *wanted, const char *(*nth)(size_t i));

#endif
