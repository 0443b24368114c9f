/* Converts the contours of a font to loops that bound the ink (the area that is printed).
 *
 * Contours rarely cross. If no contours cross, only their nesting matters: the winding number beside a loop is the sum
 * of the directions of the loops that contain it. To find crossings, a sweep goes over the segments in order of x. */
#include "geometry/text/nonzero.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/plane/areas.h"
#include "model/store/array.h"

void vs_flat_loops_free(vs_flat_loops *l) {
  free(l->at);
  free(l->loops);
  *l = (vs_flat_loops){ 0 };
}

bool vs_flat_loops_begin(vs_flat_loops *l) {
  if (!VS_GROW(l->loops, l->room, l->count + 1)) return false;
  l->loops[l->count++] = (vs_flat_loop){ l->point_count, 0, false };
  return true;
}

bool vs_flat_loops_add(vs_flat_loops *l, vs_vec2 p) {
  vs_flat_loop *loop = l->count ? &l->loops[l->count - 1] : NULL;
  if (!loop) return true; /* no loop has begun yet, so the point is ignored */
  if (loop->count && l->at[l->point_count - 1].x == p.x && l->at[l->point_count - 1].y == p.y) return true;
  if (!VS_GROW(l->at, l->point_room, l->point_count + 1)) return false;
  l->at[l->point_count++] = p;
  loop->count++;
  return true;
}

/* ---- properties of a loop ---- */

typedef struct { double min_x, min_y, max_x, max_y, area; int inside, outside; size_t holder; } loop_facts;

