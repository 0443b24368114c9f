/* Declares the replacement of sections, shadows and feature edges by regions and curves. They depend on a solid's mesh,
 * which geometry/ cannot make. Resolved nodes contain none of these kinds. All code that converts nodes to points in
 * space receives resolved nodes. */
#ifndef VS_SOLIDS_RESOLVE_H
#define VS_SOLIDS_RESOLVE_H

#include "solids/solid_meshes.h"
#include "model/scene.h"

/* Replaces each of refs by a node without sections, shadows, feature edges and lines without end, which become nothing.
 * The caller owns the new nodes. If the tolerance of `facets` is 0, each solid has its default tolerance. Returns false
 * and sets e on failure. */
bool vs_resolve(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options, vs_error *e);

#endif
