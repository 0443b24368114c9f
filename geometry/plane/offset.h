/* Declares the functions of offset.c: offsets in a plane. */
#ifndef VS_GEOMETRY_PLANE_OFFSET_H
#define VS_GEOMETRY_PLANE_OFFSET_H

#include "geometry/plane/areas.h"

/* The distance and the corners of an offset; round corners follow the fineness or, if segments is not 0, have that many
 * facets in a full turn. */
typedef struct {
  double distance;
  vs_offset_corners corners;
  const vs_fineness *fineness;
  int segments;
} vs_offset_rule;

/* An open line through two points or more, no two neighbours equal. ways: its directions at both ends, unit. */
typedef struct {
  const vs_vec2 *at;
  size_t count;
  vs_vec2 ways[2];
} vs_open_line;

/* Enlarges the area by a distance above 0, or reduces it. */
bool vs_area_offset(const vs_area *in, const vs_offset_rule *rule, vs_area *out, vs_error *e);
/* Moves the line to the left (a distance below 0: right); out is empty if nothing remains. The distance is not 0. */
bool vs_line_offset(const vs_open_line *line, const vs_offset_rule *rule, vs_polyline *out, vs_error *e);
bool vs_offset_round(const vs_node *offset, vs_affine *place, vs_offset_exact *out);
/* Finds the plane in which an open line's left is defined: columns 0 and 1 span it, and 2 is its normal, which points
 * up. For a straight line it is the plane nearest to level, for a vertical one XZ seen from -Y. Returns false if the
 * line lies in no plane. */
bool vs_line_frame(const vs_polyline *line, vs_affine *frame, vs_error *e);

#endif
