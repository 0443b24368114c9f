/* Makes lofts that follow a path or guides.
 *
 * Along a path, each section is described in the path's rotation-minimizing frame at its position. The description
 * consists of three parts. The first is the flat shape, relative to the section's centre. The second is the position of
 * the centre. The third is the tilt, the smallest rotation from the path's direction to the section's normal. Between
 * the sections, these three are interpolated smoothly in the moving frame. If the points alone were interpolated, the
 * loft would become narrower where two sections tilt in opposite directions: halfway, the tilts cancel, but the chords
 * between the points are shorter. The sections themselves do not move. Only the rows between the sections follow the
 * path.
 *
 * With guides, the free loft between two sections is moved so that its wall touches every guide. The common part of the
 * guides' motions moves all points of a row. It is a shift for one guide, a rotation with a scale for two guides, and
 * an affine map of the section's plane for three or more. The remaining motion of each guide decreases towards the next
 * guide. */
#include "geometry/profiles/loft_guided.h"

#include <stdlib.h>

#include "geometry/plane/curve.h"
#include "geometry/profiles/loft.h"
#include "geometry/profiles/loft_mesh.h"
#include "model/store/array.h"

/* ---- lofts along a path ---- */

typedef struct { vs_vec3 at, x, y, z; } guided_frame;

/* The path of the loft, and the positions of its sections on the path. */
typedef struct {
  vs_path path;
  vs_vec3 *x;       /* x[i]: x direction of the moving frame at sample i of the path */
  size_t stations;  /* number of sections along the path; on a closed path, the first section counts again at its end */
  double *s;        /* s[i]: arc length from the path's start to section i */
  vs_vec3 *local;   /* description of each section in the moving frame: its points, its centre and its tilt
                     * (guided_describe) */
} guided_way;

/* Returns the moving frame at the arc length s of the path. It is interpolated between the path's samples. */
static guided_frame guided_frame_at(const guided_way *way, double s) {
  const vs_path *p = &way->path;
  const vs_vec3 *x = way->x;
  size_t low = 0, high = p->count;
  if (p->closed) s -= p->length * floor(s / p->length);
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    if (p->at[middle].along <= s) low = middle;
    else high = middle;
  }
  if (high == p->count && !p->closed) high = low, low = low ? low - 1 : 0;
  bool round = high == p->count;
  const vs_path_point *a = &p->at[low], *b = &p->at[round ? 0 : high];
  double from = a->along, to = round ? p->length : b->along, t = to > from ? (s - from) / (to - from) : 0;
  vs_vec3 z = vs_v3_unit(vs_v3_add(vs_v3_scale(a->leaving, 1 - t), vs_v3_scale(b->arriving, t)));
  vs_vec3 across = vs_v3_add(vs_v3_scale(x[low], 1 - t), vs_v3_scale(x[round ? 0 : high], t));
  across = vs_v3_unit(vs_v3_sub(across, vs_v3_scale(z, vs_v3_dot(across, z))));
  return (guided_frame){ vs_v3_add(a->at, vs_v3_scale(vs_v3_sub(b->at, a->at), t)), across, vs_v3_cross(z, across), z };
}

/* Returns the arc length s >= `least` at which the path is nearest to the point c. On a closed path, s may be in its
 * second round. */
static double guided_nearest(const vs_path *p, vs_vec3 c, double least) {
  double best = INFINITY, at = least;
  size_t n = p->closed ? p->count : p->count - 1;
  for (size_t turn = 0; turn < (p->closed ? 2u : 1u); turn++)
    for (size_t i = 0; i < n; i++) {
      vs_vec3 a = p->at[i].at, d = vs_v3_sub(p->at[i + 1 < p->count ? i + 1 : 0].at, a);
      double dd = vs_v3_dot(d, d), t = dd > 0 ? fmax(0, fmin(1, vs_v3_dot(vs_v3_sub(c, a), d) / dd)) : 0;
      double s = p->at[i].along + t * sqrt(dd) + (double)turn * p->length,
             far = vs_v3_length(vs_v3_sub(vs_v3_add(a, vs_v3_scale(d, t)), c));
      if (s >= least && far < best * (1 - 1e-9)) best = far, at = s;
    }
  return at;
}

