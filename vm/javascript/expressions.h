/* Declares the translation of expressions of JavaScript. */
#ifndef VS_VM_JAVASCRIPT_EXPRESSIONS_H
#define VS_VM_JAVASCRIPT_EXPRESSIONS_H

#include "vm/javascript/translation.h"

bool vs_translate_value(vs_translation *t, uint32_t node);
bool vs_translate_effect(vs_translation *t, uint32_t node); /* Translates an expression whose value is not used. */
bool vs_translate_test(vs_translation *t, uint32_t node);   /* Translates an expression as a test, of which only the
                                                             * truth is used. */
/* Writes an assignment of the value of (procedure word:number) to the variable or property at the node `target`, a
 * NAME, MEMBER or INDEX. */
bool vs_translate_assign_made(vs_translation *t, uint32_t target, const char *procedure, const char *word,
                              uint32_t number);

#endif
