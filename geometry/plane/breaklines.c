/* Inserts given edges (breaklines) into a triangulation: flips the sides of triangles that a given edge crosses. */
#include "geometry/plane/breaklines.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

#define NONE UINT32_MAX

typedef uint32_t triple[3];
typedef uint32_t edge[2];

typedef struct {
  edge *at;
  size_t first, count, room;
} queue;

typedef struct {
  const vs_vec2 *at;
  triple *corner;   /* corner[t]: numbers of the three points of triangle t, counter-clockwise */
  triple *next;     /* next[t][k]: the neighbour of triangle t at the side opposite corner k, or NONE at the border */
  bool (*fixed)[3]; /* fixed[t][k]: true if the side of triangle t opposite corner k is one of the given edges */
  uint32_t *of;     /* of[v]: number of a triangle that has point v as a corner, or NONE */
  size_t count;
  double slack;     /* three points count as collinear if twice the area of their triangle is at most this value */
  queue crossed, made, todo;
} flipper;

static bool push(queue *q, uint32_t a, uint32_t b) {
  if (!VS_GROW(q->at, q->room, q->count + 1)) return false;
  q->at[q->count][0] = a, q->at[q->count++][1] = b;
  return true;
}

/* Returns twice the area of the triangle a b c. It is positive if c is to the left of the line from a to b, and 0 if
 * the three points are collinear. */
static double side(const flipper *f, uint32_t a, uint32_t b, uint32_t c) {
  vs_vec2 p = f->at[a], q = f->at[b], r = f->at[c];
  double d = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  return fabs(d) <= f->slack ? 0 : d;
}

/* Returns the index, 0 to 2, of the corner of triangle t at point v. */
static int corner_at(const flipper *f, uint32_t t, uint32_t v) {
  int k = 0;
  while (k < 2 && f->corner[t][k] != v) k++;
  return k;
}

/* Returns the next triangle after t around point v, or NONE after the last. *turned: true once the walk has reached a
 * border and goes the other way, clockwise. */
static uint32_t around(const flipper *f, uint32_t v, uint32_t t, bool *turned) {
  if (!*turned) {
    uint32_t n = f->next[t][(corner_at(f, t, v) + 1) % 3];
    if (n == f->of[v]) return NONE;
    if (n != NONE) return n;
    *turned = true, t = f->of[v];
  }
  return f->next[t][(corner_at(f, t, v) + 2) % 3];
}

/* Finds a triangle with the side from a to b. *t: number of the triangle; *k: its corner opposite this side. Returns
 * false if there is none. */
static bool find(const flipper *f, uint32_t a, uint32_t b, uint32_t *t, int *k) {
  bool turned = false;
  for (*t = f->of[a]; *t != NONE; *t = around(f, a, *t, &turned)) {
    int i = corner_at(f, *t, a);
    if (f->corner[*t][(i + 1) % 3] == b) return *k = (i + 2) % 3, true;
    if (f->corner[*t][(i + 2) % 3] == b) return *k = (i + 1) % 3, true;
  }
  return false;
}

static int back_of(const flipper *f, uint32_t t, uint32_t from) { /* returns the index of the corner of triangle t that
                                                                   * is opposite the side between t and its neighbour
                                                                   * `from` */
  int k = 0;
  while (k < 2 && f->next[t][k] != from) k++;
  return k;
}

static void fix(flipper *f, uint32_t t, int k) {
  uint32_t o = f->next[t][k];
  f->fixed[t][k] = true;
  if (o != NONE) f->fixed[o][back_of(f, o, t)] = true;
}

/* Returns the third corner of the triangle on the other side of side k of triangle t, or NONE at the border. */
static uint32_t beyond(const flipper *f, uint32_t t, int k) {
  uint32_t o = f->next[t][k];
  return o == NONE ? NONE : f->corner[o][back_of(f, o, t)];
}

static void join(flipper *f, uint32_t t, int k, uint32_t to, bool fixed) {
  f->next[t][k] = to, f->fixed[t][k] = fixed;
}

/* Replaces the side opposite corner k of triangle t by the other diagonal of the quadrilateral that t and its neighbour
 * form. */
