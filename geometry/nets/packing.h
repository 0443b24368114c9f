/* Declares the packing of circles into an area of the plane. */
#ifndef VS_GEOMETRY_NETS_PACKING_H
#define VS_GEOMETRY_NETS_PACKING_H

#include "geometry/plane/areas.h"
#include "model/long_work.h"

typedef struct {
  vs_vec2 at;
  double radius;
} vs_packed;

/* Rules for the packing. most: greatest number of circles; least: smallest radius; gap: distance between two circles,
 * and of a circle from the border. */
typedef struct { size_t most; double least, gap; } vs_packing_rule;

/* Places circles in the area, each with the largest radius that fits beside the earlier circles. `circles` has room for
 * rule->most elements; *count becomes their number. Returns false when memory is out, or with *stopped true when the
 * caller interrupts. */
bool vs_area_pack(const vs_area *area, const vs_packing_rule *rule, vs_long_work work, vs_packed *circles,
                  size_t *count, bool *stopped);

#endif
