/* Owns taking apart what is several curves or surfaces, through sets and placements: what is made of one at a time is
 * made of each. */
#ifndef VS_GEOMETRY_PARTS_H
#define VS_GEOMETRY_PARTS_H

#include "model/node.h"

/* Is n a union of curves or of surfaces, as it is or placed or painted? */
bool vs_is_several(const vs_node *n);
/* The parts of a union (else itself), each where it stands and in its paint, in order; the array is the caller's to
 * free, the references to release. False: out of memory. */
bool vs_several_parts(vs_ref whole, vs_ref **out, size_t *count);
/* A placement, a paint or a layer. */
bool vs_is_wrapper(const vs_node *n);
/* inner in the wrappers of whole; takes nothing over. NULL: out of memory. */
vs_node *vs_parts_within(vs_ref whole, vs_ref inner);
void vs_several_free(vs_ref *parts, size_t count);

#endif
