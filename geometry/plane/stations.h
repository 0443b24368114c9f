/* Declares positions on a curve by arc length: point, direction, frame and curvature at a distance from its start. */
#ifndef VS_GEOMETRY_PLANE_STATIONS_H
#define VS_GEOMETRY_PLANE_STATIONS_H

#include "geometry/plane/curve.h"

/* A curve sampled with its directions. Between samples of different directions it counts as an arc: the length of
 * circles is exact to rounding, that of splines to the fourth power of the sample distance. */
typedef struct {
  vs_path path;
  double *along;   /* arc length at each sample, then that of the whole curve */
  vs_vec3 *across; /* the frame's first direction at each sample, perpendicular to path.at[i].leaving and
                    * rotation-minimizing */
  double length;
} vs_stations;

typedef struct {
  vs_vec3 at, tangent, across; /* tangent and across are unit and perpendicular */
  double curvature;            /* 1 / radius; 0 on straight parts and at corners */
} vs_station;

/* Samples the curve with the fineness f. Returns false with the reason in *e; a curve of length 0 is an error too. */
bool vs_stations_open(const vs_node *curve, const vs_fineness *f, vs_stations *out, vs_error *e);
void vs_stations_close(vs_stations *s);
/* Returns the station at a distance from the start, limited to the range 0 to s->length. */
vs_station vs_station_at(const vs_stations *s, double distance);

#endif
