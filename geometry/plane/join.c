/* Owns the joining of open curves and the search for crossings.
 *
 * Joining: a chain begins with the first curve not yet used and takes on, at its end and then at its start, the first
 * unused curve that has an end there: quadratic in the number of curves. Crossings: edges sorted by their least
 * coordinate along the plane's first axis, each held against those that still reach it. */
#include "geometry/plane/join.h"
#include "geometry/plane/offset.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdlib.h>

#include "geometry/plane/curve.h"
#include "geometry/measure/node_measures.h"
#include "geometry/plane/areas.h"
#include "model/store/array.h"

bool vs_curve_ends(const vs_node *curve, vs_vec3 *start, vs_vec3 *end, double *size, vs_error *e) {
  vs_fineness coarse = { 1, 8 };
  vs_polyline p = { 0 };
  if (!vs_curve_sample(curve, &coarse, &p, e)) return false;
  vs_bounds b = vs_bounds_empty();
  for (size_t i = 0; i < p.count; i++) vs_bounds_add(&b, p.at[i]);
  bool ok = p.count > 0 || vs_error_set(e, VS_ERROR_MODEL, NULL, "a curve has no points");
  if (ok) {
    *start = p.at[0];
    *end = p.at[p.count - 1];
    *size = vs_bounds_diagonal(&b);
  }
  vs_polyline_free(&p);
  return ok;
}

typedef struct { vs_vec3 end[2]; double size; bool used, closed; } vs_join_part;

static bool join_near(vs_vec3 a, vs_vec3 b, double size) { return vs_v3_length(vs_v3_sub(a, b)) <= 1e-9 * size; }

/* The next unused part with an end at `at`; count: none. *far: its other end */
static size_t join_next(const vs_join_part *parts, size_t count, vs_vec3 at, double size, vs_vec3 *far) {
  for (size_t k = 0; k < count; k++)
    for (int end = 0; end < 2 && !parts[k].used && !parts[k].closed; end++)
      if (join_near(parts[k].end[end], at, fmax(size, parts[k].size))) {
        *far = parts[k].end[1 - end];
        return k;
      }
  return count;
}

bool vs_curves_join(vs_store *s, vs_ref *refs, size_t *count, vs_error *e) {
  size_t n = *count, made = 0;
  vs_join_part *parts = vs_zeros(n, sizeof *parts);
  vs_ref *chain = vs_fresh(2 * n + 1, sizeof *chain), *out = vs_fresh(n, sizeof *out);
  bool ok = (parts && chain && out) || vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < n; i++) {
    parts[i].closed = refs[i].node->flags & VS_NODE_CLOSED;
    if (!parts[i].closed) ok = vs_curve_ends(refs[i].node, &parts[i].end[0], &parts[i].end[1], &parts[i].size, e);
    if (!ok && e && !e->origin) e->origin = refs[i].origin;
  }
  for (size_t i = 0; ok && i < n; i++) {
    if (parts[i].used) continue;
    parts[i].used = true;
    size_t first = n, last = n + 1; /* the chain lies in the middle of its array and grows both ways */
    chain[n] = refs[i];
    double size = parts[i].size;
    vs_vec3 head = parts[i].end[0], tail = parts[i].end[1], far;
    bool closed = false;
    for (size_t k; !parts[i].closed && !closed;) {
      if (last - first > 1 && join_near(head, tail, size)) closed = true;
      else if ((k = join_next(parts, n, tail, size, &far)) < n) tail = far, chain[last++] = refs[k];
      else if ((k = join_next(parts, n, head, size, &far)) < n) head = far, chain[--first] = refs[k];
      else break;
      if (!closed) {
        parts[k].used = true;
        size = fmax(size, parts[k].size);
      }
    }
    if (last - first == 1) {
      out[made] = refs[i];
      vs_node_retain(out[made++].node);
      continue;
    }
    out[made] = (vs_ref){ vs_node_new(s, VS_JOIN, &(struct vs_join){ .closed = closed }, chain + first, last - first),
                          chain[first].origin };
    ok = out[made].node || vs_error_memory(e, NULL);
    made += ok;
  }
  for (size_t i = 0; i < made && ok; i++) refs[i] = out[i];
  for (size_t i = 0; i < made && !ok; i++) vs_node_release(out[i].node);
  if (ok) *count = made;
  free(parts);
  free(chain);
  free(out);
  return ok;
}

/* ---- crossings ---- */

/* low, high along x; place: in its loop, of last + 1 */
typedef struct { vs_vec2 a, b; size_t curve, place, last; double low, high, slack; } vs_cross_edge;

static int cross_compare(const void *p, const void *q) {
  const vs_cross_edge *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  return a->curve != b->curve ? (a->curve < b->curve ? -1 : 1) : a->place < b->place ? -1 : a->place > b->place;
}

static double cross_side(const vs_cross_edge *e, vs_vec2 p) { /* distance from the edge's line, left positive */
  double dx = e->b.x - e->a.x, dy = e->b.y - e->a.y;
  return (dx * (p.y - e->a.y) - dy * (p.x - e->a.x)) / hypot(dx, dy);
}

