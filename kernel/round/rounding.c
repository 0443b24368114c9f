/* Repairs a mesh whose corners are going to be rounded.
 *
 * The exact result may have corners that are closer together than the format's numbers. Where four planes nearly
 * intersect in one point, there are two corners with a very short edge. Where a corner nearly lies on another face's
 * edge, there is a triangle with almost no height. After rounding, the short edge vanishes or has an arbitrary
 * direction. The low triangle may turn over and intersect its neighbours. Three repairs prevent this:
 *   collapse  an edge of less than two units moves onto its lower corner if no triangle around it turns over and the
 *             link condition holds. It holds if the two corners have only the two neighbours opposite the edge in
 *             common. The surface then stays a manifold of the same kind.
 *   flip      the longest edge of a triangle lower than two units is replaced by an edge to its top: the neighbour
 *             behind that edge is cut in two there.
 *   drop      a shell that is thinner than two units everywhere is removed.
 * Then self_contacts.c searches the entire mesh for triangles that intersect after rounding, but not before. In formats
 * without vertex numbers, the surface near them is contracted (contraction.c).
 *
 * Threads test all triangles once and find the few triangles that need a change. Afterwards only these triangles are
 * tested, and those that have changed since. */
#include "kernel/round/rounding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernel/mesh/shells.h"
#include "kernel/round/contraction.h"
#include "kernel/round/rounding_state.h"
#include "kernel/round/self_contacts.h"
#include "kernel/round/touching.h"
#include "kernel/threads.h"
#include "model/store/array.h"

enum { ROUNDS = 3, PASSES = 3 /* ROUNDS: greatest number of rounds of collapses and flips; PASSES: number of passes of
                               * flips in a round */, CONTRACTIONS = 8 };

typedef vs_rounding rounding;

static vs_vec3 corner(const rounding *s, uint32_t v) { return vs_rounding_corner(s, v); }

static bool near(double a, double b, vs_numbers numbers) {
  double d = fabs(a - b), most = fabs(a) > fabs(b) ? fabs(a) : fabs(b);
  if (d > most * 1e-6) return false; /* Returns early for nearly all edges: in every format, a unit of the last place is
                                      * less than a millionth of the coordinate. */
  return d == 0 || d < 2 * vs_rounding_unit(most, numbers);
}

static bool too_short(const rounding *s, uint32_t a, uint32_t b) {
  vs_vec3 p = s->m->vertices[a], q = s->m->vertices[b];
  return near(p.x, q.x, s->numbers) && near(p.y, q.y, s->numbers) && near(p.z, q.z, s->numbers);
}

/* Returns true if the edge from vertex a to b is shorter than the distance by which rounding may move its ends. Such an
 * edge may still be harmless: on faces perpendicular to an axis, rounding moves all triangles alike. */
static bool unsure(const rounding *s, uint32_t a, uint32_t b) {
  double length = vs_v3_length(vs_v3_sub(s->m->vertices[a], s->m->vertices[b]));
  return length < 2 * fmax(vs_rounding_unit_at(s, a), vs_rounding_unit_at(s, b));
}

static const uint32_t *around(const rounding *s, uint32_t v) { return s->around.at + s->fans.at[v].first; }

static bool is_neighbour(const rounding *s, uint32_t v, uint32_t other) {
  for (uint32_t i = 0; i < s->fans.at[v].count; i++) {
    const uint32_t *t = s->m->triangles[around(s, v)[i]];
    if (t[0] == other || t[1] == other || t[2] == other) return true;
  }
  return false;
}

/* Marks the neighbours of each triangle that is so low that rounding may turn it over (vs_rounding_is_noise). If it has
 * turned over, its neighbours may intersect each other, although they face the same way. */
static void suspect_neighbours(vs_rounding *s) {
  for (size_t i = 0; i < s->look.count; i++) {
    uint32_t t = s->look.at[i];
    if (s->gone.at[t] || !vs_rounding_is_noise(s, t)) continue;
    for (int j = 0; j < 3; j++)
      for (uint32_t k = 0, v = s->m->triangles[t][j]; k < s->fans.at[v].count; k++) {
        uint8_t *mark = &s->changed.at[around(s, v)[k]];
        if (!*mark) *mark = VS_SUSPECT;
      }
  }
}

/* Returns true if triangle t has an edge that is shorter than the distance by which rounding may move the edge's
 * ends. */
