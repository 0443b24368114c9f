/* Owns, for geometry/ and bind/, lofts: solids and surfaces through sections. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_H
#define VS_GEOMETRY_PROFILES_LOFT_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Sections whose points are matched: column c of every row is one line of the wall. */
typedef struct {
  size_t rows, columns, loop_count;
  vs_vec3 *at;          /* rows x columns */
  vs_vec3 *center;      /* a row each */
  vs_vec3 *normal;      /* unit, along the way; zero for a point or an open curve */
  bool *point;          /* the row is one point */
  size_t *sizes;        /* of a row's loops, outer ones counter-clockwise about the normal */
  bool *hole;
  bool round;           /* the loops close */
  bool joined;          /* the last row goes on to the first */
  double size;          /* of the whole */
} vs_loft;

void vs_loft_free(vs_loft *l);
/* The first `count` children of n, matched. Fails where they do not go together. */
bool vs_loft_match(const vs_node *n, size_t count, const vs_fineness *f, vs_loft *out, vs_error *e);

/* Triangles of a loft, a ruled loft, a guided loft: appended; closed where the sections are. */
bool vs_loft_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);

/* -- what loft_guided.c and loft_mesh.c have in common -- */

typedef struct { vs_vec3 *at; size_t rows, room, columns; } vs_loft_rows;
vs_vec3 *vs_loft_rows_add(vs_loft_rows *r); /* room for one more row; NULL: out of memory */
/* A slope where the secants a and b (over steps h and k) meet: theirs if they agree, round where they turn, none where
 * one is none or they oppose each other, so that nothing swings past its ends. */
vs_vec3 vs_loft_slope(vs_vec3 a, vs_vec3 b, double h, double k);
/* The slope at an end, where the first piece has the secant a and ends with the slope m: that of a parabola. */
vs_vec3 vs_loft_end_slope(vs_vec3 a, vs_vec3 m);
/* The cubic from p to q with the slopes m and k (of the whole piece), at t in 0..1 */
vs_vec3 vs_loft_hermite(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, double t);
/* Steps that keep the chords of that cubic within the tolerance, and of its turning. */
double vs_loft_hermite_steps(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, const vs_fineness *f);
bool vs_loft_along_guides(const vs_node *n, const vs_loft *l, const vs_fineness *f, vs_loft_rows *out, vs_error *e);
bool vs_loft_along_path(const vs_node *n, const vs_loft *l, const vs_fineness *f, vs_loft_rows *out, vs_error *e);
/* Rows of the free loft between section i and the next, t in 0..1 */
/* slopes of a whole piece: leaving a row, arriving at one */
typedef struct { const vs_loft *loft; vs_vec3 *slope_in, *slope_out; } vs_loft_smooth;
bool vs_loft_smooth_make(const vs_loft *l, vs_loft_smooth *out); /* false: out of memory */
void vs_loft_smooth_free(vs_loft_smooth *s);
void vs_loft_smooth_row(const vs_loft_smooth *s, size_t i, double t, vs_vec3 *row);
double vs_loft_smooth_steps(const vs_loft_smooth *s, size_t i, const vs_fineness *f);

#endif
