/* Declares the tessellation of nodes: all back-ends get the same triangles. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Appends the triangles of a solid or surface, in the node's own coordinates, to out. The node must not be an
 * operation such as a boolean, which the kernel meshes. Its kind has a level up to SWEPT in prims.def, or is
 * TRANSFORM, MATERIAL or LAYER above such a kind. The mesh of a solid is closed and oriented. Does not recurse along
 * chains of placements. */
bool vs_tessellate(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);

/* ---- sweeps, and pipes along a curve; the functions follow placements ---- */

/* Sets *turns to true if a bend of the path turns part of the profile backwards. *turns is false for any node that is
 * no sweep or pipe. */
bool vs_sweep_turns(const vs_node *n, const vs_fineness *f, bool *turns, vs_error *e);
/* Makes closed meshes, each of the given number of steps of a sweep. Their union is the solid (swept_mesh.h). For any
 * node that is no sweep or pipe, *count is 0. The caller frees the meshes and their array. */
bool vs_sweep_runs(const vs_node *n, const vs_fineness *f, size_t steps, vs_mesh **runs, size_t *count, vs_error *e);
/* The tightest bend of a path. fits: factor by which the profile must be scaled to fit into the bend. */
typedef struct {
  vs_vec3 at;
  double fits;
} vs_sweep_bend;
/* Finds the tightest bend of the path. If near is not NULL, finds the bend that is nearest to it instead. If no bend is
 * too tight, out->fits is 1. */
bool vs_sweep_tightest(const vs_node *n, const vs_fineness *f, const vs_vec3 *near, vs_sweep_bend *out, vs_error *e);

/* ---- hulls ---- */

/* Appends points to out whose convex hull is the hull node, in its own coordinates: the corners of its parts, with the
 * fineness f. Parts must not be sets of solids other than unions; the kernel meshes these before (solids/resolve.h). */
bool vs_hull_points(const vs_node *hull, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
