/* Owns the interface of the compiler: a core tree becomes a procedure. */
#ifndef VS_VM_COMPILER_COMPILE_H
#define VS_VM_COMPILER_COMPILE_H

#include "vm/front/ast.h"

/* Sets *out to a procedure without arguments that evaluates `body`. The tree may be cleared afterwards. Literals in the
 * pool are used without a copy (the expander has stripped aliases from quoted data). */
bool vs_compile(vs_scheme *vm, vs_ast *ast, vs_core_node *body, vs_value *out);

#endif
