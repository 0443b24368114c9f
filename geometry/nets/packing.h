/* Owns the packing of circles into an area. */
#ifndef VS_GEOMETRY_NETS_PACKING_H
#define VS_GEOMETRY_NETS_PACKING_H

#include "geometry/plane/areas.h"

typedef struct {
  vs_vec2 at;
  double radius;
} vs_packed;

/* At most n circles within the area, each the largest that has room beside those before it and keeps `gap` from them
 * and from the border; none smaller than `least`. Fills circles, and *count with how many there are. The radius is the
 * largest possible less a thousandth at most. False: out of memory, or keep_going said so (*stopped). */
bool vs_area_pack(const vs_area *area, size_t n, double least, double gap,
                  bool (*keep_going)(void *context, double done), void *context, vs_packed *circles, size_t *count,
                  bool *stopped);

#endif
