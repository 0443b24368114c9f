/* Computes the rings of pipes (pipe.h). */
#include "geometry/profiles/pipe.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"


enum { LEAST_RINGS = 64 };

void vs_pipe_close(vs_pipe *p) {
  vs_stations_close(&p->stations);
  free(p->at);
  *p = (vs_pipe){ 0 };
}

bool vs_pipe_open(const vs_node *curve, int segments, double tolerance, vs_pipe *out, vs_error *e) {
  const vs_fineness f = { .tolerance = tolerance, .segments = segments };
  *out = (vs_pipe){ 0 };
  if (!vs_stations_open(curve, &f, &out->stations, e)) return false;
  const vs_stations *s = &out->stations;
  size_t spans = s->path.count - (s->path.closed ? 0 : 1);
  if (!VS_FRESH(out->at, spans + LEAST_RINGS + 2)) return vs_pipe_close(out), vs_error_memory(e, NULL);
  for (size_t i = 0; i < spans; i++) {
    double from = s->along[i], length = s->along[i + 1] - from;
    int pieces = (int)ceil(length / s->length * LEAST_RINGS - 1e-9);
    if (pieces < 1) pieces = 1; /* pieces: number of parts into which rings (circular sections) divide this span of the
                                 * curve; over all spans, at most spans + LEAST_RINGS */
    for (int k = 0; k < pieces; k++) out->at[out->count++] = from + length * k / pieces;
  }
  if (!s->path.closed) out->at[out->count++] = s->length;
  return true;
}

bool vs_pipe_rings(const vs_pipe *p, const double *radius, size_t around, vs_vec3 *grid, vs_vec3 *at) {
  const vs_stations *s = &p->stations;
  size_t sample = 0;
  for (size_t i = 0; i < p->count; i++) {
    vs_station here = vs_station_at(s, p->at[i]);
    vs_vec3 x = here.across, b = here.tangent, a = b;
    while (sample + 1 < s->path.count && s->along[sample] < p->at[i]) sample++;
    bool end = !s->path.closed && (i == 0 || i + 1 == p->count);
    if (!end && sample < s->path.count && s->along[sample] == p->at[i])
      a = s->path.at[sample].arriving, b = s->path.at[sample].leaving, x = s->across[sample];
    vs_vec3 y = vs_v3_cross(b, x), m = vs_v3_add(a, b);
    double along = vs_v3_dot(b, m);
    if (along < 0.005) return *at = here.at, false;
    if (!vs_v3_equal(a, b)) { /* at a corner of the curve, the ring (circular section) lies in the bisecting plane, so
                               * that the pipe keeps its width on both sides */
      x = vs_v3_sub(x, vs_v3_scale(b, vs_v3_dot(x, m) / along));
      y = vs_v3_sub(y, vs_v3_scale(b, vs_v3_dot(y, m) / along));
    }
    for (size_t k = 0; k < around; k++) {
      double sine, cosine;
      vs_turn_sincos((int)k, (int)around, &sine, &cosine);
      vs_vec3 d = vs_v3_add(vs_v3_scale(x, radius[i] * cosine), vs_v3_scale(y, radius[i] * sine));
      grid[i * around + k] = vs_v3_add(here.at, d);
    }
  }
  return true;
}