static void flip(flipper *f, uint32_t t, int k) {
  uint32_t o = f->next[t][k];
  int j = back_of(f, o, t), k1 = (k + 1) % 3, k2 = (k + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  uint32_t x = f->corner[t][k], u = f->corner[t][k1], v = f->corner[t][k2], y = f->corner[o][j];
  uint32_t vx = f->next[t][k1], xu = f->next[t][k2], uy = f->next[o][j1], yv = f->next[o][j2];
  bool vx_fixed = f->fixed[t][k1], xu_fixed = f->fixed[t][k2], uy_fixed = f->fixed[o][j1], yv_fixed = f->fixed[o][j2];
  if (vx != NONE) f->next[vx][back_of(f, vx, t)] = o;
  if (uy != NONE) f->next[uy][back_of(f, uy, o)] = t;
  f->corner[t][0] = x, f->corner[t][1] = u, f->corner[t][2] = y;
  f->corner[o][0] = x, f->corner[o][1] = y, f->corner[o][2] = v;
  join(f, t, 0, uy, uy_fixed), join(f, t, 1, o, false), join(f, t, 2, xu, xu_fixed);
  join(f, o, 0, yv, yv_fixed), join(f, o, 1, vx, vx_fixed), join(f, o, 2, t, false);
  f->of[x] = f->of[u] = f->of[y] = t, f->of[v] = o;
}

/* Returns true if triangle t and its neighbour opposite corner k form a strictly convex quadrilateral. */
static bool is_convex(const flipper *f, uint32_t t, int k) {
  uint32_t x = f->corner[t][k], u = f->corner[t][(k + 1) % 3], v = f->corner[t][(k + 2) % 3], y = beyond(f, t, k);
  return y != NONE && side(f, x, y, u) * side(f, x, y, v) < 0;
}

/* Returns true if the neighbour of triangle t opposite corner k has its third corner within t's circumcircle, which
 * Delaunay's condition forbids. */
static bool is_within(const flipper *f, uint32_t t, int k) {
  uint32_t y = beyond(f, t, k);
  if (y == NONE) return false;
  vs_vec2 d = f->at[y], c[3];
  double square[3];
  for (int i = 0; i < 3; i++) {
    c[i] = (vs_vec2){ f->at[f->corner[t][i]].x - d.x, f->at[f->corner[t][i]].y - d.y };
    square[i] = c[i].x * c[i].x + c[i].y * c[i].y;
  }
  double value = square[0] * (c[1].x * c[2].y - c[2].x * c[1].y) - square[1] * (c[0].x * c[2].y - c[2].x * c[0].y) +
                 square[2] * (c[0].x * c[1].y - c[1].x * c[0].y);
  double size = square[0] + square[1] + square[2];
  return value > 1e-12 * size * size;
}

static vs_vec2 crossing(const flipper *f, uint32_t a, uint32_t b, uint32_t p, uint32_t q) {
  double s = side(f, a, b, p), t = side(f, a, b, q), share = s / (s - t);
  return (vs_vec2){ f->at[p].x + share * (f->at[q].x - f->at[p].x), f->at[p].y + share * (f->at[q].y - f->at[p].y) };
}

/* Collects the sides of triangles that the segment from a to b crosses. *end: the first point after a on the segment.
 * *where: the crossing, if the segment crosses a given edge. */
static vs_breaklines_outcome collect(flipper *f, uint32_t a, uint32_t b, uint32_t *end, vs_vec2 *where) {
  bool turned = false;
  uint32_t t, p = NONE, q = NONE;
  vs_vec2 way = { f->at[b].x - f->at[a].x, f->at[b].y - f->at[a].y };
  *where = f->at[a];
  for (t = f->of[a]; t != NONE; t = around(f, a, t, &turned)) {
    int k = corner_at(f, t, a);
    p = f->corner[t][(k + 1) % 3], q = f->corner[t][(k + 2) % 3];
    uint32_t ends[2] = { p, q };
    for (int i = 0; i < 2; i++) {
      vs_vec2 d = { f->at[ends[i]].x - f->at[a].x, f->at[ends[i]].y - f->at[a].y };
      if (side(f, a, b, ends[i]) == 0 && d.x * way.x + d.y * way.y > 0) return *end = ends[i], VS_BREAKLINES_DONE;
    }
    if (side(f, a, b, p) < 0 && side(f, a, b, q) > 0) break;
  }
  while (t != NONE) {
    int k = 0;
    while (k < 2 && (f->corner[t][k] == p || f->corner[t][k] == q)) k++;
    if (f->fixed[t][k]) return *where = crossing(f, a, b, p, q), VS_BREAKLINES_CROSS;
    if (!push(&f->crossed, p, q)) return VS_BREAKLINES_MEMORY;
    uint32_t r = beyond(f, t, k);
    if (r == NONE) break;
    t = f->next[t][k];
    double s = side(f, a, b, r);
    if (s == 0) return *end = r, VS_BREAKLINES_DONE;
    if (s > 0) q = r;
    else p = r;
  }
  return VS_BREAKLINES_LOST;
}

/* Flips the sides of triangles that the segment from a to b crosses, until the segment itself is a side. Returns false
 * when memory is out, or rounding errors prevent it. */
static bool flip_crossed(flipper *f, uint32_t a, uint32_t b) {
  size_t most = 64 + 16 * f->crossed.count * f->crossed.count;
  for (; f->crossed.first < f->crossed.count && most > 0; most--) {
    uint32_t u = f->crossed.at[f->crossed.first][0], v = f->crossed.at[f->crossed.first][1], t;
    int k;
    f->crossed.first++;
    if (!find(f, u, v, &t, &k)) return false;
    if (!is_convex(f, t, k)) {
      if (!push(&f->crossed, u, v)) return false;
      continue;
    }
    uint32_t x = f->corner[t][k], y = beyond(f, t, k);
    flip(f, t, k);
    bool ends = x == a || x == b || y == a || y == b;
    bool crosses = !ends && side(f, a, b, x) * side(f, a, b, y) < 0;
    if (!push(crosses ? &f->crossed : &f->made, x, y)) return false;
  }
  return f->crossed.first == f->crossed.count;
}

/* Flips new sides of triangles, except given edges, until all satisfy Delaunay's condition, or a greatest number of
 * passes is reached. */
static bool restore(flipper *f) {
  bool changed = true;
  for (int pass = 0; changed && pass < 100; pass++) {
    changed = false;
    for (size_t i = 0; i < f->made.count; i++) {
      uint32_t t;
      int k;
      if (!find(f, f->made.at[i][0], f->made.at[i][1], &t, &k) || f->fixed[t][k]) continue;
      if (!is_within(f, t, k) || !is_convex(f, t, k)) continue;
      f->made.at[i][0] = f->corner[t][k], f->made.at[i][1] = beyond(f, t, k);
      flip(f, t, k);
      changed = true;
    }
  }
  return true;
}

static vs_breaklines_outcome insert(flipper *f, uint32_t a, uint32_t b, vs_vec2 *where) {
  uint32_t t, end = b;
  int k;
  f->todo.count = f->todo.first = 0;
  if (!push(&f->todo, a, b)) return VS_BREAKLINES_MEMORY;
  while (f->todo.count > 0) {
    f->todo.count--;
    a = f->todo.at[f->todo.count][0], b = f->todo.at[f->todo.count][1];
    if (f->of[a] == NONE || f->of[b] == NONE) return *where = f->at[a], VS_BREAKLINES_LOST;
    if (!find(f, a, b, &t, &k)) {
      f->crossed.count = f->crossed.first = f->made.count = 0;
      vs_breaklines_outcome outcome = collect(f, a, b, &end, where);
      if (outcome != VS_BREAKLINES_DONE) return outcome;
      if (end != b && !push(&f->todo, end, b)) return VS_BREAKLINES_MEMORY;
      if (!flip_crossed(f, a, end) || !find(f, a, end, &t, &k)) return *where = f->at[a], VS_BREAKLINES_LOST;
    }
    fix(f, t, k);
    if (!restore(f)) return VS_BREAKLINES_MEMORY;
    f->made.count = 0;
  }
  return VS_BREAKLINES_DONE;
}

typedef struct { uint32_t a, b, triangle, k; } half;

static int by_ends(const void *p, const void *q) {
  const half *x = p, *y = q;
  if (x->a != y->a) return x->a < y->a ? -1 : 1;
  return x->b < y->b ? -1 : x->b > y->b;
}

/* Finds the neighbours of all triangles, and a triangle at each point, for `points` points. Returns false when memory
 * is out. */
static bool link(flipper *f, size_t points) {
  half *h = vs_fresh(3 * f->count + 1, sizeof *h);
  if (!h) return false;
  for (size_t i = 0; i < points; i++) f->of[i] = NONE;
  for (uint32_t t = 0; t < f->count; t++)
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t a = f->corner[t][(k + 1) % 3], b = f->corner[t][(k + 2) % 3];
      h[3 * t + k] = (half){ a < b ? a : b, a < b ? b : a, t, k };
      f->next[t][k] = NONE;
      f->of[a] = t;
    }
  qsort(h, 3 * f->count, sizeof *h, by_ends);
  for (size_t i = 0; i + 1 < 3 * f->count; i++)
    if (h[i].a == h[i + 1].a && h[i].b == h[i + 1].b) {
      f->next[h[i].triangle][h[i].k] = h[i + 1].triangle;
      f->next[h[i + 1].triangle][h[i + 1].k] = h[i].triangle;
    }
  free(h);
  return true;
}

