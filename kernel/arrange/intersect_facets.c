/* Intersects facets that are given by their border edges (sides). The segments and points that two facets share become
 * cuts in both facets.
 *
 * Such a facet may have any outline, with holes, and its corners are exact points. The line of two planes crosses its
 * outline at events, which are sorted along the line. Imagine this line moved up, or down, by a very small distance. A
 * side between a point above the other plane and a point below it, or in it, is where the line moved up enters or
 * leaves the facet. A side between a point below and a point above or in the plane is where the line moved down does.
 * Between two events, the facet covers the line if one of the moved lines is inside. Therefore sides that lie in the
 * other plane, and corners that only touch it, need no special rule. An interval that both facets cover is cut at every
 * event, because each event is a corner of one of them. A new point is an intersection of a side's line and a plane: an
 * edge of the input and a plane, or three planes of the input, after any number of levels.
 *
 * As in intersect_patches.c, threads test pairs in independent chunks, and points are numbered afterwards, chunk by
 * chunk. */
#include "kernel/arrange/intersect_facets.h"

#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <stdlib.h>
#include <string.h>

#define FRESH (UINT32_C(1) << 31)

typedef struct { uint32_t a, b, p, q, cut; } contact; /* Two facets that touch. a, b: indices of the facets. p, q:
                                                       * numbers of the points at the ends of their common segment.
                                                       * `cut`: bit 0: the segment is new in facet a; bit 1: it is new
                                                       * in facet b. */

enum { BREAK = 0, UP = 1, DOWN = 2 };
typedef struct {
  int64_t fixed[3];
  uint32_t id;   /* point number of the event, or FRESH plus an index in `crossings` for a new point */
  uint8_t first, exact; /* first: 1 if the event lies on the outline of the first facet of the pair, 0 for the second;
                         * exact: 1 if the event's fixed-point numbers are exact */
  uint8_t turns; /* Bit UP: the line of the two planes, moved up a little, enters or leaves the facet at this event. Bit
                  * DOWN: it does so when moved down. */
} event;

/* Memory that one thread reuses for all its pairs of facets. */
typedef struct {
  VS_LIST(event) events;
  VS_LIST(vs_fresh_point) crossings; /* new points on the line in which the current two planes intersect */
  VS_LIST(uint32_t) given;           /* given[i]: index of the point crossings[i] among the new points of the task, or
                                      * VS_NONE before it is used */
} working;

typedef struct {
  vs_kernel *k;
  const vs_cluster *c;
  working *w;
  VS_LIST(contact) contacts;
  VS_LIST(vs_fresh_point) fresh;
} chunk;

static const vs_plane *plane_of(const vs_cluster *c, const vs_facet *f) { return &c->planes.all.at[f->plane]; }

/* Computes the point where side s of facet f crosses the plane `through`. The ends of the side lie on different sides
 * of that plane. */
static bool crossing(const vs_cluster *c, const vs_facet *f, const vs_facet_side *s, const vs_plane *through,
    vs_homogeneous *out) {
  if (!(s->line & VS_LINE)) return vs_meet_planes(plane_of(c, f), &c->planes.all.at[s->line], through, out);
  const vs_line *line = &c->lines.at[s->line & ~VS_LINE];
  return vs_meet_edge(line->at[0], line->at[1], through, out);
}

/* Returns true if facet f has corners on both sides of the plane p, or corners in p. */
static bool reaches(const vs_cluster *c, const vs_facet *f, const vs_plane *p) {
  vs_points_view view = vs_points_of(&c->points);
  bool above = false, below = false;
  for (uint32_t i = f[0].first; i < f[1].first; i++) {
    int side = vs_side(view, p, c->sides.at[i].from);
    if (side == 0) return true;
    above |= side > 0;
    below |= side < 0;
    if (above && below) return true;
  }
  return false;
}

static bool push_corner(chunk *m, uint32_t point, uint8_t first, uint8_t turns) {
  const vs_point *p = &m->c->points.all.at[point];
  return VS_PUSH(m->k, m->w->events, ((event){ { p->fixed[0], p->fixed[1], p->fixed[2] }, point, first,
      vs_point_exact(p), turns }));
}

