/* Declares the triangles of nodes: every back-end gets the same facets. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Appends the triangles of a solid or surface, in the node's own coordinates, to out. n is no operation (levels up to
 * SWEPT; chains of TRANSFORM, MATERIAL and LAYER are followed): the kernel meshes booleans. The mesh of a solid is
 * closed and oriented. Iterative. */
bool vs_tessellate(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);

/* ---- sweeps, and pipes along a curve: placements are followed ---- */

/* Sets *turns: whether a bend turns part of the profile back. It is false for any other solid. */
bool vs_sweep_turns(const vs_node *n, const vs_fineness *f, bool *turns, vs_error *e);
/* Makes closed meshes of the given number of steps each; their union is the solid (swept_mesh.h). Other solids get
 * none. The caller frees the meshes and their array. */
bool vs_sweep_runs(const vs_node *n, const vs_fineness *f, size_t steps, vs_mesh **runs, size_t *count, vs_error *e);
/* The place of a bend on the path, and the factor by which the profile may be scaled there. */
typedef struct {
  vs_vec3 at;
  double fits;
} vs_sweep_bend;
/* Finds the tightest bend or, if near is not NULL, the bend that is nearest to it. If no bend is too tight, fits is
 * 1. */
bool vs_sweep_tightest(const vs_node *n, const vs_fineness *f, const vs_vec3 *near, vs_sweep_bend *out, vs_error *e);

/* ---- hulls ---- */

/* Appends the points whose hull is the node's hull, in its own coordinates: corners of its parts, with f's fineness.
 * The kernel meshes sets of solids other than unions (solids/resolve.h): here they are an error. */
bool vs_hull_points(const vs_node *hull, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
