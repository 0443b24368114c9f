/* Declares the nesting of flat parts on sheets: parts of any shape are turned and moved so that they lie apart from
 * each other. */
#ifndef VS_GEOMETRY_NETS_NESTING_H
#define VS_GEOMETRY_NETS_NESTING_H

#include "geometry/plane/areas.h"
#include "model/long_work.h"

/* The sheets, and the rules for parts on them. `angles`: allowed rotations in radians; if angle_count is 0, eighths of
 * a turn and some others. `gap`: distance between parts. `margin`: distance from the border. `effort`: time of the
 * search in seconds. */
typedef struct {
  double width, height, gap, margin;
  const double *angles;
  size_t angle_count;
  double effort;
} vs_nest_rule;

/* The place of a part: it lies on sheet number `sheet`, from 0, after a rotation about the origin and then a move. */
typedef struct {
  uint32_t sheet;
  double angle;
  vs_vec2 move;
} vs_nest_place;

/* Places all parts on sheets. *unfit: index of a part that is larger than a sheet, or `count` if all parts fit; then
 * all places are set. Returns false when memory is out, or with *stopped true when the caller interrupts. */
bool vs_areas_nest(const vs_area *parts, size_t count, const vs_nest_rule *rule, vs_long_work work,
                   vs_nest_place *places, size_t *sheets, size_t *unfit, bool *stopped);

#endif
