/* Computes areas and centroids of regions by Green's theorem. The area is the integral of 1/2 (x dy - y dx) around
 * every loop. The first moments are those of 1/2 x^2 dy and -1/2 y^2 dx. Each loop is integrated piece by piece.
 *
 * A straight piece has a closed form. For a round piece c + a cos t + b sin t, the integrand is a trigonometric
 * polynomial of degree 3. Gauss's rule with eight points, over at most an eighth of a turn each, integrates it up to
 * rounding errors. Coordinates are in the outline's plane and relative to its first point, which avoids cancellation
 * far from the origin. */
#include "geometry/measure/moments.h"

#include <stdlib.h>

#include "geometry/plane/areas.h"
#include "geometry/plane/offset.h"
#include "model/store/array.h"

static const double turn = 6.28318530717958647693;

typedef struct { bool round; vs_vec2 c, a, b; /* A piece of a region's border. round: the curve c + a cos t + b sin t;
                                               * otherwise the straight piece from c to a. */ double from, to; } piece;
typedef struct { piece *at; size_t count, room; } pieces;
typedef struct { double area, x, y; } moments;

static bool add(pieces *p, piece one) {
  if (!VS_GROW(p->at, p->room, p->count + 1)) return false;
  p->at[p->count++] = one;
  return true;
}

static vs_vec2 flat(const vs_affine *map, vs_vec3 p) {
  vs_vec3 q = vs_affine_point(map, p);
  return (vs_vec2){ q.x, q.y };
}

/* Returns a piece for an arc of the circle with radius r about center, from the angle `from` to the angle `to`, in
 * radians, mapped by `map`. */
static piece arc_piece(const vs_affine *map, vs_vec3 center, double r, double from, double to) {
  vs_vec3 a = vs_affine_vector(map, vs_v3(r, 0, 0)), b = vs_affine_vector(map, vs_v3(0, r, 0));
  return (piece){ true, flat(map, center), { a.x, a.y }, { b.x, b.y }, from, to };
}

static vs_vec2 piece_at(const piece *p, double t) {
  double s, c;
  vs_sincos(t, &s, &c);
  return (vs_vec2){ p->c.x + p->a.x * c + p->b.x * s, p->c.y + p->a.y * c + p->b.y * s };
}

static vs_vec2 piece_start(const piece *p) { return p->round ? piece_at(p, p->from) : p->c; }
static vs_vec2 piece_end(const piece *p) { return p->round ? piece_at(p, p->to) : p->a; }

static void turn_round(pieces *p, size_t first) {
  for (size_t i = first, j = p->count; i < j; i++) {
    piece swap = p->at[i];
    p->at[i] = p->at[--j];
    p->at[j] = swap;
  }
  for (size_t i = first; i < p->count; i++) {
    piece *x = &p->at[i];
    if (x->round) {
      double from = x->from;
      x->from = x->to;
      x->to = from;
    } else {
      vs_vec2 c = x->c;
      x->c = x->a;
      x->a = c;
    }
  }
}

/* Appends the pieces of curve n, mapped by `map`. n is no join of curves. Sets *known to false if there is no exact
 * formula for its kind. Returns false when memory is out. */
static bool leaf(const vs_node *n, vs_affine map, pieces *out, bool *known) {
  vs_offset_exact exact;
  vs_affine place;
  while (vs_node_is_around(n)) {
    if (n->kind == VS_TRANSFORM) map = vs_affine_multiply(&map, &VS_AS(transform, n)->matrix);
    n = n->children[0].node;
  }
  if (n->kind == VS_OFFSET && vs_offset_round(n, &place, &exact)) {
    map = vs_affine_multiply(&map, &place);
    return add(
        out, arc_piece(&map, exact.arc.center, exact.arc.radius, exact.arc.start, exact.circle ? turn : exact.arc.end));
  }
  if (n->kind == VS_CIRCLE)
    return add(out, arc_piece(&map, VS_AS(circle, n)->center, VS_AS(circle, n)->radius, 0, turn));
  if (n->kind == VS_ARC)
    return add(out,
               arc_piece(&map, VS_AS(arc, n)->center, VS_AS(arc, n)->radius, VS_AS(arc, n)->start, VS_AS(arc, n)->end));
  *known = n->kind == VS_LINE;
  bool ok = true;
  const struct vs_line *line = *known ? VS_AS(line, n) : NULL;
  for (uint32_t i = 0; line && ok && i + (line->closed ? 0 : 1) < line->points->count; i++)
    ok = add(out, (piece){ .c = flat(&map, line->points->at[i]),
                           .a = flat(&map, line->points->at[(i + 1) % line->points->count]) });
  return ok;
}

static double apart(vs_vec2 p, vs_vec2 q) { return hypot(p.x - q.x, p.y - q.y); }

static bool curve(const vs_node *n, vs_affine map, pieces *out, bool *known) {
  bool ok = true;
  while (vs_node_is_around(n)) {
    if (n->kind == VS_TRANSFORM) map = vs_affine_multiply(&map, &VS_AS(transform, n)->matrix);
    n = n->children[0].node;
  }
  if (n->kind != VS_JOIN) return leaf(n, map, out, known);
  for (uint32_t i = 0; ok && *known && i < n->child_count; i++) {
    size_t first = out->count;
    ok = leaf(n->children[i].node, map, out, known);
    if (!ok || !*known || !first || out->count == first) continue;
    vs_vec2 start = piece_start(&out->at[first]), end = piece_end(&out->at[out->count - 1]);
    if (i == 1) { /* in a join of curves, the first curve may have to be reversed, so that its end is at the second
                   * curve */
      vs_vec2 head = piece_start(&out->at[0]), tail = piece_end(&out->at[first - 1]);
      if (fmin(apart(head, start), apart(head, end)) < fmin(apart(tail, start), apart(tail, end))) {
        pieces before = { out->at, first, first };
        turn_round(&before, 0);
      }
    }
    vs_vec2 tail = piece_end(&out->at[first - 1]);
    if (apart(tail, end) < apart(tail, start)) turn_round(out, first);
  }
  return ok;
}

