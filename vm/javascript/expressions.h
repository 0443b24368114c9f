/* Owns the translation of expressions. */
#ifndef VS_VM_JAVASCRIPT_EXPRESSIONS_H
#define VS_VM_JAVASCRIPT_EXPRESSIONS_H

#include "vm/javascript/translation.h"

bool vs_translate_value(vs_translation *t, uint32_t node);
bool vs_translate_effect(vs_translation *t, uint32_t node); /* an expression whose value is not used */
bool vs_translate_test(vs_translation *t, uint32_t node);   /* #f or true */
/* Assigns the value of the items, (words...) around a made name, to the variable at the NAME, MEMBER or INDEX node. */
bool vs_translate_assign_made(vs_translation *t, uint32_t target, const char *procedure, const char *word,
                              uint32_t number);

#endif
