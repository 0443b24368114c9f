/* Declares a tree of the bounds of all objects that a derivation has created so far, which rules ask about their
 * surroundings. Implemented in surroundings.c. */
#ifndef VS_BIND_RULES_SURROUNDINGS_H
#define VS_BIND_RULES_SURROUNDINGS_H

#include "bind/rules/scope.h"

typedef struct vs_surroundings vs_surroundings;
void vs_surroundings_free(vs_surroundings *a); /* Frees the tree, and releases its objects. NULL is permitted. */
/* Sets *touch to true if the scopes a and b have a common point. The test is exact: hexahedra are divided into six
 * tetrahedra, meshes into their faces. If it fails, sets the error and returns false. */
bool vs_scopes_touch(vs_bind *bind, const vs_scope *a, const vs_scope *b, bool *touch);

#endif
