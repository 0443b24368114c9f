/* Owns the translation of statements and functions. */
#ifndef VS_VM_JAVASCRIPT_STATEMENTS_H
#define VS_VM_JAVASCRIPT_STATEMENTS_H

#include "vm/javascript/translation.h"

/* A function as the value of an expression, or the procedure behind it. */
bool vs_translate_function(vs_translation *t, uint32_t node, bool direct);
/* Has the function a procedure that takes exactly its parameters? */
bool vs_translate_has_direct(const vs_translation *t, uint32_t node);

/* The whole script, as the forms of a program. */
bool vs_translate_script(vs_translation *t);

#endif
