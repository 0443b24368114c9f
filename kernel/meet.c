/* Owns the meeting of patches: finds every pair that touches and leaves in both facets the segments or point they share.
 *
 * Two patches in different planes share a segment whose ends are corners or edges of one that lie in the other. Each such end is decided by
 * integer predicates before it gets a point, so pairs that only come near cost no wide arithmetic, and a segment well inside a lid gets none. A contact
 * that is a corner or a whole boundary edge of a patch already is nothing new for that patch. Patches of one plane unite their facets into a group.
 * Patches of one leaf are treated as any others, unless it is a star on the grid: it may cross itself, or rounding may have folded it.
 *
 * Pairs are found and decided in chunks that do not know of each other; points are numbered afterwards, chunk by chunk: one result for any number of
 * threads. */
#include "kernel/cluster.h"

#include <string.h>

typedef struct { uint32_t point, fresh; } end; /* fresh: where point is VS_NONE */
typedef struct { uint32_t a, b, first, count; } contact; /* count 0: coplanar, the facets go together */

/* Whether an edge goes through a patch is asked by both of the triangles that have it, mostly soon after each other. */
typedef struct {
  uint32_t low, high, patch; /* the edge's corners, and what it may go through */
  uint32_t fresh;            /* its point's number in the chunk; or: */
} crossing;
enum { CROSSINGS = 1 << 12 };
#define PAST UINT32_MAX           /* beside the patch */
#define THROUGH (UINT32_MAX - 1)  /* has no point yet */
#define NEW (UINT32_MAX - 2)      /* not asked before */

/* What a thread works with. */
typedef struct {
  VS_LIST(int8_t) side_a, side_b;   /* of a pair's corners */
  VS_LIST(crossing) crossings;      /* the last ones, each in its place by a hash */
} working;

typedef struct {
  vs_kernel *k;
  const vs_cluster *c;
  working *w;
  VS_LIST(contact) contacts;
  VS_LIST(end) ends;
  VS_LIST(vs_fresh_point) fresh;
  VS_LIST(vs_edge) edges;         /* that those are on */
  double span[2][3];              /* the first and last end of the pair at hand, in steps */
} chunk;

static const vs_patch_corner *corners(const vs_cluster *c, const vs_patch *p) { return c->patch_corners.at + p->first; }

static int orient2(const int32_t a[3], const int32_t b[3], const int32_t c[3], const vs_plane *p) {
  int64_t ax = (int64_t)b[p->u] - a[p->u], ay = (int64_t)b[p->v] - a[p->v], bx = (int64_t)c[p->u] - a[p->u], by = (int64_t)c[p->v] - a[p->v];
  int64_t s = ax * by - ay * bx;
  return (s > 0) - (s < 0);
}

static bool corner_of(const vs_cluster *c, const vs_patch *p, uint32_t id) {
  const vs_patch_corner *x = corners(c, p);
  for (uint32_t i = 0; i < p->count; i++)
    if (x[i].point == id) return true;
  return false;
}

/* Which edge of the patch runs between the corners p and q; VS_NONE: none. */
static uint32_t edge_of(const vs_cluster *c, const vs_patch *x, uint32_t p, uint32_t q) {
  const vs_patch_corner *at = corners(c, x);
  for (uint32_t i = 0; i < x->count; i++) {
    uint32_t a = at[i].point, b = at[i + 1 == x->count ? 0 : i + 1].point;
    if ((a == p && b == q) || (a == q && b == p)) return i;
  }
  return VS_NONE;
}

/* ---- a pair, within a chunk ---- */

static vs_i128 height(const vs_plane *p, const int32_t at[3]) {
  return (vs_i128)p->n[0] * at[0] + (vs_i128)p->n[1] * at[1] + (vs_i128)p->n[2] * at[2] - p->d;
}

