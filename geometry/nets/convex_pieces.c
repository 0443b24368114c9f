/* Divides areas into convex pieces (convex_pieces.h).
 *
 * The area is cut into triangles. A side between two pieces is then removed if the polygon without it is convex, the
 * longest sides first. */
#include "geometry/nets/convex_pieces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

void vs_convex_pieces_free(vs_convex_pieces *c) {
  free(c->at), free(c->size);
  *c = (vs_convex_pieces){ 0 };
}

static double turn(vs_vec2 a, vs_vec2 b, vs_vec2 c) {
  return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
}

/* ---- pieces ---- */

/* A corner of a polygon: its point, and the next and the previous corner of the polygon. */
typedef struct { uint32_t point, next, last; } corner;

/* A side that two polygons share. a, b: the corners at which the side begins in the first and in the second polygon. */
typedef struct { uint32_t a, b; double length; } shared_side;

static int by_length(const void *a, const void *b) {
  const shared_side *p = a, *q = b;
  if (p->length != q->length) return p->length > q->length ? -1 : 1;
  return p->a < q->a ? -1 : p->a > q->a;
}

typedef struct { uint32_t from, to, corner; } half_side;

static int by_ends(const void *a, const void *b) {
  const half_side *p = a, *q = b;
  uint32_t pl = p->from < p->to ? p->from : p->to, ph = p->from < p->to ? p->to : p->from,
           ql = q->from < q->to ? q->from : q->to, qh = q->from < q->to ? q->to : q->from;
  if (pl != ql) return pl < ql ? -1 : 1;
  if (ph != qh) return ph < qh ? -1 : 1;
  return p->corner < q->corner ? -1 : p->corner > q->corner;
}

/* Finds the sides that exactly two triangles share, and writes them to `out`. Returns their number. */
static size_t shared_sides(const vs_vec2 *at, const corner *c, size_t corners, half_side *half, shared_side *out) {
  size_t count = 0;
  for (size_t i = 0; i < corners; i++) half[i] = (half_side){ c[i].point, c[c[i].next].point, (uint32_t)i };
  qsort(half, corners, sizeof *half, by_ends);
  for (size_t i = 0; i + 1 < corners; i++) {
    const half_side *p = &half[i], *q = &half[i + 1];
    if (p->from != q->to || p->to != q->from) continue;
    if (i + 2 < corners && half[i + 2].from + (uint64_t)half[i + 2].to == p->from + (uint64_t)p->to &&
        (half[i + 2].from == p->from || half[i + 2].from == p->to)) {
      while (i + 1 < corners && (half[i + 1].from == p->from || half[i + 1].from == p->to) &&
             (half[i + 1].to == p->from || half[i + 1].to == p->to))
        i++;
      continue;
    }
    vs_vec2 a = at[p->from], b = at[p->to];
    out[count++] = (shared_side){ p->corner, q->corner, hypot(a.x - b.x, a.y - b.y) };
    i++;
  }
  qsort(out, count, sizeof *out, by_length);
  return count;
}

/* Removes the side s between two polygons, which unites them, if the united polygon is convex. */
static void remove_side(const vs_vec2 *at, corner *c, const shared_side *s, double slack) {
  uint32_t a = s->a, b = s->b, an = c[a].next, bn = c[b].next, al = c[a].last, bl = c[b].last;
  /* The side goes from a to the next corner an in one polygon, and from b to the next corner bn in the other. Therefore
   * an and b are at one point, and a and bn at another. */
  if (turn(at[c[al].point], at[c[a].point], at[c[c[bn].next].point]) < -slack) return;
  if (turn(at[c[bl].point], at[c[b].point], at[c[c[an].next].point]) < -slack) return;
  c[al].next = bn, c[bn].last = al; /* the corners a and b are no longer in the united polygon */
  c[bl].next = an, c[an].last = bl;
  c[a].next = c[a].last = a, c[b].next = c[b].last = b;
}

/* Adds the polygon that contains the corner `start` as a piece. The piece begins at the leftmost of its lowest points.
 * Marks its corners as done. Returns false when memory is out. */
static bool add_ring(const vs_vec2 *at, corner *c, uint32_t start, bool *done, vs_convex_pieces *out) {
  uint32_t low = start;
  size_t n = 0;
  for (uint32_t i = start; n == 0 || i != start; i = c[i].next, n++) {
    vs_vec2 p = at[c[i].point], q = at[c[low].point];
    if (p.y < q.y || (p.y == q.y && p.x < q.x)) low = i;
    done[i] = true;
  }
  if (n < 3) return true;
  if (!VS_GROW(out->at, out->room, out->count + n) || !VS_GROW(out->size, out->piece_room, out->pieces + 1))
    return false;
  uint32_t i = low;
  for (size_t k = 0; k < n; k++, i = c[i].next) out->at[out->count++] = at[c[i].point];
  out->size[out->pieces++] = n;
  return true;
}

/* Adds the convex pieces of the area within one outer loop and outside of its holes. sizes: number of points of each
 * loop, the outer loop first. Returns false when memory is out. */
