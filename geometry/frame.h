/* Owns frames: "on the axis", and frames along a path that do not spin. */
#ifndef VS_GEOMETRY_FRAME_H
#define VS_GEOMETRY_FRAME_H

#include "model/vec.h"

#include <stddef.h>

/* The map that takes the origin to `at` and +Z to `direction` (not zero) by the smallest rotation; for -Z half a turn
 * about X. */
vs_affine vs_frame_on_axis(vs_vec3 at, vs_vec3 direction);

/* The smallest rotation that takes the unit vector a to the unit vector b (opposite ones: half a turn about any axis
 * across). */
vs_affine vs_frame_turn(vs_vec3 a, vs_vec3 b);

/* A path as frames that do not spin (double reflection; Wang, Juettler, Zheng, Liu 2008). At a corner the tangents
 * arriving and leaving differ, and the frame turns by the smallest rotation between them. */
typedef struct { vs_vec3 at, arriving, leaving; double along; /* arc length from the start */ } vs_path_point;
/* Carries x (unit, across path[0].leaving) along n points; x_out[i] belongs to path[i].leaving; path's `along` gives
 * the weight by which the spin that a closed path gathers is spread. length: of the whole, the closing stretch too.
 * Returns that spin (0 where open). n is above 0. */
double vs_frame_transport(const vs_path_point *path, size_t n, bool closed, double length, vs_vec3 x, vs_vec3 *x_out);

/* The normal made unit, and turned to look up: along +Y, or +X, where it is level. */
vs_vec3 vs_plane_up(vs_vec3 normal);

#endif
