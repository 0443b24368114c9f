/* Owns the interface of place.c: the placing of objects in scopes. */
#ifndef VS_BIND_RULES_PLACE_H
#define VS_BIND_RULES_PLACE_H

#include "bind/rules/derivation.h"

/* Fits the object into the scope's box, or deforms it to the hexahedron, and adds it to the objects made, with the
 * given origin. Returns false with the error set. */
bool vs_rules_place(vs_derivation *d, const vs_scope *s, vs_ref object, const vs_origin *origin);

#endif
