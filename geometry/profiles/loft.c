/* Matches the points of a loft's sections.
 *
 * 1. Each section becomes loops in its plane (or one open line, or a point). Its normal points in the loft's
 *    direction; its outer loops run counter-clockwise about the normal. Holes are matched with the nearest holes of the
 *    previous section.
 * 2. If a loop has the same number of points in all sections, point i of a section is matched with point i of the next.
 *    Otherwise points are matched by arc length, and each section gets the points of all others, so that no corner is
 *    cut.
 * 3. A loop starts where it is least twisted against the loop of the previous section. For this start, the sum of the
 *    scalar products of matching points is largest. The points are relative to the centres of their loops, and turned
 *    from normal to normal by the smallest rotation. */
#include "geometry/profiles/loft.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/plane/curve.h"
#include "model/store/array.h"

typedef struct {
  vs_outline outline; /* loops of the section; loop i matches loop i of the section before it */
  bool point, open;
  vs_vec3 center, normal;
} loft_section;

void vs_loft_free(vs_loft *l) {
  free(l->at);
  free(l->center);
  free(l->normal);
  free(l->point);
  free(l->sizes);
  free(l->hole);
  *l = (vs_loft){ 0 };
}

static const vs_node *loft_bare(const vs_node *n, vs_affine *placed) {
  *placed = vs_affine_identity();
  while (n->kind == VS_TRANSFORM || vs_node_is_wrapper(n) || (n->kind == VS_REGION && n->child_count == 1)) {
    if (n->kind == VS_TRANSFORM) *placed = vs_affine_multiply(placed, &VS_AS(transform, n)->matrix);
    n = n->children[0].node;
  }
  return n;
}

static bool loft_is_circle(const vs_node *n) {
  vs_affine placed;
  n = loft_bare(n, &placed);
  return n->kind == VS_CIRCLE && VS_AS(circle, n)->segments == 0;
}

/* ---- reading of the sections ---- */

static bool loft_read(const vs_node *n, const vs_fineness *f, loft_section *s, vs_error *e) {
  vs_affine placed;
  const vs_node *bare = loft_bare(n, &placed);
  vs_outline_free(&s->outline);
  if (bare->kind == VS_LINE && VS_AS(line, bare)->points->count == 1) {
    s->point = true;
    s->center = vs_affine_point(&placed, VS_AS(line, bare)->points->at[0]);
    return true;
  }
  if (n->class_ == VS_CURVE && !(n->flags & VS_NODE_CLOSED)) { /* an open curve needs no plane, so it is only sampled */
    s->open = true;
    s->outline =
        (vs_outline){ .loops = vs_zeros(1, sizeof(vs_polyline)), .hole = vs_zeros(1, sizeof(bool)), .count = 1 };
    if (!s->outline.loops || !s->outline.hole) return s->outline.count = 0, vs_error_memory(e, NULL);
    if (!vs_curve_sample(n, f, &s->outline.loops[0], e)) return false;
    if (s->outline.loops[0].count < 2)
      return vs_error_set(e, VS_ERROR_MODEL, NULL, "a section is a curve without length");
  } else {
    if (!vs_region_outline(n, f, &s->outline, e)) return false;
    if (!s->outline.count) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the region is empty");
    s->normal = s->outline.normal;
  }
  vs_outline_measure(&s->outline, &s->center);
  return true;
}

static size_t loft_points(const loft_section *s) {
  size_t n = 0;
  for (size_t l = 0; l < s->outline.count; l++) n += s->outline.loops[l].count;
  return n;
}

/* Reads all sections of the loft n. All circles of the sections get the same number of facets, the largest that any of
 * them needs. Returns false and sets e on failure. */
static bool loft_read_all(const vs_node *n, size_t count, const vs_fineness *f, loft_section *s, vs_error *e) {
  size_t most = 0;
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    ok = loft_read(n->children[i].node, f, &s[i], e);
    if (!ok && e && !e->origin) e->origin = n->children[i].origin;
    if (!ok && e && e->kind == VS_ERROR_MODEL) {
      char why[400];
      snprintf(why, sizeof why, "%.399s", e->message);
      vs_error_set(e, VS_ERROR_MODEL, e->origin, "section %zu: %s", i + 1, why);
    }
    if (ok && loft_is_circle(n->children[i].node) && loft_points(&s[i]) > most) most = loft_points(&s[i]);
  }
  for (size_t i = 0; ok && i < count; i++)
    if (loft_is_circle(n->children[i].node) && loft_points(&s[i]) < most) {
      vs_fineness same = { f->tolerance, (int)most };
      ok = loft_read(n->children[i].node, &same, &s[i], e);
    }
  return ok;
}

