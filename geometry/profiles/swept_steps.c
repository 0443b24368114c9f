/* Computes the steps of a twisted sweep.
 *
 * Two sweeps along one path whose profiles have a common edge must have the same wall there: a kerb leaves no gap to
 * its road. Therefore the wall of an edge depends on this edge alone, and not on the size of its profile.
 *
 *   points   A point at the distance r from the base needs more steps for a larger r. The path has coarse steps, the
 *            same for all profiles. A point has a row in each coarse step, or in each half, quarter ... of it, by its
 *            r. The largest r of a profile determines its rows, and stride[i] the rows that point i skips.
 *   edges    An edge of length l that turns by an angle a in a step sweeps a saddle. Two triangles deviate from its
 *            middle by l a / 4. Therefore the edge is divided into pieces. Their number follows from the steps at the
 *            edge's point nearest to the base, where steps are largest
 *
 * If the node's segments are given, a turn has so many steps, and edges are not divided. */
#include "geometry/profiles/swept_steps.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

static const double full_turn = 6.28318530717958647693;

size_t vs_steps_count(double n, size_t most) {
  n = ceil(n - 1e-9);
  return n > (double)most ? most : n > 1 ? (size_t)n : 1;
}

size_t vs_twist_coarse(const vs_fineness *f, double angle) {
  double turn = f->segments > 0 ? f->segments : vs_fineness_least(f);
  return vs_steps_count(fabs(angle) / full_turn * turn, VS_STEPS_MOST);
}

int vs_twist_halvings(const vs_fineness *f, double step, double r) {
  double most = full_turn / vs_fineness_turn(f, r, 0) * (1 + 1e-9);
  int n = 0;
  if (f->segments <= 0)
    while (ldexp(fabs(step), -n) > most) n++;
  return n;
}

/* Divides the edge from point i of the profile to the next point into pieces[i] equal pieces, for all i. Returns false
 * when memory is out. */
static bool split(vs_swept *s, const size_t *pieces) {
  size_t total = 0, end = 0;
  vs_vec2 *fine = NULL;
  for (size_t i = 0; i < s->profile_count; i++) total += pieces[i];
  if (!VS_FRESH(fine, total + 1)) return false;
  for (size_t l = 0, first = 0; l < s->loop_count; l++) {
    size_t size = s->sizes[l], begin = end;
    for (size_t i = 0; i < size; i++) {
      vs_vec2 p = s->profile[first + i], q = s->profile[first + (i + 1) % size];
      size_t k = !s->filled && i + 1 == size ? 1 : pieces[first + i]; /* k: number of pieces of edge i; 1 for the last
                                                                       * point of an open profile, after which there is
                                                                       * no edge */
      for (size_t j = 0; j < k; j++) {
        double t = (double)j / (double)k;
        fine[end++] = (vs_vec2){ p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t };
      }
    }
    first += size;
    s->sizes[l] = end - begin;
  }
  free(s->profile);
  s->profile = fine;
  s->profile_count = end;
  return true;
}

double vs_twist_lean_reach(double length, double reach) {
  int power;
  if (!(length > 0) || !(reach > 0)) return reach;
  frexp(reach / length * (1 - 1e-9), &power);
  return ldexp(length, power + (power & 1));
}

double vs_twist_reach(const vs_twist *way, double r) {
  double wide = r * fmax(1, fabs(way->scale));
  return wide * (1 + wide * way->lean);
}

void vs_twist_rows(const vs_swept *s, vs_twist *way, const vs_fineness *f) {
  double far = vs_twist_reach(way, way->reach), longest = 0, most = VS_STEPS_MOST;
  for (size_t l = 0, first = 0; l < s->loop_count; first += s->sizes[l], l++)
    for (size_t i = 0; i + !s->filled < s->sizes[l]; i++) {
      vs_vec2 p = s->profile[first + i], q = s->profile[first + (i + 1) % s->sizes[l]];
      longest = fmax(longest, hypot(q.x - p.x, q.y - p.y));
    }
  if (s->profile_count) most = fmin(most, VS_SWEPT_POINTS_MOST / (double)s->profile_count);
  double turn = way->turn / full_turn * vs_fineness_turn(f, far, 0),
         widest = way->reach > 0 ? far / way->reach : 1,
         rows = fmax(turn, sqrt(way->turn * widest * longest / (4 * f->tolerance)));
  way->rows = vs_steps_count(fmin(rows, most), VS_STEPS_MOST);
}

