/* Declares the packing of circles into an area. */
#ifndef VS_GEOMETRY_NETS_PACKING_H
#define VS_GEOMETRY_NETS_PACKING_H

#include "geometry/plane/areas.h"
#include "model/long_work.h"

typedef struct {
  vs_vec2 at;
  double radius;
} vs_packed;

/* most: the largest number of circles; least: their smallest radius; gap: the distance between circles, and to the
 * border. */
typedef struct { size_t most; double least, gap; } vs_packing_rule;

/* Places circles within the area, each the largest that fits beside those before it. circles has room for as many as
 * the rule allows; *count becomes their number. A radius is at most a thousandth below the largest possible. Returns
 * false when memory is out, or the caller interrupts (*stopped). */
bool vs_area_pack(const vs_area *area, const vs_packing_rule *rule, vs_long_work work, vs_packed *circles,
                  size_t *count, bool *stopped);

#endif