/* Finds the arc length of each section on the path p. Reverses the path if the sections follow it from its end to its
 * start. Returns false and sets e on failure. */
static bool guided_stations(const vs_loft *l, vs_path *p, double *s, vs_error *e) {
  size_t n = l->rows + l->joined;
  s[0] = 0;
  if (!p->closed && guided_nearest(p, l->center[0], 0) > guided_nearest(p, l->center[l->rows - 1], 0))
    vs_path_reverse(p);
  if (p->closed) { /* on a closed path, chooses the direction in which the second section comes before the others */
    double a = guided_nearest(p, l->center[0], 0), b = guided_nearest(p, l->center[1], a),
           c = guided_nearest(p, l->center[l->rows - 1], a);
    if (l->rows > 2 && c < b) vs_path_reverse(p);
  }
  for (size_t i = 0; i < n; i++) {
    s[i] = i == l->rows ? s[0] + p->length : guided_nearest(p, l->center[i], i ? s[i - 1] : 0);
    if (i && !(s[i] > s[i - 1] + 1e-9 * p->length))
      return vs_error_set(
          e, VS_ERROR_MODEL, NULL,
          "sections must follow each other along the path; section %zu does not lie after section %zu",
          i + 1, i);
  }
  return true;
}

/* Vectors in a section's description after its points. GUIDED_MIDDLE: its centre; GUIDED_LEAN: its tilt; GUIDED_EXTRA:
 * number of these vectors. */
enum { GUIDED_MIDDLE, GUIDED_LEAN, GUIDED_EXTRA };

static vs_vec3 guided_out(const guided_frame *f, vs_vec3 v) {
  return vs_v3_add(vs_v3_add(vs_v3_scale(f->x, v.x), vs_v3_scale(f->y, v.y)), vs_v3_scale(f->z, v.z));
}
static vs_vec3 guided_in(const guided_frame *f, vs_vec3 v) {
  return vs_v3(vs_v3_dot(v, f->x), vs_v3_dot(v, f->y), vs_v3_dot(v, f->z));
}

/* Returns v rotated about the axis w. The angle, in radians, is the length of w (Rodrigues' formula). */
static vs_vec3 guided_turned(vs_vec3 w, vs_vec3 v) {
  double angle = vs_v3_length(w);
  if (!(angle > 0)) return v;
  vs_vec3 k = vs_v3_scale(w, 1 / angle);
  vs_vec3 along = vs_v3_scale(k, vs_v3_dot(k, v) * (1 - cos(angle)));
  return vs_v3_add(vs_v3_add(vs_v3_scale(v, cos(angle)), vs_v3_scale(vs_v3_cross(k, v), sin(angle))), along);
}

/* Computes the description of a section in the moving frame f: its points, centre and tilt. The section is a row of n
 * points with its centre `middle` and its normal; the normal is zero if the section has none. */
static void guided_describe(const guided_frame *f, const vs_vec3 *row, size_t n, vs_vec3 middle, vs_vec3 normal,
                            vs_vec3 *local) {
  vs_vec3 z = guided_in(f, normal), axis = vs_v3(-z.y, z.x, 0); /* axis: cross product of +Z and z, the axis about which
                                                                 * the section is tilted */
  double sine = vs_v3_length(axis);
  vs_vec3 lean = sine > 1e-12 ? vs_v3_scale(axis, atan2(sine, z.z) / sine) : vs_v3(0, 0, 0),
          back = vs_v3_scale(lean, -1);
  for (size_t c = 0; c < n; c++) local[c] = guided_turned(back, guided_in(f, vs_v3_sub(row[c], middle)));
  local[n + GUIDED_MIDDLE] = guided_in(f, vs_v3_sub(middle, f->at));
  local[n + GUIDED_LEAN] = lean;
}

