/* Finds points where curves cross (curve_crossings.h).
 *
 * The curves are sampled and become edges in their plane, sorted by their smallest x. Each edge is compared with the
 * earlier edges that extend to its x. Two edges cross if the ends of each lie clearly on opposite sides of the other
 * edge. Where an end of an edge lies on another edge, the two curves cross if one of them changes sides there. If two
 * curves only touch, all their points are tested: a curve crosses another if it has points clearly inside and clearly
 * outside it. */
#include "geometry/plane/curve_crossings.h"

#include <stdlib.h>

#include "geometry/measure/bounds.h"
#include "geometry/plane/curve.h"
#include "geometry/plane/offset.h"
#include "geometry/plane/planar_evaluation.h"
#include "model/store/array.h"

/* An edge of a sampled curve, from a to b. `curve`: number of the curve; `place`: index of the edge in its loop;
 * `last`: index of the last edge of this loop; `low`, `high`: range of x; `slack`: distance that counts as 0. */
typedef struct { vs_vec2 a, b; size_t curve, place, last; double low, high, slack; } vs_cross_edge;


enum { TOUCHES_MOST = 64 }; /* greatest number of touching pairs of curves that are stored; the borders of a region have
                             * fewer */

typedef struct {
  vs_polyline *loops; /* loops[i]: sampled points of curve i */
  size_t count, total; /* count: number of curves; total: number of samples of all curves */
  double size;        /* diagonal of the bounding box of the largest curve */
  vs_affine frame;    /* coordinates of the plane in which the curves lie */
  vs_cross_edge *edges;
  size_t edge_count;
  size_t *starts, *after; /* index of the edge that follows edge number `place` of curve c: after[starts[c] + place] */
  struct { size_t a, b; } touches[TOUCHES_MOST]; /* pairs of curves that touch each other, by their numbers, a <= b */
  size_t touch_count;
} vs_cross_search;

static int cross_compare(const void *p, const void *q) {
  const vs_cross_edge *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  return a->curve != b->curve ? (a->curve < b->curve ? -1 : 1) : a->place < b->place ? -1 : a->place > b->place;
}

static double cross_side(const vs_cross_edge *e, vs_vec2 p) { /* returns the distance of p from the line through edge e,
                                                               * positive if p is to the left */
  double dx = e->b.x - e->a.x, dy = e->b.y - e->a.y;
  return (dx * (p.y - e->a.y) - dy * (p.x - e->a.x)) / hypot(dx, dy);
}

/* Returns true if edges p and q clearly cross: the ends of each lie on opposite sides of the other. *at: position of
 * the crossing. *touch: true if an end of one edge lies on the line of the other. */
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

/* Returns true if the direction q lies in the sector from direction p to direction r, counter-clockwise. *sure: true if
 * q is not close to a border of the sector. */
static bool cross_between(vs_vec2 p, vs_vec2 r, vs_vec2 q, bool *sure) {
  const double turn = 6.28318530717958647693, near = 0.05;
  double from = atan2(p.y, p.x), to = atan2(r.y, r.x) - from, at = atan2(q.y, q.x) - from;
  to -= turn * floor(to / turn);
  at -= turn * floor(at / turn);
  *sure = *sure && at > near && at < turn - near && fabs(at - to) > near;
  return at < to;
}

/* Returns true if the end of edge p lies on edge q and the curve of p passes through the curve of q there, to its other
 * side. `next_p`, `next_q`: the edges after p and q. */
