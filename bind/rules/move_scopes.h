/* Declares the mapping of scopes by affine maps, implemented in move_scopes.c. */
#ifndef VS_BIND_RULES_MOVE_SCOPES_H
#define VS_BIND_RULES_MOVE_SCOPES_H

#include "bind/rules/scope.h"

/* Returns a copy of the scope `of`, mapped by m. A box that m shears becomes a hexahedron. Returns NULL when memory is
 * out. */
vs_scope *vs_scope_placed(const vs_scope *of, const vs_affine *m);

#endif
