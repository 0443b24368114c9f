/* Declares round pipes of variable radius along curves. */
#ifndef VS_GEOMETRY_PROFILES_PIPE_H
#define VS_GEOMETRY_PROFILES_PIPE_H

#include "geometry/plane/stations.h"

/* The positions of a pipe's rings along a curve. */
typedef struct {
  vs_stations stations;
  double *at; /* distances from the start, ascending; of a closed curve without its end */
  size_t count;
} vs_pipe;

/* Chooses the rings: at the curve's samples, and as many more that neighbours are within a 64th of the length. */
bool vs_pipe_open(const vs_node *curve, int segments, double tolerance, vs_pipe *out, vs_error *e);
void vs_pipe_close(vs_pipe *p);
/* Fills grid, p->count rows of `around` points, with rings of these radii; at the curve's corners they are mitred.
 * Returns false if the curve turns back on itself: *at is the point. */
bool vs_pipe_rings(const vs_pipe *p, const double *radius, size_t around, vs_vec3 *grid, vs_vec3 *at);

#endif
