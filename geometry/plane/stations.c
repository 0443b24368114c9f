/* Computes positions along sampled curves by arc length (stations.h). */
#include "geometry/plane/stations.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"


void vs_stations_close(vs_stations *s) {
  vs_path_free(&s->path);
  free(s->along);
  free(s->across);
  *s = (vs_stations){ 0 };
}

static size_t span_count(const vs_stations *s) { return s->path.count - (s->path.closed ? 0 : 1); }
/* Returns the sample at the end of span i, which is the curve between samples i and i + 1 (on a closed curve, the last
 * span ends at the first sample). `i` is below s->path.count. */
static const vs_path_point *span_end(const vs_stations *s, size_t i) {
  VS_ASSERT(i < s->path.count);
  return &s->path.at[i + 1 < s->path.count ? i + 1 : 0];
}

static double angle_between(vs_vec3 a, vs_vec3 b) { return atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)); }

/* Returns the arc length of the span from p to q. An arc that turns by the angle d is (d/2) / sin(d/2) times as long as
 * its chord. */
static double span_length(const vs_path_point *p, const vs_path_point *q) {
  double half = angle_between(p->leaving, q->arriving) / 2, chord = vs_v3_length(vs_v3_sub(q->at, p->at));
  return half > 1e-8 ? chord * half / sin(half) : chord;
}

bool vs_stations_open(const vs_node *curve, const vs_fineness *f, vs_stations *out, vs_error *e) {
  vs_affine identity = vs_affine_identity();
  *out = (vs_stations){ 0 };
  if (!vs_curve_path(curve, &identity, f, &out->path, e)) return vs_stations_close(out), false;
  size_t n = out->path.count;
  if (!VS_FRESH(out->along, n + 1) || !VS_FRESH(out->across, n + 1))
    return vs_stations_close(out), vs_error_memory(e, NULL);
  double length = 0;
  out->along[0] = 0;
  for (size_t i = 0; n && i < span_count(out); i++)
    out->along[i + 1] = length += span_length(&out->path.at[i], span_end(out, i));
  out->length = length;
  if (n < 2 || !(length > 0))
    return vs_stations_close(out), vs_error_set(e, VS_ERROR_MODEL, NULL, "the curve has no length");
  vs_affine start = vs_frame_on_axis(out->path.at[0].at, out->path.at[0].leaving);
  vs_vec3 x = vs_v3(start.m[0][0], start.m[1][0], start.m[2][0]);
  vs_frame_transport(out->path.at, n, out->path.closed, out->path.length, x, out->across);
  return true;
}

vs_station vs_station_at(const vs_stations *s, double distance) {
  size_t low = 0, high = span_count(s);
  distance = distance > 0 ? distance < s->length ? distance : s->length : 0;
  while (high - low > 1) { /* binary search for the span, between samples `low` and `low` + 1, that contains the
                            * distance: along[low] <= distance */
    size_t middle = (low + high) / 2;
    if (s->along[middle] <= distance)
      low = middle;
    else
      high = middle;
  }
  const vs_path_point *p = &s->path.at[low], *q = span_end(s, low);
  double length = s->along[low + 1] - s->along[low], t = length > 0 ? (distance - s->along[low]) / length : 0;
  vs_vec3 chord = vs_v3_sub(q->at, p->at);
  double turn = angle_between(p->leaving, q->arriving), quarter = cos(turn / 4);
  vs_station r = { .curvature = turn > 1e-9 && length > 0 ? turn / length : 0 };
  if (turn <= 1e-9) {
    r.at = vs_v3_add(p->at, vs_v3_scale(chord, t));
    r.tangent = p->leaving;
  } else { /* the directions of the two samples differ: computes the point on the cubic curve that best approximates an
            * arc between them */
    double speed = vs_v3_length(chord) / (quarter * quarter), u = 1 - t;
    vs_vec3 a = vs_v3_scale(p->leaving, speed), b = vs_v3_scale(q->arriving, speed);
    r.at = vs_v3_add(vs_v3_add(vs_v3_scale(p->at, u * u * (1 + 2 * t)), vs_v3_scale(q->at, t * t * (3 - 2 * t))),
                     vs_v3_add(vs_v3_scale(a, t * u * u), vs_v3_scale(b, -t * t * u)));
    r.tangent = vs_v3_unit(vs_v3_add(vs_v3_scale(chord, 6 * t * u),
                                     vs_v3_add(vs_v3_scale(a, u * (1 - 3 * t)), vs_v3_scale(b, t * (3 * t - 2)))));
  }
  if (t == 1) r.at = q->at, r.tangent = q->arriving;
  if (t == 0) r.at = p->at, r.tangent = p->leaving;
  vs_vec3 x = s->across[low];
  bool corner = vs_v3_length(vs_v3_sub(q->arriving, q->leaving)) > 1e-6;
  if (!corner) x = vs_v3_add(vs_v3_scale(x, 1 - t), vs_v3_scale(s->across[low + 1 < s->path.count ? low + 1 : 0], t));
  x = vs_v3_unit(vs_v3_sub(x, vs_v3_scale(r.tangent, vs_v3_dot(x, r.tangent))));
  r.across = vs_v3_length(x) > 0 ? x : s->across[low];
  return r;
}
