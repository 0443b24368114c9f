/* Declares a test whether points are inside a closed mesh, for use in geometry/ alone. It is fast for many points. */
#ifndef VS_GEOMETRY_MEASURE_RAY_CROSSINGS_H
#define VS_GEOMETRY_MEASURE_RAY_CROSSINGS_H

#include "model/mesh.h"

/* An index of a mesh's triangles: for each cell of a horizontal grid, the triangles that are above or below the
 * cell. */
typedef struct {
  vs_mesh mesh;       /* the mesh, which belongs to the index and is freed with it */
  vs_bounds bounds;
  size_t cells;       /* number of cells of the horizontal grid along each of X and Y */
  uint32_t *starts;   /* starts[c]: index, in the list of triangles, of the first entry of cell c; cells * cells + 1
                       * elements */
  uint32_t *triangles;
} vs_facet_index;

bool vs_facet_index_make(vs_facet_index *x); /* makes the index of the triangles of x->mesh; returns false when memory
                                              * is out */
void vs_facet_index_free(vs_facet_index *x);
size_t vs_facet_index_bytes(const vs_facet_index *x);
/* Returns true if the winding number of the mesh at p is above 0, or p lies on the mesh. */
bool vs_facet_index_holds(const vs_facet_index *x, vs_vec3 p);

#endif
