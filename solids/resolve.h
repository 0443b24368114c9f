/* Owns the way from sections, shadows and feature edges to the regions and curves that they are: these need a solid's
 * mesh, which geometry/ cannot make. Everything that goes from nodes to space is handed nodes that have been
 * resolved. */
#ifndef VS_SOLIDS_RESOLVE_H
#define VS_SOLIDS_RESOLVE_H

#include "solids/solid_meshes.h"
#include "model/scene.h"

/* Replaces each of refs, whose nodes the caller owns, by one without such nodes, at facets (tolerance 0: each solid at
 * its own default); lines without end become nothing. Each distinct node is worked out once. Nodes that hold nothing of
 * the kind stay as they are: VS_NODE_UNRESOLVED tells. */
bool vs_resolve(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options, vs_error *e);
/* Who is told of what comes to nothing: edges of what has none, lines that pass by the drawing. May be NULL. */
typedef struct {
  void (*warn)(void *context, const vs_origin *origin, const char *message);
  void *context;
} vs_resolve_notes;
bool vs_resolve_noting(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options,
                       const vs_resolve_notes *notes, vs_error *e);

#endif
