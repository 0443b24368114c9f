/* Owns the triangles of nodes; the same facets for every back-end. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Solids and surfaces that are not operations (levels up to SWEPT; TRANSFORM, MATERIAL and LAYER chains are followed;
 * booleans are the kernel's): triangles in the node's own coordinates, appended to out. Solids come closed and
 * oriented. Iterative. */
bool vs_tessellate(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);

/* ---- of sweeps, and of pipes along a curve: placements are followed ---- */

/* Does a bend turn part of the profile back? False of any other solid. */
bool vs_sweep_turns(const vs_node *n, const vs_fineness *f, bool *turns, vs_error *e);
/* Closed meshes of so many steps each, whose union is the solid (swept_mesh.h); none of any other solid. The caller
 * frees the meshes and their array. */
bool vs_sweep_runs(const vs_node *n, const vs_fineness *f, size_t steps, vs_mesh **runs, size_t *count, vs_error *e);
/* The place of a bend, on the path, and how many times as large as it is the profile may be there. */
typedef struct {
  vs_vec3 at;
  double fits;
} vs_sweep_bend;
/* The tightest bend, or, where near is not NULL, the one nearest to that place; without a bend that is too tight fits
 * is 1. */
bool vs_sweep_tightest(const vs_node *n, const vs_fineness *f, const vs_vec3 *near, vs_sweep_bend *out, vs_error *e);

/* ---- hulls ---- */

/* The points whose hull the node's is, in its own coordinates: corners of what it holds, as finely as f asks. Sets of
 * solids other than unions are the kernel's to mesh (solids/resolve.h): they are an error here. */
bool vs_hull_points(const vs_node *hull, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