static bool has_short(const rounding *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  for (int j = 0; j < 3; j++) {
    uint32_t a = v[j], b = v[(j + 1) % 3];
    vs_vec3 d = vs_v3_sub(s->m->vertices[a], s->m->vertices[b]);
    if (vs_v3_dot(d, d) < 4 * s->coarsest * s->coarsest && (too_short(s, a, b) || unsure(s, a, b))) return true;
  }
  return false;
}

/* ---- the triangles that need a test ---- */

enum { TASK = 1 << 13 };
typedef struct { VS_LIST(uint32_t) look; VS_LIST(vs_storey) storeys; bool noise, level; } found_some;
typedef struct {
  rounding *s;
  bool noise; /* true if some triangle is so low that rounding may turn it over (vs_rounding_is_noise) */
  found_some found[VS_PIPELINE_WINDOW];
} scan;

/* Appends the plane of triangle t to to->storeys, if it is perpendicular to an axis. Skips it if the last appended
 * plane for this axis was the same. *level: true if the plane is perpendicular to an axis. Returns false when memory is
 * out. */
static bool find_storey(vs_kernel *k, const rounding *s, uint32_t t, vs_storey last[3], found_some *to, bool *level) {
  const uint32_t *v = s->m->triangles[t];
  vs_vec3 a = s->m->vertices[v[0]], b = s->m->vertices[v[1]], c = s->m->vertices[v[2]];
  int axis = a.x == b.x && a.x == c.x ? 0 : a.y == b.y && a.y == c.y ? 1 : 2;
  double value = axis == 0 ? a.x : axis == 1 ? a.y : a.z;
  *level = axis < 2 || (a.z == b.z && a.z == c.z);
  if (!*level || last[axis].value == value) return true;
  last[axis] = (vs_storey){ value, axis };
  return VS_PUSH(k, to->storeys, last[axis]);
}

static bool scan_some(vs_kernel *k, void *context, size_t index) {
  scan *c = context;
  const rounding *s = c->s;
  size_t begin = index * TASK, end = s->m->triangle_count - begin < TASK ? s->m->triangle_count : begin + TASK;
  found_some *to = &c->found[index % VS_PIPELINE_WINDOW];
  vs_storey last[3] = { { NAN, 0 }, { NAN, 0 }, { NAN, 0 } };
  to->look.count = to->storeys.count = 0;
  to->noise = false;
  to->level = true;
  for (size_t t = begin; t < end; t++) {
    bool noise = vs_rounding_is_noise(s, (uint32_t)t), level;
    to->noise = to->noise || noise;
    if ((noise || has_short(s, (uint32_t)t)) && !VS_PUSH(k, to->look, (uint32_t)t)) return false;
    if (!find_storey(k, s, (uint32_t)t, last, to, &level)) return false;
    to->level = to->level && level;
  }
  return vs_kernel_report(k, 1);
}

static bool take_found(vs_kernel *k, void *context, size_t index) {
  scan *c = context;
  const found_some *from = &c->found[index % VS_PIPELINE_WINDOW];
  c->noise = c->noise || from->noise;
  c->s->level = c->s->level && from->level;
  for (size_t i = 0; i < from->look.count; i++)
    if (!VS_PUSH(k, c->s->look, from->look.at[i])) return false;
  for (size_t i = 0; i < from->storeys.count; i++)
    if (!VS_PUSH(k, c->s->storeys, from->storeys.at[i])) return false;
  return true;
}

static int storey_order(const void *a, const void *b) {
  const vs_storey *x = a, *y = b;
  if (x->axis != y->axis) return x->axis < y->axis ? -1 : 1;
  return x->value < y->value ? -1 : x->value > y->value;
}

/* Merges two adjacent sorted runs of storeys (planes perpendicular to an axis): the indices from `low` to `middle` - 1,
 * and from `middle` to `high` - 1. scratch has room for the first run. Neither run is empty. */
static void merge_storeys(vs_storey *at, vs_storey *scratch, size_t low, size_t middle, size_t high) {
  size_t i = 0, n = middle - low, j = middle, to = low;
  VS_ASSERT(low < middle && middle < high);
  if (storey_order(&at[middle - 1], &at[middle]) <= 0) return;
  memcpy(scratch, at + low, n * sizeof *at);
  while (i < n && j < high) at[to++] = storey_order(&scratch[i], &at[j]) <= 0 ? scratch[i++] : at[j++];
  while (i < n) at[to++] = scratch[i++];
}

