/* Declares, for use in geometry/ alone, the triangles of primitive solids. All functions append to out, and return
 * false when memory is out. */
#ifndef VS_GEOMETRY_PRIMITIVES_SOLID_TRIANGLES_H
#define VS_GEOMETRY_PRIMITIVES_SOLID_TRIANGLES_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Returns true if a shape with `around` facets in one direction and `across` in the other is small enough for a mesh.
 * Otherwise returns false and sets e. The last text parameter is the shape's name for the message. */
bool vs_solid_fits(int around, int across, const char *what, vs_error *e);
/* Appends a circle of n corners about the Z direction of the frame. The first corner is in its X direction. */
bool vs_solid_ring(vs_mesh *out, const vs_affine *frame, vs_vec3 center, double r, int n);
/* Appends the triangles between two different rings of n >= 3 corners, which begin at the vertices `low` and `high`.
 * The ring at `high` is farther along the axis. */
bool vs_solid_band(vs_mesh *out, uint32_t low, uint32_t high, uint32_t n);
/* Appends triangles from a ring of n >= 3 corners to the vertex `tip`. The tip is farther along the axis than the ring,
 * or nearer if `back` is true. */
bool vs_solid_fan(vs_mesh *out, uint32_t ring, uint32_t n, uint32_t tip, bool back);
bool vs_solid_box(vs_mesh *out, vs_vec3 p, vs_vec3 q);
bool vs_solid_wedge(vs_mesh *out, vs_vec3 p, vs_vec3 q);
/* vs_disc: a disc perpendicular to an axis. vs_oval: an ellipse with the radius along X and the radius `across` along Y
 * of the axis's frame. A shape with radius 0 is an apex. */
typedef struct { vs_vec3 center; double radius; } vs_disc;
typedef struct { vs_vec3 center; double radius, across; } vs_oval;
/* Appends the solid between two discs of n corners on one axis. If `hubs`, the discs are fans of triangles about their
 * centres. */
bool vs_solid_frustum(vs_mesh *out, vs_disc base, vs_disc top, int n, bool hubs);
/* Appends the solid between two ellipses of n >= 3 corners. If `hubs`, the ellipses are fans of triangles about their
 * centres. */
bool vs_solid_oval_frustum(vs_mesh *out, vs_oval base, vs_oval top, int n, bool hubs);
/* Appends a sphere with n >= 3 facets in a full turn. */
bool vs_solid_sphere(vs_mesh *out, vs_vec3 center, double radius, int n);
bool vs_solid_torus(vs_mesh *out, vs_vec3 center, double radius, double tube, int around, int tube_turn);
/* Appends a mesh of the given points and polygonal faces. If out has tags, each triangle gets the index of its face as
 * tag. */
bool vs_solid_polyface(vs_mesh *out, const vs_points *points, const vs_faces *faces);
bool vs_solid_polyface_merged(vs_mesh *out, const vs_points *points, const vs_faces *faces,
                              uint32_t *place); /* place: result of vs_polyface_merge, the earliest equal point of each
                                                 * point; this function overwrites it with vertices */

#endif
