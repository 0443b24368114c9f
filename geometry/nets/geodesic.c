/* Computes shortest paths (geodesic.h).
 *
 * Dijkstra's algorithm finds a first path over the mesh, between its corners and STOPS points on every edge. The path
 * crosses a row of edges. The two triangles at an edge are unfolded into a plane, and the crossing moves to the point
 * where the path is straight. This is repeated for all crossings. The length is a convex function of the crossings, so
 * the result is the shortest path over these edges. If crossings end in a corner of the mesh, the path around the other
 * side of this corner is tested, and used if it is shorter (D. Martinez and others, Computing geodesics on triangular
 * meshes, 2005). */
#include "geometry/nets/geodesic.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/nets/mesh_edges.h"
#include "model/store/array.h"

#define PI 3.14159265358979323846
#define NONE VS_MESH_NONE /* number that means no point, no edge or no triangle */
enum { STOPS = 3, SWEEPS = 4000, SWEEPS_TO_COMPARE = 60, TURNS = 200 };

/* ---- Dijkstra's algorithm ---- */

typedef struct {
  uint32_t *first, *to; /* numbers of the neighbours of point i: to[first[i]] to to[first[i + 1] - 1] */
  double *length;
} links;

static void links_free(links *l) { free(l->first), free(l->to), free(l->length); }

static bool links_make(links *l, const vs_way_net *net) {
  const vs_way *ways = net->ways;
  size_t count = net->way_count, points = net->point_count;
  *l = (links){ 0 };
  if (!VS_FRESH(l->first, points + 2) || !VS_FRESH(l->to, 2 * count + 1) || !VS_FRESH(l->length, 2 * count + 1))
    return false;
  memset(l->first, 0, (points + 2) * sizeof *l->first);
  for (size_t i = 0; i < count; i++) l->first[ways[i].a + 2]++, l->first[ways[i].b + 2]++;
  for (size_t i = 2; i <= points + 1; i++) l->first[i] += l->first[i - 1];
  for (size_t i = 0; i < count; i++) {
    uint32_t j = l->first[ways[i].a + 1]++, k = l->first[ways[i].b + 1]++;
    l->to[j] = ways[i].b, l->to[k] = ways[i].a, l->length[j] = l->length[k] = ways[i].length;
  }
  return true;
}

typedef struct {
  double far;
  uint32_t point;
} visit;

static void sift_up(visit *heap, size_t i) {
  for (visit v = heap[i]; i > 0 && heap[(i - 1) / 2].far > v.far; heap[i] = v)
    heap[i] = heap[(i - 1) / 2], i = (i - 1) / 2;
}

static visit take(visit *heap, size_t *count) {
  visit top = heap[0], v = heap[--*count];
  size_t i = 0;
  for (size_t k; (k = 2 * i + 1) < *count; i = k) {
    if (k + 1 < *count && heap[k + 1].far < heap[k].far) k++;
    if (heap[k].far >= v.far) break;
    heap[i] = heap[k];
  }
  heap[i] = v;
  return top;
}

bool vs_ways_shortest(const vs_way_net *net, uint32_t from, uint32_t to, uint32_t **out, size_t *count) {
  links l;
  double *far = NULL;
  uint32_t *before = NULL;
  visit *heap = NULL;
  size_t points = net->point_count, room = 0, waiting = 0;
  VS_ASSERT(from < points && to < points);
  *out = NULL, *count = 0;
  bool ok = links_make(&l, net) && VS_FRESH(far, points + 1) && VS_FRESH(before, points + 1) &&
            VS_GROW(heap, room, 1);
  for (size_t i = 0; ok && i < points; i++) far[i] = INFINITY, before[i] = NONE;
  if (ok) far[from] = 0, heap[waiting++] = (visit){ 0, from };
  while (ok && waiting) {
    visit v = take(heap, &waiting);
    if (v.far > far[v.point]) continue;
    if (v.point == to) break;
    for (uint32_t k = l.first[v.point]; ok && k < l.first[v.point + 1]; k++) {
      double d = v.far + l.length[k];
      if (!(d < far[l.to[k]])) continue;
      far[l.to[k]] = d, before[l.to[k]] = v.point;
      ok = VS_GROW(heap, room, waiting + 1);
      if (ok) heap[waiting] = (visit){ d, l.to[k] }, sift_up(heap, waiting++);
    }
  }
  if (ok && isfinite(far[to])) {
    size_t n = 1;
    for (uint32_t i = to; before[i] != NONE; i = before[i]) n++;
    ok = VS_FRESH(*out, n);
    if (ok) *count = n;
    for (uint32_t i = to; ok && n-- > 0; i = before[i]) (*out)[n] = i;
  }
  links_free(&l);
  free(far), free(before), free(heap);
  return ok;
}