size_t vs_twist_parts(const vs_twist *way, size_t count, const vs_fineness *f) {
  double turn = way->step / full_turn * vs_fineness_turn(f, vs_twist_reach(way, way->reach), 0),
         even = (double)way->rows / (double)(count ? count : 1);
  VS_ASSERT(way->rows);
  return vs_steps_count(fmax(turn, even), VS_STEPS_MOST);
}

/* Returns the distance of the edge from p to q from the base. */
static double distance_of(vs_vec2 base, vs_vec2 p, vs_vec2 q) {
  double dx = q.x - p.x, dy = q.y - p.y, d = dx * dx + dy * dy,
         t = d > 0 ? fmax(0, fmin(1, ((base.x - p.x) * dx + (base.y - p.y) * dy) / d)) : 0;
  return hypot(p.x + dx * t - base.x, p.y + dy * t - base.y);
}

/* Sets pieces[i] to the number of pieces into which the edge from point i of the profile to the next is divided. */
static void divide_edges(const vs_swept *s, const vs_twist *way, const vs_fineness *f, size_t *pieces) {
  enum { MOST = 2000 };
  for (size_t l = 0, first = 0; l < s->loop_count; first += s->sizes[l], l++)
    for (size_t i = 0; i < s->sizes[l]; i++) {
      vs_vec2 p = s->profile[first + i], q = s->profile[first + (i + 1) % s->sizes[l]];
      int halvings = vs_twist_halvings(f, way->step, vs_twist_reach(way, distance_of(way->base, p, q)));
      double far = fmax(hypot(p.x - way->base.x, p.y - way->base.y), hypot(q.x - way->base.x, q.y - way->base.y)),
             widest = far > 0 ? vs_twist_reach(way, far) / far : 1,
             step = way->rows ? way->turn / (double)way->rows : ldexp(way->step, -halvings),
             saddle = step * widest * hypot(q.x - p.x, q.y - p.y) / 4;
      pieces[first + i] = vs_steps_count(saddle / f->tolerance, MOST);
    }
}

bool vs_twist_divide(vs_swept *s, const vs_twist *way, const vs_fineness *f) {
  if (way->step == 0 || f->segments > 0) return true;
  size_t *pieces = NULL;
  bool ok = VS_FRESH(pieces, s->profile_count + 1);
  if (ok) divide_edges(s, way, f, pieces);
  ok = ok && split(s, pieces);
  free(pieces);
  return ok;
}

bool vs_twist_strides(vs_swept *s, const vs_twist *way, int halvings, const vs_fineness *f) {
  free(s->stride);
  s->stride = NULL;
  if (!halvings || !VS_FRESH(s->stride, s->profile_count)) return !halvings;
  for (size_t i = 0; i < s->profile_count; i++) {
    double r = hypot(s->profile[i].x - way->base.x, s->profile[i].y - way->base.y);
    int own = vs_twist_halvings(f, way->step, vs_twist_reach(way, r));
    s->stride[i] = (size_t)1 << (own < halvings ? halvings - own : 0);
  }
  return true;
}

/* ---- walls that are not planar ---- */

/* Returns the deviation of two triangles from the surface that the edge from p to q of the profile sweeps from section
 * a to section b. It is a quarter of the distance by which the four corners differ from a plane. */
static double saddle_of(const vs_section *a, const vs_section *b, vs_vec2 p, vs_vec2 q) {
  vs_vec3 at[2][2], most = { 0, 0, 0 };
  for (int i = 0; i < 2; i++) {
    const vs_section *s = i ? b : a;
    at[i][0] = vs_v3_add(vs_v3_add(vs_v3_scale(s->x, p.x), vs_v3_scale(s->y, p.y)), s->at);
    at[i][1] = vs_v3_add(vs_v3_add(vs_v3_scale(s->x, q.x), vs_v3_scale(s->y, q.y)), s->at);
  }
  for (int c = 0; c < 4; c++) { /* uses the longest of the normals at the four corners */
    int i = c / 2, j = c % 2;
    vs_vec3 n = vs_v3_cross(vs_v3_sub(at[1][j], at[0][j]), vs_v3_sub(at[i][1], at[i][0]));
    if (vs_v3_length(n) > vs_v3_length(most)) most = n;
  }
  vs_vec3 bend = vs_v3_add(vs_v3_sub(at[1][1], at[1][0]), vs_v3_sub(at[0][0], at[0][1]));
  double length = vs_v3_length(most);
  return length > 0 ? fabs(vs_v3_dot(bend, most)) / length / 4 : 0;
}