/* Sets after[a] to b for each side from a to b on the triangulation's border, and after[a] to NONE for all other
 * points. Returns the lowest point of the border. */
static uint32_t find_border(const flipper *f, size_t points, uint32_t *after) {
  uint32_t lowest = NONE;
  for (size_t i = 0; i < points; i++) after[i] = NONE;
  for (uint32_t t = 0; t < f->count; t++)
    for (int k = 0; k < 3; k++) {
      uint32_t a = f->corner[t][(k + 1) % 3], b = f->corner[t][(k + 2) % 3];
      if (f->next[t][k] != NONE) continue;
      after[a] = b;
      if (lowest == NONE || f->at[a].y < f->at[lowest].y ||
          (f->at[a].y == f->at[lowest].y && f->at[a].x > f->at[lowest].x))
        lowest = a;
    }
  return lowest;
}

/* Adds triangles to t at concave corners of its border. Records the sides of these triangles, which may violate
 * Delaunay's condition. */
static bool complete(flipper *f, vs_breakline_mesh *t) {
  uint32_t *after = vs_fresh(t->count + 1, sizeof *after), *line = vs_fresh(t->count + 2, sizeof *line);
  bool ok = after && line;
  uint32_t start = ok ? find_border(f, t->count, after) : NONE, v = start;
  size_t n = 0, steps = 0;
  for (; ok && v != NONE && steps <= t->count; v = after[v], steps++) {
    while (ok && n >= 2 && side(f, line[n - 2], line[n - 1], v) < 0) {
      uint32_t a = line[n - 2], b = line[n - 1];
      ok = VS_GROW(t->triangles, t->room, t->triangle_count + 1) && push(&f->made, a, b) && push(&f->made, b, v) &&
           push(&f->made, a, v);
      if (!ok) break;
      uint32_t *corner = t->triangles[t->triangle_count++];
      corner[0] = a, corner[1] = v, corner[2] = b;
      n--;
    }
    line[n++] = v;
    if (v == start && steps > 0) break;
  }
  free(after), free(line);
  return ok;
}

