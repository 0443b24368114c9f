/* Owns the packing of circles into an area. */
#ifndef VS_GEOMETRY_NETS_PACKING_H
#define VS_GEOMETRY_NETS_PACKING_H

#include "geometry/plane/areas.h"
#include "model/long_work.h"

typedef struct {
  vs_vec2 at;
  double radius;
} vs_packed;

/* How many circles at most, none of a radius below `least`, which keep `gap` from each other and from the border. */
typedef struct { size_t most; double least, gap; } vs_packing_rule;

/* Circles within the area, each the largest that has room beside those before it. Fills circles, which has room for all
 * that the rule allows, and *count with how many there are. The radius is the largest possible less a thousandth at
 * most. False: out of memory, or the caller said so (*stopped). */
bool vs_area_pack(const vs_area *area, const vs_packing_rule *rule, vs_long_work work, vs_packed *circles,
                  size_t *count, bool *stopped);

#endif
