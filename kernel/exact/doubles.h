/* Declares functions that compute exact signs of determinants of doubles, for meshes whose vertices are not on a
 * grid. */
#ifndef VS_KERNEL_EXACT_DOUBLES_H
#define VS_KERNEL_EXACT_DOUBLES_H

#include "model/vec.h"

/* Returns on which side of the plane through a, b and c the point d lies: 1 above, -1 below, 0 in the plane. a, b and c
 * are counter-clockwise as seen from above. */
int vs_doubles_side(vs_vec3 a, vs_vec3 b, vs_vec3 c, vs_vec3 d);

/* Returns in which direction the path from a over b to c turns, as seen along an axis. The result is 1 for left, -1 for
 * right, 0 for straight. The axis is 0, 1 or 2; the next two axes point to the right and up. */
int vs_doubles_turn(int axis, vs_vec3 a, vs_vec3 b, vs_vec3 c);

#endif