/* Checks that the sections are compatible: for example, that all are closed, or all are open. *first: index of the
 * first section that is not a point. Returns false and sets e if they are not compatible. */
static bool loft_agree(const loft_section *s, size_t count, size_t *first, vs_error *e) {
  *first = count;
  for (size_t i = 0; i < count; i++) {
    if (s[i].point && i && i + 1 < count)
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "only the first and the last section may be a point; number %zu is one", i + 1);
    if (s[i].point) continue;
    if (*first == count) *first = i;
    const loft_section *a = &s[*first], *b = &s[i];
    if (a->open != b->open)
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "sections must all be closed or all be open: number %zu is %s, number %zu is %s", *first + 1,
                          a->open ? "open" : "closed", i + 1, b->open ? "open" : "closed");
    size_t holes[2] = { 0, 0 };
    for (size_t l = 0; l < a->outline.count; l++) holes[0] += a->outline.hole[l];
    for (size_t l = 0; l < b->outline.count; l++) holes[1] += b->outline.hole[l];
    if (holes[0] != holes[1])
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "sections must have equally many holes: number %zu has %zu, number %zu has %zu", *first + 1,
                          holes[0], i + 1, holes[1]);
    if (a->outline.count != b->outline.count)
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "sections must have equally many parts: number %zu has %zu, number %zu has %zu", *first + 1,
                          a->outline.count - holes[0], i + 1, b->outline.count - holes[1]);
  }
  if (*first == count) return vs_error_set(e, VS_ERROR_MODEL, NULL, "sections must not all be points");
  return true;
}

/* ---- directions of the sections ---- */

static void loft_reverse(vs_polyline *p) {
  for (size_t i = 0, j = p->count; i < j; i++) {
    vs_vec3 swap = p->at[i];
    p->at[i] = p->at[--j];
    p->at[j] = swap;
  }
}

static void loft_turn(loft_section *s) {
  s->normal = vs_v3_scale(s->normal, -1);
  for (size_t l = 0; l < s->outline.count; l++) loft_reverse(&s->outline.loops[l]);
}

/* Reverses normals of sections so that all point in the loft's direction. Where the loft's direction lies in a
 * section's plane, uses the neighbouring section's normal instead. */
static void loft_direct(loft_section *s, size_t count, bool joined) {
  bool sure = false;
  for (size_t pass = 0; pass < 2; pass++)
    for (size_t k = 0; k < count; k++) {
      size_t i = pass ? count - 1 - k : k;
      if (s[i].point || s[i].open) continue;
      size_t before = i        ? i - 1
                      : joined ? count - 1
                               : i,
             after = i + 1 < count ? i + 1
                     : joined      ? 0
                                   : i,
             beside = pass ? i + 1 : i - 1;
      vs_vec3 way = vs_v3_sub(s[after].center, s[before].center);
      double along = vs_v3_dot(way, s[i].normal), length = vs_v3_length(way);
      if (fabs(along) > 0.05 * length) {
        if (along < 0) loft_turn(&s[i]);
        sure = true;
      } else if ((pass ? i + 1 < count : i > 0) && sure && !s[beside].point &&
                 vs_v3_dot(s[beside].normal, s[i].normal) < -1e-9)
        loft_turn(&s[i]);
    }
}

static vs_vec3 loft_loop_center(const vs_polyline *p) {
  vs_vec3 sum = { 0, 0, 0 };
  double length = 0;
  for (size_t i = 0; i + (p->closed ? 0 : 1) < p->count; i++) {
    vs_vec3 a = p->at[i], b = p->at[i + 1 < p->count ? i + 1 : 0];
    double w = vs_v3_length(vs_v3_sub(b, a));
    sum = vs_v3_add(sum, vs_v3_scale(vs_v3_add(a, b), w / 2));
    length += w;
  }
  return length > 0 ? vs_v3_scale(sum, 1 / length) : p->at[0];
}