/* Ends of each lie clearly on both sides of the other. touch: they do not, but an end lies on the other's line. */
static bool cross_edges(const vs_cross_edge *p, const vs_cross_edge *q, vs_vec2 *at, bool *touch) {
  double slack = fmax(p->slack, q->slack), a = cross_side(p, q->a), b = cross_side(p, q->b), c = cross_side(q, p->a),
         d = cross_side(q, p->b);
  bool apart = (a > slack && b < -slack) || (a < -slack && b > slack),
       other = (c > slack && d < -slack) || (c < -slack && d > slack);
  if (apart && other) {
    double t = a / (a - b);
    *at = (vs_vec2){ q->a.x + t * (q->b.x - q->a.x), q->a.y + t * (q->b.y - q->a.y) };
    return true;
  }
  *touch = fmin(fmin(fabs(a), fabs(b)), fmin(fabs(c), fabs(d))) <= slack;
  return false;
}

/* Is the direction q in the sector from p counter-clockwise to r? Clearly so, or clearly not: *sure */
static bool cross_between(vs_vec2 p, vs_vec2 r, vs_vec2 q, bool *sure) {
  const double turn = 6.28318530717958647693, near = 0.05;
  double from = atan2(p.y, p.x), to = atan2(r.y, r.x) - from, at = atan2(q.y, q.x) - from;
  to -= turn * floor(to / turn);
  at -= turn * floor(at / turn);
  *sure = *sure && at > near && at < turn - near && fabs(at - to) > near;
  return at < to;
}

/* The end of p lies on q: do the two strands through that point change sides there? next: of p, and of q where its end
 * is the point too */
static bool cross_at_end(const vs_cross_edge *p, const vs_cross_edge *next_p, const vs_cross_edge *q,
                         const vs_cross_edge *next_q) {
  double slack = fmax(p->slack, q->slack), dx = q->b.x - q->a.x, dy = q->b.y - q->a.y, length = hypot(dx, dy);
  double along = ((p->b.x - q->a.x) * dx + (p->b.y - q->a.y) * dy) / length;
  /* at q's start it is the edge before that ends there */
  if (fabs(cross_side(q, p->b)) > slack || along <= slack || along > length + slack) return false;
  vs_vec2 v = p->b, in = { p->a.x - v.x, p->a.y - v.y }, out = { next_p->b.x - v.x, next_p->b.y - v.y };
  vs_vec2 end = along >= length - slack ? next_q->b : q->b, come = { q->a.x - v.x, q->a.y - v.y },
          go = { end.x - v.x, end.y - v.y };
  bool sure = true, one = cross_between(in, out, come, &sure), other = cross_between(in, out, go, &sure);
  return sure && one != other;
}

/* Where curves touch, one may pass to the other's inside through the point of touch: then it has points clearly inside
 * and clearly outside. Where neither has either, they lie on each other. */
static bool cross_through(const vs_cross_edge *edges, size_t count, size_t a, size_t b, vs_vec2 *at) {
  bool clear = false;
  for (int turn = 0; turn < 2; turn++) {
    bool in = false, out = false;
    size_t moving = turn ? a : b, still = turn ? b : a;
    for (size_t i = 0; i < count; i++) {
      if (edges[i].curve != moving) continue;
      vs_vec2 p = { (edges[i].a.x + edges[i].b.x) / 2, (edges[i].a.y + edges[i].b.y) / 2 };
      bool inside = false, on = false;
      for (size_t k = 0; k < count && !on; k++) {
        if (edges[k].curve != still) continue;
        vs_vec2 u = edges[k].a, v = edges[k].b;
        if ((u.y > p.y) != (v.y > p.y) && p.x < u.x + (p.y - u.y) / (v.y - u.y) * (v.x - u.x)) inside = !inside;
        double dx = v.x - u.x, dy = v.y - u.y, t = ((p.x - u.x) * dx + (p.y - u.y) * dy) / (dx * dx + dy * dy);
        t = fmin(1, fmax(0, t));
        on = hypot(p.x - u.x - t * dx, p.y - u.y - t * dy) <= fmax(edges[i].slack, edges[k].slack);
      }
      if (on) continue;
      in |= inside;
      out |= !inside;
      if (in && out) return *at = p, true;
    }
    clear |= in || out;
  }
  return !clear;
}

static bool cross_neighbours(const vs_cross_edge *p, const vs_cross_edge *q) {
  if (p->curve != q->curve) return false;
  size_t low = p->place < q->place ? p->place : q->place, high = p->place < q->place ? q->place : p->place;
  return high - low < 2 || (low == 0 && high == p->last);
}