/* ---- the mesh ---- */

typedef vs_mesh_edges surface;

static vs_vec3 at(const surface *s, uint32_t corner) { return s->m->vertices[corner]; }

/* A point on the mesh and the triangle that contains it. */
typedef struct { vs_vec3 at; uint32_t triangle; } place;

/* ---- the first path ---- */

/* Returns the position of a stop. Each edge has STOPS + 2 stops: its two ends and points between them. */
static vs_vec3 stop_at(const surface *s, uint32_t stop) {
  const vs_mesh_edge *e = &s->edges[stop / (STOPS + 2)];
  double share = (double)(stop % (STOPS + 2)) / (STOPS + 1);
  VS_ASSERT(stop / (STOPS + 2) < s->edge_count);
  return vs_v3_add(at(s, e->a), vs_v3_scale(vs_v3_sub(at(s, e->b), at(s, e->a)), share));
}

/* Finds the first path from p to q, over a graph of stops (points on edges). Edge e has the STOPS + 2 stops from number
 * (STOPS + 2) e on; p and q are the last two points. Returns false when memory is out. */
static bool first_way(const surface *s, const place *p, const place *q, uint32_t **out, size_t *count) {
  enum { EACH = STOPS + 2 };
  size_t points = EACH * s->edge_count + 2, n = 0, room = 0;
  vs_way *ways = NULL;
  uint32_t *seen = NULL;
  bool ok = points < NONE && VS_FRESH(seen, s->m->vertex_count + 1);
  for (size_t i = 0; ok && i < s->m->vertex_count; i++) seen[i] = NONE;
  for (uint32_t e = 0; ok && e < s->edge_count; e++)
    for (int end = 0; ok && end < 2; end++) {
      uint32_t v = end ? s->edges[e].b : s->edges[e].a, here = EACH * e + (end ? EACH - 1 : 0);
      if (seen[v] == NONE)
        seen[v] = here;
      else if ((ok = VS_GROW(ways, room, n + 1)))
        ways[n++] = (vs_way){ seen[v], here, 0 };
    }
  for (uint32_t t = 0; ok && t < s->m->triangle_count; t++)
    for (int k = 0; ok && k < 3; k++) {
      uint32_t e = s->of[t][k], f = s->of[t][(k + 1) % 3];
      ok = VS_GROW(ways, room, n + EACH * EACH + EACH);
      for (uint32_t i = 0; ok && i < EACH; i++)
        for (uint32_t j = 0; j < EACH; j++)
          ways[n++] = (vs_way){ EACH * e + i, EACH * f + j,
                                vs_v3_length(vs_v3_sub(stop_at(s, EACH * e + i), stop_at(s, EACH * f + j))) };
      for (uint32_t i = 0; ok && i + 1 < EACH; i++)
        ways[n++] = (vs_way){ EACH * e + i, EACH * e + i + 1,
                              vs_v3_length(vs_v3_sub(stop_at(s, EACH * e + i), stop_at(s, EACH * e + i + 1))) };
    }
  for (int end = 0; ok && end < 2; end++)
    for (int k = 0; ok && k < 3; k++) {
      uint32_t e = s->of[(end ? q : p)->triangle][k];
      ok = VS_GROW(ways, room, n + EACH);
      for (uint32_t i = 0; ok && i < EACH; i++)
        ways[n++] = (vs_way){ (uint32_t)points - 2 + (uint32_t)end, EACH * e + i,
                              vs_v3_length(vs_v3_sub(stop_at(s, EACH * e + i), (end ? q : p)->at)) };
    }
  ok = ok && vs_ways_shortest(&(vs_way_net){ ways, n, points }, (uint32_t)points - 2, (uint32_t)points - 1, out, count);
  free(ways), free(seen);
  return ok;
}

