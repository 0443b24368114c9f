/* Contracts the surface where rounding makes triangles intersect and no other method has removed this (contraction.h).
 *
 * A mesh in which only positions of corners count need not be a manifold by its vertex numbers. It suffices that each
 * edge is used as often in one direction as in the other. Two steps preserve this in all cases:
 *   unite   corners a few units apart become one. Triangles with two equal corners are edges, and are removed
 *   reroute the longest edge of a triangle that is lower than a few units goes through the triangle's third corner,
 *           in all triangles that have the edge. The low triangle vanishes, and its neighbour is cut in two at this
 *           corner. Low triangles without a short edge, which mesh repair calls caps, vanish only by this step.
 * If several triangles have the same three corners, equal numbers of the two orientations are removed: they are sheets
 * that lie on each other. */
#include "kernel/round/contraction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/store/disjoint.h"

static bool is_met(const vs_rounding *s, uint32_t t) { /* returns true if triangle t is near a triangle that intersects
                                                        * another triangle after rounding */
  const uint32_t *v = s->m->triangles[t];
  return s->near_met.at[v[0]] || s->near_met.at[v[1]] || s->near_met.at[v[2]];
}

static vs_vec3 place(const vs_rounding *s, uint32_t v) { return s->m->vertices[v]; }

/* ---- sheets that lie on each other ---- */

typedef struct { uint32_t corner[3], triangle; bool odd; } sheet; /* corner: vertices of the triangle in ascending
                                                                   * order; odd: true if this order has the opposite
                                                                   * orientation */

static int sheet_order(const void *a, const void *b) {
  const sheet *x = a, *y = b;
  for (int i = 0; i < 3; i++)
    if (x->corner[i] != y->corner[i]) return x->corner[i] < y->corner[i] ? -1 : 1;
  if (x->odd != y->odd) return x->odd ? 1 : -1;
  return x->triangle < y->triangle ? -1 : 1;
}

static sheet sheet_of(const uint32_t v[3], uint32_t t) {
  sheet s = { { v[0], v[1], v[2] }, t, false };
  for (int i = 0; i < 3; i++) { /* sorts the three corners of the triangle: compares corners 0 and 1, then 1 and 2, then
                                 * 0 and 1 */
    int j = i % 2;
    if (s.corner[j] < s.corner[j + 1]) continue;
    uint32_t swap = s.corner[j];
    s.corner[j] = s.corner[j + 1], s.corner[j + 1] = swap;
    s.odd = !s.odd;
  }
  return s;
}

/* Removes pairs of triangles with equal corners and opposite orientation, among the triangles at changed corners.
 * Returns false when memory is out. */
static bool cancel_sheets(vs_rounding *s) {
  const vs_mesh *m = s->m;
  VS_LIST(sheet) sheets = { 0 };
  bool ok = true;
  for (uint32_t t = 0; ok && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    if (!s->gone.at[t] && (s->busy.at[v[0]] || s->busy.at[v[1]] || s->busy.at[v[2]]))
      ok = VS_PUSH(s->k, sheets, sheet_of(v, t));
    ok = ok && vs_kernel_poll(s->k, 1);
  }
  if (ok && sheets.count) qsort(sheets.at, sheets.count, sizeof *sheets.at, sheet_order);
  for (size_t i = 0, end; ok && i < sheets.count; i = end) {
    const sheet *at = sheets.at;
    size_t even = i, odd;
    for (end = i; end < sheets.count && memcmp(at[end].corner, at[i].corner, sizeof at[i].corner) == 0; end++)
      even += !at[end].odd;
    odd = even;
    for (size_t j = i; j < even && odd < end; j++, odd++)
      s->gone.at[at[j].triangle] = s->gone.at[at[odd].triangle] = 1;
  }
  VS_DROP(s->k, sheets);
  return ok;
}

/* ---- details that must not be lost ---- */

enum { DETAIL = 16 /* Limit, in units of the last place, above which a contraction loses a detail of the surface. With
                    * 32-bit numbers, it is a millionth of the coordinate. */ };

