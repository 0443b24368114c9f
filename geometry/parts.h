/* Declares the search for the parts of sets of curves or surfaces. An operation on a curve is applied to each part of
 * such a set. */
#ifndef VS_GEOMETRY_PARTS_H
#define VS_GEOMETRY_PARTS_H

#include "model/node.h"

/* Returns true if n is a union of curves or of surfaces, or such a union within placements, materials and layers. */
bool vs_is_several(const vs_node *n);
/* Sets *out to the parts of the union `whole` in order, each with its placement and material. If `whole` is no union,
 * it is the only part. The caller frees the array and releases the references. Returns false when memory is out. */
bool vs_several_parts(vs_ref whole, vs_ref **out, size_t *count);
/* Returns true if n is a placement, a material or a layer. */
bool vs_is_wrapper(const vs_node *n);
/* Returns the node of `inner` wrapped in the placements, materials and layers of `whole`, as a new reference. Returns
 * NULL when memory is out. */
vs_node *vs_parts_within(vs_ref whole, vs_ref inner);
void vs_several_free(vs_ref *parts, size_t count);

#endif
