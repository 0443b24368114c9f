/* Proves that triangles around a hub have only those corners and edges in common that the mesh gives them. A hub is a
 * corner of more than MANY triangles.
 *
 * The boxes of these triangles all intersect at the hub. A test of every pair would take n^2 steps, for example for the
 * tip of a cone. But triangles with a common corner intersect elsewhere only if the angles that they fill at this
 * corner overlap. Let p and q be the other two corners of a triangle, relative to the hub, and d a direction. If det(p,
 * q, d) > 0, then the triangle as seen along d fills an angle between 0 and half a turn, counter-clockwise from p to q.
 * The proof succeeds if this holds for all triangles, each triangle follows another along an edge, and the angles sum
 * to one turn. Then no two of the triangles overlap. d is the mean normal. A determinant must exceed its possible
 * error. The sum of the angles is a multiple of a turn, so it is rounded to a whole number of turns. The proof takes
 * one pass around the hub, and n log n steps to sort the triangles. Pairs without a proof are tested individually.
 *
 * The boxes of a cone within another cone intersect, too. If the triangles around a hub bend the same way everywhere,
 * they bound a convex cone. Any triangle whose corners lie inside this cone is apart from all its triangles. A corner
 * is inside if it is on the inner side of the triangle in front of it, as seen along d. The angle of the corner about d
 * determines this triangle. Hubs that lie within each other become one family, again in n log n steps. */
#include "kernel/mesh/hubs.h"

#include <math.h>
#include <string.h>

enum { MANY = 64 };

/* A triangle at a hub (a corner of very many triangles). next, last: the triangle's other two corners, in its order
 * after the hub. */
typedef struct { uint32_t hub, triangle, next, last; } spoke;

typedef struct {
  const vs_fans *m;
  VS_LIST(uint32_t) count; /* count[v]: number of triangles at vertex v */
  VS_LIST(spoke) spokes;
  VS_LIST(uint32_t) order, scratch; /* order: indices of the spokes (triangles at hubs), sorted by hub and then by the
                                     * triangle's next corner; scratch: memory for the sort */
} search;

static bool before(const void *context, uint32_t a, uint32_t b) {
  const spoke *x = &((const search *)context)->spokes.at[a], *y = &((const search *)context)->spokes.at[b];
  return x->hub != y->hub ? x->hub < y->hub : x->next < y->next;
}

static const spoke *at(const search *c, size_t i) { return &c->spokes.at[c->order.at[i]]; }

/* Returns the spoke (triangle at a hub) in the range [first, end) of `order` whose next corner is `corner`. Its
 * triangle is the neighbour along the edge from the hub to that corner. Returns NULL if there is no such spoke, or
 * several. */
static const spoke *following(const search *c, size_t first, size_t end, uint32_t corner) {
  size_t low = first, high = end;
  VS_ASSERT(first <= end && end <= c->order.count);
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (at(c, middle)->next < corner) low = middle + 1;
    else high = middle;
  }
  if (low == end || at(c, low)->next != corner || (low + 1 < end && at(c, low + 1)->next == corner)) return NULL;
  return at(c, low);
}

/* Returns true if det(p, q, d) is above 0 by more than its possible rounding error: seen along d, the turn from p to q
 * is counter-clockwise. */
static bool turns(vs_vec3 p, vs_vec3 q, vs_vec3 d) {
  double size = (fabs(p.y * q.z) + fabs(p.z * q.y)) * fabs(d.x) + (fabs(p.z * q.x) + fabs(p.x * q.z)) * fabs(d.y) +
      (fabs(p.x * q.y) + fabs(p.y * q.x)) * fabs(d.z);
  return vs_v3_dot(vs_v3_cross(p, q), d) > 1e-14 * size;
}

/* Returns true if the triangles with the indices [first, end) in `order` surround their common hub exactly once. The
 * range is not empty. */
