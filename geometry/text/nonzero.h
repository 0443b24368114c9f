/* Owns, for geometry/ alone, loops in a plane that may cross themselves and each other, and the area that they bound by
 * the rule of fonts: ink is where the winding number is not 0. */
#ifndef VS_GEOMETRY_TEXT_NONZERO_H
#define VS_GEOMETRY_TEXT_NONZERO_H

#include "geometry/plane/ear_clipping.h"
#include "model/node.h"

/* points of vs_flat_loops.at; closed, the first is not repeated */
typedef struct { size_t first, count; bool hole; } vs_flat_loop;
typedef struct {
  vs_vec2 *at;
  size_t point_count, point_room;
  vs_flat_loop *loops;
  size_t count, room;
} vs_flat_loops; /* zeroed: empty */

/* begins a loop, to which add appends points; false: out of memory, as for add */
bool vs_flat_loops_begin(vs_flat_loops *l);
bool vs_flat_loops_add(vs_flat_loops *l, vs_vec2 p);      /* omits a point equal to the last */
void vs_flat_loops_free(vs_flat_loops *l);

/* Replaces the loops by those that bound the ink: none crosses another; outer ones are counter-clockwise, each followed
 * by its holes, clockwise. */
bool vs_nonzero(vs_flat_loops *l, vs_error *e);

#endif
