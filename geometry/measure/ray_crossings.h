/* Declares, for use in geometry/ alone, the test whether points are inside a closed mesh, for many points. */
#ifndef VS_GEOMETRY_MEASURE_RAY_CROSSINGS_H
#define VS_GEOMETRY_MEASURE_RAY_CROSSINGS_H

#include "model/mesh.h"

/* The triangles of a mesh by the cells of a grid seen from above. */
typedef struct {
  vs_mesh mesh;       /* owned by the index */
  vs_bounds bounds;
  size_t cells;       /* along X and along Y */
  uint32_t *starts;   /* cells * cells + 1 entries */
  uint32_t *triangles;
} vs_facet_index;

bool vs_facet_index_make(vs_facet_index *x); /* makes the index of x->mesh; false: out of memory */
void vs_facet_index_free(vs_facet_index *x);
size_t vs_facet_index_bytes(const vs_facet_index *x);
/* Returns true if the mesh winds around p more than 0 times, or p lies on it. */
bool vs_facet_index_holds(const vs_facet_index *x, vs_vec3 p);

#endif