/* ---- rows of edges that a path crosses ---- */

typedef struct {
  uint32_t *edge; /* numbers of the edges that the path crosses, in order along the path */
  double *share;  /* share[i]: position of the path's crossing i on its edge: 0 at the edge's end a, 1 at its end b */
  size_t count, edge_room, share_room;
  place p, q; /* p, q: ends of the path, with the triangles that contain them */
} row;

static void row_free(row *r) { free(r->edge), free(r->share); }

static bool row_put(row *r, uint32_t e, double share) {
  if (!VS_GROW(r->edge, r->edge_room, r->count + 1) || !VS_GROW(r->share, r->share_room, r->count + 1)) return false;
  r->edge[r->count] = e, r->share[r->count++] = share;
  return true;
}

/* Returns the point where the path r crosses its edge number i. */
static vs_vec3 crossing_at(const surface *s, const row *r, size_t i) {
  const vs_mesh_edge *e = &s->edges[r->edge[i]];
  VS_ASSERT(i < r->count);
  return vs_v3_add(at(s, e->a), vs_v3_scale(vs_v3_sub(at(s, e->b), at(s, e->a)), r->share[i]));
}

static double row_length(const surface *s, const row *r) {
  double sum = 0;
  vs_vec3 last = r->p.at;
  for (size_t i = 0; i < r->count; i++) {
    vs_vec3 c = crossing_at(s, r, i);
    sum += vs_v3_length(vs_v3_sub(c, last)), last = c;
  }
  return sum + vs_v3_length(vs_v3_sub(r->q.at, last));
}

/* Moves each crossing of path r to the point where the path is straight if the two triangles at the crossed edge are
 * unfolded into a plane. Repeats this `sweeps` times. */
static void straighten(const surface *s, row *r, int sweeps) {
  for (int sweep = 0; sweep < sweeps; sweep++) {
    double moved = 0;
    for (size_t k = 0; k < r->count; k++) {
      size_t i = sweep % 2 ? r->count - 1 - k : k;
      const vs_mesh_edge *e = &s->edges[r->edge[i]];
      vs_vec3 a = at(s, e->a), way = vs_v3_sub(at(s, e->b), a);
      vs_vec3 u = vs_v3_sub(i ? crossing_at(s, r, i - 1) : r->p.at, a);
      vs_vec3 w = vs_v3_sub(i + 1 < r->count ? crossing_at(s, r, i + 1) : r->q.at, a);
      double l = vs_v3_dot(way, way);
      if (!(l > 0)) continue;
      double fu = vs_v3_dot(u, way) / l, fw = vs_v3_dot(w, way) / l;
      double hu = vs_v3_length(vs_v3_sub(u, vs_v3_scale(way, fu))),
             hw = vs_v3_length(vs_v3_sub(w, vs_v3_scale(way, fw)));
      double share = hu + hw > 0 ? (fu * hw + fw * hu) / (hu + hw) : .5 * (fu + fw);
      double next = r->share[i] + 1.6 * (share - r->share[i]); /* over-relaxation: a step 1.6 times as long as computed
                                                                * converges sooner */
      if (hu + hw <= 0) next = share;
      next = fmin(1, fmax(0, next));
      moved = fmax(moved, fabs(next - r->share[i]));
      r->share[i] = next;
    }
    if (moved < 1e-11) break;
  }
}

/* Returns the triangle that has both edges e and f, or NONE if there is none. */
static uint32_t between(const surface *s, uint32_t e, uint32_t f) {
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2; k++)
      if (s->edges[e].side[i] != NONE && s->edges[e].side[i] == s->edges[f].side[k]) return s->edges[e].side[i];
  return NONE;
}

/* Returns the corner of the mesh at which crossing i of path r lies, or NONE if the crossing lies within its edge. */
static uint32_t ends_in(const surface *s, const row *r, size_t i) {
  const vs_mesh_edge *e = &s->edges[r->edge[i]];
  VS_ASSERT(i < r->count);
  return r->share[i] < 1e-7 ? e->a : r->share[i] > 1 - 1e-7 ? e->b : NONE;
}

