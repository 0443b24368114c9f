/* Declares the search for points where two curves intersect or touch in space. */
#ifndef VS_GEOMETRY_PLANE_MEETINGS_H
#define VS_GEOMETRY_PLANE_MEETINGS_H

#include "geometry/plane/stations.h"

typedef struct {
  vs_vec3 at;
  double s, t; /* arc lengths, from the starts of curves a and b, of the point where they meet */
} vs_meeting;

typedef enum {
  VS_MEETINGS_DONE,
  VS_MEETINGS_ALONG /* the curves coincide along a part near the point `at` */,
  VS_MEETINGS_MEMORY
} vs_meetings_outcome;

/* Finds the points where the curves a and b are at most `near` apart, in order along curve a. near is at least 0. The
 * caller frees *out. */
vs_meetings_outcome vs_curves_meet(const vs_stations *a, const vs_stations *b, double near, vs_meeting **out,
                                   size_t *count, vs_vec3 *at);

#endif
