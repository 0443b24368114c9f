/* Owns the proof that the triangles around a hub, a corner in which more than MANY end, have nothing in common but what
 * the mesh says.
 *
 * The boxes of all of them meet, so that an index tells none apart, and each pair would be tried: n^2 for the tip of a
 * cone. But triangles with a common corner meet elsewhere only where the angles that they fill there overlap. Seen
 * along some direction d, each one's other two corners p and q turn by an angle between 0 and half a turn,
 * counter-clockwise, where det(p, q, d) > 0. If that holds for all, each follows another along an edge, and the angles
 * come to one turn in all, none overlaps another. d is the mean normal, the determinants' signs are held to their
 * error, and the sum to a whole number of turns, of which it is a multiple: so one look around proves it, in n log n
 * for the order. Pairs without a proof are tried as ever. */
#include "kernel/mesh/hubs.h"

#include <math.h>
#include <string.h>

enum { MANY = 64 };

/* next, last: the triangle's corners that follow the hub */
typedef struct { uint32_t hub, triangle, next, last; } spoke;

typedef struct {
  const vs_fans *m;
  VS_LIST(uint32_t) count; /* of a vertex: its triangles */
  VS_LIST(spoke) spokes;
  VS_LIST(uint32_t) order, scratch; /* of the spokes: by hub, then by the next corner */
} search;

static bool before(const void *context, uint32_t a, uint32_t b) {
  const spoke *x = &((const search *)context)->spokes.at[a], *y = &((const search *)context)->spokes.at[b];
  return x->hub != y->hub ? x->hub < y->hub : x->next < y->next;
}

static const spoke *at(const search *c, size_t i) { return &c->spokes.at[c->order.at[i]]; }

/* The spoke in [first, end) whose triangle follows along the edge to that corner; NULL: none, or several. */
static const spoke *following(const search *c, size_t first, size_t end, uint32_t corner) {
  size_t low = first, high = end;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (at(c, middle)->next < corner) low = middle + 1;
    else high = middle;
  }
  if (low == end || at(c, low)->next != corner || (low + 1 < end && at(c, low + 1)->next == corner)) return NULL;
  return at(c, low);
}

/* Is det(p, q, d) surely above 0? */
static bool turns(vs_vec3 p, vs_vec3 q, vs_vec3 d) {
  double size = (fabs(p.y * q.z) + fabs(p.z * q.y)) * fabs(d.x) + (fabs(p.z * q.x) + fabs(p.x * q.z)) * fabs(d.y) +
      (fabs(p.x * q.y) + fabs(p.y * q.x)) * fabs(d.z);
  return vs_v3_dot(vs_v3_cross(p, q), d) > 1e-14 * size;
}

/* Do the spokes of one hub, [first, end), go round it once? */
static bool goes_round_once(const search *c, size_t first, size_t end) {
  const vs_fans *m = c->m;
  vs_vec3 hub = m->corner(m->context, at(c, first)->hub), d = vs_v3(0, 0, 0);
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
    if (!x || (x == begin) != (i + 1 == end)) return false; /* several fans, or an open one */
  }
  return fabs(sum - 6.283185307179586) < 1;
}

/* The triangles' corners that are hubs. */
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

/* How many edges lie between triangles of one hub, which the index passes over as pairs. */
static size_t edges_within(const search *c, const vs_hubs *hubs, size_t first, size_t end) {
  size_t edges = 0;
  for (size_t i = first; i < end; i++) {
    const spoke *x = at(c, i), *next = hubs->of.at[x->triangle] == x->hub ? following(c, first, end, x->last) : NULL;
    edges += next && hubs->of.at[next->triangle] == x->hub;
  }
  return edges;
}

static size_t end_of_hub(const search *c, size_t i) {
  size_t end = i + 1;
  while (end < c->order.count && at(c, end)->hub == at(c, i)->hub) end++;
  return end;
}

static bool prove(vs_kernel *k, const search *c, vs_hubs *out) {
  if (!VS_ROOM(k, out->of.at, out->of.room, c->m->triangle_count)) return false;
  memset(out->of.at, 0xff, c->m->triangle_count * sizeof *out->of.at); /* none */
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
  return true;
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