/* Sorts the storeys (planes perpendicular to an axis that contain triangles) by axis and value. Sorts short runs first
 * and then merges them, so that the caller of the kernel can interrupt in between: a million boxes have some million
 * storeys. Returns false when memory is out or the caller interrupts. */
static bool order_storeys(vs_kernel *k, vs_storey *at, size_t count) {
  enum { RUN = 1 << 15 };
  VS_LIST(vs_storey) scratch = { 0 };
  bool ok = VS_ROOM(k, scratch.at, scratch.room, count + 1);
  for (size_t low = 0; ok && low < count; low += RUN) {
    qsort(at + low, count - low < RUN ? count - low : RUN, sizeof *at, storey_order);
    ok = vs_kernel_report(k, 1);
  }
  for (size_t width = RUN; ok && width < count; width *= 2)
    for (size_t low = 0; ok && low + width < count; low += 2 * width) {
      merge_storeys(at, scratch.at, low, low + width, count - low < 2 * width ? count : low + 2 * width);
      ok = vs_kernel_report(k, 1);
    }
  VS_DROP(k, scratch);
  return ok;
}

static bool sort_storeys(rounding *s) {
  size_t kept = 0;
  bool near = false;
  if (!order_storeys(s->k, s->storeys.at, s->storeys.count)) return false;
  vs_storey *at = s->storeys.at;
  for (size_t i = 0; i < s->storeys.count; i++) {
    bool same = kept && at[kept - 1].axis == at[i].axis;
    if (same && at[kept - 1].value == at[i].value) continue;
    near = near || (same && at[i].value - at[kept - 1].value < s->coarsest);
    at[kept++] = at[i];
  }
  s->storeys.count = near ? 0 : kept;
  s->level = s->level && !near;
  return vs_kernel_report(s->k, 1);
}

/* Returns the index of the first storey (plane of triangles across an axis) at `value` or above. `axis` must be 0, 1 or
 * 2. */
size_t vs_rounding_storey(const vs_rounding *s, int axis, double value) {
  vs_storey sought = { value, axis };
  size_t low = 0, high = s->storeys.count;
  VS_ASSERT(axis >= 0 && axis < 3);
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (storey_order(&s->storeys.at[middle], &sought) < 0) low = middle + 1;
    else high = middle;
  }
  return low;
}

/* Finds the triangles that are low or have short edges. *any: true if rounding may turn one of them over. Returns false
 * when memory is out or the caller interrupts. */
static bool find_look(rounding *s, bool *any) {
  scan c = { .s = s };
  s->look.count = s->storeys.count = 0;
  s->level = true;
  bool ok =
      vs_kernel_pipeline(s->k, (s->m->triangle_count + TASK - 1) / TASK, scan_some, take_found, &c) && sort_storeys(s);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(s->k, c.found[i].look);
    VS_DROP(s->k, c.found[i].storeys);
  }
  *any = c.noise;
  return ok;
}

static bool look_at(rounding *s, uint32_t t) {
  if (s->listed.at[t] & 1) return true;
  s->listed.at[t] |= 1;
  return VS_PUSH(s->k, s->look, t);
}

static int number_order(const void *a, const void *b) {
  uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
  return x < y ? -1 : x > y;
}

/* Begins a round of repairs: marks all corners as unchanged in this round, and sorts the triangles to test. */
static void begin_round(rounding *s) {
  memset(s->busy.at, 0, s->m->vertex_count);
  for (size_t i = 1; i < s->look.count; i++)
    if (s->look.at[i - 1] > s->look.at[i]) {
      qsort(s->look.at, s->look.count, sizeof *s->look.at, number_order);
      return;
    }
}

/* Makes, for each vertex, the list of the triangles around it, and marks the triangles to test again. Returns false
 * when memory is out. */
