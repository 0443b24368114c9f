/* Implements the unfolding of closed meshes (unfolding.h).
 *
 * A run processes the edges in some order. At each edge, it joins the two pieces beside it if they then do not overlap
 * in the plane. A fourth of the orders put long edges first, and a fourth are random. The others put the steepest edge
 * at each vertex last, each for a random upward direction (W. Schlickenrieder's steepest-edge cuts, which suit convex
 * solids). */
#include "geometry/nets/unfolding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/assert.h"
#include "model/store/array.h"

enum {
  RUNS = 80,             /* greatest number of runs: each tries another order in which edges of the mesh are joined */
  PATIENCE = 300000000   /* number of comparisons of triangles after which no further order of the edges is tried */
};

/* Returns true if the triangles a and b overlap by more than the slack: no side of a or b separates them. Their corners
 * may be clockwise. */
static bool overlap(const vs_vec2 a[3], const vs_vec2 b[3], double slack) {
  for (int pass = 0; pass < 2; pass++) {
    const vs_vec2 *p = pass ? b : a, *q = pass ? a : b;
    for (int k = 0; k < 3; k++) {
      vs_vec2 from = p[k], to = p[(k + 1) % 3];
      double nx = to.y - from.y, ny = from.x - to.x, l = hypot(nx, ny), low = INFINITY, high = -INFINITY;
      if (!(l > 0)) continue;
      double own = ((p[(k + 2) % 3].x - from.x) * nx + (p[(k + 2) % 3].y - from.y) * ny) / l;
      for (int i = 0; i < 3; i++) {
        double d = ((q[i].x - from.x) * nx + (q[i].y - from.y) * ny) / l;
        low = fmin(low, d), high = fmax(high, d);
      }
      if (low >= fmax(own, 0) - slack || high <= fmin(own, 0) + slack) return false;
    }
  }
  return true;
}

typedef struct { double x0, y0, x1, y1; } box;
static const box no_box = { INFINITY, INFINITY, -INFINITY, -INFINITY };
static void box_add(box *b, vs_vec2 p) {
  b->x0 = fmin(b->x0, p.x), b->y0 = fmin(b->y0, p.y), b->x1 = fmax(b->x1, p.x), b->y1 = fmax(b->y1, p.y);
}
static box box_of(const vs_vec2 at[3]) {
  box b = no_box;
  for (int k = 0; k < 3; k++) box_add(&b, at[k]);
  return b;
}
static bool boxes_meet(const box *a, const box *b, double slack) {
  return a->x0 < b->x1 - slack && b->x0 < a->x1 - slack && a->y0 < b->y1 - slack && b->y0 < a->y1 - slack;
}

/* The state of a run, which joins pieces of the flat net in one order of the edges. The triangles of a piece form a
 * circular list. */
typedef struct {
  vs_flat_net *s;
  uint32_t *next, *count;  /* next[t]: triangle after t in the list of its piece; count[p]: number of triangles of piece
                            * p */
  uint32_t *order;         /* numbers of the edges in the order in which the run processes them */
  double *weight;          /* weight[e]: weight of edge e; an edge with a smaller weight is processed earlier */
  uint32_t *steepest;      /* steepest[v]: the steepest edge at vertex v for the run's upward direction; the run
                            * processes it last */
  vs_vec2 (*best)[3];      /* best[t]: positions in the plane of the corners of triangle t, as the run with the fewest
                            * pieces so far has laid it */
  uint32_t *best_piece;
  uint32_t *near;          /* triangles of the larger piece that lie in the bounding box of the smaller piece */
  vs_vec2 (*moved)[3];     /* moved[i]: corners of a triangle of the smaller piece after the piece was moved beside the
                            * larger piece */
  uint32_t *who;           /* who[i]: number of the triangle whose corners are moved[i] */
  double tried;            /* number of pairs of triangles that were compared so far, which limits the search */
} run;

static void run_free(run *r) {
  free(r->next), free(r->count), free(r->order), free(r->weight), free(r->steepest), free(r->best);
  free(r->best_piece), free(r->near), free(r->moved), free(r->who);
}

static bool run_make(run *r, vs_flat_net *s) {
  size_t t = s->edges.m->triangle_count + 1, e = s->edges.edge_count + 1, v = s->edges.m->vertex_count + 1;
  *r = (run){ .s = s };
  return VS_FRESH(r->next, t) && VS_FRESH(r->count, t) && VS_FRESH(r->order, e) && VS_FRESH(r->weight, e) &&
         VS_FRESH(r->steepest, v) && VS_FRESH(r->best, t) && VS_FRESH(r->best_piece, t) && VS_FRESH(r->near, t) &&
         VS_FRESH(r->moved, t) && VS_FRESH(r->who, t);
}