static moments straight(vs_vec2 p, vs_vec2 q) {
  return (moments){ (p.x * q.y - q.x * p.y) / 2, (q.y - p.y) * (p.x * p.x + p.x * q.x + q.x * q.x) / 6,
                    -(q.x - p.x) * (p.y * p.y + p.y * q.y + q.y * q.y) / 6 };
}

static moments plus(moments m, moments n) { return (moments){ m.area + n.area, m.x + n.x, m.y + n.y }; }
static moments positive(moments m) { return m.area < 0 ? (moments){ -m.area, -m.x, -m.y } : m; }

static moments integrate(const pieces *p) {
  static const double at[4] = { 0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                0.96028985649753623168 };
  static const double weight[4] = { 0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                    0.10122853629037625915 };
  moments m = { 0, 0, 0 };
  for (size_t i = 0; i < p->count; i++) {
    const piece *x = &p->at[i];
    if (!x->round) {
      m = plus(m, straight(x->c, x->a));
      continue;
    }
    if (fabs(x->to - x->from) == turn) { /* the piece is a full ellipse with the centre c */
      double area = turn / 2 * (x->a.x * x->b.y - x->a.y * x->b.x) * (x->to < x->from ? -1 : 1);
      m = plus(m, (moments){ area, area * x->c.x, area * x->c.y });
      continue;
    }
    int parts = (int)ceil(fabs(x->to - x->from) / 0.7854 - 1e-9);
    double half = (x->to - x->from) / (2 * parts);
    for (int k = 0; k < parts; k++)
      for (int g = 0; g < 8; g++) {
        double t = x->from + half * (2 * k + 1) + half * (g < 4 ? at[g] : -at[g - 4]), w = half * weight[g % 4], s, c;
        vs_sincos(t, &s, &c);
        double u = x->c.x + x->a.x * c + x->b.x * s, v = x->c.y + x->a.y * c + x->b.y * s, du = x->b.x * c - x->a.x * s,
               dv = x->b.y * c - x->a.y * s;
        m.area += w * (u * dv - v * du) / 2;
        m.x += w * u * u * dv / 2;
        m.y -= w * v * v * du / 2;
      }
  }
  return positive(m);
}

static moments of_loop(const vs_polyline *p, const vs_affine *map) {
  moments m = { 0, 0, 0 };
  for (size_t i = 0; i < p->count; i++)
    m = plus(m, straight(flat(map, p->at[i]), flat(map, p->at[(i + 1) % p->count])));
  return positive(m);
}

bool vs_region_moments(const vs_node *region, const vs_outline *o, double *area, vs_vec3 *centroid, bool *known,
                       vs_error *e) {
  vs_affine placed = vs_affine_identity();
  while (vs_node_is_around(region)) {
    if (region->kind == VS_TRANSFORM) placed = vs_affine_multiply(&placed, &VS_AS(transform, region)->matrix);
    region = region->children[0].node;
  }
  uint32_t count = region->kind == VS_REGION ? region->child_count : 1;
  *known = o->count == count && o->count > 0;
  if (!*known) return true;
  vs_affine frame = o->frame, back;
  frame.m[0][3] = o->loops[0].at[0].x, frame.m[1][3] = o->loops[0].at[0].y, frame.m[2][3] = o->loops[0].at[0].z;
  *known = vs_affine_invert(&frame, &back);
  vs_affine map = vs_affine_multiply(&back, &placed);
  moments sum = { 0, 0, 0 }, *loops = vs_fresh(o->count + 1, sizeof *loops);
  bool *taken = vs_zeros(o->count + 1, sizeof *taken), ok = loops && taken;
  for (size_t l = 0; ok && l < o->count; l++) loops[l] = of_loop(&o->loops[l], &back);
  for (uint32_t i = 0; ok && *known && i < count; i++) {
    pieces p = { 0 };
    ok = curve(region->kind == VS_REGION ? region->children[i].node : region, map, &p, known);
    moments m = integrate(&p);
    free(p.at);
    size_t best = o->count;
    double least = INFINITY;
    for (size_t l = 0; l < o->count; l++) { /* finds the loop of the region's sampled outline that was made from this
                                             * curve */
      double size = sqrt(m.area),
             off = fabs(loops[l].area - m.area) * size + fabs(loops[l].x - m.x) + fabs(loops[l].y - m.y);
      if (!taken[l] && off < least) least = off, best = l;
    }
    if (best == o->count) *known = false;
    if (!ok || !*known) break;
    taken[best] = true;
    double sign = o->hole[best] ? -1 : 1;
    sum = (moments){ sum.area + sign * m.area, sum.x + sign * m.x, sum.y + sign * m.y };
  }
  *known = *known && sum.area > 0;
  if (ok && *known) {
    *area = sum.area;
    *centroid = vs_affine_point(&frame, vs_v3(sum.x / sum.area, sum.y / sum.area, 0));
  }
  free(loops);
  free(taken);
  return ok || vs_error_memory(e, NULL);
}
