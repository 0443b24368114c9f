/* Declares the triangles of primitive solids, for use in geometry/ alone. All functions append to out, and return false
 * when memory is out. */
#ifndef VS_GEOMETRY_PRIMITIVES_SOLID_TRIANGLES_H
#define VS_GEOMETRY_PRIMITIVES_SOLID_TRIANGLES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns true if the mesh of a shape is not too large: `around` facets in one direction and `across` in the other.
 * Otherwise returns false and sets e. `what` is the name of the shape for the message. */
bool vs_solid_fits(int around, int across, const char *what, vs_error *e);
/* Appends n corners of a circle about the Z axis of the frame. The first corner lies in the direction of its X axis. */
bool vs_solid_ring(vs_mesh *out, const vs_affine *frame, vs_vec3 center, double r, int n);
/* Appends the triangles between two rings of n >= 3 corners. low, high: first vertices of the rings; the ring at `high`
 * is farther along the axis. */
bool vs_solid_band(vs_mesh *out, uint32_t low, uint32_t high, uint32_t n);
/* Appends triangles from a ring of n >= 3 corners to the vertex `tip`. The tip is farther along the axis than the ring,
 * or nearer if `back` is true. */
bool vs_solid_fan(vs_mesh *out, uint32_t ring, uint32_t n, uint32_t tip, bool back);
bool vs_solid_box(vs_mesh *out, vs_vec3 p, vs_vec3 q);
bool vs_solid_wedge(vs_mesh *out, vs_vec3 p, vs_vec3 q);
/* vs_disc: a disc perpendicular to an axis. vs_oval: an ellipse perpendicular to an axis; `radius` is its half axis
 * along X of the axis's frame, `across` along Y. If the radius is 0, the disc or ellipse is an apex. */
typedef struct { vs_vec3 center; double radius; } vs_disc;
typedef struct { vs_vec3 center; double radius, across; } vs_oval;
/* Appends the solid between two discs on one axis, with n corners each. If `hubs` is true, all triangles of a disc have
 * its centre as a corner. */
bool vs_solid_frustum(vs_mesh *out, vs_disc base, vs_disc top, int n, bool hubs);
/* Appends the solid between two ellipses on one axis, with n >= 3 corners each. If `hubs` is true, all triangles of an
 * ellipse have its centre as a corner. */
bool vs_solid_oval_frustum(vs_mesh *out, vs_oval base, vs_oval top, int n, bool hubs);
/* Appends a sphere with n >= 3 facets in a full turn. */
bool vs_solid_sphere(vs_mesh *out, vs_vec3 center, double radius, int n);
bool vs_solid_torus(vs_mesh *out, vs_vec3 center, double radius, double tube, int around, int tube_turn);
/* Appends a mesh of the given points and polygonal faces. If out has tags, each triangle gets the index of its face as
 * its tag. */
bool vs_solid_polyface(vs_mesh *out, const vs_points *points, const vs_faces *faces);
bool vs_solid_polyface_merged(vs_mesh *out, const vs_points *points, const vs_faces *faces,
                              uint32_t *place); /* place[i]: at the call, index of the earliest point with the position
                                                 * of point i (vs_polyface_merge); the function overwrites it with the
                                                 * vertex of point i */

#endif