static void guided_row(const guided_frame *f, const vs_vec3 *local, size_t n, vs_vec3 *row) {
  for (size_t c = 0; c < n; c++)
    row[c] = vs_v3_add(
        f->at, guided_out(f, vs_v3_add(local[n + GUIDED_MIDDLE], guided_turned(local[n + GUIDED_LEAN], local[c]))));
}

/* Returns the slope of a vector of the sections' descriptions at section i: its derivative by the arc length of the
 * path. `c`: index of the vector in a description; `n`: number of vectors in a description. There are at least two
 * sections. */
static vs_vec3 guided_slope(const guided_way *way, size_t n, size_t i, size_t c) {
  const vs_vec3 *local = way->local;
  const double *s = way->s;
  size_t stations = way->stations;
  vs_vec3 secant[2] = { { 0, 0, 0 }, { 0, 0, 0 } };
  double step[2] = { 1, 1 };
  size_t mid = i == 0 ? 1 : i + 1 == stations ? stations - 2 : i;
  VS_ASSERT(stations >= 2 && i < stations && c < n);
  if (stations < 3) mid = 1;
  for (int k = 0; k < 2; k++) {
    size_t a = mid - 1 + (size_t)k;
    if (a + 1 >= stations) a = stations - 2;
    step[k] = s[a + 1] - s[a];
    secant[k] = vs_v3_scale(vs_v3_sub(local[(a + 1) * n + c], local[a * n + c]), 1 / step[k]);
  }
  if (stations < 3) return secant[0];
  vs_vec3 m = vs_loft_slope(secant[0], secant[1], step[0], step[1]);
  return i == 0 ? vs_loft_end_slope(secant[0], m) : i + 1 == stations ? vs_loft_end_slope(secant[1], m) : m;
}

static bool guided_rows(const vs_loft *l, const guided_way *way, const vs_fineness *f, vs_loft_rows *out) {
  const vs_path *p = &way->path;
  const double *s = way->s;
  const vs_vec3 *local = way->local;
  size_t n = l->columns, wide = n + GUIDED_EXTRA, stations = way->stations;
  vs_vec3 *between = vs_fresh(wide, sizeof *between);
  bool ok = between != NULL;
  for (size_t i = 0; ok && i + 1 < stations; i++) {
    double from = s[i], to = s[i + 1], steps = 1;
    for (size_t c = 0; c < wide; c++) {
      vs_vec3 m = vs_v3_scale(guided_slope(way, wide, i, c), to - from),
              k = vs_v3_scale(guided_slope(way, wide, i + 1, c), to - from);
      if (c == n + GUIDED_LEAN) { /* the vector is the tilt: points of the section move on arcs, at a distance from the
                                   * axis of the tilt */
        double turn = vs_v3_length(vs_v3_sub(local[(i + 1) * wide + c], local[i * wide + c])), far = 0;
        for (size_t q = 0; q < n; q++) far = fmax(far, vs_v3_length(local[i * wide + q]));
        steps = fmax(steps, (double)vs_fineness_turn(f, far, 0) * turn / 6.283185307179586);
      } else {
        steps = fmax(steps, vs_loft_hermite_steps(local[i * wide + c], local[(i + 1) * wide + c], m, k, f));
      }
    }
    steps = ceil(steps);
    /* The number of rows between two sections depends on the difference of the two, and on the samples of the path. */
    size_t sample = 0, turns = p->closed ? 3 : 1;
    double at = from, next = 1;
    while (ok && at < to) {
      vs_vec3 *row = vs_loft_rows_add(out);
      ok = row != NULL;
      if (!ok) break;
      if (at == from) {
        for (size_t c = 0; c < n; c++) row[c] = l->at[i * n + c];
      } else {
        double t = (at - from) / (to - from);
        for (size_t c = 0; c < wide; c++) {
          vs_vec3 m = vs_v3_scale(guided_slope(way, wide, i, c), to - from),
                  k = vs_v3_scale(guided_slope(way, wide, i + 1, c), to - from);
          between[c] = vs_loft_hermite(local[i * wide + c], local[(i + 1) * wide + c], m, k, t);
        }
        guided_frame frame = guided_frame_at(way, at);
        guided_row(&frame, between, n, row);
      }
      double step = from + (to - from) * next / steps, along = INFINITY, near = 1e-6 * (to - from) / steps;
      for (; sample < turns * p->count; sample++) {
        along = p->at[sample % p->count].along + (double)(sample / p->count) * p->length;
        if (along > at + near) break;
        along = INFINITY;
      }
      if (step <= at + near) step = from + (to - from) * ++next / steps;
      at = fmin(step, along);
      if (at >= to - near) break;
      if (at == step) next++;
    }
  }
  vs_vec3 *last = ok && !l->joined ? vs_loft_rows_add(out) : NULL;
  for (size_t c = 0; last && c < n; c++) last[c] = l->at[(l->rows - 1) * n + c];
  free(between);
  return ok && (last || l->joined);
}

