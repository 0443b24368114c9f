/* Declares exact signs of determinants of doubles, for meshes that are not on a grid. */
#ifndef VS_KERNEL_EXACT_DOUBLES_H
#define VS_KERNEL_EXACT_DOUBLES_H

#include "model/vec.h"

/* Returns the side of d at the plane through a, b and c, which are counter-clockwise as seen from above: 1 above, -1
 * below, 0 in the plane. */
int vs_doubles_side(vs_vec3 a, vs_vec3 b, vs_vec3 c, vs_vec3 d);

/* Returns the turn from a over b to c as seen along an axis (0, 1, 2; the next two point to the right and up): 1 left,
 * -1 right, 0 on one line. */
int vs_doubles_turn(int axis, vs_vec3 a, vs_vec3 b, vs_vec3 c);

#endif
