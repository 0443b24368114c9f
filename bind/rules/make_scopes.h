/* Owns the interface of make_scopes.c: the constructors of scopes, and the procedures that read a scope. */
#ifndef VS_BIND_RULES_MAKE_SCOPES_H
#define VS_BIND_RULES_MAKE_SCOPES_H

#include "vm/machine/native.h"
#include "bind/rules/surroundings.h"
#include "geometry/plane/outline.h"

typedef struct vs_args vs_args;

/* returns the loops of one area of an outline; NULL: the error is set */
vs_scope_loops *vs_rules_outline_loops(vs_args *f, const vs_outline *o, size_t *next);

#endif