/* Raises pieces[i] to the number of pieces of the edge from point i of the profile to the next, as the tolerance
 * requires. first: first point of the edge's loop l. */
static void pieces_of(const vs_swept *s, size_t l, size_t first, size_t i, const vs_fineness *f, size_t *pieces) {
  enum { MOST = 2000 };
  size_t p = first + i, q = first + (i + 1) % s->sizes[l], count = s->section_count, stride = 1;
  if (s->stride) stride = s->stride[p] > s->stride[q] ? s->stride[p] : s->stride[q];
  for (size_t r = 0; r < count; r += stride) {
    if (s->sections[r].ends || (!s->joined && r + stride >= count)) continue;
    double d = saddle_of(&s->sections[r], &s->sections[(r + stride) % count], s->profile[p], s->profile[q]);
    size_t k = vs_steps_count(d / f->tolerance, MOST);
    if (k > pieces[p]) pieces[p] = k;
  }
}

bool vs_swept_flatten_edges(vs_swept *s, const vs_fineness *f) {
  size_t *pieces = NULL;
  bool ok = VS_FRESH(pieces, s->profile_count + 1);
  for (size_t i = 0; ok && i < s->profile_count; i++) pieces[i] = 1;
  for (size_t l = 0, first = 0; ok && l < s->loop_count; first += s->sizes[l], l++)
    for (size_t i = 0; i + !s->filled < s->sizes[l]; i++) pieces_of(s, l, first, i, f, pieces);
  ok = ok && split(s, pieces);
  free(pieces);
  return ok;
}

bool vs_swept_flatten_steps(vs_swept *s, const vs_fineness *f) {
  enum { MOST = 200 };
  size_t count = s->section_count, total = 0, *pieces = NULL, *steps = NULL;
  bool ok = VS_FRESH(pieces, s->profile_count + 1) && VS_FRESH(steps, count + 1);
  bool edges = !s->seam, bends = false;
  for (size_t i = 0; ok && i < s->profile_count; i++) pieces[i] = 1;
  for (size_t r = 0; ok && r < count; r++) {
    const vs_section *a = &s->sections[r], *b = &s->sections[r + 1 == count ? 0 : r + 1];
    bool goes = !a->ends && (s->joined || r + 1 < count);
    for (int pass = 0; pass < 2; pass++) { /* the first pass computes the steps, by the edge with the largest deviation;
                                            * the second pass the pieces of each edge */
      double most = 0;
      for (size_t l = 0, first = 0; goes && l < s->loop_count; first += s->sizes[l], l++)
        for (size_t i = 0; i + !s->filled < s->sizes[l]; i++) {
          double d = saddle_of(a, b, s->profile[first + i], s->profile[first + (i + 1) % s->sizes[l]]);
          most = fmax(most, d / f->tolerance);
          if (!pass || !edges) continue;
          size_t k = vs_steps_count(d / f->tolerance / (double)steps[r], MOST);
          if (k > pieces[first + i]) pieces[first + i] = k;
        }
      if (!pass) steps[r] = vs_steps_count(edges ? sqrt(most) : most, MOST);
    }
    bends = bends || steps[r] > 1;
    total += steps[r];
  }
  if (ok && bends) {
    vs_section *fine = NULL;
    size_t n = 0;
    ok = VS_FRESH(fine, total) && (!edges || split(s, pieces));
    for (size_t r = 0; ok && r < count; r++) {
      const vs_section *a = &s->sections[r], *b = &s->sections[r + 1 == count ? 0 : r + 1];
      fine[n++] = *a;
      for (size_t k = 1; k < steps[r]; k++) fine[n++] = vs_section_between(a, b, (double)k / (double)steps[r]);
    }
    if (ok) {
      free(s->sections);
      s->sections = fine;
      s->section_count = s->section_room = n;
    } else {
      free(fine);
    }
  }
  free(pieces);
  free(steps);
  return ok;
}
