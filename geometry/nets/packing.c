/* Packs circles into an area (packing.h).
 *
 * If the centre of a circle moves, the largest possible radius changes by no more than the distance of the move. The
 * area is covered with squares. A heap orders them by an upper bound for the radius of any circle with its centre in
 * the square. The first square is evaluated and divided into four, until no bound exceeds the best circle found (as in
 * V. Agafonkin's Polylabel). A new circle can only reduce the radii of others. Therefore the bounds remain valid, and
 * the heap is kept for the next circle. */
#include "geometry/nets/packing.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

typedef struct {
  vs_vec2 at;
  double half, promise;
  size_t seen; /* number of circles that were placed when this square's upper bound for a circle's radius was
                * computed */
} square;

typedef struct {
  const vs_area *area;
  const vs_packed *circles;
  size_t count;
  double gap;
  square *heap;
  size_t squares, room;
} packing;

static double to_segment(vs_vec2 p, vs_vec2 a, vs_vec2 b) {
  double dx = b.x - a.x, dy = b.y - a.y, l = dx * dx + dy * dy;
  double t = l > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / l : 0;
  t = t < 0 ? 0 : t > 1 ? 1 : t;
  return hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/* Returns the distance of p from the border of area a, which is the greatest radius of a circle about p in the area.
 * Returns a negative number if p is outside. */
static double within(const vs_area *a, vs_vec2 p) {
  double d = INFINITY;
  bool in = false;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 q = a->at[first + i], r = a->at[first + (i + 1) % a->size[l]];
      if ((q.y > p.y) != (r.y > p.y) && p.x < (r.x - q.x) * (p.y - q.y) / (r.y - q.y) + q.x) in = !in;
      d = fmin(d, to_segment(p, q, r));
    }
  return in ? d : -d;
}

/* Returns the largest radius, at most so_far, of a circle about p that keeps its distance from the placed circles with
 * an index of at least `from`. */
static double room_for(const packing *w, vs_vec2 p, double so_far, size_t from) {
  VS_ASSERT(from <= w->count);
  for (size_t i = from; i < w->count; i++)
    so_far = fmin(so_far, hypot(p.x - w->circles[i].at.x, p.y - w->circles[i].at.y) - w->circles[i].radius - w->gap);
  return so_far;
}

static bool push(packing *w, square s) {
  if (!VS_GROW(w->heap, w->room, w->squares + 1)) return false;
  size_t i = w->squares++;
  for (; i > 0 && w->heap[(i - 1) / 2].promise < s.promise; i = (i - 1) / 2) w->heap[i] = w->heap[(i - 1) / 2];
  w->heap[i] = s;
  return true;
}

static square pop(packing *w) {
  square top = w->heap[0], s = w->heap[--w->squares];
  size_t i = 0;
  for (size_t k; (k = 2 * i + 1) < w->squares; i = k) {
    if (k + 1 < w->squares && w->heap[k + 1].promise > w->heap[k].promise) k++;
    if (w->heap[k].promise <= s.promise) break;
    w->heap[i] = w->heap[k];
  }
  if (w->squares) w->heap[i] = s;
  return top;
}

/* Returns the square with the centre `at` and half the side length `half`. Its bound limits the radius of circles whose
 * centre lies in it. */
static square look(const packing *w, vs_vec2 at, double half) {
  double r = room_for(w, at, within(w->area, at) - w->gap, 0);
  return (square){ at, half, r + half * sqrt(2), w->count };
}

bool vs_area_pack(const vs_area *area, const vs_packing_rule *rule, vs_long_work work, vs_packed *circles,
                  size_t *count, bool *stopped) {
  size_t n = rule->most;
  double least = rule->least;
  packing w = { .area = area, .circles = circles, .gap = rule->gap };
  vs_vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
  for (size_t i = 0; i < area->count; i++) {
    low.x = fmin(low.x, area->at[i].x), low.y = fmin(low.y, area->at[i].y);
    high.x = fmax(high.x, area->at[i].x), high.y = fmax(high.y, area->at[i].y);
  }
  *stopped = false, *count = 0;
  double half = .5 * fmin(high.x - low.x, high.y - low.y);
  bool ok = area->loop_count == 0 || half > 0;
  for (double x = low.x + half; ok && area->loop_count && x - half < high.x; x += 2 * half)
    for (double y = low.y + half; ok && y - half < high.y; y += 2 * half)
      ok = push(&w, look(&w, (vs_vec2){ x, y }, half));
  size_t turns = 0;
  while (ok && w.count < n) {
    vs_packed best = { { 0, 0 }, 0 };
    square *kept = NULL; /* squares that were evaluated for the current circle; they are put back into the heap for the
                          * next circle */
    size_t kept_count = 0, kept_room = 0;
    while (ok && w.squares && w.heap[0].promise > fmax(least, best.radius * 1.001)) {
      square s = pop(&w);
      if (s.seen < w.count) { /* more circles have been placed since the square's bound was computed, so it is computed
                               * again */
        double r = room_for(&w, s.at, s.promise - s.half * sqrt(2), s.seen);
        s.promise = r + s.half * sqrt(2), s.seen = w.count;
        ok = push(&w, s);
        continue;
      }
      double r = s.promise - s.half * sqrt(2);
      if (r > best.radius && r >= least) best = (vs_packed){ s.at, r };
      if (++turns % 1024 == 0 && !work.going(work.context, (double)w.count / (double)n)) {
        *stopped = true, ok = false;
        break;
      }
      if (s.half < 1e-7 * least) continue;
      for (int q = 0; ok && q < 4; q++) {
        square part = look(&w, (vs_vec2){ s.at.x + (q & 1 ? .5 : -.5) * s.half, s.at.y + (q & 2 ? .5 : -.5) * s.half },
                           .5 * s.half);
        double middle = part.promise - part.half * sqrt(2);
        if (middle > best.radius && middle >= least) best = (vs_packed){ part.at, middle };
        if (part.promise <= least) continue;
        if (part.promise > best.radius * 1.001)
          ok = push(&w, part);
        else if ((ok = VS_GROW(kept, kept_room, kept_count + 1)))
          kept[kept_count++] = part;
      }
    }
    for (size_t i = 0; ok && i < kept_count; i++) ok = push(&w, kept[i]);
    free(kept);
    if (!ok || !(best.radius > 0)) break;
    circles[w.count++] = best;
  }
  free(w.heap);
  *count = w.count;
  return ok;
}