/* Orders the loops of section b so that loop i matches loop i of section a, the section before it. Outer loops are
 * matched by distance, then the holes within each outer loop. number: index of b, for messages. Returns false and sets
 * e on failure. */
static bool loft_pair(const loft_section *a, loft_section *b, size_t number, vs_error *e) {
  size_t n = b->outline.count, done = 0;
  VS_ASSERT(a->outline.count == b->outline.count);
  if (n == 1) return true;
  vs_polyline *sorted = vs_fresh(n, sizeof *sorted);
  bool *taken = vs_zeros(n, sizeof *taken), ok = sorted && taken;
  size_t outer = 0; /* index in b of the outer loop whose holes are being matched */
  if (!ok) vs_error_memory(e, NULL);
  for (size_t l = 0; ok && l < n; l++) {
    double least = INFINITY;
    size_t best = n;
    vs_vec3 want = vs_v3_sub(loft_loop_center(&a->outline.loops[l]), a->center);
    for (size_t k = 0; k < n; k++) {
      if (taken[k] || b->outline.hole[k] != a->outline.hole[l]) continue;
      if (a->outline.hole[l]) { /* loop l is a hole of the outer loop that was matched last */
        size_t holder = k;
        while (b->outline.hole[holder]) holder--;
        if (holder != outer) continue;
      }
      double d = vs_v3_length(vs_v3_sub(vs_v3_sub(loft_loop_center(&b->outline.loops[k]), b->center), want));
      if (d < least) least = d, best = k;
    }
    if (best == n) {
      ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "section %zu has its holes in other parts than the section before it",
                        number);
      break;
    }
    taken[best] = true;
    if (!a->outline.hole[l]) outer = best;
    sorted[done++] = b->outline.loops[best];
  }
  if (ok) {
    memcpy(b->outline.loops, sorted, n * sizeof *sorted);
    memcpy(b->outline.hole, a->outline.hole, n * sizeof *taken);
  }
  free(sorted);
  free(taken);
  return ok;
}

/* ---- starting points of loops ---- */

typedef struct {
  vs_vec3 *at;      /* points of the loop relative to its centre, rotated into the plane of the previous section's
                     * loop */
  double *along;    /* along[i]: arc length from the loop's start to point i, as a fraction of the loop's length */
  size_t count;
  bool closed;
} loft_line;

static void loft_line_free(loft_line *l) {
  free(l->at);
  free(l->along);
}

static bool loft_line_make(const vs_polyline *p, const vs_affine *turn, loft_line *out) {
  vs_vec3 c = loft_loop_center(p);
  *out = (loft_line){ vs_fresh(p->count + 1, sizeof *out->at), vs_fresh(p->count + 2, sizeof *out->along), p->count,
                      p->closed };
  if (!out->at || !out->along) return false;
  double length = 0;
  for (size_t i = 0; i < p->count; i++) {
    out->at[i] = vs_affine_vector(turn, vs_v3_sub(p->at[i], c));
    if (i) length += vs_v3_length(vs_v3_sub(p->at[i], p->at[i - 1]));
    out->along[i] = length;
  }
  if (p->closed) length += vs_v3_length(vs_v3_sub(p->at[0], p->at[p->count - 1]));
  for (size_t i = 0; i < p->count; i++) out->along[i] = length > 0 ? out->along[i] / length : 0;
  return true;
}

/* Returns the position at the parameter u on the polyline through the `count` > 0 points `at`. along[i]: parameter of
 * point i. If u is within `near` of along[i], returns exactly at[i]. If the line is closed, u may have any value. */
static vs_vec3 loft_line_at(const vs_vec3 *at, const double *along, size_t count, bool closed, double u, double near) {
  VS_ASSERT(count > 0);
  if (closed) u -= floor(u);
  size_t low = 0, high = count; /* binary search for the edge that contains u: along[low] <= u < along[high] */
  while (high - low > 1) {
    size_t middle = (low + high) / 2;
    if (along[middle] <= u) low = middle;
    else high = middle;
  }
  if (high == count && !closed) return at[count - 1];
  double from = along[low], to = high == count ? 1 : along[high];
  vs_vec3 p = at[low], q = at[high == count ? 0 : high];
  if (u - from <= near) return p;
  if (to - u <= near) return q;
  return vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), (u - from) / (to - from)));
}

