/* Declares meshes of grids of points, for use in geometry/ alone. Sweeps, revolutions, lofts and surfaces all become
 * such grids. */
#ifndef VS_GEOMETRY_PROFILES_GRID_H
#define VS_GEOMETRY_PROFILES_GRID_H

#include "geometry/plane/ear_clipping.h"

/* A grid: rows of `columns` points each, one after another; the array belongs to the caller. A row consists of loops,
 * each hole after the outer loop that contains it. Two triangles fill each cell between neighbouring rows. */
typedef struct {
  const vs_vec3 *at;
  size_t rows, columns;
  const size_t *sizes; /* sizes[l]: number of points of loop l in a row */
  const bool *hole;
  size_t loop_count;
  bool round;          /* true if the loops of each row are closed; false if they are open lines */
  bool joined;         /* true if the last row of points is connected to the first row by triangles */
  const size_t *seam;  /* If not NULL: the last row has the same points as the first row, in another order: point i of
                        * the last row coincides with point seam[i] of the first row. */
  bool capped;         /* true if the first and the last row are filled with triangles */
  const vs_vec2 *flat; /* the points of each row in the coordinates of the row's plane, for the triangles that fill it;
                        * NULL: the plane is computed from the points of the row */
  const bool *by_number; /* If not NULL: direction of the diagonals of the cells between row r and the next.
                          * by_number[r] is true if they go from the lower column to the higher column. */
  bool shared;         /* true if the grid of a neighbouring solid may have the same cells, with their points in the
                        * opposite order. Diagonals of equal length are then chosen by position, so that both grids are
                        * cut in the same way. */
  uint32_t *numbers;   /* If not NULL: receives the index of the vertex at each point, row by row. If the grid is
                        * joined, the vertices of the first row follow again at the end. */
} vs_quad_grid;

/* Appends the triangles of the grid. They face away from the side from which the loops of a row are counter-clockwise.
 * Neighbouring points at one position become one vertex. Returns false when memory is out. */
bool vs_grid_mesh(const vs_quad_grid *g, vs_mesh *out);

/* Returns true if the cell between the points p and q of two neighbouring rows is cut along the diagonal from the lower
 * q to the higher p, which is then the shorter one. A swap of p and q does not change the cut. low, high: the points of
 * the rows. */
bool vs_grid_cut(vs_vec3 low_p, vs_vec3 low_q, vs_vec3 high_p, vs_vec3 high_q);

/* Loops of a row, one after another, in the coordinates of the row's plane. Outer loops are counter-clockwise, and each
 * hole follows the outer loop around it. */
typedef struct { const vs_vec2 *at; const size_t *sizes; const bool *hole; size_t count; } vs_cap_loops;

/* Fills loops with triangles. row[i]: vertex at point i of the loops; turned: true if the triangles face the opposite
 * direction. The first loop is an outer loop. Returns false when memory is out. */
bool vs_grid_cap(const vs_cap_loops *loops, const uint32_t *row, vs_mesh *out, bool turned);

#endif
