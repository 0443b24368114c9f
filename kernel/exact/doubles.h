/* Owns exact signs of determinants of doubles, for meshes that are no longer, or not yet, on a grid. */
#ifndef VS_KERNEL_EXACT_DOUBLES_H
#define VS_KERNEL_EXACT_DOUBLES_H

#include "model/vec.h"

/* Which side of the plane through a, b and c, counter-clockwise as seen from above, d lies on: 1 above, -1 below, 0 in
 * it. */
int vs_doubles_side(vs_vec3 a, vs_vec3 b, vs_vec3 c, vs_vec3 d);

/* The turn from a over b to c as seen along an axis (0, 1, 2; the next two to the right and up): 1 to the left, 0 on
 * one line. */
int vs_doubles_turn(int axis, vs_vec3 a, vs_vec3 b, vs_vec3 c);

#endif