/* Sides of a's corners against b's plane; false where all are strictly on one. */
static bool sides(chunk *m, const vs_patch *a, const vs_plane *p, int8_t *out) {
  const vs_patch_corner *at = corners(m->c, a);
  bool above = false, below = false;
  for (uint32_t i = 0; i < a->count; i++) {
    int s = vs_sign128(height(p, at[i].at));
    out[i] = (int8_t)s;
    above = above || s >= 0;
    below = below || s <= 0;
  }
  return above && below;
}

static void widen(chunk *m, const double at[3], uint32_t count) {
  for (int i = 0; i < 3; i++) m->span[count ? 1 : 0][i] = at[i];
}

static crossing *crossing_of(chunk *m, uint32_t p, uint32_t q, uint32_t patch) {
  uint32_t low = p < q ? p : q, high = p < q ? q : p;
  uint64_t hash = (((uint64_t)low << 32 | high) ^ (uint64_t)patch * 0xd6e8feb86659fd93u) * 0x9e3779b97f4a7c15u;
  crossing *x = &m->w->crossings.at[hash >> 40 & (m->w->crossings.count - 1)];
  if (x->low != low || x->high != high || x->patch != patch) *x = (crossing){ low, high, patch, NEW };
  return x;
}

/* The ends of a's crossing with b's plane that lie in b; second: a is the pair's second. */
static bool ends(chunk *m, const vs_patch *a, const int8_t *side, const vs_patch *b, uint32_t first, uint32_t second) {
  const vs_cluster *c = m->c;
  const vs_plane *plane = &c->planes.all.at[b->plane];
  const vs_patch_corner *x = corners(c, a), *y = corners(c, b);
  int turn = b->flip ? -1 : 1;
  for (uint32_t i = 0; i < a->count; i++) {
    uint32_t j = i + 1 == a->count ? 0 : i + 1;
    if (side[i] == 0) {
      bool inside = true;
      for (uint32_t e = 0; inside && e < b->count; e++)
        inside = y[e].point == x[i].point || orient2(y[e].at, y[e + 1 == b->count ? 0 : e + 1].at, x[i].at, plane) * turn >= 0;
      if (!inside) continue;
      bool known = false;
      for (size_t e = first; e < m->ends.count; e++) known = known || m->ends.at[e].point == x[i].point;
      double at[3] = { x[i].at[0], x[i].at[1], x[i].at[2] };
      if (known) continue;
      widen(m, at, (uint32_t)m->ends.count - first);
      if (!VS_PUSH(m->k, m->ends, ((end){ x[i].point, VS_NONE }))) return false;
    } else if (side[i] * side[j] < 0) {
      crossing *known = crossing_of(m, x[i].point, x[j].point, (uint32_t)(b - c->patches.at));
      if (known->fresh == PAST) continue;
      double u = (double)height(plane, x[i].at), v = (double)height(plane, x[j].at), t = u / (u - v), at[3];
      for (int e = 0; e < 3; e++) at[e] = x[i].at[e] + t * ((double)x[j].at[e] - x[i].at[e]); /* right to 2^-24 steps: u and v are but for rounding */
      bool inside = true, asked = known->fresh == NEW;
      for (uint32_t e = 0; asked && inside && e < b->count; e++) {
        const int32_t *p = y[e].at, *q = y[e + 1 == b->count ? 0 : e + 1].at;
        double left = (((double)q[plane->u] - p[plane->u]) * (at[plane->v] - p[plane->v]) - ((double)q[plane->v] - p[plane->v]) * (at[plane->u] - p[plane->u])) * turn;
        if (left > 64) continue; /* its error is below 2^27 * 2^-24 twice */
        inside = left >= -64 && vs_orient3d(x[i].at, x[j].at, p, q) * side[i] * turn <= 0;
      }
      if (asked) known->fresh = inside ? THROUGH : PAST;
      if (!inside) continue;
      widen(m, at, (uint32_t)m->ends.count - first);
      if (!VS_PUSH(m->k, m->ends, ((end){ VS_NONE, i << 1 | second }))) return false; /* made into a point below */
    }
  }
  return true;
}

