/* Owns the triangles of one primitive as a good solid: what geometry/ makes of it, freed of its overlaps. */
#ifndef VS_KERNEL_PRIMITIVE_H
#define VS_KERNEL_PRIMITIVE_H

#include "geometry/tessellate.h"
#include "kernel/kernel.h"

/* As vs_tessellate, into an empty mesh; where a sweep, loft or surface overlaps itself, it becomes what it winds around more than 0 times. The
 * error has no origin where geometry/ gave none. options may be NULL. */
bool vs_primitive_mesh(const vs_node *n, const vs_facets *f, const vs_kernel_options *options, vs_mesh *out, vs_error *e);

#endif
