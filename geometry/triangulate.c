/* Owns the cutting of planar polygons with holes into triangles, by clipping ears.
 *
 * The ring is a doubly linked list of corners; a hole is spliced in over a bridge from its leftmost corner to a corner of the ring that
 * sees it, which is walked both ways. An ear is a convex corner whose triangle holds no other corner, borders included: so a corner
 * in the middle of a straight edge never ends up inside another triangle's side. After an ear the next corner is passed over, so that
 * a circle is halved again and again instead of becoming a fan of splinters. Where rounding or a crossing loop leaves no ear, the
 * most convex corner is cut all the same: the boundary stays right, which is what closedness needs. */
#include "geometry/triangulate.h"

#include <stdlib.h>

typedef struct { size_t point, next, prev; bool reflex; } vs_corner;
typedef struct {
  const vs_vec2 *at;
  vs_corner *corners;
  size_t count;
  double flat; /* twice the area under which a triangle counts as none */
} vs_ring;

static double vs_ring_turn(const vs_ring *r, size_t a, size_t b, size_t c) { /* twice the signed area */
  vs_vec2 p = r->at[r->corners[a].point], q = r->at[r->corners[b].point], s = r->at[r->corners[c].point];
  return (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
}

static bool vs_ring_same_place(const vs_ring *r, size_t a, size_t b) {
  vs_vec2 p = r->at[r->corners[a].point], q = r->at[r->corners[b].point];
  return p.x == q.x && p.y == q.y;
}

static void vs_ring_look(vs_ring *r, size_t c) {
  r->corners[c].reflex = vs_ring_turn(r, r->corners[c].prev, c, r->corners[c].next) <= r->flat;
}

static bool vs_ring_is_ear(const vs_ring *r, size_t b) {
  if (r->corners[b].reflex) return false;
  size_t a = r->corners[b].prev, c = r->corners[b].next;
  for (size_t p = r->corners[c].next; p != a; p = r->corners[p].next) {
    if (!r->corners[p].reflex) continue; /* the nearest corner inside, if there is one, is not convex */
    if (vs_ring_same_place(r, p, a) || vs_ring_same_place(r, p, b) || vs_ring_same_place(r, p, c)) continue;
    if (vs_ring_turn(r, a, b, p) >= -r->flat && vs_ring_turn(r, b, c, p) >= -r->flat && vs_ring_turn(r, c, a, p) >= -r->flat) return false;
  }
  return true;
}

/* A corner of the ring that the hole's leftmost corner can be joined to: shoot a ray to -x, take the edge it meets first, and of that
 * edge's end and the reflex corners within the triangle the one at the smallest angle to the ray. */
static size_t vs_ring_bridge(const vs_ring *r, size_t start, size_t hole) {
  vs_vec2 h = r->at[r->corners[hole].point];
  double best_x = -INFINITY;
  size_t best = start, i = start;
  bool hit = false;
  do {
    size_t n = r->corners[i].next;
    vs_vec2 p = r->at[r->corners[i].point], q = r->at[r->corners[n].point];
    if (p.y >= h.y && q.y <= h.y && p.y != q.y) { /* the ring goes down on its left side */
      double x = p.x + (h.y - p.y) * (q.x - p.x) / (q.y - p.y);
      if (x <= h.x && x > best_x) {
        best_x = x;
        best = p.x < q.x ? i : n;
        hit = true;
        if (x == h.x) return h.y == p.y ? i : n;
      }
    }
    i = n;
  } while (i != start);
  if (!hit) return start; /* a hole outside its ring: any bridge keeps the boundary right */
  vs_vec2 m = r->at[r->corners[best].point];
  double least = INFINITY;
  size_t end = best;
  i = end;
  do {
    vs_vec2 p = r->at[r->corners[i].point];
    if (p.x <= h.x && p.x >= m.x && p.x != h.x) {
      double ax = h.y < m.y ? h.x : best_x, cx = h.y < m.y ? best_x : h.x;
      bool inside = (cx - p.x) * (h.y - p.y) >= (ax - p.x) * (h.y - p.y) &&
                    (ax - p.x) * (m.y - p.y) >= (m.x - p.x) * (h.y - p.y) && (m.x - p.x) * (h.y - p.y) >= (cx - p.x) * (m.y - p.y);
      if (inside) {
        double slope = fabs(h.y - p.y) / (h.x - p.x);
        size_t before = r->corners[i].prev, after = r->corners[i].next;
        vs_vec2 a = r->at[r->corners[before].point], c = r->at[r->corners[after].point];
        double to_after = (c.x - p.x) * (h.y - p.y) - (c.y - p.y) * (h.x - p.x);   /* > 0: h to the left of the leaving edge */
        double to_before = (p.x - a.x) * (h.y - a.y) - (p.y - a.y) * (h.x - a.x);
        bool convex = (p.x - a.x) * (c.y - a.y) - (p.y - a.y) * (c.x - a.x) > 0;
        bool sees = convex ? to_after >= 0 && to_before >= 0 : to_after >= 0 || to_before >= 0;
        if (sees && (slope < least || (slope == least && p.x > r->at[r->corners[best].point].x))) {
          best = i;
          least = slope;
        }
      }
    }
    i = r->corners[i].next;
  } while (i != end);
  return best;
}

/* ring corner a -> hole corner b -> round the hole -> copy of b -> copy of a -> on */
static void vs_ring_splice(vs_ring *r, size_t a, size_t b) {
  size_t a2 = r->count++, b2 = r->count++, after = r->corners[a].next, last = r->corners[b].prev;
  r->corners[a2] = (vs_corner){ r->corners[a].point, after, b2, false };
  r->corners[b2] = (vs_corner){ r->corners[b].point, a2, last, false };
  r->corners[a].next = b;
  r->corners[b].prev = a;
  r->corners[after].prev = a2;
  r->corners[last].next = b2;
}

typedef struct { size_t corner; vs_vec2 at; } vs_hole;

static int vs_hole_compare(const void *a, const void *b) {
  const vs_hole *p = a, *q = b;
  if (p->at.x != q->at.x) return p->at.x < q->at.x ? -1 : 1;
  return p->at.y < q->at.y ? -1 : p->at.y > q->at.y;
}

static bool vs_ring_clip(vs_ring *r, size_t start, size_t left, vs_mesh *m, const uint32_t *index, bool turned) {
  size_t at = start, tried = 0;
  while (left >= 3) {
    size_t ear = at;
    if (!vs_ring_is_ear(r, at)) {
      at = r->corners[at].next;
      if (++tried < left) continue;
      double best = -INFINITY; /* no ear left: the corner of largest area goes */
      size_t i = at;
      do {
        double turn = vs_ring_turn(r, r->corners[i].prev, i, r->corners[i].next);
        if (turn > best) {
          best = turn;
          ear = i;
        }
        i = r->corners[i].next;
      } while (i != at);
    }
    size_t prev = r->corners[ear].prev, next = r->corners[ear].next;
    uint32_t a = index[r->corners[prev].point], b = index[r->corners[ear].point], c = index[r->corners[next].point];
    if (a != b && b != c && c != a && !vs_mesh_add_triangle(m, a, turned ? c : b, turned ? b : c)) return false;
    r->corners[prev].next = next;
    r->corners[next].prev = prev;
    vs_ring_look(r, prev);
    vs_ring_look(r, next);
    left--;
    tried = 0;
    at = r->corners[next].next;
  }
  return true;
}

bool vs_triangulate(const vs_vec2 *at, const size_t *sizes, size_t loop_count, vs_mesh *m, const uint32_t *index, bool turned) {
  size_t total = 0;
  double extent = 0;
  for (size_t l = 0; l < loop_count; l++) total += sizes[l];
  for (size_t i = 1; i < total; i++) extent = fmax(extent, fmax(fabs(at[i].x - at[0].x), fabs(at[i].y - at[0].y)));
  if (loop_count == 0 || sizes[0] < 3) return true;
  vs_ring r = { at, NULL, 0, 1e-14 * extent * extent };
  r.corners = malloc((total + 2 * loop_count) * sizeof *r.corners);
  vs_hole *holes = malloc(loop_count * sizeof *holes);
  bool ok = r.corners && holes;
  size_t hole_count = 0, ring_size = sizes[0];
  for (size_t l = 0, first = 0; ok && l < loop_count; first += sizes[l], l++) {
    size_t n = sizes[l], leftmost = first;
    if (l && n < 3) continue;
    for (size_t i = 0; i < n; i++) {
      r.corners[first + i] = (vs_corner){ first + i, first + (i + 1) % n, first + (i + n - 1) % n, false };
      if (at[first + i].x < at[leftmost].x || (at[first + i].x == at[leftmost].x && at[first + i].y < at[leftmost].y)) leftmost = first + i;
    }
    if (l) holes[hole_count++] = (vs_hole){ leftmost, at[leftmost] };
    if (l) ring_size += n + 2;
  }
  r.count = total;
  if (ok) {
    qsort(holes, hole_count, sizeof *holes, vs_hole_compare);
    for (size_t i = 0; i < hole_count; i++) vs_ring_splice(&r, vs_ring_bridge(&r, 0, holes[i].corner), holes[i].corner);
    size_t c = 0;
    do {
      vs_ring_look(&r, c);
      c = r.corners[c].next;
    } while (c != 0);
    ok = vs_ring_clip(&r, 0, ring_size, m, index, turned);
  }
  free(holes);
  free(r.corners);
  return ok;
}