static bool add_pieces(const vs_vec2 *at, const size_t *sizes, size_t loops, vs_convex_pieces *out) {
  size_t n = 0;
  vs_mesh m = { 0 };
  double size = 0;
  for (size_t l = 0; l < loops; l++) n += sizes[l];
  for (size_t i = 0; i < n; i++) size = fmax(size, fmax(fabs(at[i].x - at[0].x), fabs(at[i].y - at[0].y)));
  uint32_t *index = vs_fresh(n, sizeof *index);
  bool ok = index != NULL;
  for (size_t i = 0; ok && i < n; i++) index[i] = (uint32_t)i;
  ok = ok && vs_triangulate(at, sizes, loops, &m, index, false);
  size_t corners = 3 * (size_t)m.triangle_count;
  corner *c = ok ? vs_fresh(corners, sizeof *c) : NULL;
  half_side *half = ok ? vs_fresh(corners, sizeof *half) : NULL;
  shared_side *shared = ok ? vs_fresh(corners, sizeof *shared) : NULL;
  bool *done = ok ? vs_zeros(corners, sizeof *done) : NULL;
  ok = c && half && shared && done;
  for (size_t i = 0; ok && i < corners; i++) {
    uint32_t t = (uint32_t)(i - i % 3), k = (uint32_t)(i % 3);
    c[i] = (corner){ m.triangles[i / 3][k], t + (k + 1) % 3, t + (k + 2) % 3 };
  }
  size_t count = ok ? shared_sides(at, c, corners, half, shared) : 0;
  for (size_t i = 0; i < count; i++) remove_side(at, c, &shared[i], 1e-12 * size * size);
  for (size_t i = 0; ok && i < corners; i++)
    if (!done[i] && c[i].next != i) ok = add_ring(at, c, (uint32_t)i, done, out);
  free(index), free(c), free(half), free(shared), free(done);
  vs_mesh_free(&m);
  return ok;
}

bool vs_area_convex_pieces(const vs_area *a, vs_convex_pieces *out) {
  bool ok = true;
  for (size_t l = 0, first = 0; ok && l < a->loop_count;) {
    size_t loops = 1, points = a->size[l];
    while (l + loops < a->loop_count && a->hole[l + loops]) points += a->size[l + loops++];
    ok = add_pieces(a->at + first, a->size + l, loops, out);
    l += loops, first += points;
  }
  return ok;
}

/* ---- fewer corners ---- */

static double length(double x, double y) { return sqrt(x * x + y * y); }

static double to_line(vs_vec2 p, vs_vec2 a, vs_vec2 b) {
  double l = length(b.x - a.x, b.y - a.y);
  return l > 0 ? fabs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / l : length(p.x - a.x, p.y - a.y);
}

/* Sets *meet to the point where the sides a b and c d of a loop, extended beyond b and before c, intersect. Returns the
 * distance of this point from the side b c, or infinity if there is no such point. */
static double beyond(vs_vec2 a, vs_vec2 b, vs_vec2 c, vs_vec2 d, vs_vec2 *meet) {
  double ux = b.x - a.x, uy = b.y - a.y, wx = c.x - d.x, wy = c.y - d.y, k = ux * wy - uy * wx;
  if (!(k < -1e-9 * length(ux, uy) * length(wx, wy)) && !(k > 1e-9 * length(ux, uy) * length(wx, wy))) return INFINITY;
  double s = ((c.x - b.x) * wy - (c.y - b.y) * wx) / k, t = ((c.x - b.x) * uy - (c.y - b.y) * ux) / k;
  if (!(s >= 0) || !(t >= 0)) return INFINITY;
  *meet = (vs_vec2){ b.x + s * ux, b.y + s * uy };
  return to_line(*meet, b, c);
}

/* Removes corners of a loop of n corners. The new loop contains the old one and deviates from it by at most `most`, in
 * hollows by at most `hollow`. used[i]: distance by which corner i has moved outwards so far. Returns the number of
 * remaining corners. */
static size_t fewer(vs_vec2 *at, double *used, size_t n, double most, double hollow) {
  memset(used, 0, n * sizeof *used);
  for (bool again = true; again && n > 4;) {
    size_t best = n;
    double least = 1; /* least deviation, as a share of the greatest one */
    vs_vec2 place = { 0, 0 };
    bool fills = false;
    again = false;
    for (size_t i = 0; i < n; i++) {
      vs_vec2 a = at[(i + n - 1) % n], b = at[i], c = at[(i + 1) % n], d = at[(i + 2) % n], meet;
      if (turn(a, b, c) <= 0) { /* removes a concave corner, and so fills the notch at this corner with material */
        double added = (to_line(b, a, c) + fmax(used[i], fmax(used[(i + n - 1) % n], used[(i + 1) % n]))) / hollow;
        if (added <= least) least = added, best = i, fills = true, again = true;
      } else if (turn(b, c, d) > 0) { /* removes a side between two convex corners: its two neighbours are extended
                                       * until they intersect */
        double added = (beyond(a, b, c, d, &meet) + fmax(used[i], used[(i + 1) % n])) / most;
        if (added <= least) least = added, best = i, fills = false, place = meet, again = true;
      }
    }
    if (!again) break;
    size_t gone = fills ? best : (best + 1) % n;
    if (fills) used[(best + n - 1) % n] = used[(best + 1) % n] = least * hollow;
    else at[best] = place, used[best] = least * most;
    memmove(at + gone, at + gone + 1, (n - gone - 1) * sizeof *at);
    memmove(used + gone, used + gone + 1, (n - gone - 1) * sizeof *used);
    n--;
  }
  return n;
}

