/* Owns the declaration of what was made so far as rules ask of it: a tree of bounds, and objects taken apart. */
#ifndef VS_BIND_RULES_SURROUNDINGS_H
#define VS_BIND_RULES_SURROUNDINGS_H

#include "bind/rules/scope.h"

typedef struct vs_surroundings vs_surroundings;
void vs_surroundings_free(vs_surroundings *a); /* NULL is fine */
/* Do the scopes have a point in common? Exactly, hexahedra by their six tetrahedra, meshes by their faces. False: the
 * condition is set. */
bool vs_scopes_touch(vs_bind *bind, const vs_scope *a, const vs_scope *b, bool *touch);

#endif