static bool cross_at_end(const vs_cross_edge *p, const vs_cross_edge *next_p, const vs_cross_edge *q,
                         const vs_cross_edge *next_q) {
  double slack = fmax(p->slack, q->slack), dx = q->b.x - q->a.x, dy = q->b.y - q->a.y, length = hypot(dx, dy);
  double along = ((p->b.x - q->a.x) * dx + (p->b.y - q->a.y) * dy) / length;
  /* Ignores an end of p at the start of q: the edge before q ends there, too, and is compared with p. */
  if (fabs(cross_side(q, p->b)) > slack || along <= slack || along > length + slack) return false;
  vs_vec2 v = p->b, in = { p->a.x - v.x, p->a.y - v.y }, out = { next_p->b.x - v.x, next_p->b.y - v.y };
  vs_vec2 end = along >= length - slack ? next_q->b : q->b, come = { q->a.x - v.x, q->a.y - v.y },
          go = { end.x - v.x, end.y - v.y };
  bool sure = true, one = cross_between(in, out, come, &sure), other = cross_between(in, out, go, &sure);
  return sure && one != other;
}

/* Curves a and b touch. Returns true if one of these curves passes through the other: it has points clearly inside and
 * points clearly outside of it. Curves without such points coincide. */
static bool cross_through(const vs_cross_search *s, size_t a, size_t b, vs_vec2 *at) {
  const vs_cross_edge *edges = s->edges;
  size_t count = s->edge_count;
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

/* Samples the curves of refs into s->loops. Returns false on failure. */
static bool cross_sample(vs_cross_search *s, const vs_ref *refs, vs_error *e) {
  if (!VS_FRESH(s->loops, s->count + 1)) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < s->count; i++) s->loops[i] = (vs_polyline){ 0 };
  for (size_t i = 0; i < s->count; i++) {
    vs_bounds b;
    if (!vs_node_bounds(refs[i].node, &b, e)) return false;
    vs_fineness f = { vs_fineness_tolerance(&b), 0 };
    s->size = fmax(s->size, vs_bounds_diagonal(&b));
    if (!vs_curve_sample(refs[i].node, &f, &s->loops[i], e)) return false;
    s->total += s->loops[i].count;
  }
  return true;
}

/* Appends the edges of curve i, in the coordinates of the plane. straight: whether the curve is a polyline; back: map
 * from space to the plane. */
static void cross_add(vs_cross_search *s, size_t i, bool straight, const vs_affine *back) {
  const vs_polyline *l = &s->loops[i];
  vs_bounds b = vs_bounds_empty();
  for (size_t k = 0; k < l->count; k++) vs_bounds_add(&b, l->at[k]);
  double slack = fmax(1e-9 * s->size, straight ? 0 : 2 * vs_fineness_tolerance(&b));
  for (size_t k = 0; k < l->count; k++) {
    vs_vec3 p = vs_affine_point(back, l->at[k]), q = vs_affine_point(back, l->at[(k + 1) % l->count]);
    s->edges[s->edge_count++] = (vs_cross_edge){
      .a = { p.x, p.y }, .b = { q.x, q.y }, .curve = i, .place = k, .last = l->count - 1,
      .low = fmin(p.x, q.x), .high = fmax(p.x, q.x), .slack = slack
    };
  }
}

/* Makes the edges, sorted by x, and the links from each edge to the next edge of its curve. Makes no edges if the first
 * curve lies in no plane, which the caller reports. Returns false on failure. */
static bool cross_make_edges(vs_cross_search *s, const vs_ref *refs, vs_error *e) {
  vs_affine back;
  if (!VS_FRESH(s->edges, s->total + 1) || !VS_FRESH(s->after, s->total + 1) || !VS_FRESH(s->starts, s->count + 1))
    return vs_error_memory(e, NULL);
  if (!s->count || !vs_line_frame(&s->loops[0], &s->frame, NULL)) return true;
  if (!vs_affine_invert(&s->frame, &back)) return false;
  for (size_t i = 0; i < s->count; i++) cross_add(s, i, vs_curve_is_straight(refs[i].node), &back);
  if (s->edge_count) qsort(s->edges, s->edge_count, sizeof *s->edges, cross_compare);
  for (size_t i = 0, start = 0; i < s->count; start += s->loops[i++].count) s->starts[i] = start;
  for (size_t i = 0; i < s->edge_count; i++) {
    const vs_cross_edge *x = &s->edges[i];
    s->after[s->starts[x->curve] + (x->place ? x->place - 1 : x->last)] = i;
  }
  return true;
}