static bool goes_round_once(const search *c, size_t first, size_t end) {
  const vs_fans *m = c->m;
  vs_vec3 hub = m->corner(m->context, at(c, first)->hub), d = vs_v3(0, 0, 0);
  VS_ASSERT(first < end);
  for (size_t i = first; i < end; i++) {
    vs_vec3 p = vs_v3_sub(m->corner(m->context, at(c, i)->next), hub);
    vs_vec3 q = vs_v3_sub(m->corner(m->context, at(c, i)->last), hub);
    d = vs_v3_add(d, vs_v3_unit(vs_v3_cross(p, q)));
  }
  d = vs_v3_unit(d);
  double sum = 0;
  const spoke *begin = at(c, first), *x = begin;
  for (size_t i = first; i < end; i++) {
    vs_vec3 p = vs_v3_sub(m->corner(m->context, x->next), hub), q = vs_v3_sub(m->corner(m->context, x->last), hub);
    if (!turns(p, q, d)) return false;
    sum += atan2(vs_v3_dot(vs_v3_cross(p, q), d), vs_v3_dot(p, q) - vs_v3_dot(p, d) * vs_v3_dot(q, d));
    x = following(c, first, end, x->last);
    if (!x || (x == begin) != (i + 1 == end)) return false; /* the triangles at the hub form several fans, or a fan that
                                                             * does not close */
  }
  return fabs(sum - 6.283185307179586) < 1;
}

/* Makes a spoke for each triangle corner at a hub. A spoke is a list entry for a triangle; a hub is a vertex of very
 * many triangles. */
static bool find_spokes(vs_kernel *k, search *c) {
  const vs_fans *m = c->m;
  for (uint32_t t = 0; t < m->triangle_count; t++)
    for (uint32_t j = 0; j < 3 && !(m->gone && m->gone[t]); j++) {
      const uint32_t *v = m->triangles[t];
      if (c->count.at[v[j]] <= MANY) continue;
      spoke made = { v[j], t, v[j == 2 ? 0 : j + 1], v[j == 0 ? 2 : j - 1] };
      if (!VS_PUSH(k, c->spokes, made) || !VS_PUSH(k, c->order, (uint32_t)c->spokes.count - 1)) return false;
    }
  if (!VS_ROOM(k, c->scratch.at, c->scratch.room, c->order.count + 1)) return false;
  vs_kernel_sort(c->order.at, c->scratch.at, c->order.count, before, c);
  return vs_kernel_report(k, k->part);
}

/* Returns the number of edges that two triangles around one hub (a vertex of very many triangles) share. The search for
 * pairs of boxes omits such triangles, so it does not count these edges. */
static size_t edges_within(const search *c, const vs_hubs *hubs, size_t first, size_t end) {
  size_t edges = 0;
  for (size_t i = first; i < end; i++) {
    const spoke *x = at(c, i), *next = hubs->of.at[x->triangle] == x->hub ? following(c, first, end, x->last) : NULL;
    edges += next && hubs->of.at[next->triangle] == x->hub;
  }
  return edges;
}

/* Returns the index in `order` after the last triangle of a hub: the hub of the triangle at index i. */
static size_t end_of_hub(const search *c, size_t i) {
  size_t end = i + 1;
  VS_ASSERT(i < c->order.count);
  while (end < c->order.count && at(c, end)->hub == at(c, i)->hub) end++;
  return end;
}

/* ---- hubs within the cones of other hubs ---- */

enum { NESTED = 64 }; /* greatest number of hubs (vertices of very many triangles) whose cones are tested against each
                       * other */

/* A hub (vertex of very many triangles) and the cone that its triangles bound. The cone's edges are in order and
 * relative to the hub. */
typedef struct {
  vs_vec3 hub, d, u, v; /* hub: position of the cone's tip; d: unit vector along the cone's axis; u, v: unit vectors
                         * perpendicular to d */
  double side;          /* 1 if the cone opens from its tip in the direction d, -1 if it opens in the opposite
                         * direction */
  size_t first, count;  /* first, count: range of the cone's edges in the arrays of edges and of their angles */
  bool convex;
} cone;
typedef struct {
  VS_LIST(vs_vec3) edges;
  VS_LIST(vs_vec3) corners;
  VS_LIST(double) angles;
  VS_LIST(cone) cones;
} cones;

static int turn_of(vs_vec3 p, vs_vec3 q, vs_vec3 d) { return turns(p, q, d) ? 1 : turns(q, p, d) ? -1 : 0; }