static bool index_mesh(rounding *s) {
  const vs_mesh *m = s->m;
  size_t n = m->vertex_count, triangles = m->triangle_count;
  if (!VS_ROOM(s->k, s->fans.at, s->fans.room, n + 1) ||
      !VS_ROOM(s->k, s->around.at, s->around.room, 3 * triangles + 1))
    return false;
  memset(s->fans.at, 0, (n + 1) * sizeof *s->fans.at);
  memset(s->listed.at, 0, triangles);
  memset(s->gone.at, 0, triangles);
  for (size_t t = 0; t < triangles; t++)
    for (int j = 0; j < 3; j++) s->fans.at[m->triangles[t][j]].count++;
  uint32_t sum = 0;
  for (size_t v = 0; v < n; v++) {
    s->fans.at[v].first = sum;
    sum += s->fans.at[v].count;
    s->fans.at[v].count = 0;
  }
  for (size_t t = 0; t < triangles; t++)
    for (int j = 0; j < 3; j++) {
      vs_fan *f = &s->fans.at[m->triangles[t][j]];
      s->around.at[f->first + f->count++] = (uint32_t)t;
    }
  s->around.count = sum;
  for (size_t i = 0; i < s->look.count; i++) s->listed.at[s->look.at[i]] = 1;
  return vs_kernel_report(s->k, 1);
}

/* Adds triangle t to the list of triangles around vertex v. Returns false when memory is out. */
static bool give(rounding *s, uint32_t v, uint32_t t) {
  vs_fan *f = &s->fans.at[v];
  if (f->first + f->count != s->around.count) { /* moves the list of vertex v's triangles to the end of `around`, where
                                                 * it can grow */
    if (!VS_ROOM(s->k, s->around.at, s->around.room, s->around.count + f->count + 1)) return false;
    if (f->count) memcpy(s->around.at + s->around.count, s->around.at + f->first, f->count * sizeof *s->around.at);
    f->first = (uint32_t)s->around.count;
    s->around.count += f->count;
  }
  f->count++;
  return VS_PUSH(s->k, s->around, t);
}

static void take_off(rounding *s, uint32_t v, uint32_t t) {
  vs_fan *f = &s->fans.at[v];
  uint32_t *at = s->around.at + f->first, kept = 0;
  for (uint32_t i = 0; i < f->count; i++)
    if (at[i] != t) at[kept++] = at[i];
  f->count = kept;
}

/* ---- short edges ---- */

/* Returns true if the edge from a to b may be collapsed by moving vertex b to vertex a. Every remaining triangle around
 * b must keep its orientation, unless rounding makes it arbitrary anyway. Only the two vertices opposite the edge may
 * be neighbours of both a and b. a and b differ. */
static bool allowed(const rounding *s, uint32_t a, uint32_t b) {
  uint32_t common = 0, both = 0;
  vs_vec3 to = s->m->vertices[a];
  VS_ASSERT(a != b);
  for (uint32_t i = 0; i < s->fans.at[b].count; i++) {
    uint32_t other = around(s, b)[i];
    const uint32_t *t = s->m->triangles[other];
    uint32_t j = t[0] == b ? 0 : t[1] == b ? 1 : 2, p = t[(j + 1) % 3], q = t[(j + 2) % 3];
    if (p == a || q == a) {
      both++;
      continue;
    }
    if (is_neighbour(s, a, p)) common++; /* Exactly one triangle has an edge from b to p. Therefore each common
                                          * neighbour p of a and b is counted at most once. */
    vs_vec3 before = vs_rounding_normal(s->m->vertices[b], s->m->vertices[p], s->m->vertices[q]),
            after = vs_rounding_normal(to, s->m->vertices[p], s->m->vertices[q]);
    if (vs_v3_dot(before, after) < 0 && !vs_rounding_is_noise(s, other)) return false; /* a triangle that rounding may
                                                                                        * turn over anyway may also turn
                                                                                        * over here */
  }
  /* Each of the two corners opposite the edge is a neighbour of a and b. The loop counts only one of them: the other
   * follows b in a triangle at the edge, which the loop skips. Therefore `common` must be 1. */
  bool tetrahedron = s->fans.at[a].count == 3 && s->fans.at[b].count == 3; /* the collapse of an edge of a tetrahedron
                                                                            * would leave two triangles that lie on each
                                                                            * other */
  return both == 2 && common == 1 && !tetrahedron;
}

/* ---- low triangles ---- */

static bool same_side(vs_vec3 n, vs_vec3 a, vs_vec3 b, vs_vec3 c) {
  return vs_v3_dot(n, vs_rounding_normal(a, b, c)) > 0;
}

/* Removes triangle t if it is so low that rounding may turn it over. Replaces its longest edge by an edge from its
 * third corner into the neighbour at that edge, which is thus cut in two. Returns false if a new triangle would be as
 * low, or turn over. t is not removed yet. */
