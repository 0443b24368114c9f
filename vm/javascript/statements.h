/* Declares the translation of statements and functions of JavaScript. */
#ifndef VS_VM_JAVASCRIPT_STATEMENTS_H
#define VS_VM_JAVASCRIPT_STATEMENTS_H

#include "vm/javascript/translation.h"

/* Translates a function as the value of an expression. If `direct` is true, translates it as a procedure with exactly
 * the function's parameters. */
bool vs_translate_function(vs_translation *t, uint32_t node, bool direct);
/* Returns true if the translation contains a procedure with exactly the function's parameters, which calls by the
 * function's name use. */
bool vs_translate_has_direct(const vs_translation *t, uint32_t node);

/* Translates the script to the forms of a program. */
bool vs_translate_script(vs_translation *t);

#endif