/* Coplanar patches: do they touch in more than corners and edges that both have? */
static bool overlap(const vs_cluster *c, const vs_patch *a, const vs_patch *b) {
  const vs_plane *plane = &c->planes.all.at[a->plane];
  const vs_patch *t[2] = { a, b };
  bool apart = false;
  for (int s = 0; s < 2; s++) {
    const vs_patch_corner *x = corners(c, t[s]), *y = corners(c, t[!s]);
    int turn = t[s]->flip ? -1 : 1;
    for (uint32_t i = 0; i < t[s]->count; i++) {
      uint32_t j = i + 1 == t[s]->count ? 0 : i + 1;
      bool outside = true, trivial = true;
      for (uint32_t e = 0; outside && e < t[!s]->count; e++) {
        int side = orient2(x[i].at, x[j].at, y[e].at, plane) * turn;
        outside = side <= 0;
        if (side == 0 && y[e].point != x[i].point && y[e].point != x[j].point) trivial = false;
      }
      if (outside && trivial) return false;
      apart = apart || outside;
    }
  }
  return !(apart && a->facet == b->facet);
}

/* Triangles of one leaf in different planes, that share corners as neighbours do: are these all they share? Those with an edge in common share the line of
 * their planes, and so the edge alone; with one corner, where the rest of one lies to one side of the other. Only where it is quick to say. */
static bool only_neighbours(const vs_cluster *c, const vs_patch *a, const vs_patch *b) {
  if (a->count != 3 || b->count != 3) return false;
  const vs_patch_corner *x = corners(c, a), *y = corners(c, b);
  uint32_t shared = 0, in_a = 0, in_b = 0; /* bits of corners */
  for (uint32_t i = 0; i < 3; i++)
    for (uint32_t j = 0; j < 3; j++)
      if (x[i].point == y[j].point) shared++, in_a |= 1u << i, in_b |= 1u << j;
  static const uint8_t edge[8] = { [3] = 1, [6] = 2, [5] = 4 }; /* of two corners: the bit of the edge between */
  if (shared == 2) return !(a->inner & edge[in_a]) && !(b->inner & edge[in_b]);
  if (shared != 1) return false;
  for (int side = 0; side < 2; side++) {
    const vs_plane *p = &c->planes.all.at[side ? b->plane : a->plane];
    const vs_patch_corner *at = side ? x : y;
    uint32_t own = side ? in_a : in_b, i = own == 1 ? 1 : 0, j = own == 4 ? 1 : 2;
    if (vs_sign128(height(p, at[i].at)) * vs_sign128(height(p, at[j].at)) > 0) return true;
  }
  return false;
}

