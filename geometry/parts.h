/* Declares the search for the parts of a set of curves or surfaces. An operation on such a set is applied to each of
 * its parts. */
#ifndef VS_GEOMETRY_PARTS_H
#define VS_GEOMETRY_PARTS_H

#include "model/node.h"

/* Returns true if n is a union of curves or of surfaces; placements, materials and layers may be around it. */
bool vs_is_several(const vs_node *n);
/* Sets *out to the parts of the union `whole` in order, each with its placement and material. A node that is no union
 * is its own only part. The caller frees the array and releases the references. Returns false when memory is out. */
bool vs_several_parts(vs_ref whole, vs_ref **out, size_t *count);
/* Returns true if n is a placement, a material or a layer. */
bool vs_is_wrapper(const vs_node *n);
/* Returns `inner` inside the placements, materials and layers that `whole` has, as a new reference; NULL when memory is
 * out. */
vs_node *vs_parts_within(vs_ref whole, vs_ref inner);
void vs_several_free(vs_ref *parts, size_t count);

#endif