/* Returns the edge of triangle t, other than e, that ends at the corner. */
static uint32_t turn_in(const surface *s, uint32_t t, uint32_t corner, uint32_t e) {
  for (int k = 0; k < 3; k++) {
    uint32_t f = s->of[t][k];
    if (f != e && (s->edges[f].a == corner || s->edges[f].b == corner)) return f;
  }
  return NONE;
}

static double angle_at(vs_vec3 corner, vs_vec3 p, vs_vec3 q) {
  vs_vec3 a = vs_v3_sub(p, corner), b = vs_v3_sub(q, corner);
  return atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b));
}

/* Crossings of a path, `first` to `stop` - 1, that all lie at one corner of the mesh. before, after: the triangles
 * before and after this corner on the path. */
typedef struct { size_t first, stop; uint32_t corner, before, after; } touch;

/* Makes in `out` the list of edges that path r crosses if it passes c's corner on the other side. *there: true if there
 * is such a list and it allows a shorter path. Returns false when memory is out. */
static bool other_side(const surface *s, const row *r, const touch *c, row *out, bool *there) {
  size_t i = c->first, j = c->stop;
  uint32_t corner = c->corner;
  VS_ASSERT(i < j && j <= r->count);
  *there = false;
  for (size_t k = 0; k < i; k++)
    if (!row_put(out, r->edge[k], r->share[k])) return false;
  uint32_t t = c->before, e = turn_in(s, t, corner, r->edge[i]);
  vs_vec3 middle = at(s, corner), last = i ? crossing_at(s, r, i - 1) : r->p.at;
  double angle = 0;
  for (size_t turns = 0; t != c->after; turns++) {
    if (e == NONE || turns > s->edge_count) return true;
    vs_vec3 far = at(s, s->edges[e].a == corner ? s->edges[e].b : s->edges[e].a);
    angle += angle_at(middle, last, far), last = far;
    if (!row_put(out, e, s->edges[e].a == corner ? .01 : .99)) return false;
    t = s->edges[e].side[0] == t ? s->edges[e].side[1] : s->edges[e].side[0];
    if (t == NONE) return true;
    e = turn_in(s, t, corner, e);
  }
  angle += angle_at(middle, last, j < r->count ? crossing_at(s, r, j) : r->q.at);
  if (angle > PI - 1e-9) return true;
  for (size_t k = j; k < r->count; k++)
    if (!row_put(out, r->edge[k], r->share[k])) return false;
  *there = true;
  return true;
}

/* Tests whether path r becomes shorter if it passes one of its corners of the mesh on the other side. If so, replaces r
 * by the shorter path and sets *better to true. Returns false when memory is out. */
static bool go_round(const surface *s, row *r, bool *better) {
  double length = row_length(s, r);
  *better = false;
  for (size_t i = 0; i < r->count;) {
    uint32_t corner = ends_in(s, r, i);
    size_t j = i + 1;
    if (corner == NONE) {
      i = j;
      continue;
    }
    while (j < r->count && ends_in(s, r, j) == corner) j++;
    touch c = { .first = i, .stop = j, .corner = corner };
    c.before = i ? between(s, r->edge[i - 1], r->edge[i]) : r->p.triangle;
    c.after = j < r->count ? between(s, r->edge[j - 1], r->edge[j]) : r->q.triangle;
    row other = { .p = r->p, .q = r->q };
    bool there = false, ok = c.before == NONE || c.after == NONE || other_side(s, r, &c, &other, &there);
    if (ok && there) {
      straighten(s, &other, SWEEPS_TO_COMPARE);
      double now = row_length(s, &other);
      if (now < length * (1 - 1e-10)) {
        j = i + (other.count > r->count - (j - i) ? other.count - (r->count - (j - i)) : 0);
        row_free(r);
        *r = other, *better = true, length = now;
        i = j;
        continue;
      }
    }
    row_free(&other);
    if (!ok) return false;
    i = j;
  }
  return true;
}

/* Sets r to the list of edges that a path over the given stops (points on edges) crosses. *whole: false if no list was
 * found. Returns false when memory is out. */
