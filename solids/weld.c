/* Implements the welding of meshes: it removes details smaller than a step.
 *
 * Where two surfaces nearly coincide, their exact union has millions of needles and crumbs. They are invisible, and the
 * next union cuts each of them again. Two steps remove them. The mesh stays closed: each edge has as many triangles in
 * one direction as in the other.
 *   unite    a corner moves to the first corner that is closer than the step, if there is one. The first corners do
 *            not move, so no row of corners contracts to a point, and corners that two meshes share stay shared
 *   reroute  the longest edge of a triangle lower than the step is led through the triangle's third corner, in all
 *            triangles with this edge. The low triangle vanishes. Each edge becomes two shorter edges, so this ends */
#include "solids/weld.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/net.h"
#include "model/store/array.h"

enum { NONE = -1, REROUTES = 12 };

static size_t slots_for(size_t n) {
  size_t slots = 64;
  while (slots < 2 * n) slots *= 2;
  return slots;
}

static uint64_t mixed(uint64_t h) {
  h = (h ^ h >> 29) * 0xbf58476d1ce4e5b9u;
  return h ^ h >> 32;
}

/* ---- unite ---- */

typedef struct { int64_t at[3]; } cell;

/* Corners that do not move, sorted by the cells of a grid. A cell is several steps wide, so that the corners near a
 * given corner mostly lie in one or two cells. */
typedef struct {
  const vs_mesh *m;
  double step, width;
  size_t slots;
  int64_t *first; /* first[h]: first corner in the list of slot h of the hash table of cells, or NONE */
  int64_t *next;  /* next[v]: corner after v in the list of corners of its cell, or NONE */
  uint32_t *to;   /* to[v]: the corner that replaces corner v */
} stay;

static cell cell_of(const stay *s, vs_vec3 p, double off) {
  return (cell){ { (int64_t)floor((p.x + off) / s->width), (int64_t)floor((p.y + off) / s->width),
                   (int64_t)floor((p.z + off) / s->width) } };
}

static size_t slot_of(const stay *s, cell c) {
  uint64_t h = mixed((uint64_t)c.at[0] * 0x9e3779b97f4a7c15u + (uint64_t)c.at[1]);
  return (size_t)(mixed(h * 0x94d049bb133111ebu + (uint64_t)c.at[2]) & (s->slots - 1));
}

/* Returns the first of the corners that do not move and that are closer to v than the step; NONE if there is none. */
static int64_t near_one(const stay *s, uint32_t v) {
  const vs_vec3 *at = s->m->vertices;
  cell low = cell_of(s, at[v], -s->step), high = cell_of(s, at[v], s->step), c;
  int64_t found = NONE;
  for (c.at[0] = low.at[0]; c.at[0] <= high.at[0]; c.at[0]++)
    for (c.at[1] = low.at[1]; c.at[1] <= high.at[1]; c.at[1]++)
      for (c.at[2] = low.at[2]; c.at[2] <= high.at[2]; c.at[2]++)
        for (int64_t u = s->first[slot_of(s, c)]; u != NONE; u = s->next[u])
          if ((found == NONE || u < found) && vs_v3_length(vs_v3_sub(at[u], at[v])) < s->step) found = u;
  return found;
}

static bool unite(vs_mesh *m, double step) {
  stay s = { .m = m, .step = step, .width = 8 * step, .slots = slots_for(m->vertex_count) };
  bool any = false;
  bool ok = VS_FRESH(s.first, s.slots) && VS_FRESH(s.next, m->vertex_count + 1) && VS_FRESH(s.to, m->vertex_count + 1);
  for (size_t i = 0; ok && i < s.slots; i++) s.first[i] = NONE;
  for (uint32_t v = 0; ok && v < m->vertex_count; v++) {
    int64_t u = near_one(&s, v);
    s.to[v] = u == NONE ? v : (uint32_t)u;
    any = any || u != NONE;
    if (u != NONE) continue;
    size_t slot = slot_of(&s, cell_of(&s, m->vertices[v], 0));
    s.next[v] = s.first[slot];
    s.first[slot] = v;
  }
  for (size_t t = 0; ok && any && t < m->triangle_count; t++)
    for (int i = 0; i < 3; i++) m->triangles[t][i] = s.to[m->triangles[t][i]];
  free(s.first);
  free(s.next);
  free(s.to);
  return ok && (!any || vs_mesh_net(m, 0));
}

/* ---- reroute ---- */

typedef struct { uint32_t low, high, through; double height; bool held; } detour;
typedef struct {
  detour *at;
  size_t slots;
} detours;