static double cross(vs_vec2 a, vs_vec2 b, vs_vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/* Computes the bounding box and the signed area of a loop of l. */
static loop_facts facts_of(const vs_flat_loops *l, const vs_flat_loop *loop) {
  const vs_vec2 *p = l->at + loop->first;
  loop_facts f = { INFINITY, INFINITY, -INFINITY, -INFINITY, 0, 0, 0, SIZE_MAX };
  VS_ASSERT(loop->first + loop->count <= l->point_count);
  for (size_t i = 0; i < loop->count; i++) {
    f.min_x = fmin(f.min_x, p[i].x), f.max_x = fmax(f.max_x, p[i].x);
    f.min_y = fmin(f.min_y, p[i].y), f.max_y = fmax(f.max_y, p[i].y);
    if (i > 1) f.area += cross(p[0], p[i - 1], p[i]) / 2;
  }
  return f;
}

/* Returns true if the point `at` is inside a loop of l. */
static bool holds(const vs_flat_loops *l, const vs_flat_loop *loop, vs_vec2 at) {
  const vs_vec2 *p = l->at + loop->first;
  bool inside = false;
  VS_ASSERT(loop->first + loop->count <= l->point_count);
  for (size_t i = 0, j = loop->count - 1; i < loop->count; j = i++)
    if ((p[i].y > at.y) != (p[j].y > at.y) && at.x < p[i].x + (at.y - p[i].y) / (p[j].y - p[i].y) * (p[j].x - p[i].x))
      inside = !inside;
  return inside;
}

/* Removes the last point of each loop of l if it equals the first point. Then removes loops with fewer than three
 * points or without area. */
static void drop_flat(vs_flat_loops *l) {
  size_t kept = 0;
  for (size_t i = 0; i < l->count; i++) {
    vs_flat_loop loop = l->loops[i];
    const vs_vec2 *p = l->at + loop.first;
    while (loop.count > 1 && p[0].x == p[loop.count - 1].x && p[0].y == p[loop.count - 1].y) loop.count--;
    if (loop.count < 3 || facts_of(l, &loop).area == 0) continue;
    l->loops[kept++] = loop;
  }
  l->count = kept;
}

/* ---- crossings ---- */

typedef struct { vs_vec2 a, b; double min_x, max_x; size_t loop, place; } segment;

static int by_start(const void *p, const void *q) {
  const segment *a = p, *b = q;
  if (a->min_x != b->min_x) return a->min_x < b->min_x ? -1 : 1;
  return a->loop != b->loop ? (a->loop < b->loop ? -1 : 1) : a->place < b->place ? -1 : a->place > b->place;
}

static bool meet(const segment *s, const segment *t) {
  if (fmin(s->a.y, s->b.y) > fmax(t->a.y, t->b.y) || fmin(t->a.y, t->b.y) > fmax(s->a.y, s->b.y)) return false;
  double a = cross(s->a, s->b, t->a), b = cross(s->a, s->b, t->b), c = cross(t->a, t->b, s->a),
         d = cross(t->a, t->b, s->b);
  return !((a > 0 && b > 0) || (a < 0 && b < 0) || (c > 0 && d > 0) || (c < 0 && d < 0));
}

/* Sets *found to true if loops of l cross or touch. Returns false when memory is out. */
static bool any_cross(const vs_flat_loops *l, bool *found) {
  size_t count = 0, active = 0;
  for (size_t i = 0; i < l->count; i++) count += l->loops[i].count;
  segment *all = vs_fresh(count + 1, sizeof *all);
  size_t *now = vs_fresh(count + 1, sizeof *now);
  *found = false;
  if (all && now) {
    count = 0;
    for (size_t i = 0; i < l->count; i++)
      for (size_t k = 0; k < l->loops[i].count; k++) {
        vs_vec2 a = l->at[l->loops[i].first + k], b = l->at[l->loops[i].first + (k + 1) % l->loops[i].count];
        all[count++] = (segment){ a, b, fmin(a.x, b.x), fmax(a.x, b.x), i, k };
      }
    qsort(all, count, sizeof *all, by_start);
    for (size_t i = 0; i < count && !*found; i++) {
      size_t kept = 0;
      for (size_t k = 0; k < active && !*found; k++) {
        const segment *s = &all[now[k]], *t = &all[i];
        if (s->max_x < t->min_x) continue;
        now[kept++] = now[k];
        size_t n = l->loops[s->loop].count;
        bool neighbours = s->loop == t->loop && ((s->place + 1) % n == t->place || (t->place + 1) % n == s->place);
        *found = !neighbours && meet(s, t);
      }
      active = kept;
      now[active++] = i;
    }
  }
  bool ok = all && now;
  free(all);
  free(now);
  return ok;
}

/* ---- loops that do not cross ---- */

/* Reverses the direction of a loop of l. */
static void turn(vs_flat_loops *l, const vs_flat_loop *loop) {
  vs_vec2 *p = l->at + loop->first;
  VS_ASSERT(loop->first + loop->count <= l->point_count);
  for (size_t i = 0, j = loop->count; i < j; i++) {
    vs_vec2 swap = p[i];
    p[i] = p[--j];
    p[j] = swap;
  }
}

/* Removes loops that do not bound ink (the printed area), and places each hole after its outer loop. No two loops may
 * cross. Returns false when memory is out. */
static bool nest(vs_flat_loops *l) {
  size_t n = l->count, done = 0;
  loop_facts *f = vs_fresh(n + 1, sizeof *f);
  vs_flat_loop *sorted = vs_fresh(n + 1, sizeof *sorted);
  bool ok = f && sorted;
  for (size_t i = 0; ok && i < n; i++) f[i] = facts_of(l, &l->loops[i]);
  for (size_t i = 0; ok && i < n; i++) {
    vs_vec2 at = l->at[l->loops[i].first];
    for (size_t j = 0; j < n; j++)
      if (j != i && at.x > f[j].min_x && at.x < f[j].max_x && at.y > f[j].min_y && at.y < f[j].max_y &&
          holds(l, &l->loops[j], at))
        f[i].outside += f[j].area > 0 ? 1 : -1;
    f[i].inside = f[i].outside + (f[i].area > 0 ? 1 : -1);
  }
  for (size_t i = 0; ok && i < n; i++) { /* the outer loop of a hole is the smallest loop that contains the hole */
    if (!f[i].outside || f[i].inside) continue;
    vs_vec2 at = l->at[l->loops[i].first];
    for (size_t j = 0; j < n; j++)
      if (!f[j].outside && f[j].inside && at.x > f[j].min_x && at.x < f[j].max_x && at.y > f[j].min_y &&
          at.y < f[j].max_y && (f[i].holder == SIZE_MAX || fabs(f[j].area) < fabs(f[f[i].holder].area)) &&
          holds(l, &l->loops[j], at))
        f[i].holder = j;
  }
  for (size_t i = 0; ok && i < n; i++) {
    if (f[i].outside || !f[i].inside) continue;
    if (f[i].area < 0) turn(l, &l->loops[i]);
    sorted[done] = l->loops[i];
    sorted[done++].hole = false;
    for (size_t j = 0; j < n; j++) {
      if (f[j].holder != i) continue;
      if (f[j].area > 0) turn(l, &l->loops[j]);
      sorted[done] = l->loops[j];
      sorted[done++].hole = true;
    }
  }
  if (ok) { /* removes loops that have ink on both sides, or on neither side */
    memcpy(l->loops, sorted, done * sizeof *sorted);
    l->count = done;
  }
  free(f);
  free(sorted);
  return ok;
}

/* ---- loops that cross ---- */

static bool resolve(vs_flat_loops *l, vs_error *e) {
  vs_area out = { 0 };
  vs_vec2 (*edges)[2] = vs_fresh(l->point_count + 1, sizeof *edges);
  size_t count = 0;
  if (!edges) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < l->count; i++)
    for (size_t k = 0; k < l->loops[i].count; k++, count++) {
      edges[count][0] = l->at[l->loops[i].first + k];
      edges[count][1] = l->at[l->loops[i].first + (k + 1) % l->loops[i].count];
    }
  bool ok = vs_area_of_chain((const vs_vec2 (*)[2])edges, count, "make-text", &out, e);
  free(edges);
  if (ok) vs_flat_loops_free(l);
  for (size_t i = 0, first = 0; ok && i < out.loop_count; first += out.size[i++]) {
    ok = vs_flat_loops_begin(l);
    for (size_t k = 0; ok && k < out.size[i]; k++) ok = vs_flat_loops_add(l, out.at[first + k]);
    if (ok) l->loops[i].hole = out.hole[i];
    ok = ok || vs_error_memory(e, NULL);
  }
  vs_area_free(&out);
  return ok;
}

bool vs_nonzero(vs_flat_loops *l, vs_error *e) {
  bool crossing;
  drop_flat(l);
  if (!any_cross(l, &crossing)) return vs_error_memory(e, NULL);
  return crossing ? resolve(l, e) : nest(l) || vs_error_memory(e, NULL);
}
