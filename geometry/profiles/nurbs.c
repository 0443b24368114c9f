/* Evaluates rational B-splines (nurbs.h). */
#include "geometry/profiles/nurbs.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"


enum { TERMS = VS_NURBS_DEGREE + 1, SPLITS = 10, LINES = 24 };

double vs_nurbs_low(const vs_nurbs_knots *k) { return k->knots[k->degree]; }
double vs_nurbs_high(const vs_nurbs_knots *k) { return k->knots[k->count]; }

vs_nurbs_fault vs_nurbs_check(const vs_nurbs_knots *k, size_t *at) {
  size_t n = k->count + (size_t)k->degree + 1, same = 1;
  for (size_t i = 1; i < n; i++) {
    *at = i;
    if (k->knots[i] < k->knots[i - 1]) return VS_NURBS_FALLS;
    same = k->knots[i] == k->knots[i - 1] ? same + 1 : 1;
    bool inner = k->knots[i] > vs_nurbs_low(k) && k->knots[i] < vs_nurbs_high(k);
    if (inner && same > (size_t)k->degree) return VS_NURBS_BREAKS;
  }
  *at = k->count;
  return vs_nurbs_low(k) < vs_nurbs_high(k) ? VS_NURBS_GOOD : VS_NURBS_NOTHING;
}

/* Returns the index of the knot span that contains the parameter t: knots[span] <= t < knots[span + 1]. At the end of
 * the parameter's range, returns the last span that is not empty. The degree is 1 to VS_NURBS_DEGREE; the number of
 * control points is greater. */
static size_t span_of(const vs_nurbs_knots *k, double t) {
  size_t low = (size_t)k->degree, high = k->count;
  VS_ASSERT(k->degree >= 1 && k->degree <= VS_NURBS_DEGREE && k->count > (size_t)k->degree);
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    if (k->knots[middle] <= t)
      low = middle;
    else
      high = middle;
  }
  while (low > (size_t)k->degree && k->knots[low] == k->knots[low + 1]) low--; /* at the end of the parameter's
                                                                                * range, goes back over knot spans of
                                                                                * length 0 */
  return low;
}

/* Computes the basis functions that are not 0 in the span, at the parameter t, and their derivatives (The NURBS Book,
 * algorithm A2.3 for the first derivative). The span lies in the parameter's range. */
static void basis(const vs_nurbs_knots *k, size_t span, double t, double *value, double *slope) {
  double left[TERMS + 1], right[TERMS + 1], before[TERMS] = { 1 };
  int p = k->degree;
  VS_ASSERT(span >= (size_t)k->degree && span < k->count);
  value[0] = 1;
  for (int j = 1; j <= p; j++) {
    double saved = 0;
    left[j] = t - k->knots[span + 1 - (size_t)j];
    right[j] = k->knots[span + (size_t)j] - t;
    if (j == p)
      for (int r = 0; r < p; r++) before[r] = value[r];
    for (int r = 0; r < j; r++) {
      double part = value[r] / (right[r + 1] + left[j - r]);
      value[r] = saved + right[r + 1] * part;
      saved = left[j - r] * part;
    }
    value[j] = saved;
  }
  for (int r = 0; r <= p; r++) { /* computes the basis functions of degree p from those of degree p - 1, which are in
                                  * `before` */
    size_t i = span - (size_t)p + (size_t)r;
    double low = k->knots[i + (size_t)p] - k->knots[i], high = k->knots[i + (size_t)p + 1] - k->knots[i + 1];
    slope[r] = (r > 0 && low > 0 ? p * before[r - 1] / low : 0) - (r < p && high > 0 ? p * before[r] / high : 0);
  }
}

typedef struct {
  vs_vec3 at;
  double weight;
} homogeneous;

static void add(homogeneous *sum, vs_vec3 at, double weight) {
  sum->at = vs_v3_add(sum->at, vs_v3_scale(at, weight));
  sum->weight += weight;
}

static vs_vec3 rational_slope(const homogeneous *sum, const homogeneous *slope, vs_vec3 at) {
  return vs_v3_scale(vs_v3_sub(slope->at, vs_v3_scale(at, slope->weight)), 1 / sum->weight);
}

/* A value of the parameter, and the index of the knot span that contains it. */
typedef struct { size_t span; double at; } knot_place;

