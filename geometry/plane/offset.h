/* Declares offsets in a plane: areas enlarged or reduced by a distance, and lines moved to one side. */
#ifndef VS_GEOMETRY_PLANE_OFFSET_H
#define VS_GEOMETRY_PLANE_OFFSET_H

#include "geometry/plane/areas.h"

/* The distance of an offset and the form of its corners. segments: number of facets of a round corner in a full turn;
 * 0: it follows the fineness. */
typedef struct {
  double distance;
  vs_offset_corners corners;
  const vs_fineness *fineness;
  int segments;
} vs_offset_rule;

/* An open line through at least two points; neighbouring points differ. ways: exact unit directions of the line at its
 * two ends. */
typedef struct {
  const vs_vec2 *at;
  size_t count;
  vs_vec2 ways[2];
} vs_open_line;

/* Enlarges the area by the rule's distance, or reduces it if the distance is negative. Returns false and sets e on
 * failure. */
bool vs_area_offset(const vs_area *in, const vs_offset_rule *rule, vs_area *out, vs_error *e);
/* Moves the line to the left by the rule's distance, or to the right if the distance is negative. The distance is not
 * 0. out is empty if nothing remains. Returns false and sets e on failure. */
bool vs_line_offset(const vs_open_line *line, const vs_offset_rule *rule, vs_polyline *out, vs_error *e);
bool vs_offset_round(const vs_node *offset, vs_affine *place, vs_offset_exact *out);
/* Finds the plane in which an open line has a left side. Columns 0 and 1 of *frame span the plane; column 2 is its
 * normal, which points up. For a straight line, uses the plane nearest to horizontal, or if the line is vertical, XZ.
 * Returns false if the line lies in no plane. */
bool vs_line_frame(const vs_polyline *line, vs_affine *frame, vs_error *e);

#endif
