/* Owns the interface of offset.c: offsets in a plane. */
#ifndef VS_GEOMETRY_PLANE_OFFSET_H
#define VS_GEOMETRY_PLANE_OFFSET_H

#include "geometry/plane/areas.h"

/* By how far and with which corners; round ones by the fineness, or segments facets a turn where that is not 0. */
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

/* in made larger by a distance above 0 or smaller */
bool vs_area_offset(const vs_area *in, const vs_offset_rule *rule, vs_area *out, vs_error *e);
/* The line moved to the left (a distance below 0: right); out is empty where nothing is left of it. The distance is
 * not 0. */
bool vs_line_offset(const vs_open_line *line, const vs_offset_rule *rule, vs_polyline *out, vs_error *e);
bool vs_offset_round(const vs_node *offset, vs_affine *place, vs_offset_exact *out);
/* The plane that an open line's left is seen in: columns 0 and 1, and 2 its normal, which looks up; of a straight line
 * the plane nearest to level, of an upright one XZ seen from -Y. False: it lies in no plane. */
bool vs_line_frame(const vs_polyline *line, vs_affine *frame, vs_error *e);

#endif