bool vs_loft_along_path(const vs_node *n, const vs_loft *l, const vs_fineness *f, vs_loft_rows *out, vs_error *e) {
  guided_way way = { .stations = l->rows + l->joined };
  vs_affine identity = vs_affine_identity();
  size_t stations = way.stations;
  double *s = way.s = vs_fresh(stations + 1, sizeof *s);
  vs_vec3 *local = way.local = vs_fresh(stations * (l->columns + GUIDED_EXTRA), sizeof *local);
  vs_path *p = &way.path;
  bool ok = (s && local) || vs_error_memory(e, NULL);
  ok = ok && vs_curve_path(n->children[n->child_count - 1].node, &identity, f, p, e);
  if (ok && p->count < 2) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "the path is a point");
  ok = ok && guided_stations(l, p, s, e) &&
       ((way.x = vs_fresh(p->count + 1, sizeof *way.x)) != NULL || vs_error_memory(e, NULL));
  if (ok) {
    vs_affine square = vs_frame_on_axis(p->at[0].at, p->at[0].leaving);
    vs_vec3 across = vs_v3(square.m[0][0], square.m[1][0], square.m[2][0]);
    vs_frame_transport(p->at, p->count, p->closed, p->length, across, way.x);
  }
  for (size_t i = 0; ok && i < stations; i++) {
    guided_frame frame = guided_frame_at(&way, s[i]);
    size_t row = i % l->rows;
    guided_describe(&frame, &l->at[row * l->columns], l->columns, l->center[row], l->normal[row],
                    &local[i * (l->columns + GUIDED_EXTRA)]);
  }
  ok = ok && (guided_rows(l, &way, f, out) || vs_error_memory(e, NULL));
  vs_path_free(p);
  free(s);
  free(local);
  free(way.x);
  return ok;
}

/* ---- lofts with guides ---- */

typedef struct {
  vs_path path;
  double *s;      /* s[i]: arc length of the guide at section i */
  size_t loop;    /* index of the loop of the sections that this guide touches */
  double *column; /* column[i]: where the guide touches section i: column of the point in the loop, with a fraction
                   * between two points */
} guided_line;

/* Finds where the guide p is nearest to a loop in a row of l. *s: arc length of the guide there; *column: column of the
 * loop's point, with a fraction. Returns their distance. */
