/* Owns grids of points as nodes: which of their borders meet, and whether they so close. */
#ifndef VS_GEOMETRY_PROFILES_SURFACE_H
#define VS_GEOMETRY_PROFILES_SURFACE_H

#include "model/mesh.h"
#include "model/node.h"

/* rows x columns points (two or more of each), row by row, the caller's. closed_u, closed_v: the last row (each row's
 * last point) goes on to the first. */
typedef struct {
  const vs_vec3 *at;
  size_t rows, columns;
  bool closed_u, closed_v;
} vs_point_grid;

/* Makes the node: kind VS_GRID_MESH or VS_GRID_SURFACE. Borders that meet within 1e-9 of the whole's size become one
 * where they are not closed, also where one has shrunk to a point. A surface that closes so is a solid. All in one
 * line: the empty node. NULL: e says why. */
vs_node *vs_surface_make(vs_store *s, vs_kind kind, const vs_point_grid *grid, vs_error *e);
/* Appends the triangles: facing along (next row - row) x (next column - column), a solid outwards. False: out of
 * memory. */
bool vs_surface_mesh(const vs_node *n, vs_mesh *out);

#endif
