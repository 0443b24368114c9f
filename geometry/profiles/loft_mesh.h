/* Declares the functions of loft_mesh.c: the walls of lofts. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_MESH_H
#define VS_GEOMETRY_PROFILES_LOFT_MESH_H

#include "geometry/profiles/loft.h"

/* Appends the triangles of a loft, a ruled loft or a guided loft; they are closed if the sections are. */
bool vs_loft_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
vs_vec3 *vs_loft_rows_add(vs_loft_rows *r); /* makes room for one more row; NULL: out of memory */
/* Returns the slope where the secants a and b (over steps h and k) meet: their own if they agree, circular where they
 * turn, zero if one is zero or they are opposite. The curve therefore never overshoots its ends. */
vs_vec3 vs_loft_slope(vs_vec3 a, vs_vec3 b, double h, double k);
/* Returns the slope at an end of a piece with the secant a that ends with the slope m: that of a parabola. */
vs_vec3 vs_loft_end_slope(vs_vec3 a, vs_vec3 m);
/* Returns the cubic from p to q with the slopes m and k (of the whole piece), at t in 0..1. */
vs_vec3 vs_loft_hermite(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, double t);
/* Returns the steps that keep the chords of that cubic within the tolerance, also for its rotation. */
double vs_loft_hermite_steps(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, const vs_fineness *f);
bool vs_loft_smooth_make(const vs_loft *l, vs_loft_smooth *out); /* false: out of memory */
void vs_loft_smooth_free(vs_loft_smooth *s);
/* Computes row t, 0 to 1, between section i and the next. */
void vs_loft_smooth_row(const vs_loft_smooth *s, size_t i, double t, vs_vec3 *row);
double vs_loft_smooth_steps(const vs_loft_smooth *s, size_t i, const vs_fineness *f);

#endif
