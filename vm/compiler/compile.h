/* Declares the compiler, which translates a core tree to a procedure. */
#ifndef VS_VM_COMPILER_COMPILE_H
#define VS_VM_COMPILER_COMPILE_H

#include "vm/front/ast.h"

/* Sets *out to a procedure without arguments that evaluates `body`. The tree may be cleared afterwards. The code
 * contains the constants of the tree's pool themselves, not copies; the expander has already removed aliases (renamed
 * identifiers) from quoted data. Returns false with the error set. */
bool vs_compile(vs_scheme *vm, vs_ast *ast, vs_core_node *body, vs_value *out);

#endif