enum { LOFT_SAMPLES = 128, LOFT_CORNERS = 32 };

static double loft_score(const vs_vec3 *a, const loft_line *b, double shift) {
  double sum = 0;
  for (size_t i = 0; i < LOFT_SAMPLES; i++)
    sum += vs_v3_dot(a[i], loft_line_at(b->at, b->along, b->count, true, (double)i / LOFT_SAMPLES + shift, 0));
  return sum;
}

static size_t loft_corners(const loft_line *l, double *out) { /* Writes the parameters (fractions of the length) of
                                                               * those points to out where the line turns by more than
                                                               * 0.3 radians. Returns their number. */
  size_t found = 0;
  for (size_t i = 0; i < l->count && found < LOFT_CORNERS; i++) {
    vs_vec3 a = vs_v3_sub(l->at[i], l->at[i ? i - 1 : l->count - 1]),
            b = vs_v3_sub(l->at[(i + 1) % l->count], l->at[i]);
    if (atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)) > 0.3) out[found++] = l->along[i];
  }
  return found;
}

/* Returns where loop b must start so that the wall between loops a and b is twisted least, as a fraction of b's length.
 * Loop a starts at `from`. Prefers a start that matches corners with corners to one that is slightly better. */
static double loft_least_twist(const loft_line *a, double from, const loft_line *b) {
  vs_vec3 samples[LOFT_SAMPLES];
  double aa = 0, bb = 0, best = -INFINITY, shift = 0, corner_best = -INFINITY, corner_shift = 0;
  double ca[LOFT_CORNERS], cb[LOFT_CORNERS];
  for (size_t i = 0; i < LOFT_SAMPLES; i++) {
    samples[i] = loft_line_at(a->at, a->along, a->count, true, (double)i / LOFT_SAMPLES + from, 0);
    vs_vec3 q = loft_line_at(b->at, b->along, b->count, true, (double)i / LOFT_SAMPLES, 0);
    aa += vs_v3_dot(samples[i], samples[i]);
    bb += vs_v3_dot(q, q);
  }
  double scale = sqrt(aa * bb);
  for (size_t k = 0; k < LOFT_SAMPLES; k++) {
    double score = loft_score(samples, b, (double)k / LOFT_SAMPLES);
    if (score > best + 1e-9 * scale) best = score, shift = (double)k / LOFT_SAMPLES;
  }
  size_t na = loft_corners(a, ca), nb = loft_corners(b, cb);
  for (size_t i = 0; i < na; i++)
    for (size_t k = 0; k < nb; k++) {
      double score = loft_score(samples, b, cb[k] - (ca[i] - from));
      if (score > corner_best + 1e-9 * scale) corner_best = score, corner_shift = cb[k] - (ca[i] - from);
    }
  if (corner_best > best - 0.02 * scale) return corner_shift - floor(corner_shift);
  double low = shift - 1.0 / LOFT_SAMPLES, high = shift + 1.0 / LOFT_SAMPLES;
  for (int i = 0; i < 40; i++) {
    double p = low + (high - low) / 3, q = high - (high - low) / 3;
    if (loft_score(samples, b, p) < loft_score(samples, b, q)) low = p;
    else high = q;
  }
  double fine = (low + high) / 2;
  if (loft_score(samples, b, fine) <= best + 1e-9 * scale) fine = shift; /* prefers the tested shift, a round number, if
                                                                          * it is as good as the exact optimum `fine` */
  return fine - floor(fine);
}

/* Finds the point of loop b that matches point `from` of loop a so that the wall between the loops is twisted least.
 * *best: index of that point. The loops have equal numbers of points. Returns false when interrupted. */