bool vs_curves_cross(const vs_ref *refs, size_t count, vs_crossing *out, vs_error *e) {
  *out = (vs_crossing){ 0 };
  vs_polyline *loops = vs_zeros(count, sizeof *loops);
  bool ok = loops || vs_error_memory(e, NULL);
  size_t total = 0, edge_count = 0, touch_count = 0;
  struct { size_t a, b; } touches[64]; /* more pairs are not looked at: they are of drawings, not of regions */
  vs_cross_edge *edges = NULL;
  vs_affine frame = vs_affine_identity(), back = frame;
  double size = 0;
  for (size_t i = 0; ok && i < count; i++) {
    vs_bounds b;
    ok = vs_node_bounds(refs[i].node, &b, e);
    vs_fineness f = { vs_fineness_tolerance(&b), 0 };
    size = fmax(size, vs_bounds_diagonal(&b));
    ok = ok && vs_curve_sample(refs[i].node, &f, &loops[i], e);
    total += loops[i].count;
  }
  if (ok && total) {
    edges = vs_fresh(total, sizeof *edges);
    ok = edges || vs_error_memory(e, NULL);
  }
  for (size_t i = 0; ok && i < count; i++) {
    if (!i) {
      ok = vs_line_frame(&loops[0], &frame, NULL);
      if (!ok) { /* it lies in no plane: whoever asks has looked before */
        ok = true;
        break;
      }
      ok = vs_affine_invert(&frame, &back);
    }
    bool straight = vs_curve_is_straight(refs[i].node);
    vs_bounds b = vs_bounds_empty();
    for (size_t k = 0; k < loops[i].count; k++) vs_bounds_add(&b, loops[i].at[k]);
    double slack = fmax(1e-9 * size, straight ? 0 : 2 * vs_fineness_tolerance(&b));
    for (size_t k = 0; k < loops[i].count; k++) {
      vs_vec3 p = vs_affine_point(&back, loops[i].at[k]),
              q = vs_affine_point(&back, loops[i].at[(k + 1) % loops[i].count]);
      edges[edge_count++] = (vs_cross_edge){ { p.x, p.y },   { q.x, q.y },   i,    k, loops[i].count - 1,
                                             fmin(p.x, q.x), fmax(p.x, q.x), slack };
    }
  }
  if (ok && edge_count) qsort(edges, edge_count, sizeof *edges, cross_compare);
  /* after[starts[curve] + place]: where the edge that follows it stands now */
  size_t *after = vs_fresh(total + 1, sizeof *after), *starts = vs_fresh(count + 1, sizeof *starts);
  ok = ok && ((after && starts) || vs_error_memory(e, NULL));
  for (size_t i = 0, start = 0; ok && i < count; start += loops[i++].count) starts[i] = start;
  for (size_t i = 0; ok && i < edge_count; i++)
    after[starts[edges[i].curve] + (edges[i].place ? edges[i].place - 1 : edges[i].last)] = i;
  double widest = 0;
  for (size_t i = 0; i < edge_count; i++) widest = fmax(widest, edges[i].high - edges[i].low);
  for (size_t i = 0; ok && !out->found && i < edge_count; i++)
    for (size_t k = i; k-- > 0 && edges[k].low >= edges[i].low - widest;) {
      vs_vec2 at;
      bool touch = false;
      if (edges[k].high < edges[i].low || fmax(edges[k].a.y, edges[k].b.y) < fmin(edges[i].a.y, edges[i].b.y) ||
          fmin(edges[k].a.y, edges[k].b.y) > fmax(edges[i].a.y, edges[i].b.y) || cross_neighbours(&edges[i], &edges[k]))
        continue;
      size_t a = edges[i].curve < edges[k].curve ? edges[i].curve : edges[k].curve,
             b = edges[i].curve < edges[k].curve ? edges[k].curve : edges[i].curve;
      if (cross_edges(&edges[i], &edges[k], &at, &touch)) {
        *out = (vs_crossing){ a, b, vs_affine_point(&frame, vs_v3(at.x, at.y, 0)), true };
        break;
      }
      const vs_cross_edge *p = &edges[i], *q = &edges[k];
      if (touch &&
          (cross_at_end(p, &edges[after[starts[p->curve] + p->place]], q, &edges[after[starts[q->curve] + q->place]]) ||
           cross_at_end(q, &edges[after[starts[q->curve] + q->place]], p,
                        &edges[after[starts[p->curve] + p->place]]))) {
        *out = (vs_crossing){ a, b, vs_affine_point(&frame, vs_v3(q->b.x, q->b.y, 0)), true };
        break;
      }
      if (!touch || a == b || touch_count == 64) continue;
      size_t known = 0;
      while (known < touch_count && (touches[known].a != a || touches[known].b != b)) known++;
      if (known < touch_count) continue;
      touches[touch_count].a = a;
      touches[touch_count++].b = b;
    }
  for (size_t i = 0; ok && !out->found && i < touch_count; i++) {
    vs_vec2 at = { 0, 0 };
    for (size_t k = 0; k < edge_count; k++)
      if (edges[k].curve == touches[i].a) at = edges[k].a;
    if (cross_through(edges, edge_count, touches[i].a, touches[i].b, &at))
      *out = (vs_crossing){ touches[i].a, touches[i].b, vs_affine_point(&frame, vs_v3(at.x, at.y, 0)), true };
  }
  for (size_t i = 0; loops && i < count; i++) vs_polyline_free(&loops[i]);
  free(loops);
  free(edges);
  free(after);
  free(starts);
  return ok;
}
