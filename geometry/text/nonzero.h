/* Declares loops in a plane that may cross themselves and each other, and the area that they bound; for use in
 * geometry/ alone. By the rule of fonts, the ink (printed area) is where the winding number is not 0. */
#ifndef VS_GEOMETRY_TEXT_NONZERO_H
#define VS_GEOMETRY_TEXT_NONZERO_H

#include "geometry/plane/ear_clipping.h"
#include "model/node.h"

/* A closed loop: `count` points of the array `at` of vs_flat_loops, beginning with index `first`. The first point is
 * not repeated at the end. */
typedef struct { size_t first, count; bool hole; } vs_flat_loop;
typedef struct {
  vs_vec2 *at;
  size_t point_count, point_room;
  vs_flat_loop *loops;
  size_t count, room;
} vs_flat_loops; /* all loops and their points; a structure with all bytes 0 contains no loops */

/* Begins a loop, to which vs_flat_loops_add appends points. Returns false when memory is out. */
bool vs_flat_loops_begin(vs_flat_loops *l);
bool vs_flat_loops_add(vs_flat_loops *l, vs_vec2 p);      /* adds the point p to the last loop, unless p equals the
                                                           * loop's last point; returns false when memory is out */
void vs_flat_loops_free(vs_flat_loops *l);

/* Replaces the loops by loops that bound the ink and do not cross. Outer loops are counter-clockwise. Each outer loop
 * is followed by its holes, which are clockwise. Returns false and sets e on failure. */
bool vs_nonzero(vs_flat_loops *l, vs_error *e);

#endif
