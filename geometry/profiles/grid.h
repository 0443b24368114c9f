/* Owns, for geometry/ alone, grids of points as meshes: what sweeps, revolutions, lofts and surfaces all come to. */
#ifndef VS_GEOMETRY_PROFILES_GRID_H
#define VS_GEOMETRY_PROFILES_GRID_H

#include "geometry/plane/ear_clipping.h"

/* rows of `columns` points each, row by row. A row is loops one behind the other, each hole behind the outer loop that
 * holds it; neighbours are joined by two triangles a cell. Borrowed from whoever fills it. */
typedef struct {
  const vs_vec3 *at;
  size_t rows, columns;
  const size_t *sizes; /* of the loops of a row */
  const bool *hole;
  size_t loop_count;
  bool round;          /* the loops close; else they are open strips */
  bool joined;         /* the last row goes on to the first */
  const size_t *seam;  /* else NULL, or: the last row stands where the first does, its point i where that has seam[i] */
  bool capped;         /* the first and the last row are filled */
  const vs_vec2 *flat; /* one row in its plane, for the caps; NULL: each in the plane that its points tell */
  const bool *by_number; /* NULL, or of each row: cells to the next are cut from the lower column to the higher one */
  uint32_t *numbers;   /* NULL, or room for the vertex of each point, and of the first row's again where it is joined */
} vs_quad_grid;

/* Appends the triangles: facing away from the side that a row's loops turn counter-clockwise about. Neighbours in
 * exactly one place become one vertex, so that poles and apexes close. False: out of memory. A grid that is joined has
 * no seam. */
bool vs_grid_mesh(const vs_quad_grid *g, vs_mesh *out);

/* Loops of a row in its plane, one behind the other; outer ones counter-clockwise, each hole behind the outer loop that
 * holds it. */
typedef struct { const vs_vec2 *at; const size_t *sizes; const bool *hole; size_t count; } vs_cap_loops;

/* Fills loops whose points are the vertices row[]. turned: the triangles face the other way. The first loop is an outer
 * one. */
bool vs_grid_cap(const vs_cap_loops *loops, const uint32_t *row, vs_mesh *out, bool turned);

#endif
