/* Declares the points where two curves meet in space. */
#ifndef VS_GEOMETRY_PLANE_MEETINGS_H
#define VS_GEOMETRY_PLANE_MEETINGS_H

#include "geometry/plane/stations.h"

typedef struct {
  vs_vec3 at;
  double s, t; /* distances from the starts of both curves */
} vs_meeting;

typedef enum {
  VS_MEETINGS_DONE,
  VS_MEETINGS_ALONG /* they lie on each other near `at` */,
  VS_MEETINGS_MEMORY
} vs_meetings_outcome;

/* Finds the points within `near` >= 0 of both curves, in the order of a; the caller frees *out. */
vs_meetings_outcome vs_curves_meet(const vs_stations *a, const vs_stations *b, double near, vs_meeting **out,
                                   size_t *count, vs_vec3 *at);

#endif
