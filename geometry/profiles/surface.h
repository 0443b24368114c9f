/* Owns grids of points as nodes: which of their borders meet, and whether they so close. */
#ifndef VS_GEOMETRY_PROFILES_SURFACE_H
#define VS_GEOMETRY_PROFILES_SURFACE_H

#include "model/mesh.h"
#include "model/node.h"

/* Makes the node: kind VS_GRID_MESH or VS_GRID_SURFACE, rows x columns points (two or more of each), row by row.
 * Borders that meet within 1e-9 of the whole's size become one, also where one has shrunk to a point; closed_u,
 * closed_v: the last row (each row's last point) goes on to the first in any case. A surface that closes so is a solid.
 * All in one line: the empty node. NULL: e says why. */
vs_node *vs_surface_make(vs_store *s, vs_kind kind, const vs_vec3 *at, size_t rows, size_t columns, bool closed_u,
                         bool closed_v, vs_error *e);
/* Appends the triangles: facing along (next row - row) x (next column - column), a solid outwards. False: out of
 * memory. */
bool vs_surface_mesh(const vs_node *n, vs_mesh *out);

#endif