static bool flip(rounding *s, uint32_t t) {
  vs_mesh *m = s->m;
  const uint32_t *v = m->triangles[t];
  int base = vs_rounding_longest(s, t);
  uint32_t p = v[base], q = v[(base + 1) % 3], top = v[(base + 2) % 3], other = UINT32_MAX, far = 0;
  VS_ASSERT(!s->gone.at[t]);
  for (uint32_t i = 0; i < s->fans.at[p].count; i++) {
    const uint32_t *w = m->triangles[around(s, p)[i]];
    for (int j = 0; j < 3; j++)
      if (w[j] == q && w[(j + 1) % 3] == p) other = around(s, p)[i], far = w[(j + 2) % 3];
  }
  const uint8_t *busy = s->busy.at;
  if (other == UINT32_MAX || far == top || busy[p] || busy[q] || busy[top] || busy[far] || is_neighbour(s, top, far))
    return false;
  const vs_vec3 *x = m->vertices;
  vs_vec3 before = vs_rounding_normal(x[q], x[p], x[far]), rp = corner(s, p), rq = corner(s, q), rt = corner(s, top),
          rf = corner(s, far);
  if (!same_side(before, x[p], x[far], x[top]) || !same_side(before, x[far], x[q], x[top])) return false;
  if (!same_side(before, rp, rf, rt) || !same_side(before, rf, rq, rt)) return false;
  double old = fmin(vs_rounding_height(x[p], x[q], x[top]), vs_rounding_height(x[q], x[p], x[far])),
         now = fmin(vs_rounding_height(x[p], x[far], x[top]), vs_rounding_height(x[far], x[q], x[top]));
  if (now <= old) return false;
  uint32_t one[3] = { p, far, top }, two[3] = { far, q, top };
  memcpy(m->triangles[t], one, sizeof one);
  memcpy(m->triangles[other], two, sizeof two);
  if (m->tags) m->tags[t] = m->tags[other];
  s->changed.at[t] = s->changed.at[other] = VS_CHANGED;
  s->busy.at[p] = s->busy.at[q] = s->busy.at[top] = s->busy.at[far] = 1;
  take_off(s, p, other);
  take_off(s, q, t);
  return give(s, top, other) && give(s, far, t) && look_at(s, t) && look_at(s, other);
}

/* Removes triangles that are too low by one pass of flips; *done: number of flips. Returns false when memory is out. */
static bool flip_round(rounding *s, size_t *done) {
  begin_round(s);
  *done = 0;
  for (size_t i = 0, n = s->look.count; i < n; i++) {
    if (!vs_kernel_poll(s->k, 1)) return false;
    if (!s->gone.at[s->look.at[i]] && vs_rounding_is_noise(s, s->look.at[i])) *done += flip(s, s->look.at[i]);
  }
  return s->k->error->status == VS_KERNEL_FINE;
}

/* Removes from the mesh's array the triangles that are marked as gone. */
static void squeeze(rounding *s) {
  size_t kept = 0;
  for (size_t t = 0; t < s->m->triangle_count; t++)
    if (!s->gone.at[t]) s->changed.at[kept++] = s->changed.at[t];
  vs_mesh_squeeze(s->m, s->gone.at);
}

/* Collapses the edge between vertices a and b: replaces b by a, and marks the two triangles at the edge as gone. a and
 * b differ. Returns false when memory is out. */
static bool collapse(rounding *s, uint32_t a, uint32_t b) {
  vs_mesh *m = s->m;
  VS_ASSERT(a != b);
  for (int end = 0; end < 2; end++)
    for (uint32_t i = 0, v = end ? b : a; i < s->fans.at[v].count; i++)
      for (int k = 0; k < 3; k++) s->busy.at[m->triangles[around(s, v)[i]][k]] = 1;
  for (uint32_t i = 0; i < s->fans.at[b].count; i++) {
    uint32_t t = around(s, b)[i], *v = m->triangles[t];
    if (v[0] == a || v[1] == a || v[2] == a) {
      s->gone.at[t] = 1;
      for (int k = 0; k < 3; k++)
        if (v[k] != b) take_off(s, v[k], t);
    } else {
      for (int k = 0; k < 3; k++)
        if (v[k] == b) v[k] = a;
      s->changed.at[t] = VS_CHANGED;
      if (!give(s, a, t) || !look_at(s, t)) return false;
    }
  }
  s->fans.at[b].count = 0;
  return true;
}

