/* Declares, for use in geometry/ and bind/, lofts: solids and surfaces through sections. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_H
#define VS_GEOMETRY_PROFILES_LOFT_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Sections whose points are matched: column c of every row is one line of the wall. */
typedef struct {
  size_t rows, columns, loop_count;
  vs_vec3 *at;          /* rows x columns */
  vs_vec3 *center;      /* one value for each row */
  vs_vec3 *normal;      /* unit, in the loft's direction; zero for a point or an open curve */
  bool *point;          /* the row is one point */
  size_t *sizes;        /* sizes of a row's loops, outer ones counter-clockwise about the normal */
  bool *hole;
  bool round;           /* the loops close */
  bool joined;          /* the last row is joined to the first */
  double size;          /* of the whole loft */
} vs_loft;

void vs_loft_free(vs_loft *l);
/* Matches the first `count` children of n, 1 to their number. Fails if they are not compatible. */
bool vs_loft_match(const vs_node *n, size_t count, const vs_fineness *f, vs_loft *out, vs_error *e);

/* -- shared by loft_guided.c and loft_mesh.c -- */

typedef struct { vs_vec3 *at; size_t rows, room, columns; } vs_loft_rows;
/* rows of the free loft between section i and the next, t in 0..1 */
/* slopes of a whole piece: leaving a row, arriving at one */
typedef struct { const vs_loft *loft; vs_vec3 *slope_in, *slope_out; } vs_loft_smooth;

#endif