/* A rotation and a shift of the plane. */
typedef struct { double c, s, x, y; } motion;
static vs_vec2 go(const motion *m, vs_vec2 p) {
  return (vs_vec2){ m->c * p.x - m->s * p.y + m->x, m->s * p.x + m->c * p.y + m->y };
}

/* Returns the motion of the plane that moves the points from[0] and from[1] to to[0] and to[1]. */
static motion between(const vs_vec2 from[2], const vs_vec2 to[2]) {
  double ax = from[1].x - from[0].x, ay = from[1].y - from[0].y, bx = to[1].x - to[0].x, by = to[1].y - to[0].y;
  double l = hypot(ax, ay) * hypot(bx, by);
  motion m = { l > 0 ? (ax * bx + ay * by) / l : 1, l > 0 ? (ax * by - ay * bx) / l : 0, 0, 0 };
  double n = hypot(m.c, m.s);
  m.c /= n, m.s /= n;
  m.x = (to[0].x + to[1].x) / 2 - (m.c * (from[0].x + from[1].x) - m.s * (from[0].y + from[1].y)) / 2;
  m.y = (to[0].y + to[1].y) / 2 - (m.s * (from[0].x + from[1].x) + m.c * (from[0].y + from[1].y)) / 2;
  return m;
}

/* Joins the two pieces of the flat net at edge e, unless they would then overlap in the plane. Returns true if it
 * joined them. */
static bool merge(run *r, uint32_t e) {
  vs_flat_net *s = r->s;
  const vs_mesh_edge *g = &s->edges.edges[e];
  uint32_t stays = g->side[0], goes = g->side[1];
  if (s->piece[stays] == s->piece[goes]) return false;
  if (r->count[s->piece[stays]] < r->count[s->piece[goes]]) stays = g->side[1], goes = g->side[0];
  vs_vec2 from[2], to[2];
  vs_flat_net_ends(s, goes, e, from), vs_flat_net_ends(s, stays, e, to);
  motion m = between(from, to);
  box whole = no_box;
  size_t count = 0, near = 0;
  uint32_t t = goes;
  do {
    for (int k = 0; k < 3; k++) box_add(&whole, r->moved[count][k] = go(&m, s->at[t][k]));
    r->who[count++] = t;
  } while ((t = r->next[t]) != goes);
  t = stays;
  do {
    box b = box_of(s->at[t]);
    if (boxes_meet(&b, &whole, s->slack)) r->near[near++] = t;
  } while ((t = r->next[t]) != stays);
  for (size_t i = 0; i < count; i++) {
    box a = box_of(r->moved[i]);
    for (size_t j = 0; j < near; j++) {
      box b = box_of(s->at[r->near[j]]);
      if (boxes_meet(&a, &b, s->slack) && overlap(r->moved[i], s->at[r->near[j]], 10 * s->slack)) {
        r->tried += (double)(i * near + j);
        return false;
      }
    }
  }
  r->tried += (double)(count * near + count);
  uint32_t kept = s->piece[stays], swap = r->next[stays];
  for (size_t i = 0; i < count; i++) {
    memcpy(s->at[r->who[i]], r->moved[i], sizeof r->moved[i]);
    s->piece[r->who[i]] = kept;
  }
  r->next[stays] = r->next[goes], r->next[goes] = swap;
  r->count[kept] += (uint32_t)count;
  s->pieces--;
  return true;
}

typedef struct { double weight; uint32_t edge; } weighed;
static int by_weight(const void *p, const void *q) {
  const weighed *a = p, *b = q;
  if (a->weight != b->weight) return a->weight < b->weight ? -1 : 1;
  return a->edge < b->edge ? -1 : a->edge > b->edge;
}