/* Returns true if moving the triangle's corner `corner` to the vertex `to` loses a detail: `to` is more than DETAIL
 * units off the plane of triangle t. Along a finely divided surface, corners may move farther without loss. */
static bool leaves(const vs_rounding *s, const uint32_t t[3], uint32_t corner, uint32_t to) {
  vs_vec3 n = vs_rounding_normal(place(s, t[0]), place(s, t[1]), place(s, t[2]));
  double off = fabs(vs_v3_dot(n, vs_v3_sub(place(s, to), place(s, corner))));
  return off > DETAIL * vs_rounding_unit_at(s, to) * vs_v3_length(n);
}

static void lose(vs_rounded *out, vs_vec3 at) {
  if (out->lost++ == 0) out->lost_at = at;
}

/* ---- uniting of corners ---- */

/* Unites the ends of edges shorter than `units` units of the last place, near triangles that intersect. all: true for
 * all triangles there; false: only triangles whose direction rounding changes. *count: number of united corners.
 * Returns false when memory is out. */
static bool unite(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count) {
  vs_mesh *m = s->m;
  VS_LIST(uint32_t) parent = { 0 };
  VS_LIST(vs_bounds) boxes = { 0 };
  bool ok = VS_ROOM(s->k, parent.at, parent.room, m->vertex_count + 1) &&
            VS_ROOM(s->k, boxes.at, boxes.room, m->vertex_count + 1);
  if (ok) vs_disjoint(parent.at, (uint32_t)m->vertex_count);
  for (uint32_t v = 0; ok && v < m->vertex_count; v++) boxes.at[v] = (vs_bounds){ place(s, v), place(s, v) };
  for (uint32_t t = 0; ok && t < m->triangle_count; t++) {
    ok = vs_kernel_poll(s->k, 1);
    if (!is_met(s, t) || !(all || vs_rounding_bends(s, t))) continue;
    for (int j = 0; j < 3; j++) {
      uint32_t v = m->triangles[t][j], w = m->triangles[t][(j + 1) % 3], a = vs_find(parent.at, v),
               b = vs_find(parent.at, w), low = a < b ? a : b;
      double most = units * fmax(vs_rounding_unit_at(s, v), vs_rounding_unit_at(s, w));
      vs_bounds both = boxes.at[a];
      vs_bounds_unite(&both, &boxes.at[b]);
      if (a == b || vs_v3_length(vs_v3_sub(place(s, v), place(s, w))) >= most || vs_bounds_diagonal(&both) >= 3 * most)
        continue;
      vs_unite(parent.at, a, b);
      boxes.at[low] = both;
      s->busy.at[low] = 1;
      ++*count;
    }
  }
  for (uint32_t t = 0; ok && *count && t < m->triangle_count; t++) {
    uint32_t *v = m->triangles[t], to[3];
    for (int j = 0; j < 3; j++) {
      to[j] = vs_find(parent.at, v[j]);
      if (to[j] == v[j]) continue;
      s->changed.at[t] = VS_CHANGED;
      if (s->busy.at[v[j]] || !leaves(s, v, v[j], to[j])) continue;
      s->busy.at[v[j]] = 1; /* marks the corner as changed in this round */
      lose(out, place(s, v[j]));
    }
    memcpy(v, to, sizeof to);
    s->gone.at[t] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    ok = vs_kernel_poll(s->k, 1);
  }
  VS_DROP(s->k, parent);
  VS_DROP(s->k, boxes);
  return ok;
}

/* ---- rerouting of edges ---- */

/* A triangle that is too low (a cap). `low`, `high`: vertices at the ends of its longest edge, with low < high; `top`:
 * its third vertex; `along`: position of the third vertex along the longest edge. */
typedef struct { uint32_t low, high, top; double along; } cap;
typedef VS_LIST(cap) caps;
typedef VS_LIST(uint32_t) corners;

static int cap_order(const void *a, const void *b) {
  const cap *x = a, *y = b;
  if (x->low != y->low) return x->low < y->low ? -1 : 1;
  if (x->high != y->high) return x->high < y->high ? -1 : 1;
  if (x->along != y->along) return x->along < y->along ? -1 : 1;
  return x->top < y->top ? -1 : x->top > y->top;
}

