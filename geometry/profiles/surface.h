/* Declares grids of points as nodes: the borders that meet, and whether they close the surface. */
#ifndef VS_GEOMETRY_PROFILES_SURFACE_H
#define VS_GEOMETRY_PROFILES_SURFACE_H

#include "model/mesh.h"
#include "model/node.h"

/* rows x columns points (two or more of each), row by row, the caller's. closed_u, closed_v: the last row (each row's
 * last point) is joined to the first. */
typedef struct {
  const vs_vec3 *at;
  size_t rows, columns;
  bool closed_u, closed_v;
} vs_point_grid;

/* Makes the node: kind VS_GRID_MESH or VS_GRID_SURFACE. Borders that are not closed and meet within 1e-9 of the whole's
 * size become one, also a border that has shrunk to a point. A surface that this closes is a solid. Collinear points
 * give the empty node. NULL: e has the reason. */
vs_node *vs_surface_make(vs_store *s, vs_kind kind, const vs_point_grid *grid, vs_error *e);
/* Appends the triangles: they face along (next row - row) x (next column - column), those of a solid outwards. Returns
 * false when memory is out. */
bool vs_surface_mesh(const vs_node *n, vs_mesh *out);

#endif