static vs_vec3 point_in(const vs_nurbs *n, knot_place u, knot_place v, vs_vec3 *by_u, vs_vec3 *by_v) {
  double a[TERMS], da[TERMS], b[TERMS] = { 1 }, db[TERMS] = { 0 };
  bool surface = n->v.count > 0;
  int q = surface ? n->v.degree : 0;
  basis(&n->u, u.span, u.at, a, da);
  if (surface) basis(&n->v, v.span, v.at, b, db);
  homogeneous sum = { { 0, 0, 0 }, 0 }, along_u = sum, along_v = sum;
  for (int i = 0; i <= n->u.degree; i++)
    for (int j = 0; j <= q; j++) {
      size_t row = u.span - (size_t)n->u.degree + (size_t)i, column = v.span - (size_t)q + (size_t)j;
      size_t at = surface ? row * n->v.count + column : row;
      double w = n->weights ? n->weights[at] : 1;
      add(&sum, n->points[at], w * a[i] * b[j]);
      add(&along_u, n->points[at], w * da[i] * b[j]);
      add(&along_v, n->points[at], w * a[i] * db[j]);
    }
  vs_vec3 r = vs_v3_scale(sum.at, 1 / sum.weight);
  if (by_u) *by_u = rational_slope(&sum, &along_u, r);
  if (by_v) *by_v = rational_slope(&sum, &along_v, r);
  return r;
}

vs_vec3 vs_nurbs_point(const vs_nurbs *n, double u, double v, vs_vec3 *slope_u, vs_vec3 *slope_v) {
  knot_place in_u = { span_of(&n->u, u), u }, in_v = { n->v.count ? span_of(&n->v, v) : 0, v };
  return point_in(n, in_u, in_v, slope_u, slope_v);
}

/* ---- parameters for sampling ---- */

/* Writes the different knots within the parameter's range to out, in ascending order. Returns their number. */
static size_t break_points(const vs_nurbs_knots *k, double *out) {
  size_t count = 0;
  for (size_t i = (size_t)k->degree; i <= k->count; i++)
    if (!count || k->knots[i] > out[count - 1]) out[count++] = k->knots[i];
  return count;
}

/* Returns the distance of the curve from its chord over the parameters [a, b]: the largest of three distances, at the
 * quarters of the range. For a surface, returns the largest over `lines` of its lines, at the parameters `across` of
 * the other direction. */
static double sagitta(const vs_nurbs *n, bool along_v, const double *across, size_t lines, double a, double b) {
  double most = 0;
  for (size_t i = 0; i < lines; i++) {
    vs_vec3 at[5];
    for (int k = 0; k < 5; k++) {
      double t = a + (b - a) * k / 4;
      at[k] = along_v ? vs_nurbs_point(n, across[i], t, NULL, NULL) : vs_nurbs_point(n, t, across[i], NULL, NULL);
    }
    vs_vec3 chord = vs_v3_sub(at[4], at[0]), way = vs_v3_unit(chord);
    for (int k = 1; k < 4; k++) { /* measures the distances of points from the line through the chord; their positions
                                   * along this line do not matter */
      vs_vec3 d = vs_v3_sub(at[k], at[0]);
      most = fmax(most, vs_v3_length(vs_v3_sub(d, vs_v3_scale(way, vs_v3_dot(d, way)))));
    }
  }
  return most;
}

size_t vs_nurbs_parameters(const vs_nurbs *n, bool along_v, double chord, double **out) {
  const vs_nurbs_knots *k = along_v ? &n->v : &n->u, *other = along_v ? &n->u : &n->v;
  double across[LINES + 1] = { 0 }, *ends = NULL, *made = NULL;
  size_t lines = 1, room = 0, count = 0;
  VS_ASSERT(chord > 0);
  if (n->v.count) {
    lines = LINES + 1;
    for (size_t i = 0; i < lines; i++)
      across[i] = vs_nurbs_low(other) + (vs_nurbs_high(other) - vs_nurbs_low(other)) * (double)i / LINES;
  }
  *out = NULL;
  if (!VS_FRESH(ends, k->count + 2)) return 0;
  size_t spans = break_points(k, ends) - 1;
  bool ok = true;
  for (size_t i = 0; ok && i < spans; i++) {
    int pieces = 1;
    for (bool fine = false; !fine && pieces < 512; pieces *= fine ? 1 : 2) {
      fine = true;
      for (int j = 0; fine && j < pieces; j++) {
        double w = (ends[i + 1] - ends[i]) / pieces;
        fine = sagitta(n, along_v, across, lines, ends[i] + w * j, ends[i] + w * (j + 1)) <= chord;
      }
    }
    ok = VS_GROW(made, room, count + (size_t)pieces + 1);
    for (int j = 0; ok && j < pieces; j++) made[count++] = ends[i] + (ends[i + 1] - ends[i]) * j / pieces;
  }
  if (ok) made[count++] = ends[spans];
  free(ends);
  if (!ok) return free(made), (size_t)0;
  *out = made;
  return count;
}