/* TOPS: greatest number of vertices through which one edge is rerouted in one step; LOOP: greatest number of vertices
 * of the polygon that results from a triangle */
enum { TOPS = 16, LOOP = 3 + 3 * TOPS };

static bool find_caps(vs_rounding *s, double units, bool all, caps *to) {
  const vs_mesh *m = s->m;
  for (uint32_t t = 0; t < m->triangle_count; t++) {
    if (!vs_kernel_poll(s->k, 1)) return false;
    if (s->gone.at[t] || !is_met(s, t) || !(all || vs_rounding_bends(s, t))) continue;
    const uint32_t *v = m->triangles[t];
    int base = vs_rounding_longest(s, t);
    uint32_t p = v[base], q = v[(base + 1) % 3];
    cap n = { p < q ? p : q, p < q ? q : p, v[(base + 2) % 3], 0 };
    vs_vec3 a = place(s, n.low), edge = vs_v3_sub(place(s, n.high), a), up = vs_v3_sub(place(s, n.top), a);
    double length = vs_v3_length(edge),
           most = units * fmax(vs_rounding_unit_at(s, p), vs_rounding_unit_at(s, q));
    if (length <= 0 || vs_v3_length(vs_v3_cross(edge, up)) >= most * length) continue;
    n.along = vs_v3_dot(edge, up) / (length * length);
    if (n.along > 0 && n.along < 1 && !VS_PUSH(s->k, *to, n)) return false;
  }
  if (to->count == 0) return true;
  qsort(to->at, to->count, sizeof *to->at, cap_order);
  size_t kept = 0, tops = 0;
  for (size_t i = 0; i < to->count; i++) {
    const cap *n = &to->at[i], *last = kept ? &to->at[kept - 1] : NULL;
    bool same = last && last->low == n->low && last->high == n->high;
    if (same && last->top == n->top) continue;
    tops = same ? tops + 1 : 1;
    if (tops <= TOPS) to->at[kept++] = *n;
  }
  to->count = kept;
  return true;
}

/* Lists the vertices through which the edge from p to q is rerouted, in order from p to q. Returns their number. p and
 * q differ. */
static size_t route_of(const caps *all, uint32_t p, uint32_t q, uint32_t *to) {
  uint32_t a = p < q ? p : q, b = p < q ? q : p;
  size_t low = 0, high = all->count, count = 0;
  VS_ASSERT(p != q);
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    const cap *n = &all->at[middle];
    if (n->low < a || (n->low == a && n->high < b)) low = middle + 1;
    else high = middle;
  }
  while (low + count < all->count && all->at[low + count].low == a && all->at[low + count].high == b) count++;
  for (size_t i = 0; i < count; i++) to[i] = all->at[low + (p < q ? i : count - 1 - i)].top;
  return count;
}

/* Cuts a loop in which no vertex repeats into triangles that all have one of its vertices. Chooses the vertex for which
 * the lowest triangle is highest. Returns false when memory is out. */
static bool cut_loop(vs_rounding *s, const uint32_t *loop, size_t count, corners *to) {
  size_t from = 0;
  double best = -1;
  if (count < 3) return true;
  for (size_t i = 0; i < count && count > 3; i++) {
    double least = INFINITY;
    for (size_t j = 1; j + 1 < count; j++) {
      vs_vec3 a = place(s, loop[i]), b = place(s, loop[(i + j) % count]), c = place(s, loop[(i + j + 1) % count]);
      least = fmin(least, vs_rounding_height(a, b, c));
    }
    if (least > best) best = least, from = i;
  }
  for (size_t j = 1; j + 1 < count; j++)
    if (!VS_PUSH(s->k, *to, loop[from]) || !VS_PUSH(s->k, *to, loop[(from + j) % count]) ||
        !VS_PUSH(s->k, *to, loop[(from + j + 1) % count]))
      return false;
  return true;
}

/* Divides a loop that visits a vertex twice into two loops there, and cuts all loops into triangles. Returns false when
 * memory is out. */