static bool loft_least_twist_index(const loft_line *a, size_t from, const loft_line *b, vs_store *s, size_t *best,
                                   vs_error *e) {
  size_t n = b->count, stride = n / 512 + 1;
  double most = -INFINITY, scale = 0;
  VS_ASSERT(from < a->count && a->count == b->count);
  *best = from;
  for (size_t j = 0; j < n; j += stride) scale += vs_v3_dot(a->at[j], a->at[j]) + vs_v3_dot(b->at[j], b->at[j]);
  for (size_t t = 0; t < n; t++) {
    if (!vs_store_going(s, (uint32_t)(4 * n / stride), e)) return false;
    size_t k = (from + t) % n; /* begins with the start that loop b has already; keeps it if no other start is better */
    double sum = 0;
    for (size_t j = 0; j < n; j += stride) sum += vs_v3_dot(a->at[(from + j) % n], b->at[(k + j) % n]);
    if (sum > most + 1e-9 * scale) most = sum, *best = k;
  }
  return true;
}

/* ---- matching of points ---- */

static int loft_compare(const void *a, const void *b) {
  double p = *(const double *)a, q = *(const double *)b;
  return p < q ? -1 : p > q;
}

#define LOFT_NEAR 1e-5 /* fraction of a loop's length: parameters of points that differ by less count as equal */

/* Lists, in ascending order from 0, the parameters (fractions of the length) of every point of every section, or
 * fewer if there would be too many. All sections get points there. Returns the number of parameters, or 0 when
 * memory is out. */
static size_t loft_places(const loft_line *lines, const double *shift, size_t count, double **out) {
  size_t total = 2, most = 0, kept = 0;
  for (size_t i = 0; i < count; i++) {
    total += lines[i].count + LOFT_CORNERS;
    if (lines[i].count > most) most = lines[i].count;
  }
  double *u = vs_fresh(total + most, sizeof *u);
  *out = u;
  if (!u) return 0;
  bool closed = true;
  for (size_t pass = 0; pass < 2; pass++) {
    size_t n = 0;
    u[n++] = 0;
    for (size_t i = 0; i < count; i++) {
      if (!lines[i].count) continue;
      double corners[LOFT_CORNERS];
      closed = lines[i].closed;
      size_t m = pass ? loft_corners(&lines[i], corners) : lines[i].count;
      for (size_t k = 0; k < m; k++) {
        double place = (pass ? corners[k] : lines[i].along[k]) - shift[i];
        u[n++] = closed ? place - floor(place) : place;
      }
    }
    for (size_t k = 1; pass && k < most; k++) u[n++] = (double)k / (double)most;
    if (!closed) u[n++] = 1;
    qsort(u, n, sizeof *u, loft_compare);
    kept = 1;
    for (size_t k = 1; k < n; k++)
      if (u[k] - u[kept - 1] > LOFT_NEAR && (!closed || u[k] < 1 - LOFT_NEAR)) u[kept++] = u[k];
    if (!closed) u[kept - 1] = 1;
    if (kept <= 4 * most + 256) break;
  }
  return kept;
}

typedef struct { loft_line *lines; double *shift; size_t *start; double *places; size_t count; } loft_match;

enum { TWISTS = 1 << 18 }; /* estimated time, in nanoseconds, of a search for the least twist between two loops, passed
                            * to vs_store_going */

/* The sections of a loft. `first`: index of the first section that is not a single point. */
typedef struct { loft_section *at; size_t count, first; } loft_sections;

/* Matches the points of loop l of all sections. matched[i]: receives loop l of section i; all these loops have equally
 * many points. Returns false and sets e on failure. */