static bool add_events(chunk *m, const vs_facet *f, const vs_facet *other, uint8_t first) {
  const vs_cluster *c = m->c;
  const vs_plane *p = plane_of(c, other);
  vs_points_view view = vs_points_of(&c->points);
  uint32_t known = VS_NONE;
  int side = 0;
  for (uint32_t i = f[0].first; i < f[1].first; i++) {
    const vs_facet_side *s = &c->sides.at[i];
    int from = s->from == known ? side : vs_side(view, p, s->from), to = vs_side(view, p, s->to);
    known = s->to;
    side = to;
    uint8_t turns = (uint8_t)(((from > 0) != (to > 0) ? UP : 0) | ((from < 0) != (to < 0) ? DOWN : 0));
    if (from == 0 && !push_corner(m, s->from, first, BREAK)) return false;
    if (!turns) continue;
    if (from == 0 || to == 0) {
      if (!push_corner(m, from == 0 ? s->from : s->to, first, turns)) return false;
      continue;
    }
    vs_fresh_point x;
    if (!crossing(c, f, s, p, &x.at)) return VS_BROKEN(m->k, "a side and a plane do not meet");
    vs_fresh_fill(&x);
    event e = { { x.fixed[0], x.fixed[1], x.fixed[2] }, FRESH | (uint32_t)m->w->crossings.count, first, x.exact,
        turns };
    if (!VS_PUSH(m->k, m->w->crossings, x) || !VS_PUSH(m->k, m->w->events, e)) return false;
  }
  return true;
}

static void load(const chunk *m, const event *e, vs_homogeneous *out) {
  if (e->id & FRESH) {
    *out = m->w->crossings.at[e->id & ~FRESH].at;
    return;
  }
  const vs_point *p = &m->c->points.all.at[e->id];
  if (vs_point_exact(p)) vs_homogeneous_fixed(p->fixed, out);
  else *out = m->c->points.big.at[p->big];
}

/* Compares the positions of two events on one line along the axis (0, 1 or 2). Returns -1, 1, or 0 if they are one
 * point. */
static int compare(const chunk *m, const event *a, const event *b, int axis) {
  VS_ASSERT(axis >= 0 && axis < 3);
  if (a->fixed[axis] != b->fixed[axis]) return a->fixed[axis] < b->fixed[axis] ? -1 : 1;
  if (a->id == b->id || (a->exact && b->exact)) return 0;
  vs_homogeneous p, q;
  load(m, a, &p);
  load(m, b, &q);
  return vs_homogeneous_compare(&p, &q, axis);
}

static void sort_events(chunk *m, int axis) {
  event *at = m->w->events.at;
  size_t n = m->w->events.count;
  for (size_t gap = n > 32 ? n / 2 : 1; gap && n; gap = gap == 2 ? 1 : (size_t)((double)gap / 2.2))
    for (size_t i = gap; i < n; i++) {
      event x = at[i];
      size_t j = i;
      for (; j >= gap && compare(m, &x, &at[j - gap], axis) < 0; j -= gap) at[j] = at[j - gap];
      at[j] = x;
    }
}

/* Returns a coordinate axis that is not perpendicular to the intersection line of the planes p and q. The planes are
 * not parallel. */
static int axis_of(const vs_plane *p, const vs_plane *q) {
  double most = -1;
  int best = 0;
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    vs_i128 d = (vs_i128)p->n[u] * q->n[v] - (vs_i128)p->n[v] * q->n[u];
    double size = d < 0 ? -(double)d : (double)d;
    if (size > most) most = size, best = i;
  }
  return best;
}

/* Sets *id to the point number of event e. If the point is new, it is added to the chunk's new points. */
static bool name(chunk *m, const event *e, uint32_t *id) {
  *id = e->id;
  if (!(e->id & FRESH)) return true;
  uint32_t *given = &m->w->given.at[e->id & ~FRESH];
  if (*given == VS_NONE) {
    *given = (uint32_t)m->fresh.count;
    if (!VS_PUSH(m->k, m->fresh, m->w->crossings.at[e->id & ~FRESH])) return false;
  }
  *id = FRESH | *given;
  return true;
}

/* Returns true if the segment from p to q is new for facet f: neither a side nor a corner of f. */
static bool is_new(const vs_cluster *c, const vs_facet *f, uint32_t p, uint32_t q) {
  if ((p | q) & FRESH) return true;
  for (uint32_t i = f[0].first; i < f[1].first; i++) {
    const vs_facet_side *s = &c->sides.at[i];
    if ((s->from == p && (p == q || s->to == q)) || (s->from == q && s->to == p)) return false;
  }
  return true;
}

