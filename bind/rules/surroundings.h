/* Declares a tree of the bounds of all objects created up to now, which answers questions of rules. Implemented in
 * surroundings.c. */
#ifndef VS_BIND_RULES_SURROUNDINGS_H
#define VS_BIND_RULES_SURROUNDINGS_H

#include "bind/rules/scope.h"

typedef struct vs_surroundings vs_surroundings;
void vs_surroundings_free(vs_surroundings *a); /* Frees the tree and its objects. NULL is permitted. */
/* Sets *touch to whether the two scopes have a common point. The test is exact: hexahedra are divided into six
 * tetrahedra, meshes into their faces. If it fails, sets the error and returns false. */
bool vs_scopes_touch(vs_bind *bind, const vs_scope *a, const vs_scope *b, bool *touch);

#endif
