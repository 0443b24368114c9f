/* Declares, for use in geometry/ alone, the triangles of primitive solids. All functions append to out; false: out of memory. */
#ifndef VS_GEOMETRY_PRIMITIVES_SOLID_TRIANGLES_H
#define VS_GEOMETRY_PRIMITIVES_SOLID_TRIANGLES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns true if a shape of so many facets around and across is small enough: their product can be huge. False: an
 * error is set. */
bool vs_solid_fits(int around, int across, const char *what, vs_error *e);
/* Appends a circle of n corners about the frame's Z direction, the first on its X. */
bool vs_solid_ring(vs_mesh *out, const vs_affine *frame, vs_vec3 center, double r, int n);
/* Appends triangles between the ring that starts at vertex low and the one at high, which is farther along the axis.
 * The rings differ, and have three corners or more. */
bool vs_solid_band(vs_mesh *out, uint32_t low, uint32_t high, uint32_t n);
/* Appends triangles from a ring of three corners or more to one vertex: farther along the axis, or (back) before it. */
bool vs_solid_fan(vs_mesh *out, uint32_t ring, uint32_t n, uint32_t tip, bool back);
bool vs_solid_box(vs_mesh *out, vs_vec3 p, vs_vec3 q);
bool vs_solid_wedge(vs_mesh *out, vs_vec3 p, vs_vec3 q);
/* A disc perpendicular to an axis, and an ellipse: its radii along X and Y of the axis's frame. A radius of 0 is an
 * apex. */
typedef struct { vs_vec3 center; double radius; } vs_disc;
typedef struct { vs_vec3 center; double radius, across; } vs_oval;
/* Appends the solid between two discs of n corners. hubs: the discs are fans about their centres. */
bool vs_solid_frustum(vs_mesh *out, vs_disc base, vs_disc top, int n, bool hubs);
/* Does the same for ellipses; n is 3 or more. */
bool vs_solid_oval_frustum(vs_mesh *out, vs_oval base, vs_oval top, int n, bool hubs);
/* Appends a sphere of n >= 3 facets in a turn. */
bool vs_solid_sphere(vs_mesh *out, vs_vec3 center, double radius, int n);
bool vs_solid_torus(vs_mesh *out, vs_vec3 center, double radius, double tube, int around, int tube_turn);
/* If out has tags, each triangle gets its face's index, from 0. */
bool vs_solid_polyface(vs_mesh *out, const vs_points *points, const vs_faces *faces);
bool vs_solid_polyface_merged(vs_mesh *out, const vs_points *points, const vs_faces *faces,
                              uint32_t *place); /* place: of vs_polyface_merge; overwritten */

#endif