static bool cut_loops(vs_rounding *s, const uint32_t *loop, size_t count, corners *to) {
  uint32_t open[LOOP];
  size_t n = 0;
  for (size_t i = 0; i < count; i++) {
    size_t before = 0;
    while (before < n && open[before] != loop[i]) before++;
    if (before < n && !cut_loop(s, open + before, n - before, to)) return false;
    n = before;
    open[n++] = loop[i];
  }
  return cut_loop(s, open, n, to);
}

/* Replaces triangle t of the mesh by the triangles in `by`, a list with three vertices for each triangle, or none.
 * Returns false when memory is out. */
static bool replace(vs_rounding *s, uint32_t t, const corners *by) {
  vs_mesh *m = s->m;
  size_t more = by->count > 3 ? by->count / 3 - 1 : 0, all = m->triangle_count + more + 1;
  VS_ASSERT(by->count % 3 == 0 && t < s->m->triangle_count);
  s->gone.at[t] = by->count == 0;
  if (all > m->triangle_room && !vs_mesh_reserve(m, m->vertex_count, all + all / 8)) return false;
  if (!VS_ROOM(s->k, s->gone.at, s->gone.room, all) || !VS_ROOM(s->k, s->listed.at, s->listed.room, all) ||
      !VS_ROOM(s->k, s->changed.at, s->changed.room, all))
    return false;
  for (size_t i = 0; i < by->count; i += 3) {
    uint32_t to = i == 0 ? t : (uint32_t)m->triangle_count++;
    memcpy(m->triangles[to], by->at + i, sizeof m->triangles[to]);
    if (m->tags) m->tags[to] = m->tags[t];
    s->gone.at[to] = s->listed.at[to] = 0;
    s->changed.at[to] = VS_CHANGED;
  }
  return true;
}

/* Removes triangles that are lower than `units` units of the last place, near triangles that intersect. Reroutes their
 * longest edges through their third corners. all: true for all triangles there; false: only triangles whose direction
 * rounding changes. *count: number of removed triangles. Returns false when memory is out. */
static bool reroute(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count) {
  vs_mesh *m = s->m;
  caps found = { 0 };
  corners cut = { 0 };
  bool ok = find_caps(s, units, all, &found);
  for (size_t i = 0; ok && i < found.count; i++)
    s->busy.at[found.at[i].low] = s->busy.at[found.at[i].high] = s->busy.at[found.at[i].top] = 1;
  for (uint32_t t = 0, n = (uint32_t)m->triangle_count; ok && found.count && t < n; t++) {
    const uint32_t *v = m->triangles[t];
    uint32_t loop[LOOP];
    size_t corners_count = 0;
    ok = vs_kernel_poll(s->k, 1);
    if (s->gone.at[t] || s->busy.at[v[0]] + s->busy.at[v[1]] + s->busy.at[v[2]] < 2) continue;
    for (int j = 0; j < 3; j++) {
      loop[corners_count++] = v[j];
      size_t tops = route_of(&found, v[j], v[(j + 1) % 3], loop + corners_count);
      for (size_t i = 0; i < tops; i++)
        if (leaves(s, v, v[j], loop[corners_count + i])) lose(out, place(s, loop[corners_count + i]));
      corners_count += tops;
    }
    if (corners_count == 3) continue;
    cut.count = 0;
    ok = ok && cut_loops(s, loop, corners_count, &cut) && replace(s, t, &cut);
  }
  *count += found.count;
  VS_DROP(s->k, found);
  VS_DROP(s->k, cut);
  return ok;
}

bool vs_rounding_contract(vs_rounding *s, double units, bool all, vs_rounded *out, size_t *count) {
  VS_ASSERT(units > 0);
  *count = 0;
  memset(s->busy.at, 0, s->m->vertex_count);
  memset(s->gone.at, 0, s->m->triangle_count);
  bool ok = unite(s, units, all, out, count) && reroute(s, units, all, out, count) && (!*count || cancel_sheets(s));
  out->collapsed += *count;
  return ok;
}