static bool row_of_way(const surface *s, const uint32_t *way, size_t count, row *r, bool *whole) {
  enum { EACH = STOPS + 2 };
  uint32_t t = r->p.triangle;
  *whole = true;
  for (size_t i = 1; i + 1 < count; i++) {
    uint32_t e = way[i] / EACH, stop = way[i] % EACH;
    double share = (double)stop / (EACH - 1);
    bool corner = stop == 0 || stop == EACH - 1;
    uint32_t v = stop == 0 ? s->edges[e].a : s->edges[e].b;
    /* next: the triangle in which the path continues after this stop */
    uint32_t next = r->q.triangle;
    if (i + 2 < count) {
      uint32_t f = way[i + 1] / EACH;
      if (f == e) continue; /* the path goes along edge f, and leaves the edge only at the next stop */
      next = between(s, e, f);
      if (next == NONE) { /* the stop is a corner of the mesh; each other edge at this corner has a stop of another
                           * number at the same position */
        if (!corner) return *whole = false, true;
        continue;
      }
    }
    if (next == t) continue;
    if (!corner) {
      if (s->edges[e].side[0] != t && s->edges[e].side[1] != t) return *whole = false, true;
      if (!row_put(r, e, share)) return false;
      t = next;
      continue;
    }
    /* Walks around the corner from triangle t to the triangle `next`, in one direction and then in the other. */
    for (int way_round = 0; way_round < 2 && t != next; way_round++) {
      row part = { 0 };
      uint32_t at_triangle = t, out = NONE;
      for (int k = 0, seen = 0; k < 3; k++) {
        uint32_t f = s->of[t][k];
        if ((s->edges[f].a == v || s->edges[f].b == v) && seen++ == way_round) out = f;
      }
      bool ok = true;
      for (size_t turns = 0; ok && at_triangle != next && out != NONE && turns <= s->edge_count; turns++) {
        ok = row_put(&part, out, s->edges[out].a == v ? 0 : 1);
        at_triangle = s->edges[out].side[0] == at_triangle ? s->edges[out].side[1] : s->edges[out].side[0];
        if (at_triangle == NONE) break;
        out = turn_in(s, at_triangle, v, out);
      }
      for (size_t k = 0; ok && at_triangle == next && k < part.count; k++) ok = row_put(r, part.edge[k], part.share[k]);
      row_free(&part);
      if (!ok) return false;
      if (at_triangle == next) t = next;
    }
    if (t != next) return *whole = false, true;
  }
  *whole = t == r->q.triangle;
  return true;
}

bool vs_mesh_geodesic(const vs_mesh *m, vs_vec3 p, vs_vec3 q, vs_vec3 **out, size_t *count) {
  surface s;
  uint32_t *way = NULL;
  size_t stops = 0;
  *out = NULL, *count = 0;
  row r = { 0 };
  bool ok = vs_mesh_edges_make(&s, m), whole = false;
  if (ok && m->triangle_count) {
    r.p.triangle = vs_mesh_edges_nearest(&s, p, &r.p.at), r.q.triangle = vs_mesh_edges_nearest(&s, q, &r.q.at);
    if (r.p.triangle == r.q.triangle) {
      whole = true;
    } else {
      ok = first_way(&s, &r.p, &r.q, &way, &stops);
      if (ok && stops) ok = row_of_way(&s, way, stops, &r, &whole);
      bool better = whole;
      for (int turn = 0; ok && better && turn < TURNS; turn++) {
        straighten(&s, &r, SWEEPS);
        ok = go_round(&s, &r, &better);
      }
    }
    size_t points = whole ? r.count + 2 : stops;
    ok = ok && VS_FRESH(*out, points + 1);
    for (size_t i = 0; ok && i < points; i++)
      (*out)[(*count)++] = i == 0            ? r.p.at
                           : i == points - 1 ? r.q.at
                           : whole           ? crossing_at(&s, &r, i - 1)
                                             : stop_at(&s, way[i]); /* if no list of edges was found, the points of the
                                                                     * path are the stops themselves, such as corners at
                                                                     * borders */
  }
  vs_mesh_edges_free(&s);
  row_free(&r);
  free(way);
  return ok;
}
