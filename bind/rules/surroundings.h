/* Owns the interface of surroundings.c: the objects made so far, for questions of rules: a tree of bounds, and objects
 * with their triangles. */
#ifndef VS_BIND_RULES_SURROUNDINGS_H
#define VS_BIND_RULES_SURROUNDINGS_H

#include "bind/rules/scope.h"

typedef struct vs_surroundings vs_surroundings;
void vs_surroundings_free(vs_surroundings *a); /* NULL is fine */
/* Tests exactly whether the scopes have a common point: hexahedra by six tetrahedra, meshes by their faces. Returns
 * false with the condition set. */
bool vs_scopes_touch(vs_bind *bind, const vs_scope *a, const vs_scope *b, bool *touch);

#endif
