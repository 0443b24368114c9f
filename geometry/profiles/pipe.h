/* Declares round pipes of variable radius along curves. */
#ifndef VS_GEOMETRY_PROFILES_PIPE_H
#define VS_GEOMETRY_PROFILES_PIPE_H

#include "geometry/plane/stations.h"

/* The positions of the rings (circular sections) of a pipe along a curve. */
typedef struct {
  vs_stations stations;
  double *at; /* at[i]: distance of ring i (a circular section) along the curve from its start, ascending; a closed
               * curve has no ring at its end */
  size_t count;
} vs_pipe;

/* Chooses the positions of a pipe's rings (circular sections): one at each sample of the curve, and more between
 * samples, so that neighbouring rings are at most a 64th of the curve's length apart. Returns false and sets e on
 * failure. */
bool vs_pipe_open(const vs_node *curve, int segments, double tolerance, vs_pipe *out, vs_error *e);
void vs_pipe_close(vs_pipe *p);
/* Fills grid with p->count rings of `around` points. radius[i]: radius of ring i. Rings at corners of the curve are
 * mitred. Returns false if the curve turns back on itself; *at is then the point where it does. */
bool vs_pipe_rings(const vs_pipe *p, const double *radius, size_t around, vs_vec3 *grid, vs_vec3 *at);

#endif