/* Finds the neighbours of the triangles, adds the missing triangles at the border, and finds the neighbours again.
 * Returns false when memory is out. */
static bool prepare(flipper *f, vs_breakline_mesh *t) {
  for (int pass = 0; pass < 2; pass++) {
    free(f->next), free(f->fixed);
    f->corner = t->triangles, f->count = t->triangle_count;
    f->next = vs_fresh(f->count + 1, sizeof *f->next), f->fixed = vs_zeros(f->count + 1, sizeof *f->fixed);
    if (!f->next || !f->fixed || !link(f, t->count)) return false;
    if (pass == 0 && !complete(f, t)) return false;
  }
  return restore(f);
}

vs_breaklines_outcome vs_breaklines_insert(vs_breakline_mesh *t, const uint32_t (*edges)[2], size_t edge_count,
                                                 vs_vec2 *where) {
  flipper f = { .at = t->at, .of = vs_fresh(t->count + 1, sizeof *f.of) };
  double size = 0;
  for (size_t i = 1; i < t->count; i++)
    size = fmax(size, hypot(t->at[i].x - t->at[0].x, t->at[i].y - t->at[0].y));
  f.slack = 1e-13 * size * size;
  bool ok = f.of && prepare(&f, t);
  vs_breaklines_outcome outcome = ok ? VS_BREAKLINES_DONE : VS_BREAKLINES_MEMORY;
  for (size_t i = 0; outcome == VS_BREAKLINES_DONE && i < edge_count; i++)
    if (edges[i][0] != edges[i][1]) outcome = insert(&f, edges[i][0], edges[i][1], where);
  free(f.next), free(f.fixed), free(f.of);
  free(f.crossed.at), free(f.made.at), free(f.todo.at);
  return outcome;
}