/* ---- curves as nodes ---- */

typedef struct {
  vs_vec3 at, slope;
} sample;
typedef struct {
  sample *at;
  size_t count, room;
} samples;

static bool append(samples *s, sample p) {
  if (!VS_GROW(s->at, s->room, s->count + 1)) return false;
  s->at[s->count++] = p;
  return true;
}

static sample sample_in(const vs_nurbs *n, size_t span, double t) {
  sample r;
  r.at = point_in(n, (knot_place){ span, t }, (knot_place){ 0, 0 }, &r.slope, NULL);
  r.slope = vs_v3_unit(r.slope);
  return r;
}

/* Returns true if samples a and b of a curve are too far apart. They are if the cubic through them, with their
 * directions, deviates from the sample `middle` by more than `slack`, or if the curve turns by more than a 64th of a
 * turn between them. */
static bool is_coarse(sample a, sample b, sample middle, double slack) {
  double turn = atan2(vs_v3_length(vs_v3_cross(a.slope, b.slope)), vs_v3_dot(a.slope, b.slope));
  double chord = vs_v3_length(vs_v3_sub(b.at, a.at)), quarter = cos(turn / 4);
  if (chord == 0) return true;
  if (turn > 6.2831853071795865 / 64) return true;
  vs_vec3 bow = vs_v3_scale(vs_v3_sub(a.slope, b.slope), chord / (quarter * quarter) / 8);
  vs_vec3 d = vs_v3_sub(middle.at, vs_v3_add(vs_v3_scale(vs_v3_add(a.at, b.at), .5), bow));
  vs_vec3 way = vs_v3_unit(vs_v3_sub(b.at, a.at));
  return vs_v3_length(vs_v3_sub(d, vs_v3_scale(way, vs_v3_dot(d, way)))) > slack;
}

/* Appends samples of one knot span, for parameters from a to b; b itself is not sampled. slack: allowed deviation of
 * the curve between samples. */
static bool sample_span(const vs_nurbs *n, size_t span, double a, double b, double slack, samples *out) {
  enum { START = 4 };
  double to[START + SPLITS + 1]; /* stack of ranges of the parameter that are still to be sampled; a range is given by
                                  * its end, and the next range is on top */
  int depth[START + SPLITS + 1], todo = 0;
  for (int i = 0; i < START; i++) to[todo] = b + (a - b) * i / START, depth[todo++] = 0;
  double from = a;
  sample start = sample_in(n, span, a);
  while (todo) {
    double end = to[todo - 1], middle = (from + end) / 2;
    sample stop = sample_in(n, span, end);
    if (depth[todo - 1] < SPLITS && is_coarse(start, stop, sample_in(n, span, middle), slack)) {
      depth[todo - 1]++;
      to[todo] = middle, depth[todo] = depth[todo - 1], todo++;
      continue;
    }
    if (!append(out, start)) return false;
    from = end, start = stop, todo--;
  }
  return true;
}

static vs_node *spline_node(vs_store *s, const sample *at, size_t count, bool closed) {
  vs_vec3 *points = NULL;
  size_t kept = 0;
  if (!VS_FRESH(points, count + 1)) return NULL;
  for (size_t i = 0; i < count; i++)
    if (!kept || !vs_v3_equal(points[kept - 1], at[i].at)) points[kept++] = at[i].at;
  vs_points *p = vs_points_new(s, points, kept);
  struct vs_spline d = { .points = p, .closed = closed };
  if (!closed) d.start_tangent = at[0].slope, d.end_tangent = at[count - 1].slope;
  struct vs_line line = { .points = p };
  vs_node *n = !p ? NULL : kept < 3 ? vs_node_new(s, VS_LINE, &line, NULL, 0) : vs_node_new(s, VS_SPLINE, &d, NULL, 0);
  if (p) vs_points_release(s, p);
  free(points);
  return n;
}