static bool loft_match_loop(vs_store *store, const loft_sections *all, size_t l, loft_match *m, vs_polyline *matched,
                            vs_error *e) {
  loft_section *s = all->at;
  size_t rows = all->count, first = all->first;
  bool alike = true, ok = true;
  size_t last = first, size = s[first].outline.loops[l].count;
  for (size_t i = first; ok && i < rows; i++) {
    if (s[i].point) continue;
    vs_polyline *p = &s[i].outline.loops[l];
    if (s[i].open && i > first) { /* reverses an open section if its line goes against the line of the section before
                                   * it */
      const vs_polyline *q = &s[last].outline.loops[l];
      vs_vec3 a = q->at[0], b = q->at[q->count - 1], c = p->at[0], d = p->at[p->count - 1];
      if (vs_v3_length(vs_v3_sub(a, d)) + vs_v3_length(vs_v3_sub(b, c)) <
          (vs_v3_length(vs_v3_sub(a, c)) + vs_v3_length(vs_v3_sub(b, d))) * (1 - 1e-9))
        loft_reverse(p);
    }
    vs_affine turn = i > first && !s[i].open ? vs_frame_turn(s[i].normal, s[last].normal) : vs_affine_identity();
    ok = loft_line_make(p, &turn, &m->lines[i]) || vs_error_memory(e, NULL);
    alike = alike && p->count == size;
    last = i;
  }
  last = first;
  for (size_t i = first; ok && i < rows; i++) {
    m->shift[i] = 0;
    m->start[i] = 0;
    if (s[i].point || s[i].open || i == first) continue;
    /* before: loop l of section `last` in its own plane; m->lines[last] is the same loop, rotated into the plane of the
     * section before it. */
    loft_line before;
    vs_affine identity = vs_affine_identity();
    ok = (loft_line_make(&s[last].outline.loops[l], &identity, &before) || vs_error_memory(e, NULL)) &&
         vs_store_going(store, alike ? 1 : TWISTS, e);
    if (ok && alike) ok = loft_least_twist_index(&before, m->start[last], &m->lines[i], store, &m->start[i], e);
    else if (ok) m->shift[i] = loft_least_twist(&before, m->shift[last], &m->lines[i]);
    loft_line_free(&before);
    last = i;
  }
  m->count = size;
  if (ok && !alike)
    ok = (m->count = loft_places(m->lines, m->shift, rows, &m->places)) > 0 || vs_error_memory(e, NULL);
  for (size_t i = first; ok && i < rows; i++) {
    matched[i] = (vs_polyline){ .at = vs_fresh(m->count + 1, sizeof(vs_vec3)), .count = m->count };
    ok = (matched[i].at || vs_error_memory(e, NULL)) &&
         vs_store_going(store, (uint32_t)(m->count < 1000000 ? 64 * m->count : 64000000), e);
    const vs_polyline *p = s[i].point ? NULL : &s[i].outline.loops[l];
    for (size_t k = 0; ok && k < m->count; k++)
      matched[i].at[k] =
          !p      ? s[i].center
          : alike ? p->at[(m->start[i] + k) % size]
                  : loft_line_at(p->at, m->lines[i].along, p->count, p->closed, m->places[k] + m->shift[i], LOFT_NEAR);
  }
  return ok;
}

static void loft_match_free(loft_match *m, size_t rows) {
  for (size_t i = 0; m->lines && i < rows; i++) loft_line_free(&m->lines[i]);
  free(m->lines);
  free(m->shift);
  free(m->start);
  free(m->places);
  *m = (loft_match){ 0 };
}

static bool loft_room(vs_loft *out, size_t rows, size_t loops) {
  out->center = vs_fresh(rows + 1, sizeof *out->center);
  out->normal = vs_zeros(rows + 1, sizeof *out->normal);
  out->point = vs_zeros(rows + 1, sizeof *out->point);
  out->sizes = vs_zeros(loops + 1, sizeof *out->sizes);
  out->hole = vs_zeros(loops + 1, sizeof *out->hole);
  return out->center && out->normal && out->point && out->sizes && out->hole;
}