static bool sides_cross(vs_vec2 a, vs_vec2 b, vs_vec2 c, vs_vec2 d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

static bool crosses_itself(const vs_area *a) {
  for (size_t l = 0, f = 0; l < a->loop_count; f += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++)
      for (size_t k = l, g = f; k < a->loop_count; g += a->size[k++])
        for (size_t j = k == l ? i + 1 : 0; j < a->size[k]; j++)
          if (sides_cross(a->at[f + i], a->at[f + (i + 1) % a->size[l]], a->at[g + j],
                          a->at[g + (j + 1) % a->size[k]]))
            return true;
  return false;
}

static bool copy_loops(const vs_area *a, double most, double hollow, vs_area *out) {
  vs_vec2 *loop = vs_fresh(a->count, sizeof *loop);
  double *used = vs_fresh(a->count, sizeof *used);
  bool ok = loop && used;
  for (size_t l = 0, first = 0; ok && l < a->loop_count; first += a->size[l++]) {
    size_t n = a->size[l];
    memcpy(loop, a->at + first, n * sizeof *loop);
    if (most > 0) n = fewer(loop, used, n, most, hollow);
    for (size_t i = 0; ok && i < n; i++) ok = vs_area_point(out, loop[i].x, loop[i].y);
    ok = ok && vs_area_loop(out, a->hole[l]);
  }
  free(loop), free(used);
  return ok;
}

bool vs_area_outer_corners(const vs_area *a, double most, double hollow, vs_area *out) {
  if (!copy_loops(a, most, hollow, out)) return false;
  if (!(most > 0) || !crosses_itself(out)) return true;
  vs_area_free(out);
  return copy_loops(a, 0, 0, out);
}

/* ---- sums of convex polygons ---- */

size_t vs_convex_sum(const vs_vec2 *a, size_t n, const vs_vec2 *b, size_t m, vs_vec2 *out) {
  size_t i = 0, j = 0, count = 0;
  VS_ASSERT(n >= 3 && m >= 3);
  while (i < n || j < m) {
    vs_vec2 p = a[i < n ? i : 0], pn = a[i + 1 < n ? i + 1 : 0], q = b[j < m ? j : 0], qn = b[j + 1 < m ? j + 1 : 0];
    double c = i == n ? -1 : j == m ? 1 : (pn.x - p.x) * (qn.y - q.y) - (pn.y - p.y) * (qn.x - q.x);
    out[count++] = (vs_vec2){ p.x + q.x, p.y + q.y };
    if (c >= 0) i++;
    if (c <= 0) j++;
  }
  return count;
}

size_t vs_convex_grow(const vs_vec2 *at, size_t n, double d, vs_vec2 *out) {
  static const double step_cos = 0.98078528040323044912, step_sin = 0.19509032201612826785; /* cosine and sine of pi /
                                                                                             * 16, the angle between
                                                                                             * neighbouring points of a
                                                                                             * rounded corner */
  size_t count = 0, first = n;
  vs_vec2 last = { 0, 0 }, next;
  for (size_t i = 0; i < n; i++) { /* finds the last side that is longer than 0; the loop below begins with its
                                    * normal */
    vs_vec2 p = at[n - 1 - i], q = at[i ? n - i : 0];
    double l = hypot(q.x - p.x, q.y - p.y);
    if (!(l > 0)) continue;
    last = (vs_vec2){ (q.y - p.y) / l, (p.x - q.x) / l }, first = i;
    break;
  }
  for (size_t i = 0; first < n && i < n; i++) {
    vs_vec2 p = at[i], q = at[i + 1 < n ? i + 1 : 0];
    double l = hypot(q.x - p.x, q.y - p.y);
    if (!(l > 0)) continue;
    next = (vs_vec2){ (q.y - p.y) / l, (p.x - q.x) / l };
    for (int k = 0; k < 32 && last.x * next.x + last.y * next.y < step_cos; k++) {
      vs_vec2 mid = { last.x * step_cos - last.y * step_sin, last.x * step_sin + last.y * step_cos };
      double s = d / (1 + step_cos);
      out[count++] = (vs_vec2){ p.x + s * (last.x + mid.x), p.y + s * (last.y + mid.y) };
      last = mid;
    }
    double s = d / (1 + last.x * next.x + last.y * next.y);
    out[count++] = (vs_vec2){ p.x + s * (last.x + next.x), p.y + s * (last.y + next.y) };
    last = next;
  }
  return count;
}
