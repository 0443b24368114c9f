/* Declares the parts of sets of curves or surfaces, found through sets and placements: an operation on one curve is
 * applied to each part. */
#ifndef VS_GEOMETRY_PARTS_H
#define VS_GEOMETRY_PARTS_H

#include "model/node.h"

/* Returns true if n is a union of curves or of surfaces, possibly within placements, materials and layers. */
bool vs_is_several(const vs_node *n);
/* Sets *out to the parts of a union (or to the one node itself), in order, each with its placement and material. The
 * caller frees the array and releases the references. Returns false when memory is out. */
bool vs_several_parts(vs_ref whole, vs_ref **out, size_t *count);
/* Returns true if n is a placement, a material or a layer. */
bool vs_is_wrapper(const vs_node *n);
/* Returns inner within the wrappers of whole; retains its own references. NULL: out of memory. */
vs_node *vs_parts_within(vs_ref whole, vs_ref inner);
void vs_several_free(vs_ref *parts, size_t count);

#endif
