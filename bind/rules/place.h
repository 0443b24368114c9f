/* Declares the placing of objects in scopes, implemented in place.c. */
#ifndef VS_BIND_RULES_PLACE_H
#define VS_BIND_RULES_PLACE_H

#include "bind/rules/derivation.h"

/* Scales the object to the box of the scope s, or deforms it to the hexahedron s. Adds the object, with this origin, to
 * the objects of the derivation d. If it fails, sets the error and returns false. */
bool vs_rules_place(vs_derivation *d, const vs_scope *s, vs_ref object, const vs_origin *origin);

#endif