/* Returns true if place x is on the inner side of the triangle between edge i of cone w and the next edge, by more than
 * rounding errors. x is relative to the hub. */
static bool under(const cones *c, const cone *w, size_t i, vs_vec3 x) {
  return turn_of(c->edges.at[w->first + i % w->count], c->edges.at[w->first + (i + 1) % w->count], x) == w->side;
}

static double angle_of(const cone *w, vs_vec3 x) { return atan2(vs_v3_dot(x, w->v), vs_v3_dot(x, w->u)); }

/* Adds the cone around a hub (vertex). Its triangles, with the indices [first, end) in the search's `order`, surround
 * it once. Sets the cone's member `convex`. Returns false when memory is out. */
static bool make_cone(vs_kernel *k, const search *s, size_t first, size_t end, cones *c) {
  cone w = { .hub = s->m->corner(s->m->context, at(s, first)->hub), .first = c->edges.count };
  for (size_t i = first; i < end; i++)
    w.d = vs_v3_add(w.d, vs_v3_unit(vs_v3_cross(vs_v3_sub(s->m->corner(s->m->context, at(s, i)->next), w.hub),
                                                vs_v3_sub(s->m->corner(s->m->context, at(s, i)->last), w.hub))));
  w.d = vs_v3_unit(w.d);
  const spoke *x = at(s, first);
  for (size_t i = first; i < end; i++, x = following(s, first, end, x->last)) {
    vs_vec3 far = s->m->corner(s->m->context, x->next);
    if (!VS_PUSH(k, c->corners, far) || !VS_PUSH(k, c->edges, vs_v3_sub(far, w.hub))) return false;
  }
  const vs_vec3 *p = c->edges.at + w.first;
  size_t n = w.count = end - first;
  w.side = vs_v3_dot(p[0], w.d) > 0 ? 1 : -1;
  w.convex = true;
  for (size_t i = 0; w.convex && i < n; i++) {
    double along = vs_v3_dot(p[i], w.d) * w.side;
    w.convex = along > 1e-14 * (fabs(p[i].x * w.d.x) + fabs(p[i].y * w.d.y) + fabs(p[i].z * w.d.z)) &&
               turn_of(p[i], p[(i + 1) % n], p[(i + 2) % n]) == w.side;
  }
  w.u = vs_v3_unit(vs_v3_sub(p[0], vs_v3_scale(w.d, vs_v3_dot(p[0], w.d))));
  w.v = vs_v3_cross(w.d, w.u);
  for (size_t i = 0; i < n; i++) {
    double angle = i ? angle_of(&w, p[i]) : 0;
    if (!VS_PUSH(k, c->angles, angle < 0 ? angle + 6.283185307179586 : angle)) return false;
  }
  return VS_PUSH(k, c->cones, w);
}

/* Returns true if the place is inside the convex cone w, by more than rounding errors. It is tested against three
 * neighbouring triangles, so that a rounding error in its angle does not matter. */
static bool within(const cones *c, const cone *w, vs_vec3 place) {
  vs_vec3 x = vs_v3_sub(place, w->hub);
  double angle = angle_of(w, x);
  VS_ASSERT(w->convex);
  if (angle < 0) angle += 6.283185307179586;
  size_t low = 0, high = w->count; /* finds, by bisection, the last edge of the cone whose angle is at most the angle of
                                    * the place */
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (c->angles.at[w->first + middle] <= angle) low = middle;
    else high = middle;
  }
  size_t from = low + w->count - 1; /* index of the edge before the edge found by bisection, counted around the cone */
  vs_vec3 p = c->edges.at[w->first + from % w->count], q = c->edges.at[w->first + (from + 3) % w->count];
  return turns(p, q, w->d) && turns(p, x, w->d) && turns(x, q, w->d) && under(c, w, from, x) &&
         under(c, w, from + 1, x) && under(c, w, from + 2, x);
}

/* Returns true if all triangles around the tip of cone b lie inside cone a. */
static bool holds(const cones *c, const cone *a, const cone *b) {
  vs_vec3 x = vs_v3_sub(b->hub, a->hub);
  if (!a->convex) return false;
  for (size_t i = 0; i < a->count; i++)
    if (!under(c, a, i, x)) return false;
  for (size_t i = 0; i < b->count; i++)
    if (!within(c, a, c->corners.at[b->first + i])) return false;
  return true;
}

