/* Owns the interface of move_scopes.c: scopes moved by any affine map. */
#ifndef VS_BIND_RULES_MOVE_SCOPES_H
#define VS_BIND_RULES_MOVE_SCOPES_H

#include "bind/rules/scope.h"

/* Returns the scope moved by m: a sheared box becomes a hexahedron. NULL: out of memory. */
vs_scope *vs_scope_placed(const vs_scope *of, const vs_affine *m);

#endif
