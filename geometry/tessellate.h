/* Declares the tessellation of nodes. All back-ends use it, and so get equal triangles. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/profiles/overturn.h"
#include "geometry/shapes/hull.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Appends the triangles of a solid or surface, in the node's own coordinates, to out. The mesh of a solid is closed and
 * oriented. The node's kind has a level up to SWEPT in prims.def, or is a placement, material or layer of such a node.
 * Returns false and sets e on failure. */
bool vs_tessellate(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);

/* ---- the bends of sweeps, and of pipes along a curve; placements may be around these ---- */

typedef struct vs_bends vs_bends; /* the planned sections of a sweep or pipe, from which its mesh is made */
/* Plans the sections of n, which is a sweep, or a pipe along a curve. Returns NULL and sets e on failure. The caller
 * frees the result with vs_bends_free. */
vs_bends *vs_bends_new(const vs_node *n, const vs_fineness *f, vs_error *e);
void vs_bends_free(vs_bends *b);
size_t vs_bends_steps(const vs_bends *b); /* Returns the number of steps; a step is the part between two neighbouring
                                           * sections. */
/* Divides steps at bends that are tighter than the profile is wide, as far as a smaller tolerance requires. marked[r]:
 * true if step r may be divided; NULL: all may. Returns false when memory is out. */
bool vs_bends_refine(vs_bends *b, const bool *marked, double tolerance);
/* Sets *turns to true if a part of the profile goes backwards at some bend of the path. Returns false when memory is
 * out. */
bool vs_bends_turn(const vs_bends *b, bool *turns);
/* Appends the triangles of the sweep or pipe to out, as vs_tessellate does. Returns false when memory is out, or if the
 * mesh becomes too large (out->over is then set). */
bool vs_bends_mesh(const vs_bends *b, vs_mesh *out);
/* Makes closed meshes, each of the given number of steps, whose union is the solid (swept_mesh.h). The caller frees the
 * meshes and their array. Returns false when memory is out. */
bool vs_bends_runs(const vs_bends *b, size_t steps, vs_mesh **runs, size_t *count);
/* Writes at most `most` random points to out, from the steps in which a part of the profile goes backwards; *count:
 * number of points. A point may lie beside the sweep. Equal sweeps have equal points. Returns false when memory is
 * out. */
bool vs_bends_samples(const vs_bends *b, vs_step_point *out, size_t most, size_t *count);
/* The tightest bend of a path. fits: factor by which the profile must be scaled down to fit into the bend, 1 if it
 * fits. */
typedef struct {
  vs_vec3 at;
  double fits;
} vs_bend;
/* Finds the bend that limits the profile most, or if `near` is not NULL, the bend nearest to that point. If no bend is
 * too tight, out->fits is 1. */
void vs_bends_tightest(const vs_bends *b, const vs_vec3 *near, vs_bend *out);

/* ---- hulls ---- */

/* Appends points to out whose convex hull is the node `hull`, in its own coordinates: the corners of its parts, sampled
 * with the fineness f. The parts contain no booleans except unions. Returns false and sets e on failure. */
bool vs_hull_points(const vs_node *hull, const vs_fineness *f, vs_cloud *out, vs_error *e);

#endif
