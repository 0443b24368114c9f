/* Owns the arrangement of arguments other than exactly the required ones (optional, keyword, rest), and the errors
 * about them. */
#ifndef VS_VM_MACHINE_ARGUMENTS_H
#define VS_VM_MACHINE_ARGUMENTS_H

#include "vm/machine/native.h"

/* Arranges a[0..n) in an activation that has room for all parameters (and VS_ACTIVATION_SLACK). kw is a KEYWORDS object
 * with the names of the last values, or #f. The caller sets vm->top, base and pc. Returns false with the error set. */
bool vs_arguments_closure(vs_scheme *vm, const vs_code *code, vs_value *a, size_t n, vs_value kw);
/* Does the same for a native. *given: positional arguments; *total: slots in use afterwards. */
bool vs_arguments_native(vs_scheme *vm, const vs_native *native, vs_value *a, size_t n, vs_value kw, size_t *given,
                         size_t *total);
static inline bool vs_native_laid_out(const vs_native *n) { return n->def->slots > 0 || n->keywords != VS_FALSE; }
/* Returns true if #:this is the only keyword of a call, and the procedure has no such parameter: it is none of a
 * script's, or does not use `this`. The call then drops the value, which is the last argument. */
bool vs_leaves_self(const vs_scheme *vm, vs_value f, vs_value kw);
/* Reports that no clause of a case-lambda takes so many arguments; returns false. */
bool vs_fail_clauses(vs_scheme *vm, const vs_case *c, size_t got);
/* Returns the form of a call of f, "(wall length [height])", without its keywords; NULL if f has no name or several
 * clauses, or the form exceeds `size`. */
const char *vs_procedure_form(vs_value f, char *room, size_t size);
/* Returns true if a procedure of this shape takes n arguments; kw names at most n of them. */
bool vs_arguments_fit(const vs_code *code, size_t n, vs_value kw);

#endif