static double guided_touch(const vs_loft *l, size_t row, const vs_path *p, size_t loop, double *s, double *column) {
  size_t first = row * l->columns, size = l->sizes[loop], pieces = l->round ? size : size - 1,
         stretches = p->closed ? p->count : p->count - 1;
  double least = INFINITY;
  VS_ASSERT(row < l->rows && loop < l->loop_count);
  for (size_t k = 0; k < loop; k++) first += l->sizes[k];
  if (l->point[row]) pieces = 1;
  for (size_t i = 0; i < stretches; i++) {
    vs_vec3 a = p->at[i].at, d = vs_v3_sub(p->at[i + 1 < p->count ? i + 1 : 0].at, a);
    double dd = vs_v3_dot(d, d);
    for (size_t c = 0; c < pieces; c++) {
      /* Finds the nearest points of the two segments a + t d and b + u g, with t and u from 0 to 1 (Ericson). */
      vs_vec3 b = l->at[first + c], g = vs_v3_sub(l->at[first + (c + 1) % size], b), r = vs_v3_sub(a, b);
      double gg = vs_v3_dot(g, g), dg = vs_v3_dot(d, g), dr = vs_v3_dot(d, r), gr = vs_v3_dot(g, r),
             det = dd * gg - dg * dg;
      double t = det > 1e-12 * dd * gg ? fmax(0, fmin(1, (dg * gr - gg * dr) / det)) : 0,
             u = gg > 0 ? (dg * t + gr) / gg : 0;
      if (u < 0) u = 0, t = dd > 0 ? fmax(0, fmin(1, -dr / dd)) : 0;
      else if (u > 1) u = 1, t = dd > 0 ? fmax(0, fmin(1, (dg - dr) / dd)) : 0;
      double far = vs_v3_length(vs_v3_sub(vs_v3_add(a, vs_v3_scale(d, t)), vs_v3_add(b, vs_v3_scale(g, u))));
      if (far < least) {
        least = far;
        *s = p->at[i].along + t * sqrt(dd);
        *column = (double)c + u;
      }
    }
  }
  return least;
}

static bool guided_line_make(const vs_node *n, size_t number, const vs_loft *l, const vs_fineness *f, guided_line *g,
                             vs_error *e) {
  vs_affine identity = vs_affine_identity();
  g->s = vs_fresh(l->rows + 1, sizeof *g->s);
  g->column = vs_fresh(l->rows + 1, sizeof *g->column);
  if (!g->s || !g->column) return vs_error_memory(e, NULL);
  if (!vs_curve_path(n, &identity, f, &g->path, e)) return false;
  if (g->path.count < 2) return vs_error_set(e, VS_ERROR_MODEL, NULL, "guide %zu is a point", number);
  double least = INFINITY, slack = fmax(1e-3 * l->size, 2 * f->tolerance);
  for (size_t loop = 0; loop < l->loop_count; loop++) { /* finds the loop that this guide touches in all sections, if
                                                         * there is such a loop */
    double worst = 0, s, column;
    for (size_t i = 0; i < l->rows; i++) worst = fmax(worst, guided_touch(l, i, &g->path, loop, &s, &column));
    if (worst < least) least = worst, g->loop = loop;
  }
  for (size_t i = 0; i < l->rows; i++) {
    double far = guided_touch(l, i, &g->path, g->loop, &g->s[i], &g->column[i]);
    if (far > slack)
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "guide %zu must meet every section; it passes section %zu at a distance of %.6g", number,
                          i + 1, far);
    if (l->point[i]) g->column[i] = -1; /* -1: the section is a point, where a guide touches all lines of the wall at
                                         * once */
  }
  if (g->s[0] > g->s[l->rows - 1]) {
    for (size_t i = 0; i < l->rows; i++) g->s[i] = g->path.length - g->s[i];
    vs_path_reverse(&g->path);
  }
  for (size_t i = 0; i < l->rows; i++) {
    if (i && g->s[i] <= g->s[i - 1])
      return vs_error_set(e, VS_ERROR_MODEL, NULL, "guide %zu must meet the sections in their order", number);
    if (g->column[i] < 0) g->column[i] = g->column[i ? i - 1 : 1];
  }
  if (g->column[0] < 0) g->column[0] = 0;
  return true;
}

