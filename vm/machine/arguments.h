/* Declares the arrangement of optional, keyword and rest arguments, and the errors about arguments. */
#ifndef VS_VM_MACHINE_ARGUMENTS_H
#define VS_VM_MACHINE_ARGUMENTS_H

#include "vm/machine/native.h"

/* Arranges the arguments a[0..n) in an activation that has room for all parameters (and VS_ACTIVATION_SLACK). kw is a
 * KEYWORDS object with the names of the last arguments, or #f. The caller sets vm->top, base and pc. If it fails, sets
 * the error and returns false. */
bool vs_arguments_closure(vs_scheme *vm, const vs_code *code, vs_value *a, size_t n, vs_value kw);
/* Arranges the arguments of a native as vs_arguments_closure does for a closure. Sets *given to the number of
 * positional arguments in the call, and *total to the number of slots in use afterwards. */
bool vs_arguments_native(vs_scheme *vm, const vs_native *native, vs_value *a, size_t n, vs_value kw, size_t *given,
                         size_t *total);
static inline bool vs_native_laid_out(const vs_native *n) { return n->def->slots > 0 || n->keywords != VS_FALSE; }
/* Returns true if #:this is the only keyword of a call and the procedure f has no such parameter. The call then omits
 * the last argument, the value of `this`. */
bool vs_leaves_self(const vs_scheme *vm, vs_value f, vs_value kw);
/* Sets the error that no clause of a case-lambda accepts this number of arguments. Returns false. */
bool vs_fail_clauses(vs_scheme *vm, const vs_case *c, size_t got);
/* Returns a call of f as text without keywords, such as "(wall length [height])". Returns NULL if f has no name or
 * several clauses, or if the text exceeds `size` bytes. */
const char *vs_procedure_form(vs_value f, char *room, size_t size);
/* Returns true if a procedure with this code accepts n arguments. kw: KEYWORDS object with the names of the last
 * arguments, or #f. */
bool vs_arguments_fit(const vs_code *code, size_t n, vs_value kw);

#endif