static detour *detour_at(const detours *d, uint32_t a, uint32_t b) {
  uint32_t low = a < b ? a : b, high = a < b ? b : a;
  size_t i = (size_t)mixed(low * 0x9e3779b97f4a7c15u + high) & (d->slots - 1);
  while (d->at[i].held && (d->at[i].low != low || d->at[i].high != high)) i = (i + 1) & (d->slots - 1);
  d->at[i].low = low;
  d->at[i].high = high;
  return &d->at[i];
}

/* Returns the height of triangle t over its longest edge. Sets *longest to the corner (0 to 2) where this edge
 * begins. */
static double height_of(const vs_mesh *m, const uint32_t t[3], int *longest) {
  const vs_vec3 *v = m->vertices;
  double most = -1;
  for (int i = 0; i < 3; i++) {
    double length = vs_v3_length(vs_v3_sub(v[t[i]], v[t[(i + 1) % 3]]));
    if (length > most) most = length, *longest = i;
  }
  vs_vec3 n = vs_v3_cross(vs_v3_sub(v[t[1]], v[t[0]]), vs_v3_sub(v[t[2]], v[t[0]]));
  return most > 0 ? vs_v3_length(n) / most : 0;
}

/* Lists the longest edges of triangles whose height is below the step. Each is to be led through the triangle's third
 * corner; if two triangles have the edge, through the corner that is nearer to it. Returns the number of edges. */
static size_t plan_detours(const vs_mesh *m, double step, detours *d) {
  size_t count = 0;
  memset(d->at, 0, d->slots * sizeof *d->at);
  for (size_t t = 0; t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    int longest = 0;
    double height = height_of(m, v, &longest);
    if (height >= step) continue;
    uint32_t through = v[(longest + 2) % 3];
    detour *now = detour_at(d, v[longest], v[(longest + 1) % 3]);
    if (now->held && (height > now->height || (height == now->height && through >= now->through))) continue;
    count += !now->held;
    now->held = true;
    now->height = height;
    now->through = through;
  }
  return count;
}

/* Adds triangle t to out, with each listed edge led through another corner. The result is a fan of triangles around one
 * of these corners, so that no listed edge remains. Returns false if memory is out. */
static bool add_rerouted(vs_mesh *out, const detours *d, const uint32_t t[3]) {
  uint32_t round[6];
  int n = 0, from = 0;
  bool ok = true;
  for (int i = 0; i < 3; i++) {
    const detour *by = detour_at(d, t[i], t[(i + 1) % 3]);
    round[n++] = t[i];
    if (!by->held) continue;
    from = n;
    round[n++] = by->through;
  }
  for (int i = 2; ok && i < n; i++)
    ok = vs_mesh_add_triangle(out, round[from], round[(from + i - 1) % n], round[(from + i) % n]);
  return ok;
}

static bool reroute(vs_mesh *m, double step, bool *any) {
  detours d = { NULL, slots_for(3 * m->triangle_count) };
  vs_mesh out = { 0 };
  if (!VS_FRESH(d.at, d.slots)) return false;
  *any = plan_detours(m, step, &d) > 0;
  bool ok = true;
  for (size_t t = 0; ok && *any && t < m->triangle_count; t++) ok = add_rerouted(&out, &d, m->triangles[t]);
  ok = ok && (!*any || vs_mesh_net(&out, 0));
  free(d.at);
  if (ok && *any) {
    free(m->triangles);
    m->triangles = out.triangles;
    m->triangle_count = out.triangle_count;
    m->triangle_room = out.triangle_room;
  } else free(out.triangles);
  return ok;
}

/* ---- unite and reroute ---- */

bool vs_mesh_drop_lonely(vs_mesh *m) {
  uint32_t *to = NULL, count = 0;
  if (!VS_FRESH(to, m->vertex_count + 1)) return false;
  memset(to, 0, (m->vertex_count + 1) * sizeof *to);
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int i = 0; i < 3; i++) to[m->triangles[t][i]] = 1;
  for (size_t v = 0; v < m->vertex_count; v++) {
    if (!to[v]) continue;
    to[v] = count;
    m->vertices[count++] = m->vertices[v];
  }
  for (size_t t = 0; t < m->triangle_count; t++)
    for (int i = 0; i < 3; i++) m->triangles[t][i] = to[m->triangles[t][i]];
  m->vertex_count = count;
  free(to);
  return true;
}

bool vs_mesh_weld(vs_mesh *m, double step) {
  free(m->tags);
  m->tags = NULL;
  bool any = true, ok = unite(m, step);
  for (int i = 0; ok && any && i < REROUTES; i++) ok = reroute(m, step, &any);
  return ok && vs_mesh_drop_lonely(m);
}
