/* Owns what a node is in space as triangles and polylines; the same facets for every back-end. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

/* Solids and surfaces that are not operations (levels up to SWEPT; TRANSFORM, MATERIAL and LAYER chains are followed; booleans are
 * the kernel's): triangles in the node's own coordinates, appended to out. Solids come closed and oriented. Iterative. */
bool vs_tessellate(const vs_node *n, const vs_facets *f, vs_mesh *out, vs_error *e);

/* A curve as points. closed: the first is not repeated. Exact ends. */
typedef struct { vs_vec3 *at; size_t count, room; bool closed; } vs_polyline;
void vs_polyline_free(vs_polyline *p);
bool vs_curve_sample(const vs_node *curve, const vs_facets *f, vs_polyline *out, vs_error *e);

/* A region (or a closed curve taken as filled) as loops in one plane: outer loops counter-clockwise about the normal, holes clockwise,
 * each hole after the outer loop that holds it. The normal of a plane looks up; of a vertical one along +Y, or along +X where that lies in it.
 * frame: columns 0 and 1 span the plane, 2 is the normal, 3 the plane's point nearest the origin. An open curve (profiles of surfaces) is
 * one loop that is not closed. */
typedef struct { vs_polyline *loops; bool *hole; size_t count; vs_vec3 point, normal; vs_affine frame; } vs_outline;
void vs_outline_free(vs_outline *o);
bool vs_outline_coplanar(const vs_outline *a, const vs_outline *b);
/* No loops where the region turns out to be empty: an intersection of what does not meet. */
bool vs_region_outline(const vs_node *region, const vs_facets *f, vs_outline *out, vs_error *e);
/* Is p in the region's plane and in it or on its border? Of fine samples where it is round. */
bool vs_region_contains(const vs_node *region, vs_vec3 p, bool *inside, vs_error *e);
/* Area and centroid of the sampled outline; of an open one its length and middle. */
double vs_outline_measure(const vs_outline *o, vs_vec3 *centroid);

#endif