static bool add_contact(chunk *m, uint32_t a, uint32_t b, const event *from, const event *to) {
  const vs_cluster *c = m->c;
  uint32_t p, q;
  if (!name(m, from, &p) || !name(m, to, &q)) return false;
  uint32_t cut = (uint32_t)is_new(c, &c->facets.at[a], p, q) | (uint32_t)is_new(c, &c->facets.at[b], p, q) << 1;
  return !cut || VS_PUSH(m->k, m->contacts, ((contact){ a, b, p, q, cut }));
}

/* Returns the first event from index i on, and skips the events at the same point. Among the events at this point,
 * prefers one whose point already has a number. *end: index after the last event at this point. */
static event *gather(chunk *m, size_t i, int axis, size_t *end) {
  event *at = m->w->events.at, *best = &at[i];
  VS_ASSERT(i < m->w->events.count);
  for (*end = i + 1; *end < m->w->events.count && compare(m, &at[i], &at[*end], axis) == 0; ++*end)
    if (best->id & FRESH && !(at[*end].id & FRESH)) best = &at[*end];
  return best;
}

static bool share(chunk *m, uint32_t a, uint32_t b) {
  const vs_cluster *c = m->c;
  const vs_facet *f = &c->facets.at[a], *g = &c->facets.at[b];
  if (!reaches(c, f, plane_of(c, g)) || !reaches(c, g, plane_of(c, f))) return true;
  m->w->events.count = m->w->crossings.count = 0;
  if (!add_events(m, f, g, 1) || !add_events(m, g, f, 0)) return false;
  size_t n = m->w->events.count;
  if (!VS_ROOM(m->k, m->w->given.at, m->w->given.room, m->w->crossings.count + 1)) return false;
  for (size_t i = 0; i < m->w->crossings.count; i++) m->w->given.at[i] = VS_NONE;
  int axis = axis_of(plane_of(c, f), plane_of(c, g));
  sort_events(m, axis);
  uint8_t in[2] = { 0, 0 }; /* in[f] for facet f of the pair: bit UP is set if the line of the two planes, moved up a
                             * little, is inside the facet; bit DOWN if it is inside when moved down */
  bool covered = false;     /* true if both facets of the pair contain the interval of their common line directly before
                             * this event */
  event before = { .id = VS_NONE };
  for (size_t i = 0, end; i < n; i = end) {
    const event here = *gather(m, i, axis, &end);
    bool touches[2] = { in[0] != 0, in[1] != 0 };
    if (covered && !add_contact(m, a, b, &before, &here)) return false;
    for (size_t j = i; j < end; j++) {
      const event *e = &m->w->events.at[j];
      in[e->first] ^= e->turns;
      touches[e->first] = true;
    }
    bool goes_on = in[0] && in[1];
    if (!covered && !goes_on && touches[0] && touches[1] && !add_contact(m, a, b, &here, &here)) return false;
    covered = goes_on;
    before = here;
  }
  return (!in[0] && !in[1]) || VS_BROKEN(m->k, "an outline is open");
}

static bool meet(void *context, uint32_t a, uint32_t b) {
  chunk *m = context;
  if (a > b) {
    uint32_t t = a;
    a = b;
    b = t;
  }
  if (!vs_kernel_poll(m->k, m->k->part)) return false;
  if (m->c->facets.at[a].plane == m->c->facets.at[b].plane)
    return VS_PUSH(m->k, m->contacts, ((contact){ a, b, 0, 0, 0 }));
  return share(m, a, b);
}

typedef struct {
  vs_cluster *c;
  vs_points_table points; /* new points of all tasks; the points of the cluster itself do not change while threads
                           * work */
  vs_bvh bvh;
  VS_LIST(vs_bvh_box) boxes;
  VS_LIST(uint32_t) families, group, ids;
  chunk chunks[VS_PIPELINE_WINDOW];
  working *works; /* array with the working memory of each thread */
} meeting;

enum { CHUNK = 64 }; /* number of blocks of the tree of boxes in which one task searches pairs of facets */

