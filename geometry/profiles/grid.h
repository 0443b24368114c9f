/* Declares, for use in geometry/ alone, grids of points as meshes: the common form of sweeps, revolutions, lofts and surfaces. */
#ifndef VS_GEOMETRY_PROFILES_GRID_H
#define VS_GEOMETRY_PROFILES_GRID_H

#include "geometry/plane/ear_clipping.h"

/* rows of `columns` points each, row by row. A row consists of loops one after the other, each hole after the outer
 * loop that contains it; two triangles for each cell join neighbouring rows. Borrowed from the caller. */
typedef struct {
  const vs_vec3 *at;
  size_t rows, columns;
  const size_t *sizes; /* of the loops of a row */
  const bool *hole;
  size_t loop_count;
  bool round;          /* the loops close; else they are open strips */
  bool joined;         /* the last row is joined to the first */
  const size_t *seam;  /* NULL, or: the last row has the position of the first, its point i that of point seam[i] */
  bool capped;         /* the first and the last row are filled */
  const vs_vec2 *flat; /* one row in its plane, for the caps; NULL: the plane of each row is computed from its points */
  const bool *by_number; /* NULL, or for each row: the diagonals of the cells to the next row go from the lower column
                          * to the higher */
  uint32_t *numbers;   /* NULL, or room for the vertex of each point, and of the first row's again if joined */
} vs_quad_grid;

/* Appends the triangles: they face away from the side from which a row's loops are counter-clockwise. Neighbours at
 * exactly the same position become one vertex; poles and apexes therefore close. A grid that is joined has no seam.
 * Returns false when memory is out. */
bool vs_grid_mesh(const vs_quad_grid *g, vs_mesh *out);

/* Loops of a row in its plane, one after the other: outer ones counter-clockwise, each hole after the outer loop that
 * contains it. */
typedef struct { const vs_vec2 *at; const size_t *sizes; const bool *hole; size_t count; } vs_cap_loops;

/* Fills loops whose points are the vertices row[]. turned: the triangles face the other way. The first loop is an outer
 * one. */
bool vs_grid_cap(const vs_cap_loops *loops, const uint32_t *row, vs_mesh *out, bool turned);

#endif
