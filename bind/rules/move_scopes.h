/* Owns the declaration of scopes brought elsewhere by any affine map. */
#ifndef VS_BIND_RULES_MOVE_SCOPES_H
#define VS_BIND_RULES_MOVE_SCOPES_H

#include "bind/rules/scope.h"

/* The scope where m brings it: a box that is sheared becomes a hexahedron. NULL: out of memory. */
vs_scope *vs_scope_placed(const vs_scope *of, const vs_affine *m);

#endif
