/* Declares a solid with its faces and edges, as a modeller sees them. */
#ifndef VS_SOLIDS_FACED_SOLID_H
#define VS_SOLIDS_FACED_SOLID_H

#include "geometry/measure/face_edges.h"
#include "solids/solid_meshes.h"

typedef struct {
  vs_solid solid;      /* its parts are primitives (vs_solid_of_leaves) */
  vs_mesh_edges edges;
  vs_mesh_faces faces;
} vs_faced_solid;

/* Evaluates an object, and finds its faces and edges. facets: if their tolerance is 0, they are four times as fine as
 * by default. Returns false and sets *error on failure. The caller frees *out in either case. */
bool vs_faced_solid_find(vs_ref ref, const vs_fineness *facets, const vs_kernel_options *options, vs_faced_solid *out,
                         vs_error *error);
void vs_faced_solid_free(vs_faced_solid *s);
/* Returns true if the triangles of the primitive of this face approximate a curved surface. Hulls of points and
 * extruded polygons do not. */
bool vs_faced_solid_is_round(const vs_faced_solid *s, uint32_t face);

#endif
