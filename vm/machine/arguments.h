/* Owns the arranging of arguments that are not simply as many as required: optional, keyword, rest; and the errors
 * about them. */
#ifndef VS_VM_MACHINE_ARGUMENTS_H
#define VS_VM_MACHINE_ARGUMENTS_H

#include "vm/machine/native.h"

/* a[0..n) in an activation that has room for all parameters (and VS_ACTIVATION_SLACK); kw: a KEYWORDS object or #f.
   vm->top, base, pc are the caller's business. false: the error is set. Of the n values the last belong to the names of
   kw. */
bool vs_arguments_closure(vs_scheme *vm, const vs_code *code, vs_value *a, size_t n, vs_value kw);
/* *given: positional arguments; *total: slots in use afterwards. Of the n values the last belong to the names of kw. */
bool vs_arguments_native(vs_scheme *vm, const vs_native *native, vs_value *a, size_t n, vs_value kw, size_t *given,
                         size_t *total);
static inline bool vs_native_laid_out(const vs_native *n) { return n->def->slots > 0 || n->keywords != VS_FALSE; }
/* Is #:this all that a call gives by keyword, to a procedure without it? Then the procedure is none of a script's, or
   one that does not ask: the value, the last argument, is left away. */
bool vs_leaves_self(const vs_scheme *vm, vs_value f, vs_value kw);
/* no clause of a case-lambda takes so many arguments: false, the error set */
bool vs_fail_clauses(vs_scheme *vm, const vs_case *c, size_t got);
/* How f is called, "(wall length [height])", without its keywords; NULL: f has no name, is of several clauses, or
 * there is no room. */
const char *vs_procedure_form(vs_value f, char *room, size_t size);
/* does a procedure of this shape take n arguments? kw names no more than n of the arguments. */
bool vs_arguments_fit(const vs_code *code, size_t n, vs_value kw);

#endif