static bool meet(void *context, uint32_t first, uint32_t second) {
  chunk *m = context;
  const vs_cluster *c = m->c;
  if (first > second) { /* points are numbered in an order that does not depend on the index */
    uint32_t t = first;
    first = second;
    second = t;
  }
  const vs_patch *a = &c->patches.at[first], *b = &c->patches.at[second];
  if (!vs_kernel_poll(m->k, 0.1)) return false;
  uint32_t base = (uint32_t)m->ends.count;
  if (a->place == b->place && a->plane != b->plane && only_neighbours(c, a, b)) return true;
  if (a->plane == b->plane) return !overlap(c, a, b) || VS_PUSH(m->k, m->contacts, ((contact){ first, second, base, 0 }));
  if (!VS_ROOM(m->k, m->w->side_a.at, m->w->side_a.room, a->count) || !VS_ROOM(m->k, m->w->side_b.at, m->w->side_b.room, b->count)) return false;
  if (!sides(m, b, &c->planes.all.at[a->plane], m->w->side_b.at) || !sides(m, a, &c->planes.all.at[b->plane], m->w->side_a.at)) return true;
  if (!ends(m, a, m->w->side_a.at, b, base, 0) || !ends(m, b, m->w->side_b.at, a, base, 1)) return false;
  uint32_t count = (uint32_t)m->ends.count - base;
  if (count == 0) return true;
  if (a->place != b->place) {
    const double *p = m->span[0], *q = m->span[count > 1];
    if (count <= 2 && vs_cull_segment(c, a->place, b->place, p, q)) {
      m->ends.count = base;
      return true;
    }
  }
  for (uint32_t i = base; i < base + count; i++) {
    end *e = &m->ends.at[i];
    if (e->point != VS_NONE) continue;
    const vs_patch *from = e->fresh & 1 ? b : a, *through = e->fresh & 1 ? a : b;
    uint32_t at = e->fresh >> 1;
    const vs_patch_corner *x = corners(c, from);
    const vs_patch_corner *p = &x[at], *q = &x[at + 1 == from->count ? 0 : at + 1];
    crossing *known = crossing_of(m, p->point, q->point, e->fresh & 1 ? first : second);
    if (known->fresh < m->fresh.count) {
      e->fresh = known->fresh;
      continue;
    }
    vs_fresh_point made;
    if (!vs_meet_edge(p->at, q->at, &c->planes.all.at[through->plane], &made.at))
      return VS_BROKEN(m->k, "an edge and a plane do not meet");
    vs_fresh_fill(&made);
    e->fresh = known->fresh = (uint32_t)m->fresh.count;
    vs_edge edge = { p->point < q->point ? p->point : q->point, p->point < q->point ? q->point : p->point };
    if (!VS_PUSH(m->k, m->fresh, made) || !VS_PUSH(m->k, m->edges, edge)) return false;
  }
  return VS_PUSH(m->k, m->contacts, ((contact){ first, second, base, count }));
}

/* ---- the chunks together ---- */

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  uint32_t *group; /* union-find over facets */
  VS_LIST(uint32_t) line; /* the points of a contact, in order along it */
  VS_LIST(uint32_t) ids;  /* of a chunk's fresh points */
  chunk chunks[VS_PIPELINE_WINDOW];
  working *works; /* one a thread */
} meeting;

static bool leave(meeting *m, const vs_patch *t, uint32_t p, uint32_t q, uint32_t plane) {
  if (p == q ? corner_of(m->c, t, p) : false) return true;
  uint32_t edge = edge_of(m->c, t, p, q);
  if (edge != VS_NONE && !(edge < 3 && (t->inner >> edge & 1))) return true;
  m->c->facets.at[t->facet].touched = true;
  return VS_PUSH(m->k, m->c->cuts, ((vs_cut){ t->facet, p, q, plane }));
}

