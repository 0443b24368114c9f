/* Owns frames: "on the axis", and frames along a path that do not spin. */
#ifndef VS_GEOMETRY_FRAME_H
#define VS_GEOMETRY_FRAME_H

#include "model/vec.h"

/* The map that takes the origin to `at` and +Z to `direction` (not zero) by the smallest rotation; for -Z half a turn about X. */
vs_affine vs_frame_on_axis(vs_vec3 at, vs_vec3 direction);

/* Frames at each of n points of a path (closed: joins), rotation-minimising (double reflection, Wang et al. 2008). tangents: unit, one a
 * point. The first frame's axes are given; out[i] has columns x, y, tangent, point. A closed path's spin is spread evenly. */
void vs_frame_transport(const vs_vec3 *points, const vs_vec3 *tangents, int n, bool closed, vs_vec3 first_x, vs_affine *out);

#endif
