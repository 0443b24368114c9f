/* Declares frames: placement on an axis, and rotation-minimizing frames along a path. */
#ifndef VS_GEOMETRY_FRAME_H
#define VS_GEOMETRY_FRAME_H

#include "model/vec.h"

#include <stddef.h>

/* Returns the map that moves the origin to `at` and turns +Z into `direction` by the smallest rotation. direction is
 * not zero. If direction is -Z, it is half a turn about X. */
vs_affine vs_frame_on_axis(vs_vec3 at, vs_vec3 direction);

/* Returns the smallest rotation that turns the unit vector a into the unit vector b. If a and b are opposite, it is
 * half a turn about an axis perpendicular to a. */
vs_affine vs_frame_turn(vs_vec3 a, vs_vec3 b);

/* A sample of a path. at: the point; arriving, leaving: unit tangents before and after it, which differ at a corner. */
typedef struct { vs_vec3 at, arriving, leaving; double along; /* along: arc length from the start of the path to this
                                                               * sample */ } vs_path_point;
/* Moves the unit vector x along a path of n > 0 points with the least rotation; x_out[i] is the moved vector at point
 * i. On a closed path, x would return turned by some angle; this turn is distributed along the path. Returns that angle
 * in radians. */
double vs_frame_transport(const vs_path_point *path, size_t n, bool closed, double length, vs_vec3 x, vs_vec3 *x_out);

/* Returns the unit vector of the normal or of its opposite, whichever points up. A horizontal vector points towards +Y,
 * or to +X if it is parallel to X. */
vs_vec3 vs_plane_up(vs_vec3 normal);

#endif
