/* Declares functions of make_scopes.c that other operators use. */
#ifndef VS_BIND_RULES_MAKE_SCOPES_H
#define VS_BIND_RULES_MAKE_SCOPES_H

#include "vm/machine/native.h"
#include "bind/rules/surroundings.h"
#include "geometry/plane/outline.h"

typedef struct vs_args vs_args;

/* Returns the loops of one area of an outline: the area's outer loop and its holes. *next is the index of the outer
 * loop, and becomes that of the next area. If it fails, sets the error and returns NULL. */
vs_scope_loops *vs_rules_outline_loops(vs_args *f, const vs_outline *o, size_t *next);

#endif
