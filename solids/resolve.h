/* Owns the step from sections, shadows and feature edges to regions and curves: these need a solid's mesh, which
 * geometry/ cannot make. All code that goes from nodes to space receives resolved nodes. */
#ifndef VS_SOLIDS_RESOLVE_H
#define VS_SOLIDS_RESOLVE_H

#include "solids/solid_meshes.h"
#include "model/scene.h"

/* Replaces each of refs, whose nodes the caller owns, by one without such nodes, at facets (tolerance 0: each solid has
 * its default); lines without end become nothing. Each distinct node is resolved once. Nodes that contain none of these
 * stay unchanged: VS_NODE_UNRESOLVED marks the others. */
bool vs_resolve(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options, vs_error *e);
/* Callbacks for objects that become nothing: edges of an object without any, lines that miss the drawing. May be
 * NULL. */
typedef struct {
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  void *context;
} vs_resolve_notes;
bool vs_resolve_noting(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                       const vs_resolve_notes *notes, vs_error *e);

#endif