static vs_vec3 guided_point(const vs_path *p, double s) {
  size_t low = 0, high = p->count;
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    if (p->at[middle].along <= s) low = middle;
    else high = middle;
  }
  if (high == p->count) return p->at[low].at;
  double from = p->at[low].along, to = p->at[high].along;
  return vs_v3_add(p->at[low].at,
                   vs_v3_scale(vs_v3_sub(p->at[high].at, p->at[low].at), to > from ? (s - from) / (to - from) : 0));
}

/* Returns the first column of a loop in a row. If loop == l->loop_count, returns the number of columns. */
static size_t guided_first(const vs_loft *l, size_t loop) {
  size_t first = 0;
  VS_ASSERT(loop <= l->loop_count);
  for (size_t k = 0; k < loop; k++) first += l->sizes[k];
  return first;
}

static double guided_column(const vs_loft *l, const guided_line *g, size_t i, double t) { /* returns the column that
                                                                                           * guide g touches at the
                                                                                           * fraction t between
                                                                                           * section i and the next;
                                                                                           * goes the shorter way
                                                                                           * around the loop */
  double a = g->column[i], b = g->column[i + 1], size = (double)l->sizes[g->loop];
  if (l->round && b - a > size / 2) b -= size;
  if (l->round && a - b > size / 2) b += size;
  double c = a + (b - a) * t;
  return l->round ? c - size * floor(c / size) : c;
}

/* Computes the affine map x -> c + m (x - b) that best maps the n >= 1 points `from` to the points `to`, by least
 * squares. *b, *c: means of `from` and of `to`. For one point the map is a shift; for two points, a rotation with a
 * uniform scale. */
static void guided_fit(const vs_vec3 *from, const vs_vec3 *to, size_t n, vs_vec3 *b, vs_vec3 *c, double m[3][3]) {
  VS_ASSERT(n > 0);
  *b = *c = vs_v3(0, 0, 0);
  for (size_t j = 0; j < n; j++)
    *b = vs_v3_add(*b, vs_v3_scale(from[j], 1.0 / (double)n)), *c = vs_v3_add(*c, vs_v3_scale(to[j], 1.0 / (double)n));
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) m[i][k] = i == k;
  if (n < 2) return;
  double spread = 0, wide = 0;
  vs_vec3 axis = { 0, 0, 0 }, area = { 0, 0, 0 };
  for (size_t j = 0; j < n; j++) {
    vs_vec3 d = vs_v3_sub(from[j], *b);
    spread += vs_v3_dot(d, d);
    if (vs_v3_dot(d, d) > vs_v3_dot(axis, axis)) axis = d;
    wide += vs_v3_dot(vs_v3_sub(to[j], *c), vs_v3_sub(to[j], *c));
  }
  if (!(spread > 0)) return;
  for (size_t j = 0; j < n; j++) {
    vs_vec3 x = vs_v3_cross(axis, vs_v3_sub(from[j], *b));
    if (vs_v3_dot(x, x) > vs_v3_dot(area, area)) area = x;
  }
  vs_vec3 normal = vs_v3_unit(area), x = vs_v3_unit(axis), y = vs_v3_cross(normal, x);
  bool planar = n > 2 && vs_v3_length(area) > 0.05 * vs_v3_dot(axis, axis);
  if (!planar) { /* two points, or collinear ones: a uniform scale, and the rotation from the line of the points to the
                  * line of their images */
    vs_vec3 way = { 0, 0, 0 };
    for (size_t j = 0; j < n; j++)
      way = vs_v3_add(way, vs_v3_scale(vs_v3_sub(to[j], *c), vs_v3_dot(vs_v3_sub(from[j], *b), x)));
    if (!(vs_v3_length(way) > 1e-12 * spread)) return;
    vs_affine turn = vs_frame_turn(x, vs_v3_unit(way));
    double k = sqrt(wide / spread);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) m[i][j] = turn.m[i][j] * k;
    return;
  }
  /* Solves the normal equations for the images of the plane's directions x and y. Lengths perpendicular to the plane do
   * not change. */
  double xx = 0, xy = 0, yy = 0;
  vs_vec3 px = { 0, 0, 0 }, py = { 0, 0, 0 };
  for (size_t j = 0; j < n; j++) {
    vs_vec3 d = vs_v3_sub(from[j], *b), g = vs_v3_sub(to[j], *c);
    double u = vs_v3_dot(d, x), v = vs_v3_dot(d, y);
    xx += u * u, xy += u * v, yy += v * v;
    px = vs_v3_add(px, vs_v3_scale(g, u));
    py = vs_v3_add(py, vs_v3_scale(g, v));
  }
  double det = xx * yy - xy * xy;
  vs_vec3 mx = vs_v3_scale(vs_v3_sub(vs_v3_scale(px, yy), vs_v3_scale(py, xy)), 1 / det),
          my = vs_v3_scale(vs_v3_sub(vs_v3_scale(py, xx), vs_v3_scale(px, xy)), 1 / det);
  vs_vec3 mz = vs_v3_unit(vs_v3_cross(mx, my));
  const double cols[3][3] = { { mx.x, mx.y, mx.z }, { my.x, my.y, my.z }, { mz.x, mz.y, mz.z } };
  const double old[3][3] = { { x.x, x.y, x.z }, { y.x, y.y, y.z }, { normal.x, normal.y, normal.z } };
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) m[i][k] = cols[0][i] * old[0][k] + cols[1][i] * old[1][k] + cols[2][i] * old[2][k];
}

