/* Declares the replacement of sections, shadows and feature edges by regions and curves. They depend on a solid's mesh,
 * which geometry/ cannot make. Resolved nodes contain none of these kinds. All code that converts nodes to points in
 * space receives resolved nodes. */
#ifndef VS_SOLIDS_RESOLVE_H
#define VS_SOLIDS_RESOLVE_H

#include "solids/solid_meshes.h"
#include "model/scene.h"

/* Replaces each of refs, whose nodes the caller owns, by a node without sections, shadows, feature edges and lines
 * without end. Lines without end become nothing. facets with tolerance 0: each solid has its default tolerance. Only
 * nodes with the flag VS_NODE_UNRESOLVED change, each distinct node once. With options->warns, the job receives a
 * warning for each object that becomes nothing: the edges of an object without edges, a solid in a flat hexahedron. */
bool vs_resolve(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options, vs_error *e);

#endif
