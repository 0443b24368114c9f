/* Declares positions on a curve by arc length: point, direction, frame and curvature at a distance from its start. */
#ifndef VS_GEOMETRY_PLANE_STATIONS_H
#define VS_GEOMETRY_PLANE_STATIONS_H

#include "geometry/plane/curve.h"

/* A sampled curve with its directions. Between samples with different directions it is treated as an arc, so that the
 * length of a circle is exact up to rounding. */
typedef struct {
  vs_path path;
  double *along;   /* along[i]: arc length from the curve's start to sample i; an extra last element is the length of
                    * the whole curve */
  vs_vec3 *across; /* across[i]: first direction of the rotation-minimizing frame at sample i, perpendicular to
                    * path.at[i].leaving */
  double length;
} vs_stations;

typedef struct {
  vs_vec3 at, tangent, across; /* at: the point; tangent: unit direction of the curve there; across: first direction of
                                * the rotation-minimizing frame, a unit vector perpendicular to the tangent */
  double curvature;            /* curvature of the curve at this point: 1 / radius; 0 on straight parts and at
                                * corners */
} vs_station;

/* Samples the curve with the fineness f. Returns false and sets *e on failure, for example if the curve has the length
 * 0. */
bool vs_stations_open(const vs_node *curve, const vs_fineness *f, vs_stations *out, vs_error *e);
void vs_stations_close(vs_stations *s);
/* Returns the point, direction and frame of the curve at the given distance from its start. The distance is limited to
 * the range 0 to s->length. */
vs_station vs_station_at(const vs_stations *s, double distance);

#endif
