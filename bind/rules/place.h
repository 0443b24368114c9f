/* Owns the interface of place.c: the placing of objects in scopes. */
#ifndef VS_BIND_RULES_PLACE_H
#define VS_BIND_RULES_PLACE_H

#include "bind/rules/derivation.h"

/* The object in the scope: fitted into its box, or deformed. Gathered; with the given origin. False: the error is
 * set. */
bool vs_rules_place(vs_derivation *d, const vs_scope *s, vs_ref object, const vs_origin *origin);

#endif