static bool meet_chunk(vs_kernel *k, void *context, size_t index) {
  meeting *all = context;
  chunk *m = &all->chunks[index % VS_PIPELINE_WINDOW];
  m->k = k;
  m->c = all->c;
  m->w = &all->works[k->worker];
  m->contacts.count = m->fresh.count = 0;
  return vs_bvh_pairs(k, &all->bvh, (uint32_t)index * CHUNK, (uint32_t)(index + 1) * CHUNK, meet, m) &&
      vs_kernel_report(k, k->part);
}

static bool leave(vs_kernel *k, vs_cluster *c, uint32_t facet, uint32_t p, uint32_t q, uint32_t plane) {
  c->facets.at[facet].touched = true;
  return VS_PUSH(k, c->cuts, ((vs_facet_cut){ facet, p, q, plane }));
}

static bool absorb(vs_kernel *k, void *context, size_t index) {
  meeting *m = context;
  vs_cluster *c = m->c;
  const chunk *from = &m->chunks[index % VS_PIPELINE_WINDOW];
  if (!VS_ROOM(k, m->ids.at, m->ids.room, from->fresh.count + 1) ||
      !vs_points_add_all(k, &m->points, &c->points, from->fresh.at, from->fresh.count, m->ids.at))
    return false;
  for (size_t i = 0; i < from->contacts.count; i++) {
    const contact *x = &from->contacts.at[i];
    if (!x->cut) {
      c->facets.at[x->a].touched = c->facets.at[x->b].touched = true;
      vs_unite(m->group.at, x->a, x->b);
      continue;
    }
    uint32_t p = x->p & FRESH ? m->ids.at[x->p & ~FRESH] : x->p, q = x->q & FRESH ? m->ids.at[x->q & ~FRESH] : x->q;
    if ((x->cut & 1 && !leave(k, c, x->a, p, q, c->facets.at[x->b].plane)) ||
        (x->cut & 2 && !leave(k, c, x->b, p, q, c->facets.at[x->a].plane)))
      return false;
  }
  return true;
}

static bool index_facets(vs_kernel *k, meeting *m) {
  const vs_cluster *c = m->c;
  uint32_t n = (uint32_t)c->facets.count;
  if (!VS_ROOM(k, m->boxes.at, m->boxes.room, (size_t)n + 1) ||
      !VS_ROOM(k, m->families.at, m->families.room, (size_t)n + 1) ||
      !VS_ROOM(k, m->group.at, m->group.room, (size_t)n + 1))
    return false;
  vs_disjoint(m->group.at, n);
  for (uint32_t f = 0; f < n; f++) {
    vs_bvh_box *b = &m->boxes.at[f];
    *b = vs_box_nowhere;
    for (uint32_t i = c->facets.at[f].first; i < c->facets.at[f + 1].first; i++) {
      vs_box_add_point(b, &c->points.all.at[c->sides.at[i].from]);
    }
    m->families.at[f] = c->facets.at[f].place;
  }
  m->bvh.families = m->families.at;
  return vs_bvh_build(k, &m->bvh, m->boxes.at, n);
}

bool vs_meet_facets(vs_kernel *k, vs_cluster *c) {
  meeting m = { .c = c };
  size_t works = 0;
  bool ok = VS_ROOM(k, m.works, works, k->threads);
  if (ok) memset(m.works, 0, works * sizeof *m.works);
  ok = ok && index_facets(k, &m) &&
      vs_kernel_pipeline(k, ((size_t)vs_bvh_blocks(&m.bvh) + CHUNK - 1) / CHUNK, meet_chunk, absorb, &m) &&
      vs_points_append(k, &c->points, &m.points);
  for (uint32_t i = 0; ok && i < c->facets.count; i++) c->facets.at[i].group = vs_find(m.group.at, i);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(k, m.chunks[i].contacts);
    VS_DROP(k, m.chunks[i].fresh);
  }
  for (size_t i = 0; i < works; i++) {
    VS_DROP(k, m.works[i].events);
    VS_DROP(k, m.works[i].crossings);
    VS_DROP(k, m.works[i].given);
  }
  VS_FREE(k, m.works, works);
  VS_DROP(k, m.boxes);
  VS_DROP(k, m.families);
  VS_DROP(k, m.group);
  VS_DROP(k, m.ids);
  vs_points_free(k, &m.points);
  vs_bvh_free(k, &m.bvh);
  return ok;
}
