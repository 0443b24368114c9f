/* Declares frames: placement on an axis, and rotation-minimizing frames along a path. */
#ifndef VS_GEOMETRY_FRAME_H
#define VS_GEOMETRY_FRAME_H

#include "model/vec.h"

#include <stddef.h>

/* Returns the map that takes the origin to `at` and +Z to `direction` (not zero) by the smallest rotation; for -Z, half
 * a turn about X. */
vs_affine vs_frame_on_axis(vs_vec3 at, vs_vec3 direction);

/* Returns the smallest rotation that takes the unit vector a to the unit vector b. If they are opposite: half a turn
 * about a perpendicular axis. */
vs_affine vs_frame_turn(vs_vec3 a, vs_vec3 b);

/* A point of a path with rotation-minimizing frames (double reflection; Wang, Juettler, Zheng, Liu 2008). At a corner
 * the arriving and the leaving tangent differ; the frame turns by the smallest rotation between them. */
typedef struct { vs_vec3 at, arriving, leaving; double along; /* arc length from the start */ } vs_path_point;
/* Carries x (unit, perpendicular to path[0].leaving) along n > 0 points; x_out[i] belongs to path[i].leaving. A closed
 * path ends with a spin; it is distributed in proportion to `along`. length: of the whole path, including the closing
 * segment. Returns the spin in radians (0 if the path is open). */
double vs_frame_transport(const vs_path_point *path, size_t n, bool closed, double length, vs_vec3 x, vs_vec3 *x_out);

/* Returns the normal as a unit vector that points up; a level one points towards +Y, or along +X. */
vs_vec3 vs_plane_up(vs_vec3 normal);

#endif
