/* Declares polylines and outlines: the points of curves and regions. */
#ifndef VS_GEOMETRY_PLANE_OUTLINE_H
#define VS_GEOMETRY_PLANE_OUTLINE_H

#include "model/node.h"

/* The points of a curve. If `closed` is true, the first point is not repeated at the end. */
typedef struct { vs_vec3 *at; size_t count, room; bool closed; } vs_polyline;
void vs_polyline_free(vs_polyline *p);

/* The loops of a region in one plane. Outer loops are counter-clockwise about the normal, which points up; each is
 * followed by its holes, clockwise. Columns of frame: 0 and 1 span the plane, 2 is the normal, 3 is the point of the
 * plane nearest to the origin. */
typedef struct { vs_polyline *loops; bool *hole; size_t count; vs_vec3 point, normal; vs_affine frame; } vs_outline;
void vs_outline_free(vs_outline *o);
/* Makes an outline of loops in one plane. It takes over the points, and the given loops are empty afterwards, even on
 * failure. Returns false and sets e on failure. */
bool vs_outline_of_loops(vs_polyline *loops, size_t count, vs_outline *out, vs_error *e);
/* Finds the plane of o's loops and its frame. Returns false if the loops enclose no area, or do not lie in one
 * plane. */
bool vs_outline_plane(vs_outline *o, vs_error *e);
/* Reverses those loops that have the wrong direction: outer loops become counter-clockwise about the normal, holes
 * clockwise. */
void vs_outline_orient(vs_outline *o);
/* Returns the area of the outline and sets *centroid. For an open outline, these are the length and the centroid of the
 * curve. */
double vs_outline_measure(const vs_outline *o, vs_vec3 *centroid);

#endif
