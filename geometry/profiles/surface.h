/* Declares nodes that are made of grids of points. Borders of the grid that coincide are joined, and may close the
 * surface. */
#ifndef VS_GEOMETRY_PROFILES_SURFACE_H
#define VS_GEOMETRY_PROFILES_SURFACE_H

#include "model/mesh.h"
#include "model/node.h"

/* A grid of rows * columns points, one row after another, at least two of each. The array belongs to the caller.
 * closed_u: true if the last row is joined to the first; closed_v: true if the last point of each row is joined to the
 * first. */
typedef struct {
  const vs_vec3 *at;
  size_t rows, columns;
  bool closed_u, closed_v;
} vs_point_grid;

/* Makes a node of the kind VS_GRID_MESH or VS_GRID_SURFACE. Joins borders of the grid that coincide within 1e-9 of its
 * size; if this closes the surface, the node is a solid. Returns the empty node if all points are collinear. Returns
 * NULL and sets e on failure. */
vs_node *vs_surface_make(vs_store *s, vs_kind kind, const vs_point_grid *grid, vs_error *e);
/* Appends the triangles of grid node n to out. They face outwards if n is a solid, else in the direction (next row -
 * row) x (next column - column). Returns false when memory is out. */
bool vs_surface_mesh(const vs_node *n, vs_mesh *out);

#endif
