/* Owns, for geometry/ alone, the question "is this point inside?" put to a closed mesh, many times. */
#ifndef VS_GEOMETRY_MEASURE_RAY_CROSSINGS_H
#define VS_GEOMETRY_MEASURE_RAY_CROSSINGS_H

#include "model/mesh.h"

/* The triangles of a mesh by the cells of a lattice seen from above. */
typedef struct {
  vs_mesh mesh;       /* owned */
  vs_bounds bounds;
  size_t cells;       /* along X and along Y */
  uint32_t *starts;   /* cells * cells + 1 */
  uint32_t *triangles;
} vs_facet_index;

bool vs_facet_index_make(vs_facet_index *x); /* of x->mesh; false: out of memory */
void vs_facet_index_free(vs_facet_index *x);
size_t vs_facet_index_bytes(const vs_facet_index *x);
/* Does the mesh wind around p more than 0 times, or does p lie on it? */
bool vs_facet_index_holds(const vs_facet_index *x, vs_vec3 p);

#endif
