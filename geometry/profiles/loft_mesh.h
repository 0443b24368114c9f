/* Declares the making of the walls of lofts: solids and surfaces through sections. */
#ifndef VS_GEOMETRY_PROFILES_LOFT_MESH_H
#define VS_GEOMETRY_PROFILES_LOFT_MESH_H

#include "geometry/profiles/loft.h"

/* Appends the triangles of a loft, ruled loft or guided loft. The mesh is closed if the sections are regions. Returns
 * false and sets e on failure. */
bool vs_loft_mesh(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
vs_vec3 *vs_loft_rows_add(vs_loft_rows *r); /* makes room for another row of points and returns it; returns NULL when
                                             * memory is out */
/* Returns the slope at a point between two pieces of a curve. a, b: mean slopes of the pieces before and after it; h,
 * k: their lengths. The slope is zero if a or b is zero or they are opposite, so that the curve never overshoots its
 * ends. */
vs_vec3 vs_loft_slope(vs_vec3 a, vs_vec3 b, double h, double k);
/* Returns the slope at the free end of a piece of a curve. It is that of a parabola: a is the mean slope of the piece,
 * and m the slope at its other end. */
vs_vec3 vs_loft_end_slope(vs_vec3 a, vs_vec3 m);
/* Returns the point at t, 0 to 1, of the cubic curve from p to q. m, k: its derivatives by t at p and at q. */
vs_vec3 vs_loft_hermite(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, double t);
/* Returns into how many equal steps the cubic of vs_loft_hermite must be divided, so that the distance of chords from
 * it, and the turns between them, are within the tolerance. */
double vs_loft_hermite_steps(vs_vec3 p, vs_vec3 q, vs_vec3 m, vs_vec3 k, const vs_fineness *f);
bool vs_loft_smooth_make(const vs_loft *l, vs_loft_smooth *out); /* computes the slopes at all points of the loft's
                                                                  * sections; returns false when memory is out */
void vs_loft_smooth_free(vs_loft_smooth *s);
/* Computes the row of points at the position t, 0 to 1, between section i and the next section. */
void vs_loft_smooth_row(const vs_loft_smooth *s, size_t i, double t, vs_vec3 *row);
double vs_loft_smooth_steps(const vs_loft_smooth *s, size_t i, const vs_fineness *f);

#endif
