/* Declares balls that contain nodes. A map that turns keeps a ball's size, where it enlarges a box: the box of a set
 * below a hundred placements that turn could be 10^12 times too large, and the ball limits it. */
#ifndef VS_GEOMETRY_MEASURE_BALL_H
#define VS_GEOMETRY_MEASURE_BALL_H

#include "model/vec.h"

/* radius: less than 0 if the ball is empty, infinite if it contains the whole space */
typedef struct { vs_vec3 middle; double radius; } vs_ball;

vs_ball vs_ball_empty(void);
/* Returns the smallest ball that contains the box. This ball and those below are larger by their middles' rounding
 * errors. */
vs_ball vs_ball_of_box(const vs_bounds *b);
/* Returns a ball that contains the ball mapped by a. If a keeps angles, it is the smallest. */
vs_ball vs_ball_mapped(const vs_ball *ball, const vs_affine *a);
/* Enlarges `all` to the smallest ball that contains it and `more`. */
void vs_ball_unite(vs_ball *all, const vs_ball *more);
/* Reduces the box b, which contains the same thing as the ball, to the ball's box, enlarged by rounding errors. */
void vs_ball_limit(const vs_ball *ball, vs_bounds *b);

#endif