/* Unites hubs (vertices of very many triangles) whose triangles lie within each other's cones to families. Triangles of
 * one family need no test against each other. A family has the number of its first hub. */
static bool join_nested(vs_kernel *k, const search *s, vs_hubs *out) {
  size_t count = out->corners.count;
  cones c = { .cones = { 0 } };
  uint32_t family[NESTED];
  bool ok = true, any = false;
  if (count < 2 || count > NESTED) return true;
  for (size_t i = 0, end, hub = 0; ok && hub < count; i = end) {
    end = end_of_hub(s, i);
    if (at(s, i)->hub != out->corners.at[hub]) continue;
    ok = make_cone(k, s, i, end, &c);
    hub++;
  }
  for (size_t i = 0; ok && i < count; i++) {
    family[i] = (uint32_t)i;
    for (size_t f = 0; family[i] == i && f < i; f++) {
      if (family[f] != f) continue;
      bool apart = true; /* true if the hub's triangles do not intersect the triangles of any hub in the family */
      for (size_t j = f; apart && j < i; j++)
        apart = family[j] != f || holds(&c, &c.cones.at[j], &c.cones.at[i]) ||
                holds(&c, &c.cones.at[i], &c.cones.at[j]);
      if (apart) family[i] = (uint32_t)f, any = true;
    }
    ok = vs_kernel_report(k, k->part);
  }
  for (size_t t = 0; ok && any && t < out->of.count; t++) {
    size_t hub = 0;
    if (out->of.at[t] == UINT32_MAX) continue;
    while (out->corners.at[hub] != out->of.at[t]) hub++;
    out->of.at[t] = out->corners.at[family[hub]];
  }
  VS_DROP(k, c.edges);
  VS_DROP(k, c.corners);
  VS_DROP(k, c.angles);
  VS_DROP(k, c.cones);
  return ok;
}

static bool prove(vs_kernel *k, const search *c, vs_hubs *out) {
  if (!VS_ROOM(k, out->of.at, out->of.room, c->m->triangle_count)) return false;
  memset(out->of.at, 0xff, c->m->triangle_count * sizeof *out->of.at); /* sets every element to UINT32_MAX, which means
                                                                        * that the triangle has no hub */
  out->of.count = c->m->triangle_count;
  for (size_t i = 0, end; i < c->order.count; i = end) {
    end = end_of_hub(c, i);
    if (!goes_round_once(c, i, end)) continue;
    if (!VS_PUSH(k, out->corners, at(c, i)->hub)) return false;
    for (size_t j = i; j < end; j++) out->of.at[at(c, j)->triangle] = at(c, j)->hub;
    if (!vs_kernel_report(k, k->part)) return false;
  }
  for (size_t i = 0, end, hub = 0; hub < out->corners.count; i = end) {
    end = end_of_hub(c, i);
    if (at(c, i)->hub != out->corners.at[hub]) continue;
    out->edges += edges_within(c, out, i, end);
    hub++;
  }
  return join_nested(k, c, out);
}

bool vs_hubs_find(vs_kernel *k, const vs_fans *m, vs_hubs *out) {
  search c = { .m = m };
  bool any = false, ok = VS_ROOM(k, c.count.at, c.count.room, m->vertex_count + 1);
  if (ok) memset(c.count.at, 0, (m->vertex_count + 1) * sizeof *c.count.at);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    for (int j = 0; j < 3; j++) any |= ++c.count.at[m->triangles[t][j]] > MANY;
    ok = vs_kernel_poll(k, k->part);
  }
  ok = ok && (!any || (find_spokes(k, &c) && prove(k, &c, out)));
  VS_DROP(k, c.count);
  VS_DROP(k, c.spokes);
  VS_DROP(k, c.order);
  VS_DROP(k, c.scratch);
  return ok;
}

void vs_hubs_free(vs_kernel *k, vs_hubs *hubs) {
  VS_DROP(k, hubs->of);
  VS_DROP(k, hubs->corners);
}
