/* Owns what a node is in space as triangles and polylines; the same facets for every back-end. */
#ifndef VS_GEOMETRY_TESSELLATE_H
#define VS_GEOMETRY_TESSELLATE_H

#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  double tolerance; /* chord height, model units, > 0 */
  int segments;     /* > 0: facets a turn for every node whose own field is 0 */
} vs_facets;

/* The default chord height of a drawing: the power of two nearest 1/4000 of the diagonal of its bounds. */
double vs_facets_tolerance(const vs_bounds *drawing);
/* Facets a full turn of radius r: by the node's own segments, then f->segments, then f->tolerance; never fewer than 32 by tolerance; a
 * multiple of 4 by tolerance so that quarter turns are vertices. */
int vs_facets_turn(const vs_facets *f, double r, int segments);

/* Solids and surfaces that are not operations (levels up to SWEPT; TRANSFORM, MATERIAL and LAYER chains are followed; booleans are
 * the kernel's): triangles in the node's own coordinates, appended to out. Solids come closed and oriented. Iterative. */
bool vs_tessellate(const vs_node *n, const vs_facets *f, vs_mesh *out, vs_error *e);

/* A curve as points. closed: the first is not repeated. Exact ends. */
typedef struct { vs_vec3 *at; size_t count, room; bool closed; } vs_polyline;
void vs_polyline_free(vs_polyline *p);
bool vs_curve_sample(const vs_node *curve, const vs_facets *f, vs_polyline *out, vs_error *e);

/* A region (or a closed curve taken as filled) as loops in one plane: outer loops counter-clockwise about the normal, holes clockwise. */
typedef struct { vs_polyline *loops; size_t count; vs_vec3 point, normal; } vs_outline;
void vs_outline_free(vs_outline *o);
bool vs_region_outline(const vs_node *region, const vs_facets *f, vs_outline *out, vs_error *e);

#endif