typedef struct { double column; vs_vec3 rest; } guided_pin;

static int guided_pin_compare(const void *a, const void *b) {
  double p = ((const guided_pin *)a)->column, q = ((const guided_pin *)b)->column;
  return p < q ? -1 : p > q;
}

/* All guides of a loft. pins, from, to: working memory with one element for each guide. */
typedef struct {
  guided_line *lines;
  size_t count;
  guided_pin *pins;
  vs_vec3 *from, *to;
} guided_lines;

/* Moves a row of points so that it touches the guides. The row is that of the loft without guides at the fraction t
 * between section i and the next. */
static void guided_lead(const vs_loft *l, const guided_lines *by, size_t i, double t, vs_vec3 *row) {
  const guided_line *g = by->lines;
  guided_pin *pins = by->pins;
  vs_vec3 b, c, *from = by->from, *to = by->to;
  size_t guides = by->count;
  double m[3][3];
  for (size_t j = 0; j < guides; j++) {
    size_t first = guided_first(l, g[j].loop), size = l->sizes[g[j].loop];
    double column = guided_column(l, &g[j], i, t), fraction = column - floor(column);
    size_t k = (size_t)column % size;
    vs_vec3 p = row[first + k], q = row[first + (k + 1 < size ? k + 1 : l->round ? 0 : k)];
    from[j] = vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), fraction));
    to[j] = guided_point(&g[j].path, g[j].s[i] + (g[j].s[i + 1] - g[j].s[i]) * t);
  }
  guided_fit(from, to, guides, &b, &c, m);
  for (size_t k = 0; k < l->columns + guides; k++) {
    vs_vec3 *p = k < l->columns ? &row[k] : &from[k - l->columns], d = vs_v3_sub(*p, b);
    *p =
        vs_v3_add(c, vs_v3(m[0][0] * d.x + m[0][1] * d.y + m[0][2] * d.z, m[1][0] * d.x + m[1][1] * d.y + m[1][2] * d.z,
                           m[2][0] * d.x + m[2][1] * d.y + m[2][2] * d.z));
  }
  for (size_t loop = 0, first = 0; loop < l->loop_count; first += l->sizes[loop++]) {
    size_t n = 0;
    double size = (double)l->sizes[loop];
    for (size_t j = 0; j < guides; j++)
      if (g[j].loop == loop) pins[n++] = (guided_pin){ guided_column(l, &g[j], i, t), vs_v3_sub(to[j], from[j]) };
    if (!n) continue;
    qsort(pins, n, sizeof *pins, guided_pin_compare);
    for (size_t k = 0; k < l->sizes[loop]; k++) {
      size_t after = 0;
      while (after < n && pins[after].column < (double)k) after++;
      size_t high = after < n ? after : l->round ? 0 : n - 1, low = after ? after - 1 : l->round ? n - 1 : 0;
      double span = pins[high].column - pins[low].column, way = (double)k - pins[low].column;
      if (l->round && span <= 0) span += size;
      if (l->round && way < 0) way += size;
      double u = low == high && n == 1 ? 0 : span > 0 ? fmax(0, fmin(1, way / span)) : 0;
      u = u * u * (3 - 2 * u);
      row[first + k] =
          vs_v3_add(row[first + k], vs_v3_add(vs_v3_scale(pins[low].rest, 1 - u), vs_v3_scale(pins[high].rest, u)));
    }
  }
}