static const vs_cross_edge *cross_next(const vs_cross_search *s, const vs_cross_edge *p) {
  return &s->edges[s->after[s->starts[p->curve] + p->place]];
}

/* Stores that curves a and b touch. cross_touching compares all stored pairs later. */
static void cross_note(vs_cross_search *s, size_t a, size_t b) {
  for (size_t i = 0; i < s->touch_count; i++)
    if (s->touches[i].a == a && s->touches[i].b == b) return;
  if (s->touch_count == TOUCHES_MOST) return;
  s->touches[s->touch_count].a = a;
  s->touches[s->touch_count++].b = b;
}

static bool cross_found(const vs_cross_search *s, size_t a, size_t b, vs_vec2 at, vs_crossing *out) {
  *out = (vs_crossing){ a, b, vs_affine_point(&s->frame, vs_v3(at.x, at.y, 0)), true };
  return true;
}

/* Returns true if edges p and q, whose ranges of x overlap, cross, or if their curves cross at an end of p or q. */
static bool cross_pair(vs_cross_search *s, const vs_cross_edge *p, const vs_cross_edge *q, vs_crossing *out) {
  if (q->high < p->low || fmax(q->a.y, q->b.y) < fmin(p->a.y, p->b.y) ||
      fmin(q->a.y, q->b.y) > fmax(p->a.y, p->b.y) || cross_neighbours(p, q))
    return false;
  size_t a = p->curve < q->curve ? p->curve : q->curve, b = p->curve < q->curve ? q->curve : p->curve;
  vs_vec2 at;
  bool touch = false;
  if (cross_edges(p, q, &at, &touch)) return cross_found(s, a, b, at, out);
  if (!touch) return false;
  const vs_cross_edge *next_p = cross_next(s, p), *next_q = cross_next(s, q);
  if (cross_at_end(p, next_p, q, next_q) || cross_at_end(q, next_q, p, next_p)) return cross_found(s, a, b, q->b, out);
  if (a != b) cross_note(s, a, b);
  return false;
}

/* Compares all pairs of edges whose ranges of x overlap. Returns true if two curves cross, and sets *out to the first
 * crossing. */
static bool cross_sweep(vs_cross_search *s, vs_crossing *out) {
  double widest = 0;
  for (size_t i = 0; i < s->edge_count; i++) widest = fmax(widest, s->edges[i].high - s->edges[i].low);
  for (size_t i = 0; i < s->edge_count; i++)
    for (size_t k = i; k-- > 0 && s->edges[k].low >= s->edges[i].low - widest;)
      if (cross_pair(s, &s->edges[i], &s->edges[k], out)) return true;
  return false;
}

/* Compares the pairs of curves that touch. Returns true if one of them passes through the other, and sets *out to the
 * crossing. */
static bool cross_touching(const vs_cross_search *s, vs_crossing *out) {
  for (size_t i = 0; i < s->touch_count; i++) {
    vs_vec2 at = { 0, 0 };
    for (size_t k = 0; k < s->edge_count; k++)
      if (s->edges[k].curve == s->touches[i].a) at = s->edges[k].a;
    if (cross_through(s, s->touches[i].a, s->touches[i].b, &at))
      return cross_found(s, s->touches[i].a, s->touches[i].b, at, out);
  }
  return false;
}

bool vs_curves_cross(const vs_ref *refs, size_t count, vs_crossing *out, vs_error *e) {
  vs_cross_search s = { .count = count, .frame = vs_affine_identity() };
  *out = (vs_crossing){ 0 };
  bool ok = cross_sample(&s, refs, e) && cross_make_edges(&s, refs, e);
  if (ok && !cross_sweep(&s, out)) cross_touching(&s, out);
  for (size_t i = 0; s.loops && i < count; i++) vs_polyline_free(&s.loops[i]);
  free(s.loops), free(s.edges), free(s.after), free(s.starts);
  return ok;
}