static double next_random(uint64_t *state) { /* returns a pseudo-random number from -1 to 1 */
  *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

/* Sets the weights of the edges, which determine their order, for run number `number`. */
static void weigh(run *r, int number) {
  vs_flat_net *s = r->s;
  const vs_mesh *m = s->edges.m;
  uint64_t seed = (uint64_t)number * UINT64_C(0x9E3779B97F4A7C15) + 12345;
  vs_vec3 up = { next_random(&seed), next_random(&seed), next_random(&seed) };
  size_t n = s->edges.edge_count;
  for (size_t v = 0; v < m->vertex_count; v++) r->steepest[v] = VS_MESH_NONE;
  for (uint32_t e = 0; e < n; e++) {
    const vs_mesh_edge *g = &s->edges.edges[e];
    vs_vec3 d = vs_v3_sub(m->vertices[g->b], m->vertices[g->a]);
    double l = vs_v3_length(d);
    r->weight[e] = 0;
    if (number % 4 == 0) r->weight[e] = -l * (1 + (number ? .5 * next_random(&seed) : 0));
    if (number % 4 == 2) r->weight[e] = next_random(&seed);
    for (int k = 0; k < 2 && l > 0; k++) {
      uint32_t v = k ? g->b : g->a, old = r->steepest[v];
      double slope = (k ? -1 : 1) * vs_v3_dot(d, up) / l;
      if (old == VS_MESH_NONE) {
        r->steepest[v] = e;
        continue;
      }
      const vs_mesh_edge *o = &s->edges.edges[old];
      vs_vec3 w = vs_v3_sub(m->vertices[o->a == v ? o->b : o->a], m->vertices[v]);
      if (slope > vs_v3_dot(w, up) / vs_v3_length(w)) r->steepest[v] = e;
    }
  }
  if (number % 2)
    for (size_t v = 0; v < m->vertex_count; v++)
      if (r->steepest[v] != VS_MESH_NONE) r->weight[r->steepest[v]] = 1;
}

/* Sorts the edges by weight into `order`. Returns false when memory is out. */
static bool sort_edges(run *r) {
  size_t n = r->s->edges.edge_count;
  weighed *w = vs_fresh(n + 1, sizeof *w);
  if (!w) return false;
  for (uint32_t e = 0; e < n; e++) w[e] = (weighed){ r->weight[e], e };
  qsort(w, n, sizeof *w, by_weight);
  for (size_t i = 0; i < n; i++) r->order[i] = w[i].edge;
  free(w);
  return true;
}

/* At the beginning of a run, makes each flat face a separate piece of the net. */
static void separate(run *r) {
  vs_flat_net *s = r->s;
  size_t n = s->edges.m->triangle_count;
  uint32_t *first = r->near; /* first[p]: number of the first triangle of flat face p; uses the memory of the array
                              * `near` */
  for (size_t f = 0; f < s->faces; f++) first[f] = VS_MESH_NONE, r->count[f] = 0;
  for (uint32_t t = 0; t < n; t++) {
    uint32_t f = s->piece[t] = s->face[t];
    r->count[f]++;
    r->next[t] = t;
    if (first[f] == VS_MESH_NONE) first[f] = t;
    else r->next[t] = r->next[first[f]], r->next[first[f]] = t;
  }
  s->pieces = s->faces;
}

bool vs_flat_net_unfold(vs_flat_net *s, vs_long_work work) {
  run r;
  vs_flatness flatness;
  size_t n = s->edges.m->triangle_count, fewest = SIZE_MAX;
  bool ok = run_make(&r, s) && vs_flat_net_unroll(s, &flatness);
  for (int number = 0; ok && number < RUNS && fewest > 1 && r.tried < PATIENCE; number++) {
    separate(&r);
    weigh(&r, number);
    ok = sort_edges(&r);
    for (size_t i = 0; ok && i < s->edges.edge_count; i++) {
      merge(&r, r.order[i]);
      if (i % 256 == 0 && work.going && !work.going(work.context, (double)number / RUNS)) ok = false;
    }
    if (!ok || s->pieces >= fewest) continue;
    fewest = s->pieces;
    memcpy(r.best, s->at, n * sizeof *r.best);
    memcpy(r.best_piece, s->piece, n * sizeof *r.best_piece);
  }
  if (ok && fewest != SIZE_MAX) { /* numbers the pieces of the flat net from 0, in the order of their first triangles */
    uint32_t *name = r.near, count = 0;
    for (size_t f = 0; f < s->faces; f++) name[f] = VS_MESH_NONE;
    memcpy(s->at, r.best, n * sizeof *r.best);
    for (size_t t = 0; t < n; t++) {
      uint32_t *p = &name[r.best_piece[t]];
      if (*p == VS_MESH_NONE) *p = count++;
      s->piece[t] = *p;
    }
    s->pieces = count;
    vs_flat_net_join(s, 10 * s->slack);
  }
  run_free(&r);
  return ok;
}

/* ---- glue tabs ---- */

typedef struct {
  const vs_flat_net *s;
  vs_vec2 (*taken)[3]; /* taken: triangles of the glue tabs that are already placed, two for each tab */
  uint32_t *piece;     /* piece[i]: number of the piece to which the triangle taken[i] belongs */
  size_t count;
} tab_field;

static bool is_free(const tab_field *f, const vs_vec2 at[3], uint32_t piece) {
  const vs_flat_net *s = f->s;
  box b = box_of(at);
  for (uint32_t t = 0; t < s->edges.m->triangle_count; t++) {
    if (s->piece[t] != piece) continue;
    box o = box_of(s->at[t]);
    if (boxes_meet(&b, &o, s->slack) && overlap(at, s->at[t], 10 * s->slack)) return false;
  }
  for (size_t i = 0; i < f->count; i++) {
    if (f->piece[i] != piece) continue;
    box o = box_of(f->taken[i]);
    if (boxes_meet(&b, &o, s->slack) && overlap(at, f->taken[i], 10 * s->slack)) return false;
  }
  return true;
}

/* Sets ends to the ends of the border edge e of triangle t, in the order in which the triangle lies to the left of the
 * edge. */
static void border_ends(const vs_flat_net *s, uint32_t t, uint32_t e, vs_vec2 ends[2]) {
  vs_flat_net_ends(s, t, e, ends);
  vs_vec2 w = s->at[t][vs_flat_net_corner(s, t, e)];
  if ((ends[1].x - ends[0].x) * (w.y - ends[0].y) - (ends[1].y - ends[0].y) * (w.x - ends[0].x) < 0) {
    vs_vec2 swap = ends[0];
    ends[0] = ends[1], ends[1] = swap;
  }
}

/* Finds the widest glue tab that fits at edge e of triangle t: `width`, three quarters of it, and so on, down to a
 * fifth. Returns the tab's width, or 0 if none fits. out: its two outer corners. */
static double widest(const tab_field *f, uint32_t t, uint32_t e, double width, vs_vec2 out[2]) {
  vs_vec2 p[2];
  border_ends(f->s, t, e, p);
  double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y, l = hypot(ux, uy);
  if (!(l > 0)) return 0;
  ux /= l, uy /= l;
  for (double w = width; w > .2 * width; w *= .75) {
    double in = fmin(w, l / 3);
    out[0] = (vs_vec2){ p[0].x + in * ux + w * uy, p[0].y + in * uy - w * ux };
    out[1] = (vs_vec2){ p[1].x - in * ux + w * uy, p[1].y - in * uy - w * ux };
    const vs_vec2 one[3] = { p[0], out[0], p[1] }, other[3] = { p[1], out[0], out[1] };
    if (is_free(f, one, f->s->piece[t]) && is_free(f, other, f->s->piece[t])) return w;
  }
  return 0;
}

bool vs_flat_net_tabs(const vs_flat_net *s, double width, vs_glue_tab **tabs, size_t *count, size_t *missing) {
  size_t n = s->edges.edge_count;
  tab_field f = { .s = s };
  vs_glue_tab *made = vs_fresh(n + 1, sizeof *made);
  *tabs = made, *count = *missing = 0;
  bool ok = made && VS_FRESH(f.taken, 2 * n + 1) && VS_FRESH(f.piece, 2 * n + 1);
  for (uint32_t e = 0; ok && e < n; e++) {
    const vs_mesh_edge *g = &s->edges.edges[e];
    if (s->joined[e] || g->side[1] == VS_MESH_NONE) continue;
    vs_vec2 at[2][2], p[2];
    double w[2];
    for (int k = 0; k < 2; k++) w[k] = widest(&f, g->side[k], e, width, at[k]);
    int k = w[1] > w[0];
    if (!(w[k] > 0)) {
      ++*missing;
      continue;
    }
    border_ends(s, g->side[k], e, p);
    made[(*count)++] = (vs_glue_tab){ g->side[k], e, { at[k][0], at[k][1] } };
    for (int i = 0; i < 2; i++, f.count++) {
      f.piece[f.count] = s->piece[g->side[k]];
      f.taken[f.count][0] = i ? p[1] : p[0], f.taken[f.count][1] = at[k][0], f.taken[f.count][2] = i ? at[k][1] : p[1];
    }
  }
  free(f.taken), free(f.piece);
  return ok;
}