static bool absorb(vs_kernel *k, void *context, size_t index) {
  meeting *m = context;
  vs_cluster *c = m->c;
  const chunk *from = &m->chunks[index % VS_PIPELINE_WINDOW];
  if (!VS_ROOM(k, m->ids.at, m->ids.room, from->fresh.count + 1) ||
      !vs_points_add_all(k, &c->points, NULL, from->fresh.at, from->fresh.count, m->ids.at) ||
      !VS_ROOM(k, c->edge_of.at, c->edge_of.room, c->points.all.count))
    return false;
  for (; c->edge_of.count < c->points.all.count;) c->edge_of.at[c->edge_of.count++] = (vs_edge){ 0, 0 };
  for (size_t i = 0; i < from->fresh.count; i++) c->edge_of.at[m->ids.at[i]] = from->edges.at[i];
  for (size_t i = 0; i < from->contacts.count; i++) {
    const contact *x = &from->contacts.at[i];
    const vs_patch *a = &c->patches.at[x->a], *b = &c->patches.at[x->b];
    if (x->count == 0) {
      c->facets.at[a->facet].touched = c->facets.at[b->facet].touched = true;
      vs_unite(m->group, a->facet, b->facet);
      continue;
    }
    m->line.count = 0;
    for (uint32_t j = x->first; j < x->first + x->count; j++) {
      uint32_t id = from->ends.at[j].point == VS_NONE ? m->ids.at[from->ends.at[j].fresh] : from->ends.at[j].point;
      bool known = false;
      for (size_t e = 0; e < m->line.count; e++) known = known || m->line.at[e] == id;
      if (!known && !VS_PUSH(m->k, m->line, id)) return false;
    }
    uint32_t n = (uint32_t)m->line.count, *line = m->line.at;
    if (n > 2) { /* corners in one line: sort along an axis in which they differ */
      vs_points_view view = vs_points_of(&c->points);
      int axis = 0;
      while (axis < 2 && vs_compare(view, line[0], line[1], axis) == 0) axis++;
      for (uint32_t j = 1; j < n; j++) {
        uint32_t id = line[j], to = j;
        for (; to > 0 && vs_compare(view, line[to - 1], id, axis) > 0; to--) line[to] = line[to - 1];
        line[to] = id;
      }
    }
    for (uint32_t j = 0; j == 0 || j + 1 < n; j++) {
      uint32_t p = line[j], q = line[n > 1 ? j + 1 : j];
      if (!leave(m, a, p, q, b->plane) || !leave(m, b, p, q, a->plane)) return false;
    }
  }
  return true;
}

enum { CHUNK = 256 }; /* blocks of the index */

static bool meet_chunk(vs_kernel *k, void *context, size_t index) {
  meeting *all = context;
  chunk *m = &all->chunks[index % VS_PIPELINE_WINDOW];
  m->k = k;
  m->c = all->c;
  m->w = &all->works[k->worker];
  m->contacts.count = m->ends.count = m->fresh.count = m->edges.count = 0;
  uint32_t first = (uint32_t)index * CHUNK, blocks = vs_bvh_blocks(&all->c->bvh) - first;
  size_t crossings = 64;
  while (crossings < CROSSINGS && crossings < 32 * (size_t)blocks) crossings *= 2;
  if (!VS_ROOM(k, m->w->crossings.at, m->w->crossings.room, crossings)) return false;
  memset(m->w->crossings.at, 0xff, crossings * sizeof *m->w->crossings.at); /* nobody's: what a chunk finds depends on itself alone */
  m->w->crossings.count = crossings;
  return vs_bvh_pairs(&all->c->bvh, first, first + CHUNK, meet, m) && vs_kernel_report(k, 0.1);
}

bool vs_meet_patches(vs_kernel *k, vs_cluster *c) {
  meeting m = { .k = k, .c = c };
  size_t room = 0, works = 0;
  bool ok = VS_ROOM(k, m.group, room, c->facets.count + 1) && VS_ROOM(k, m.works, works, k->threads);
  if (ok) memset(m.works, 0, works * sizeof *m.works);
  if (ok) vs_disjoint(m.group, (uint32_t)c->facets.count);
  ok = ok && vs_kernel_pipeline(k, ((size_t)vs_bvh_blocks(&c->bvh) + CHUNK - 1) / CHUNK, meet_chunk, absorb, &m);
  for (uint32_t i = 0; ok && i < c->facets.count; i++) c->facets.at[i].group = vs_find(m.group, i);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(k, m.chunks[i].contacts);
    VS_DROP(k, m.chunks[i].ends);
    VS_DROP(k, m.chunks[i].fresh);
    VS_DROP(k, m.chunks[i].edges);
  }
  for (size_t i = 0; i < works; i++) {
    VS_DROP(k, m.works[i].side_a);
    VS_DROP(k, m.works[i].side_b);
    VS_DROP(k, m.works[i].crossings);
  }
  VS_FREE(k, m.works, works);
  VS_DROP(k, m.line);
  VS_DROP(k, m.ids);
  VS_FREE(k, m.group, room);
  return ok;
}
