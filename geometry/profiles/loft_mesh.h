/* Owns the interface of loft_mesh.c: the walls of lofts. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_MESH_H
#define VS_GEOMETRY_PROFILES_LOFT_MESH_H

#include "geometry/profiles/loft.h"

/* Triangles of a loft, a ruled loft, a guided loft: appended; closed where the sections are. */
bool vs_loft_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
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
bool vs_loft_smooth_make(const vs_loft *l, vs_loft_smooth *out); /* false: out of memory */
void vs_loft_smooth_free(vs_loft_smooth *s);
/* Row t, 0 to 1, of the way from section i to the next. */
void vs_loft_smooth_row(const vs_loft_smooth *s, size_t i, double t, vs_vec3 *row);
double vs_loft_smooth_steps(const vs_loft_smooth *s, size_t i, const vs_fineness *f);

#endif