static bool collapse_round(rounding *s, size_t *done) {
  const vs_mesh *m = s->m;
  begin_round(s);
  *done = 0;
  for (size_t i = 0, n = s->look.count; i < n; i++) {
    uint32_t t = s->look.at[i];
    if (!vs_kernel_poll(s->k, 1)) return false;
    for (int j = 0; j < 3 && !s->gone.at[t]; j++) {
      uint32_t a = m->triangles[t][j], b = m->triangles[t][(j + 1) % 3], low = a < b ? a : b, high = a < b ? b : a;
      if (s->busy.at[a] || s->busy.at[b] || !(too_short(s, a, b) || (unsure(s, a, b) && vs_rounding_bends(s, t))) ||
          !allowed(s, low, high))
        continue;
      if (!collapse(s, low, high)) return false;
      ++*done;
    }
  }
  return true;
}

/* ---- shells that are too thin for the format's numbers (blades) ---- */

static bool is_blade(const rounding *s, const vs_shell *of) {
  return fabs(of->volume) <= of->area * vs_rounding_unit(of->reach, s->numbers); /* `<=`, not `<`: both sides are 0 for
                                                                                  * a shell that is a single point */
}

/* Removes each shell (connected part of the surface) that is thinner than two units of the last place everywhere, if
 * rounding bends it. Its sides would lie on each other. Keeps such shells if there are no others. Returns false when
 * memory is out. */
static bool drop_blades(rounding *s, vs_rounded *out) {
  vs_mesh *m = s->m;
  bool ok = vs_rounding_find_shells(s);
  const vs_shells *shells = &s->shells;
  uint8_t *goes = ok ? vs_zeros((size_t)shells->count + 1, 1) : NULL;
  uint32_t going = 0;
  ok = goes != NULL;
  for (uint32_t t = 0; ok && t < m->triangle_count; t++) {
    uint32_t shell = shells->of[m->triangles[t][0]];
    if (!goes[shell] && is_blade(s, &shells->at[shell]) && vs_rounding_bends(s, t)) goes[shell] = 1;
    ok = vs_kernel_poll(s->k, 1);
  }
  for (uint32_t i = 0; ok && i < shells->count; i++) {
    if (!goes[i]) continue;
    if (going++ == 0) out->dropped_at = shells->at[i].from;
  }
  if (ok && going && going < shells->count) {
    for (size_t t = 0; t < m->triangle_count; t++) s->gone.at[t] = goes[shells->of[m->triangles[t][0]]];
    squeeze(s);
    out->dropped = going;
  }
  free(goes);
  return ok;
}

/* ---- the whole mesh ---- */

static bool drop_vertices(rounding *s) {
  vs_mesh *m = s->m;
  uint32_t count = 0;
  VS_LIST(uint32_t) number = { 0 };
  if (!VS_ROOM(s->k, number.at, number.room, m->vertex_count + 1)) return false;
  memset(number.at, 0, m->vertex_count * sizeof *number.at);
  for (size_t i = 0; i < 3 * m->triangle_count; i++) number.at[m->triangles[i / 3][i % 3]] = 1;
  for (uint32_t v = 0; v < m->vertex_count; v++)
    if (number.at[v]) {
      m->vertices[count] = m->vertices[v];
      number.at[v] = count++;
    }
  m->vertex_count = count;
  for (size_t i = 0; i < 3 * m->triangle_count; i++) m->triangles[i / 3][i % 3] = number.at[m->triangles[i / 3][i % 3]];
  VS_DROP(s->k, number);
  return true;
}

/* Makes all lists and marks again after vertices and triangles have got new numbers. Returns false when memory is out
 * or the caller interrupts. */
static bool begin_again(rounding *s) {
  bool any;
  return find_look(s, &any) && index_mesh(s);
}