/* Returns the number of rows between section i and the next section that the samples of guide g require. */
static double guided_line_steps(const guided_line *g, size_t i) {
  size_t n = 1;
  for (size_t k = 0; k < g->path.count; k++) n += g->path.at[k].along > g->s[i] && g->path.at[k].along < g->s[i + 1];
  return n > 256 ? 256 : (double)n;
}

bool vs_loft_along_guides(const vs_node *n, const vs_loft *l, const vs_fineness *f, vs_loft_rows *out, vs_error *e) {
  size_t sections = (size_t)VS_AS(guided_loft, n)->section_count, guides = n->child_count - sections;
  guided_line *g = vs_zeros(guides + 1, sizeof *g);
  guided_pin *pins = vs_fresh(guides + 1, sizeof *pins);
  vs_vec3 *points = vs_fresh(2 * guides + 1, sizeof *points);
  guided_lines by = { g, guides, pins, points, points ? points + guides : NULL };
  vs_loft_smooth s = { 0 };
  bool ok = (g && pins && points && vs_loft_smooth_make(l, &s)) || vs_error_memory(e, NULL);
  if (ok && l->joined)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL,
                      "the first and the last section coincide, which guides do not allow; give a closed path instead");
  for (size_t j = 0; ok && j < guides; j++) {
    ok = guided_line_make(n->children[sections + j].node, j + 1, l, f, &g[j], e);
    if (!ok && e && !e->origin) e->origin = n->children[sections + j].origin;
  }
  for (size_t i = 0; ok && i + 1 < l->rows; i++) {
    double steps = vs_loft_smooth_steps(&s, i, f);
    for (size_t j = 0; j < guides; j++) steps = fmax(steps, guided_line_steps(&g[j], i));
    for (double k = 0; ok && k < steps; k++) {
      vs_vec3 *row = vs_loft_rows_add(out);
      ok = row || vs_error_memory(e, NULL);
      if (!row) break;
      vs_loft_smooth_row(&s, i, k / steps, row);
      if (k > 0) guided_lead(l, &by, i, k / steps, row);
    }
  }
  vs_vec3 *last = ok ? vs_loft_rows_add(out) : NULL;
  if (last) vs_loft_smooth_row(&s, l->rows - 2, 1, last);
  else if (ok) ok = vs_error_memory(e, NULL);
  for (size_t j = 0; g && j < guides; j++) {
    vs_path_free(&g[j].path);
    free(g[j].s);
    free(g[j].column);
  }
  vs_loft_smooth_free(&s);
  free(g);
  free(pins);
  free(points);
  return ok;
}
