/* Declares the mapping of scopes, implemented in move_scopes.c. */
#ifndef VS_BIND_RULES_MOVE_SCOPES_H
#define VS_BIND_RULES_MOVE_SCOPES_H

#include "bind/rules/scope.h"

/* Returns a copy of the scope to which the map m was applied. A box that is sheared becomes a hexahedron. Returns NULL
 * when memory is out. */
vs_scope *vs_scope_placed(const vs_scope *of, const vs_affine *m);

#endif