static vs_node *line_node(vs_store *s, const vs_nurbs *n, double near) {
  samples all = { 0 };
  bool ok = true;
  double *ends = NULL;
  size_t count = VS_FRESH(ends, n->u.count + 2) ? break_points(&n->u, ends) : 0;
  for (size_t i = 0; ok && i < count; i++)
    ok = append(&all, (sample){ .at = vs_nurbs_point(n, ends[i], 0, NULL, NULL) });
  bool closed = all.count > 3 && vs_v3_length(vs_v3_sub(all.at[0].at, all.at[all.count - 1].at)) <= near;
  vs_node *made = NULL;
  if (ends && ok) {
    vs_vec3 *at = NULL;
    if (!VS_FRESH(at, all.count + 1)) count = 0;
    for (size_t i = 0; at && i < all.count; i++) at[i] = all.at[i].at;
    vs_points *p = at ? vs_points_new(s, at, all.count - closed) : NULL;
    if (p) {
      made = vs_node_new(s, VS_LINE, &(struct vs_line){ .points = p, .closed = closed }, NULL, 0);
      vs_points_release(s, p);
    }
    free(at);
  }
  free(ends), free(all.at);
  return made;
}

static bool is_corner(vs_vec3 a, vs_vec3 b) { return vs_v3_length(vs_v3_sub(a, b)) > 1e-6; }

vs_node *vs_nurbs_curve_node(vs_store *s, const vs_nurbs *n) {
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < n->u.count; i++) vs_bounds_add(&b, n->points[i]);
  double size = vs_bounds_diagonal(&b), near = 1e-9 * size;
  if (!(size > 0)) return vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
  if (n->u.degree == 1) return line_node(s, n, near);
  samples piece = { 0 };
  vs_ref *pieces = NULL;
  size_t count = 0, room = 0;
  bool ok = true, closed = false;
  vs_vec3 first = { 0, 0, 0 }, first_way = first;
  vs_node *made = NULL;
  for (size_t span = (size_t)n->u.degree, next; ok && span < n->u.count; span = next) {
    double a = n->u.knots[span], z = n->u.knots[span + 1];
    next = span + 1;
    if (!(z > a)) continue;
    while (next < n->u.count && n->u.knots[next + 1] == n->u.knots[next]) next++; /* finds the next knot span whose
                                                                                   * length is not 0 */
    ok = sample_span(n, span, a, z, 1e-7 * size, &piece);
    if (!ok) break;
    sample end = sample_in(n, span, z);
    bool last = next >= n->u.count || !(n->u.knots[n->u.count] > z);
    if (!count && piece.count && vs_nurbs_low(&n->u) == a) first = piece.at[0].at, first_way = piece.at[0].slope;
    if (last) closed = vs_v3_length(vs_v3_sub(end.at, first)) <= near;
    bool smooth = last && closed && !count && !is_corner(end.slope, first_way);
    if (!last && !is_corner(end.slope, sample_in(n, next, z).slope)) continue;
    if (!smooth) ok = append(&piece, end);
    size_t half = piece.count / 2;
    bool halved = last && closed && !count && !smooth && half > 0; /* a closed curve without corners, except where its
                                                                    * ends meet, must be divided into two splines */
    ok = ok && VS_GROW(pieces, room, count + 2);
    if (ok && halved) {
      pieces[count] = (vs_ref){ spline_node(s, piece.at, half + 1, false), NULL };
      ok = pieces[count].node != NULL;
      count += ok;
    }
    size_t from = halved ? half : 0;
    if (ok) {
      pieces[count] = (vs_ref){ spline_node(s, piece.at + from, piece.count - from, smooth), NULL };
      ok = pieces[count].node != NULL;
      count += ok;
    }
    piece.count = 0;
    if (last) break;
  }
  if (ok && count == 1) made = vs_node_retain(pieces[0].node);
  if (ok && count > 1) made = vs_node_new(s, VS_JOIN, &(struct vs_join){ .closed = closed }, pieces, count);
  for (size_t i = 0; i < count; i++) vs_node_release(pieces[i].node);
  free(pieces), free(piece.at);
  return made;
}