static bool round_mesh(vs_rounding *s, vs_rounded *out) {
  vs_mesh *m = s->m;
  size_t n = m->vertex_count, collapsed, flipped, more, before = 0;
  bool any = false, ok = true;
  if (!vs_kernel_report(s->k, 1)) return false;
  s->bounds = vs_mesh_bounds(m);
  s->coarsest =
      2 * vs_rounding_unit(fmax(vs_rounding_reach(s->bounds.min), vs_rounding_reach(s->bounds.max)), s->numbers);
  if (!find_look(s, &any)) return false;
  if (!any && s->level) return true;
  if (!VS_ROOM(s->k, s->busy.at, s->busy.room, n + 1) || !VS_ROOM(s->k, s->near_met.at, s->near_met.room, n + 1) ||
      !VS_ROOM(s->k, s->gone.at, s->gone.room, m->triangle_count + 1) ||
      !VS_ROOM(s->k, s->listed.at, s->listed.room, m->triangle_count + 1) ||
      !VS_ROOM(s->k, s->changed.at, s->changed.room, m->triangle_count + 1))
    return false;
  memset(s->changed.at, 0, m->triangle_count);
  memset(s->near_met.at, 0, n);
  if (!vs_rounding_suspect_touching(s)) return false;
  if (!any) {
    memset(s->gone.at, 0, m->triangle_count);
    memset(s->listed.at, 0, m->triangle_count);
    if (!vs_rounding_count_met(s, out)) return false;
    if (!out->met || !s->places) return true;
    before = out->met_before;
  }
  if (!drop_blades(s, out) || !(out->dropped ? begin_again(s) : index_mesh(s))) return false;
  for (int round = 0; ok && round < ROUNDS; round++) {
    ok = collapse_round(s, &collapsed);
    flipped = 0;
    for (int pass = 0; ok && pass < PASSES; pass++) {
      ok = flip_round(s, &more);
      flipped += more;
      if (!more) break;
    }
    out->collapsed += collapsed;
    out->flipped += flipped;
    if (!collapsed && !flipped) break;
  }
  if (ok) suspect_neighbours(s);
  ok = ok && vs_rounding_count_met(s, out);
  if (ok && out->met_before > before) before = out->met_before;
  if (ok) squeeze(s);
  /* Each of the first three rounds unites corners at larger distances than the round before. The rounds continue as
   * long as the number of intersecting triangles decreases. */
  for (int round = 0; ok && s->places && out->met && round < CONTRACTIONS; round++) {
    enum { ALL = 2, MANY = 10000, PART = 16 };
    if (out->met > MANY && out->met > m->triangle_count / PART) break;
    size_t contracted = 0, met = out->met;
    ok = vs_rounding_contract(s, 4 << (round < ALL ? round : ALL), round >= ALL, out, &contracted);
    if (!ok || (!contracted && round >= ALL)) break;
    if (!contracted) continue;
    squeeze(s);
    ok = begin_again(s) && flip_round(s, &flipped);
    if (ok) suspect_neighbours(s);
    ok = ok && vs_rounding_count_met(s, out);
    out->flipped += flipped;
    if (round > ALL && out->met >= met) break;
  }
  out->met_before = before; /* Contraction may make triangles cross that did not cross in the exact result. Therefore
                             * met_before keeps its value from before the contraction. */
  return ok && (out->collapsed || out->dropped ? drop_vertices(s) : true);
}

bool vs_mesh_round(vs_mesh *m, vs_numbers numbers, const vs_kernel_options *options, vs_rounded *out,
                    vs_kernel_error *error) {
  enum { SERIAL = 10000 }; /* number of triangles below which a single thread works */
  vs_kernel_error ignored;
  vs_kernel k = { .options = options,
                  .error = error ? error : &ignored,
                  .threads = m->triangle_count < SERIAL ? 1 : vs_kernel_threads(options),
                  .done = 1 };
  bool places = numbers == VS_NUMBERS_LOOSE;
  vs_rounding s = { .k = &k, .m = m, .numbers = places ? VS_NUMBERS_SINGLE : numbers, .places = places };
  *k.error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
  *out = (vs_rounded){ 0 };
  vs_kernel_time(&k, options && options->counts ? options->counts->seconds : NULL);
  bool ok = round_mesh(&s, out);
  if (s.numbers != VS_NUMBERS_SINGLE) out->met_before = out->met;
  vs_kernel_lap(&k, VS_STEP_ROUND);
  VS_DROP(&k, s.fans);
  VS_DROP(&k, s.around);
  VS_DROP(&k, s.look);
  VS_DROP(&k, s.busy);
  VS_DROP(&k, s.gone);
  VS_DROP(&k, s.listed);
  VS_DROP(&k, s.changed);
  VS_DROP(&k, s.near_met);
  VS_DROP(&k, s.folded);
  VS_DROP(&k, s.alone);
  vs_shells_free(&s.shells);
  VS_DROP(&k, s.storeys);
  return ok || (vs_kernel_no_memory(&k), false);
}
