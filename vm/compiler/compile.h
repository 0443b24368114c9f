/* Owns the way from a core tree to a procedure. */
#ifndef VS_VM_COMPILER_COMPILE_H
#define VS_VM_COMPILER_COMPILE_H

#include "vm/front/ast.h"

/* *out = a procedure of no arguments that does what `body` says when called. The tree may be cleared afterwards.
   Literals in the pool are used as they are (the expander has stripped aliases from quoted data). */
bool vs_compile(vs_scheme *vm, vs_ast *ast, vs_core_node *body, vs_value *out);

#endif