/* Makes one table of the matched points of all loops of all sections. Returns false and sets e on failure. */
static bool loft_tabulate(vs_store *store, const loft_sections *all, vs_loft *out, vs_error *e) {
  const loft_section *s = all->at;
  size_t rows = all->count, first = all->first;
  size_t loops = s[first].outline.count;
  vs_polyline *matched = vs_zeros(rows * loops + 1, sizeof *matched);
  bool ok = (matched && loft_room(out, rows, loops)) || vs_error_memory(e, NULL);
  for (size_t l = 0; ok && l < loops; l++) {
    loft_match m = { vs_zeros(rows + 1, sizeof *m.lines), vs_zeros(rows + 1, sizeof *m.shift),
                     vs_zeros(rows + 1, sizeof *m.start), NULL, 0 };
    ok = ((m.lines && m.shift && m.start) || vs_error_memory(e, NULL)) &&
         loft_match_loop(store, all, l, &m, matched + l * rows, e);
    out->sizes[l] = m.count;
    out->hole[l] = s[first].outline.hole[l];
    out->columns += m.count;
    /* Fills the rows before the row of section `first`. Each of them is a section that is a point, so all points of the
     * row coincide. */
    for (size_t i = 0; ok && i < first; i++) {
      matched[l * rows + i] = (vs_polyline){ .at = vs_fresh(m.count + 1, sizeof(vs_vec3)), .count = m.count };
      ok = matched[l * rows + i].at || vs_error_memory(e, NULL);
      for (size_t k = 0; ok && k < m.count; k++) matched[l * rows + i].at[k] = s[i].center;
    }
    loft_match_free(&m, rows);
  }
  out->rows = rows;
  out->loop_count = loops;
  out->round = !s[first].open;
  out->at = ok ? vs_fresh(rows * out->columns + 1, sizeof *out->at) : NULL;
  ok = ok && (out->at || vs_error_memory(e, NULL));
  for (size_t i = 0; ok && i < rows; i++) {
    out->center[i] = s[i].center;
    out->normal[i] = s[i].point || s[i].open ? vs_v3(0, 0, 0) : s[i].normal;
    out->point[i] = s[i].point;
    for (size_t l = 0, at = i * out->columns; l < loops; at += out->sizes[l], l++)
      memcpy(out->at + at, matched[l * rows + i].at, out->sizes[l] * sizeof *out->at);
  }
  for (size_t i = 0; matched && i < rows * loops; i++) vs_polyline_free(&matched[i]);
  free(matched);
  return ok;
}

/* Returns true if section b repeats section a: every point is at the same position, within the distance `near`. */
static bool loft_again(const loft_section *a, const loft_section *b, double near) {
  if (a->point || b->point || a->outline.count != b->outline.count) return false;
  for (size_t l = 0; l < a->outline.count; l++) {
    const vs_polyline *p = &a->outline.loops[l], *q = &b->outline.loops[l];
    if (p->count != q->count) return false;
    for (size_t i = 0; i < p->count; i++)
      if (vs_v3_length(vs_v3_sub(p->at[i], q->at[i])) > near) return false;
  }
  return true;
}

bool vs_loft_match(const vs_node *n, size_t count, const vs_fineness *f, vs_loft *out, vs_error *e) {
  VS_ASSERT(count > 0 && count <= n->child_count);
  *out = (vs_loft){ 0 };
  loft_section *s = vs_zeros(count + 1, sizeof *s);
  size_t first = 0, rows = count;
  vs_bounds b = vs_bounds_empty();
  if (!s) return vs_error_memory(e, NULL);
  bool ok = loft_read_all(n, count, f, s, e) && loft_agree(s, count, &first, e);
  for (size_t i = 0; ok && i < count; i++) {
    if (s[i].point) vs_bounds_add(&b, s[i].center);
    for (size_t l = 0; l < s[i].outline.count; l++)
      for (size_t k = 0; k < s[i].outline.loops[l].count; k++) vs_bounds_add(&b, s[i].outline.loops[l].at[k]);
  }
  out->size = vs_bounds_diagonal(&b);
  for (size_t i = 1; ok && i < count; i++)
    if (s[i].point == s[i - 1].point && vs_v3_length(vs_v3_sub(s[i].center, s[i - 1].center)) <= 1e-9 * out->size &&
        (s[i].point || loft_again(&s[i - 1], &s[i], 1e-9 * out->size)))
      ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "sections %zu and %zu are the same, in the same place", i, i + 1);
  if (ok && count > 3 && loft_again(&s[0], &s[count - 1], 1e-9 * out->size)) {
    out->joined = true;
    rows--;
    vs_outline_free(&s[rows].outline);
  }
  if (ok) loft_direct(s, rows, out->joined);
  for (size_t i = first + 1, last = first; ok && i < rows; i++) {
    if (s[i].point) continue;
    ok = loft_pair(&s[last], &s[i], i + 1, e);
    last = i;
  }
  ok = ok && loft_tabulate(n->store, &(loft_sections){ s, rows, first }, out, e);
  for (size_t i = 0; i < count; i++) vs_outline_free(&s[i].outline);
  free(s);
  if (!ok) vs_loft_free(out);
  return ok;
}
