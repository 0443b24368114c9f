/* Owns polylines and outlines: points that curves and regions become. */
#ifndef VS_GEOMETRY_PLANE_OUTLINE_H
#define VS_GEOMETRY_PLANE_OUTLINE_H

#include "model/node.h"

/* A curve as points. closed: the first is not repeated. */
typedef struct { vs_vec3 *at; size_t count, room; bool closed; } vs_polyline;
void vs_polyline_free(vs_polyline *p);

/* The loops of a region in one plane: outer loops counter-clockwise about the normal, holes clockwise, each hole after
 * the outer loop that holds it. The normal of a plane looks up; of a vertical one along +Y, or along +X where that lies
 * in it. frame: columns 0 and 1 span the plane, 2 is the normal, 3 the plane's point nearest the origin. An open curve
 * (profiles of surfaces) is one loop that is not closed. */
typedef struct { vs_polyline *loops; bool *hole; size_t count; vs_vec3 point, normal; vs_affine frame; } vs_outline;
void vs_outline_free(vs_outline *o);
/* Loops in one plane as an outline: takes them over (each is left empty), also where it fails. */
bool vs_outline_of_loops(vs_polyline *loops, size_t count, vs_outline *out, vs_error *e);
/* Finds the plane of loops that are there, and its frame. False: they enclose no area, or leave every plane. */
bool vs_outline_plane(vs_outline *o, vs_error *e);
/* Turns the loops as the outline says: outer ones counter-clockwise about the normal, holes clockwise. */
void vs_outline_orient(vs_outline *o);
/* Area and centroid of the outline; of an open one its length and middle. */
double vs_outline_measure(const vs_outline *o, vs_vec3 *centroid);

#endif
