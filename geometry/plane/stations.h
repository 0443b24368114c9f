/* Owns places on a curve by arc length: point, direction, frame and curvature at a distance from its start. */
#ifndef VS_GEOMETRY_PLANE_STATIONS_H
#define VS_GEOMETRY_PLANE_STATIONS_H

#include "geometry/plane/curve.h"

/* A curve sampled with its directions. Between samples that differ in direction it is taken as an arc: of circles the
 * length is exact to rounding, of splines to the fourth power of the sampling. */
typedef struct {
  vs_path path;
  double *along;   /* arc length at each sample, and behind them that of the whole */
  vs_vec3 *across; /* the frame's first direction at each sample, across path.at[i].leaving: it does not spin */
  double length;
} vs_stations;

typedef struct {
  vs_vec3 at, tangent, across; /* tangent and across are unit and square to each other */
  double curvature;            /* 1 / radius; 0 on straight parts and at corners */
} vs_station;

/* Samples the curve as f says. False: *e says why; what has no length is an error too. */
bool vs_stations_open(const vs_node *curve, const vs_fineness *f, vs_stations *out, vs_error *e);
void vs_stations_close(vs_stations *s);
/* The station at a distance from the start, which is taken as from 0 to s->length. */
vs_station vs_station_at(const vs_stations *s, double distance);

#endif
