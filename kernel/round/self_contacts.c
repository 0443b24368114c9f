/* Searches the mesh for triangles that intersect because of rounding.
 *
 * Triangles that intersect after rounding are within some units of each other before. A surface that does not touch
 * itself separates inside from outside. Between two of its sheets that face the same way and are close to each other,
 * there is another sheet that faces the opposite way. Where sheets end beside each other, so do the walls at their
 * ends. Therefore triangles that face the same way need no test. Nearly all triangles that touch face the same way: the
 * triangles of one plane, and neighbours on curved surfaces. A triangle lower than some units is tested against all
 * others, because its direction is arbitrary. A triangle with changed corners is tested against all others, too. The
 * change may have removed the sheet between two others, or the wall between two planes.
 *
 * Notation.
 *   run      up to 16 triangles that follow each other in the mesh, touch, and face the same way up to 15 degrees;
 *            or a single triangle that is low or that rounding has given other corners, since the triangles of a
 *            run are not tested against each other
 *   slab     the interval along a run's middle normal that contains all its corners
 *   level    of a run: it lies in a plane across an axis. The other runs are open. Each coordinate is rounded
 *            separately, and coordinates keep their order. Such a plane therefore stays a plane, two level runs do not
 *            come to cross, and a corner in a level run's plane stays in it. (If two such planes are less than two
 *            units apart, nothing counts as level.)
 *   storey   a plane across an axis that contains level runs
 *
 * A mesh that is given by positions has already been moved to its final place, and its coordinates rounded to doubles
 * there. A corner that was near a level run's plane may now lie in it, in the middle of the run. In such a mesh, a
 * corner in a level run's plane is tested like any other.
 *
 * The first index contains the boxes of the open runs. A second contains the open runs that a storey may touch or
 * cross, for the level runs. Two runs are apart if the corners of one lie on one side beyond the other's slab,
 * except for shared corners. Otherwise, the pieces of each run in the other's slab are compared: by their boxes, and
 * then triangle by triangle by boxes and planes. triangles_apart.c decides the remaining pairs. */
#include "kernel/round/self_contacts.h"

#include "kernel/mesh/triangles_apart.h"
#include "kernel/mesh/triangles_meet.h"
#include "kernel/mesh/bvh.h"
#include "kernel/mesh/hubs.h"
#include "kernel/round/rounding_state.h"
#include "kernel/round/stars.h"
#include "kernel/threads.h"

#include <math.h>
#include <string.h>

enum { STEEP = 4, NOT_ITS = 255, NOT_LEVEL = 3, OPEN = 0, LEVEL = 1, RUN = 16, TRIANGLES = 1 << 13 };
#define ALIKE 0.85f /* least cosine of the angle between the normals of two runs that face the same way */

/* A triangle with its normal. Its corners are mostly rounded already. */
typedef struct {
  uint32_t triangle;
  vs_vec3 at[3], normal, size; /* at: corners; normal: normal whose length is twice the area; size: for each component
                                * of the normal, the sum of the sizes of its products; 1e-14 of this exceeds any
                                * rounding error */
  double low[3], high[3];
  bool flat; /* true if the three corners lie on one line */
} sheet;

typedef float floats __attribute__((vector_size(16)));
typedef int32_t truths __attribute__((vector_size(16)));
/* Four corners of a run (neighbouring triangles tested together), relative to the middle of the mesh. If the run has
 * fewer corners, its last corner is repeated. */
typedef struct { floats x, y, z; uint32_t corner[4]; } corners;
enum { FOURS = (3 * RUN + 3) / 4 };

typedef struct {
  uint32_t first, first_four, first_place;
  uint8_t count, fours;          /* count: number of triangles in the run (triangles tested together); fours: number of
                                  * groups of four corners */
  bool is_low;                   /* true if the run is one triangle whose height is less than some units of the
                                  * last place */
  uint8_t is_changed;            /* marks (VS_CHANGED ...) of the run's only triangle; 0 if the run has several
                                  * triangles */
  bool busy;                     /* true for a run that is not perpendicular to an axis, if it crosses or nearly touches
                                  * a plane that contains runs perpendicular to an axis */
  bool anew;                     /* true if the run (triangles tested together) must be tested against all others,
                                  * because its only triangle has changed */
  uint8_t level;                 /* axis to which the run is perpendicular: 0 for x, 1 for y, 2 for z; all its corners
                                  * then have the coordinate `value` */
  /* corner of very many triangles that all triangles of the run share, and around which no test is needed (hubs.h);
   * UINT32_MAX: there is none */
  uint32_t hub;
  double value;
  float normal[3], low, high;    /* interval along the run's unit normal that contains all its corners, from `low` to
                                  * `high`; enlarged by the margin on both sides */
  float height, longest;         /* height: least height of the run's triangles; longest: length of their longest edge;
                                  * in units of the mesh */
} run;

/* The range of a run's coordinates along each axis. `near_low`: true if a second corner of the run is within the margin
 * of the low end of the range; `near_high`: the same for the high end. */
typedef struct { double low[3], high[3]; bool near_low[3], near_high[3], any; /* any: true if the run is a single
                                                                               * triangle that is low or has changed,
                                                                               * which is tested against all planes of
                                                                               * runs */ } reach;

typedef struct { VS_LIST(run) at; VS_LIST(vs_bvh_box) boxes; } runs;
typedef struct { runs kinds[2]; VS_LIST(corners) fours; VS_LIST(uint8_t) places; } made; /* the runs (triangles tested
                                                                                          * together) that a task has
                                                                                          * made; kinds[OPEN]: runs not
                                                                                          * perpendicular to an axis;
                                                                                          * kinds[LEVEL]: runs
                                                                                          * perpendicular to an axis */
typedef struct { uint32_t a, b; bool before; } pair; /* a, b: numbers of two triangles that intersect; before: true if
                                                      * they also intersect before rounding */

typedef struct {
  vs_rounding *s;
  vs_rounded *out;
  vs_vec3 middle;
  double step;                   /* length of a step of the boxes' integer coordinates, in units of the mesh */
  double low;                    /* height below which a triangle counts as low */
  float margin;                  /* length by which the interval of a run is enlarged on both sides, which exceeds the
                                  * rounding errors of 32-bit numbers */
  made all;
  VS_LIST(uint32_t) busy;        /* indices of runs that are not perpendicular to an axis, and cross or nearly touch a
                                  * plane of runs that are */
  VS_LIST(vs_bvh_box) busy_boxes;
  VS_LIST(reach) reaches;        /* reaches[i]: the ranges of coordinates of run number busy[i] */
  vs_hubs around;                /* corners of very many triangles, in the mesh with rounded corners */
  VS_LIST(uint32_t) hubs;        /* hubs[i]: the member `hub` of the run with the index i among the runs that are not
                                  * perpendicular to an axis */
  vs_bvh bvh, busy_bvh;          /* bvh: tree of the boxes of all runs that are not perpendicular to an axis; busy_bvh:
                                  * tree of the boxes of the runs in `busy` */
  made found[VS_PIPELINE_WINDOW];
  struct { VS_LIST(pair) at, folds; } met[VS_PIPELINE_WINDOW]; /* at: pairs of triangles that intersect; folds: pairs of
                                                                * triangles that share an edge and are folded onto each
                                                                * other, see is_fold */
  bool folds;                    /* true if pairs of triangles were found that are folded onto each other */
} search;

/* ---- pairs of triangles ---- */

static vs_vec3 magnitudes(vs_vec3 p, vs_vec3 q) {
  vs_vec3 a = vs_v3(fabs(p.x), fabs(p.y), fabs(p.z)), b = vs_v3(fabs(q.x), fabs(q.y), fabs(q.z));
  return vs_v3(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x);
}

static void measure(sheet *to) {
  const vs_vec3 *v = to->at;
  vs_vec3 e = vs_v3_sub(v[1], v[0]), f = vs_v3_sub(v[2], v[0]);
  to->normal = vs_v3_cross(e, f);
  to->size = magnitudes(e, f);
  vs_bounds box = vs_bounds_empty();
  for (int i = 0; i < 3; i++) vs_bounds_add(&box, v[i]);
  to->low[0] = box.min.x, to->low[1] = box.min.y, to->low[2] = box.min.z;
  to->high[0] = box.max.x, to->high[1] = box.max.y, to->high[2] = box.max.z;
  double area = vs_v3_dot(to->normal, to->normal), error = vs_v3_dot(to->size, to->size);
  to->flat = !(area > 1e-28 * error) && vs_triangle_is_flat(to->at);
}

static void load(const vs_rounding *s, uint32_t t, sheet *to) {
  to->triangle = t;
  for (int i = 0; i < 3; i++) to->at[i] = vs_rounding_corner(s, s->m->triangles[t][i]);
  measure(to);
}

static void load_exact(const vs_rounding *s, uint32_t t, sheet *to) {
  to->triangle = t;
  for (int i = 0; i < 3; i++) to->at[i] = s->m->vertices[s->m->triangles[t][i]];
  measure(to);
}

/* Returns true if all corners of triangle b are on one side of triangle a's plane. Corners that b shares with a do not
 * count. */
static bool beside(const sheet *a, const sheet *b) {
  bool above = false, below = false;
  int unsure = 0;
  for (int i = 0; i < 3; i++) {
    vs_vec3 d = vs_v3_sub(b->at[i], a->at[0]);
    double x = vs_v3_dot(a->normal, d),
           sure = 1e-14 * (a->size.x * fabs(d.x) + a->size.y * fabs(d.y) + a->size.z * fabs(d.z));
    if (x > sure) above = true;
    else if (x < -sure) below = true;
    else if (unsure++,
             !vs_v3_equal(b->at[i], a->at[0]) && !vs_v3_equal(b->at[i], a->at[1]) && !vs_v3_equal(b->at[i], a->at[2]))
      return false;
  }
  return above != below && unsure < 3;
}

static bool apart(const sheet *a, const sheet *b) {
  int shared;
  for (int i = 0; i < 3; i++)
    if (a->low[i] > b->high[i] || b->low[i] > a->high[i]) return true;
  return beside(a, b) || beside(b, a) || vs_triangles_apart(a->at, b->at, &shared);
}

/* ---- runs ---- */

/* A triangle that is to be added to a run. `longest`: square of its longest edge; `height`: square of its least height;
 * `low`: true if the triangle is too low to share a run with others. */
typedef struct { vs_vec3 at[3], normal; vs_bounds box; double longest, height; bool low; } facet;

/* Returns triangle t of the mesh with its normal, box and sizes. */
static facet facet_of(const search *c, uint32_t t) {
  facet f;
  VS_ASSERT(t < c->s->m->triangle_count);
  f.box = vs_bounds_empty();
  for (int i = 0; i < 3; i++) vs_bounds_add(&f.box, f.at[i] = c->s->m->vertices[c->s->m->triangles[t][i]]);
  vs_vec3 a = vs_v3_sub(f.at[1], f.at[0]), b = vs_v3_sub(f.at[2], f.at[1]), d = vs_v3_sub(f.at[0], f.at[2]);
  f.normal = vs_v3_cross(a, b);
  double x = vs_v3_dot(a, a), y = vs_v3_dot(b, b), z = vs_v3_dot(d, d), longest = x > y ? x : y;
  f.longest = z > longest ? z : longest;
  f.height = f.longest > 0 ? vs_v3_dot(f.normal, f.normal) / f.longest : 0;
  f.low = vs_v3_dot(f.normal, f.normal) < c->low * c->low * f.longest;
  return f;
}

static bool bounds_touch(const vs_bounds *a, const vs_bounds *b) {
  return (a->min.x <= b->max.x) & (b->min.x <= a->max.x) & (a->min.y <= b->max.y) & (b->min.y <= a->max.y) &
         (a->min.z <= b->max.z) & (b->min.z <= a->max.z);
}

/* Returns true if the normals a and b differ by less than 15 degrees. */
static bool alike(vs_vec3 a, vs_vec3 b) {
  double d = vs_v3_dot(a, b);
  return d > 0 && d * d > 0.933 * vs_v3_dot(a, a) * vs_v3_dot(b, b);
}

static vs_bvh_box box_of(const search *c, const vs_bounds *w) {
  double wide = 2 * c->s->coarsest, scale = 1 / c->step;
  vs_vec3 low = vs_v3_scale(vs_v3_sub(w->min, c->middle), scale),
          high = vs_v3_scale(vs_v3_sub(w->max, c->middle), scale);
  int32_t more = (int32_t)(wide * scale) + 1;
  return (vs_bvh_box){ { (int32_t)low.x - more, (int32_t)low.y - more, (int32_t)low.z - more },
                   { (int32_t)high.x + more, (int32_t)high.y + more, (int32_t)high.z + more } };
}

/* A run (triangles tested together) while triangles are added to it. Its list of corners contains nearly every corner
 * only once. */
typedef struct {
  run r;
  vs_vec3 normal;
  vs_bounds box;
  corners four[FOURS];
  uint32_t count, last[64];
} making;

static bool gather(vs_kernel *k, const search *c, uint32_t t, const facet *f, made *to, making *g) {
  for (int i = 0; i < 3; i++) {
    uint32_t v = c->s->m->triangles[t][i], n = g->last[v & 63];
    if (n >= g->count || g->four[n / 4].corner[n % 4] != v) {
      n = g->last[v & 63] = g->count++;
      vs_vec3 at = vs_v3_sub(f->at[i], c->middle);
      corners *p = &g->four[n / 4];
      for (uint32_t j = n % 4; j < 4; j++)
        p->x[j] = (float)at.x, p->y[j] = (float)at.y, p->z[j] = (float)at.z, p->corner[j] = v;
    }
    if (!VS_PUSH(k, to->places, (uint8_t)n)) return false;
  }
  return true;
}

static floats heights(const run *r, const corners *p) {
  return r->normal[0] * p->x + r->normal[1] * p->y + r->normal[2] * p->z;
}

static double coordinate(vs_vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/* Returns true if the run has corners on both sides of a plane that contains runs perpendicular to an axis, or within
 * the margin of such a plane. Otherwise it cannot intersect any of these runs. */
static bool is_busy(const search *c, const run *r, const vs_bounds *box, const corners *four) {
  const vs_rounding *s = c->s;
  if (r->is_low || r->is_changed) return true;
  for (int axis = 0; axis < 3; axis++) {
    double low = coordinate(box->min, axis), high = coordinate(box->max, axis);
    for (size_t i = vs_rounding_storey(s, axis, low - c->margin); i < s->storeys.count; i++) {
      double value = s->storeys.at[i].value;
      if (s->storeys.at[i].axis != axis || value > high + c->margin) break;
      if (s->places || (value != low && value != high)) return true;
      for (uint32_t j = 0; j < 4u * r->fours; j++) {
        double x = coordinate(s->m->vertices[four[j / 4].corner[j % 4]], axis);
        if (x != value && fabs(x - value) <= c->margin) return true;
      }
    }
  }
  return false;
}

static bool end_run(vs_kernel *k, const search *c, made *to, making *g) {
  double length = vs_v3_length(g->normal);
  vs_vec3 n = length > 0 ? vs_v3_scale(g->normal, 1 / length) : vs_v3(1, 0, 0);
  const vs_bounds *b = &g->box;
  run *r = &g->r;
  r->normal[0] = (float)n.x, r->normal[1] = (float)n.y, r->normal[2] = (float)n.z;
  r->low = INFINITY, r->high = -INFINITY;
  r->height = sqrtf(r->height), r->longest = sqrtf(r->longest);
  r->fours = (uint8_t)((g->count + 3) / 4);
  r->first_four = (uint32_t)to->fours.count;
  if (!VS_ROOM(k, to->fours.at, to->fours.room, to->fours.count + FOURS)) return false;
  for (uint32_t i = 0; i < r->fours; i++) {
    floats h = heights(r, &g->four[i]);
    for (int j = 0; j < 4; j++) {
      if (h[j] < r->low) r->low = h[j];
      if (h[j] > r->high) r->high = h[j];
    }
    to->fours.at[to->fours.count++] = g->four[i];
  }
  r->low -= c->margin;
  r->high += c->margin;
  r->level = r->is_low || r->is_changed ? NOT_LEVEL
             : b->min.x == b->max.x     ? 0
             : b->min.y == b->max.y     ? 1
             : b->min.z == b->max.z     ? 2
                                        : NOT_LEVEL;
  r->value = coordinate(b->min, r->level);
  size_t storey = r->level == NOT_LEVEL ? 0 : vs_rounding_storey(c->s, r->level, r->value);
  if (r->level != NOT_LEVEL && (storey == c->s->storeys.count || c->s->storeys.at[storey].value != r->value))
    r->level = NOT_LEVEL;
  r->busy = r->level == NOT_LEVEL && is_busy(c, r, b, g->four);
  runs *kind = &to->kinds[r->level == NOT_LEVEL ? OPEN : LEVEL];
  return VS_PUSH(k, kind->at, *r) && VS_PUSH(k, kind->boxes, box_of(c, b));
}

/* Returns true if triangle t has changed since the last search, or has a corner of a triangle that intersected another
 * in that search. After the test of all pairs, two triangles for which this is false need no second test. */
static bool is_anew(const vs_rounding *s, uint32_t t) {
  const uint32_t *v = s->m->triangles[t];
  return !s->searched || (s->changed.at[t] && !(s->changed.at[t] & VS_SEEN)) || s->near_met.at[v[0]] == 1 ||
         s->near_met.at[v[1]] == 1 || s->near_met.at[v[2]] == 1;
}

static bool make_runs(vs_kernel *k, void *context, size_t index) {
  search *c = context;
  made *to = &c->found[index % VS_PIPELINE_WINDOW];
  size_t count = c->s->m->triangle_count, begin = index * TRIANGLES,
         end = count - begin < TRIANGLES ? count : begin + TRIANGLES;
  making g;
  run *r = &g.r;
  r->count = 0;
  for (int i = 0; i < 2; i++) to->kinds[i].at.count = to->kinds[i].boxes.count = 0;
  to->fours.count = to->places.count = 0;
  for (size_t t = begin; t < end; t++) {
    if (c->s->gone.at[t] || (c->s->alone.count && c->s->alone.at[c->s->m->triangles[t][0]])) continue;
    facet f = facet_of(c, (uint32_t)t);
    uint32_t hub = c->around.of.count ? c->around.of.at[t] : UINT32_MAX;
    if (r->count && (r->count == RUN || hub != r->hub || f.low || r->is_low || r->is_changed || c->s->changed.at[t] ||
        t != r->first + r->count || !alike(f.normal, g.normal) || !bounds_touch(&g.box, &f.box))) {
      if (!end_run(k, c, to, &g)) return false;
      r->count = 0;
    }
    if (r->count == 0) {
      *r = (run){ .first = (uint32_t)t, .first_place = (uint32_t)to->places.count, .is_low = f.low,
          .is_changed = c->s->changed.at[t], .hub = hub, .height = INFINITY };
      g.normal = vs_v3(0, 0, 0);
      g.box = vs_bounds_empty();
      g.count = 0;
      memset(g.last, 0xff, sizeof g.last);
    }
    r->count++;
    r->anew = r->anew || is_anew(c->s, (uint32_t)t);
    r->height = fminf(r->height, (float)f.height), r->longest = fmaxf(r->longest, (float)f.longest);
    g.normal = vs_v3_add(g.normal, f.normal);
    vs_bounds_unite(&g.box, &f.box);
    if (!gather(k, c, (uint32_t)t, &f, to, &g)) return false;
  }
  return (!r->count || end_run(k, c, to, &g)) && vs_kernel_report(k, 1);
}

static bool take_kind(vs_kernel *k, const made *all, runs *to, const runs *from) {
  size_t n = to->at.count, more = from->at.count;
  if (!VS_ROOM(k, to->at.at, to->at.room, n + more + 1) || !VS_ROOM(k, to->boxes.at, to->boxes.room, n + more + 1))
    return false;
  for (size_t i = 0; i < more; i++) {
    run r = from->at.at[i];
    r.first_four += (uint32_t)all->fours.count;
    r.first_place += (uint32_t)all->places.count;
    to->at.at[n + i] = r;
    to->boxes.at[n + i] = from->boxes.at[i];
  }
  to->at.count = to->boxes.count = n + more;
  return true;
}

static bool take_runs(vs_kernel *k, void *context, size_t index) {
  search *c = context;
  made *from = &c->found[index % VS_PIPELINE_WINDOW], *to = &c->all;
  for (size_t i = 0; i < from->kinds[OPEN].at.count; i++)
    if (from->kinds[OPEN].at.at[i].busy && (!VS_PUSH(k, c->busy, (uint32_t)(to->kinds[OPEN].at.count + i)) ||
                                            !VS_PUSH(k, c->busy_boxes, from->kinds[OPEN].boxes.at[i])))
      return false;
  size_t fours = to->fours.count, places = to->places.count;
  if (!take_kind(k, to, &to->kinds[OPEN], &from->kinds[OPEN]) ||
      !take_kind(k, to, &to->kinds[LEVEL], &from->kinds[LEVEL]) ||
      !VS_ROOM(k, to->fours.at, to->fours.room, fours + from->fours.count + 1) ||
      !VS_ROOM(k, to->places.at, to->places.room, places + from->places.count + 1))
    return false;
  if (from->fours.count) memcpy(to->fours.at + fours, from->fours.at, from->fours.count * sizeof *from->fours.at);
  if (from->places.count) memcpy(to->places.at + places, from->places.at, from->places.count);
  to->fours.count += from->fours.count;
  to->places.count += from->places.count;
  return true;
}

static void drop_made(vs_kernel *k, made *m) {
  for (int i = 0; i < 2; i++) {
    VS_DROP(k, m->kinds[i].at);
    VS_DROP(k, m->kinds[i].boxes);
  }
  VS_DROP(k, m->fours);
  VS_DROP(k, m->places);
}

/* ---- pairs of runs ---- */

static uint32_t bits(truths all) { /* converts the lanes of a comparison to bits: bit i is set if lane i is true */
  uint64_t half[2];
  all &= (truths){ 1, 2, 4, 8 };
  memcpy(half, &all, sizeof half);
  half[0] |= half[1];
  return (uint32_t)(half[0] | half[0] >> 32);
}

/* Returns the index of the corner in run r, or NOT_ITS if the run does not contain this corner. */
static uint32_t place_of(const search *c, const run *r, uint32_t corner) {
  const corners *four = c->all.fours.at + r->first_four;
  for (uint32_t i = 0; i < 4u * r->fours; i++)
    if (four[i / 4].corner[i % 4] == corner) return i;
  return NOT_ITS;
}

static bool has_edge(const search *c, const run *r, uint32_t p, uint32_t q) { /* returns true if the run has an edge
                                                                               * between its corners with the indices p
                                                                               * and q */
  const uint8_t *place = c->all.places.at + r->first_place;
  for (uint32_t t = 0; t < r->count; t++, place += 3)
    if ((place[0] == p || place[1] == p || place[2] == p) && (place[0] == q || place[1] == q || place[2] == q))
      return true;
  return false;
}

/* Returns true if run b is steep over the plane of run a: over a distance of a's least height, b rises by more than
 * rounding may lift a corner. */
static bool falls_away(const search *c, const run *a, const run *b) {
  float enough = STEEP * (float)c->s->coarsest * b->longest, least = INFINITY;
  if (a->height * c->margin >= enough) return true; /* in nearly all cases, the lowest triangle of run a is high
                                                     * enough */
  const corners *four = c->all.fours.at + b->first_four;
  for (uint32_t i = 0; i < b->fours; i++) {
    floats h = heights(a, &four[i]);
    for (int j = 0; j < 4; j++) {
      float beyond = h[j] > a->high ? h[j] - a->high : a->low - h[j];
      if (beyond > 0) least = fminf(least, beyond);
    }
  }
  return a->height * (least + c->margin) >= enough;
}

/* Returns true if all corners of run b are beyond the interval of run a along its normal, on one side. Shared corners
 * and edges between shared corners do not count. If a is perpendicular to an axis, corners in its plane are allowed,
 * because they stay in it. */
static bool beyond(const search *c, const run *a, const run *b) {
  uint32_t above = 0, below = 0, in[4 * FOURS]; /* in[i]: for corner i of run b, its index among the corners of run a,
                                                 * or NOT_ITS */
  uint64_t shared = 0;
  bool touches = false, slopes = false;
  const corners *four = c->all.fours.at + b->first_four;
  for (uint32_t i = 0; i < b->fours; i++) {
    floats h = heights(a, &four[i]);
    uint32_t over = bits(h > a->high), under = bits(h < a->low), within = 15 & ~(over | under);
    above |= over;
    below |= under;
    if (above && below) return false;
    for (; within; within &= within - 1) {
      uint32_t at = 4 * i + (uint32_t)__builtin_ctz(within), corner = four[i].corner[at % 4];
      touches = true;
      slopes = slopes || a->level == NOT_LEVEL;
      if (a->level != NOT_LEVEL && !c->s->places && !b->is_changed &&
          coordinate(c->s->m->vertices[corner], a->level) == a->value)
        continue;
      if ((in[at] = place_of(c, a, corner)) == NOT_ITS) return false;
      shared |= UINT64_C(1) << at;
    }
  }
  if (!(above || below) || (touches && (a->is_low || b->is_low))) return false;
  if (slopes && !falls_away(c, a, b)) return false;
  const uint8_t *place = c->all.places.at + b->first_place;
  for (uint32_t t = 0; shared & (shared - 1) && t < b->count; t++, place += 3) {
    if (shared >> place[0] & shared >> place[1] & shared >> place[2] & 1) return false;
    for (int i = 0; i < 3; i++) {
      uint32_t p = place[i], q = place[i == 2 ? 0 : i + 1];
      if (shared >> p & shared >> q & 1 && !has_edge(c, a, in[p], in[q])) return false;
    }
  }
  return true;
}

/* The part of a triangle that lies in the interval of another run along that run's normal. min, max: its box; rounded:
 * the triangle after rounding, computed when needed (made). */
typedef struct { float min[3], max[3]; sheet rounded; uint32_t triangle; bool made; } piece;

static void add_place(piece *p, float x, float y, float z) {
  float at[3] = { x, y, z };
  for (int i = 0; i < 3; i++) {
    p->min[i] = at[i] < p->min[i] ? at[i] : p->min[i];
    p->max[i] = at[i] > p->max[i] ? at[i] : p->max[i];
  }
}

/* Adds to the piece the point where the edge from corner i to corner j has the given height over the plane of the other
 * run. */
static void add_through(piece *p, const corners *four, const float *h, uint32_t i, uint32_t j, float height) {
  const corners *a = &four[i / 4], *b = &four[j / 4];
  uint32_t x = i % 4, y = j % 4;
  if ((h[i] < height) == (h[j] < height)) return;
  float part = (height - h[i]) / (h[j] - h[i]);
  add_place(p, a->x[x] + part * (b->x[y] - a->x[x]), a->y[x] + part * (b->y[y] - a->y[x]),
            a->z[x] + part * (b->z[y] - a->z[x]));
}

/* Computes the pieces of run r that lie in the interval of another run along that run's normal. Returns their
 * number. */
static uint32_t cut(const search *c, const run *r, const run *slab, piece *to) {
  const corners *four = c->all.fours.at + r->first_four;
  const uint8_t *place = c->all.places.at + r->first_place;
  float h[4 * FOURS], low = slab->low, high = slab->high;
  uint32_t count = 0;
  for (uint32_t i = 0; i < r->fours; i++) {
    floats of = heights(slab, &four[i]);
    memcpy(h + 4 * i, &of, sizeof of);
  }
  for (uint32_t t = 0; t < r->count; t++, place += 3) {
    if ((h[place[0]] > high && h[place[1]] > high && h[place[2]] > high) ||
        (h[place[0]] < low && h[place[1]] < low && h[place[2]] < low))
      continue;
    piece *p = &to[count++];
    p->triangle = r->first + t;
    p->made = false;
    for (int i = 0; i < 3; i++) p->min[i] = INFINITY, p->max[i] = -INFINITY;
    for (int i = 0; i < 3; i++) {
      uint32_t at = place[i], next = place[i == 2 ? 0 : i + 1];
      if (h[at] >= low && h[at] <= high)
        add_place(p, four[at / 4].x[at % 4], four[at / 4].y[at % 4], four[at / 4].z[at % 4]);
      add_through(p, four, h, at, next, low);
      add_through(p, four, h, at, next, high);
    }
    for (int i = 0; i < 3; i++) p->min[i] -= c->margin, p->max[i] += c->margin;
  }
  return count;
}

static bool pieces_touch(const piece *a, const piece *b) {
  return (a->min[0] <= b->max[0]) & (b->min[0] <= a->max[0]) & (a->min[1] <= b->max[1]) & (b->min[1] <= a->max[1]) &
         (a->min[2] <= b->max[2]) & (b->min[2] <= a->max[2]);
}

static const sheet *sheet_of(const search *c, piece *p) {
  if (!p->made) load(c->s, p->triangle, &p->rounded);
  p->made = true;
  return &p->rounded;
}

typedef struct { vs_kernel *k; search *c; size_t at; const run *level; } looking;

/* Returns true if triangles x and y share an edge, face each other, and are so close that rounding may move one through
 * the other. The triangles beyond them may then cross although they face the same way. */
static bool is_fold(const search *c, const sheet *x, const sheet *y) {
  enum { UNITS = 16 };
  double along = vs_v3_dot(x->normal, y->normal), n = vs_v3_dot(x->normal, x->normal);
  if (!(along < 0) || along * along < 0.99 * n * vs_v3_dot(y->normal, y->normal)) return false;
  const uint32_t *v = c->s->m->triangles[x->triangle], *w = c->s->m->triangles[y->triangle];
  int shared = 0;
  double height = 0;
  for (int i = 0; i < 3; i++) {
    bool is_shared = w[i] == v[0] || w[i] == v[1] || w[i] == v[2];
    shared += is_shared;
    if (!is_shared) height = vs_v3_dot(x->normal, vs_v3_sub(y->at[i], x->at[0]));
  }
  return shared == 2 && height * height < UNITS * c->s->coarsest * (UNITS * c->s->coarsest) * n;
}

/* Tests whether triangles x and y intersect after rounding, and records the pair if they do. Records also whether they
 * intersected before rounding. For triangles with changed corners that did not, rounding is the cause. */
static bool try_triangles(looking *l, const sheet *x, const sheet *y) {
  const vs_rounding *s = l->c->s;
  if (is_fold(l->c, x, y) && !VS_PUSH(l->k, l->c->met[l->at].folds, ((pair){ x->triangle, y->triangle, false })))
    return false;
  if (x->flat || y->flat || apart(x, y)) return true;
  vs_triangle_meeting meeting = vs_triangles_meet(x->at, y->at);
  if (meeting == VS_MEET_NOT) return true;
  sheet p, q;
  load_exact(s, x->triangle, &p);
  load_exact(s, y->triangle, &q);
  bool before = !apart(&p, &q) && (p.flat || q.flat || vs_triangles_meet(p.at, q.at) != VS_MEET_NOT);
  if (before && meeting == VS_MEET_TOUCH && !vs_triangles_cross_level(x->at, y->at)) return true; /* the triangles
                                                                                                   * touched before
                                                                                                   * rounding, and
                                                                                                   * afterwards they
                                                                                                   * still touch without
                                                                                                   * crossing */
  return VS_PUSH(l->k, l->c->met[l->at].at, ((pair){ x->triangle, y->triangle, before }));
}

static bool try_runs(looking *l, const run *a, const run *b) {
  const search *c = l->c;
  piece of_a[RUN], of_b[RUN];
  uint32_t a_count = cut(c, a, b, of_a), b_count = a_count ? cut(c, b, a, of_b) : 0;
  for (uint32_t i = 0; i < a_count; i++)
    for (uint32_t j = 0; j < b_count; j++)
      if (pieces_touch(&of_a[i], &of_b[j]) &&
          !try_triangles(l, sheet_of(c, &of_a[i]), sheet_of(c, &of_b[j])))
        return false;
  return true;
}

static bool look_pair(looking *l, const run *a, const run *b) {
  if (!vs_kernel_poll(l->k, 1)) return false;
  if (!a->anew && !b->anew) return true;
  float same = a->normal[0] * b->normal[0] + a->normal[1] * b->normal[1] + a->normal[2] * b->normal[2];
  return (same > ALIKE && !a->is_low && !b->is_low && !a->is_changed && !b->is_changed) || beyond(l->c, a, b) ||
         beyond(l->c, b, a) || try_runs(l, a, b);
}

static bool look_open(void *context, uint32_t first, uint32_t second) {
  looking *l = context;
  const run *all = l->c->all.kinds[OPEN].at.at;
  return look_pair(l, &all[first < second ? first : second], &all[first < second ? second : first]);
}

static bool reach_of(vs_kernel *k, search *c, const run *r) {
  reach to = { .any = r->is_low || r->is_changed };
  const corners *four = c->all.fours.at + r->first_four;
  for (int axis = 0; axis < 3; axis++) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < 4u * r->fours; i++) {
      double x = coordinate(c->s->m->vertices[four[i / 4].corner[i % 4]], axis);
      low = fmin(low, x), high = fmax(high, x);
    }
    for (uint32_t i = 0; i < 4u * r->fours; i++) {
      double x = coordinate(c->s->m->vertices[four[i / 4].corner[i % 4]], axis);
      to.near_low[axis] = to.near_low[axis] || (x != low && x - low <= c->margin);
      to.near_high[axis] = to.near_high[axis] || (x != high && high - x <= c->margin);
    }
    to.low[axis] = low, to.high[axis] = high;
  }
  return VS_PUSH(k, c->reaches, to);
}

/* Returns true if the run may intersect runs in the plane at `value` perpendicular to the axis, because it crosses or
 * nearly touches this plane. */
static bool is_busy_at(const search *c, const reach *r, int axis, double value) {
  double low = r->low[axis], high = r->high[axis];
  if (r->any) return true;
  if (value == low || value == high)
    return c->s->places || (value == low && r->near_low[axis]) || (value == high && r->near_high[axis]);
  return low - value <= c->margin && value - high <= c->margin;
}

static bool look_level(void *context, uint32_t busy) {
  looking *l = context;
  const run *level = l->level;
  if (!is_busy_at(l->c, &l->c->reaches.at[busy], level->level, level->value)) return vs_kernel_poll(l->k, 1);
  return look_pair(l, l->level, &l->c->all.kinds[OPEN].at.at[l->c->busy.at[busy]]);
}

/* Marks the triangles that contraction may change: those at corners of intersecting triangles, and two further rings of
 * triangles around them. Returns false if interrupted. */
static bool mark_around(vs_rounding *s) {
  for (uint8_t ring = 1; ring <= 2; ring++)
    for (size_t t = 0; t < s->m->triangle_count; t++) {
      const uint32_t *v = s->m->triangles[t];
      bool near = false;
      for (int i = 0; i < 3; i++) near = near || (s->near_met.at[v[i]] && s->near_met.at[v[i]] <= ring);
      for (int i = 0; near && !s->gone.at[t] && i < 3; i++)
        if (!s->near_met.at[v[i]]) s->near_met.at[v[i]] = (uint8_t)(ring + 1);
      if (!vs_kernel_poll(s->k, 1)) return false;
    }
  return true;
}

enum { BLOCKS = 256, QUERIES = 1024 };

/* Returns the number of tasks that test pairs of runs (groups of triangles) that are not perpendicular to an axis. The
 * later tasks test the runs that are perpendicular to an axis. */
static size_t open_tasks(const search *c) { return ((size_t)vs_bvh_blocks(&c->bvh) + BLOCKS - 1) / BLOCKS; }

static bool look(vs_kernel *k, void *context, size_t index) {
  search *c = context;
  const runs *level = &c->all.kinds[LEVEL];
  looking l = { k, c, index % VS_PIPELINE_WINDOW, NULL };
  size_t open = open_tasks(c), begin = (index - open) * QUERIES, end = begin + QUERIES;
  c->met[l.at].at.count = c->met[l.at].folds.count = 0;
  if (index < open)
    return vs_bvh_pairs(k, &c->bvh, (uint32_t)index * BLOCKS, ((uint32_t)index + 1) * BLOCKS, look_open, &l) &&
           vs_kernel_report(k, 1);
  for (size_t i = begin; i < level->at.count && i < end; i++) {
    l.level = &level->at.at[i];
    if (!vs_bvh_query(&c->busy_bvh, &level->boxes.at[i], look_level, &l)) return false;
  }
  return vs_kernel_report(k, 1);
}

static void count_once(const search *c, uint32_t t) {
  vs_rounding *s = c->s;
  if (s->listed.at[t] & 2) return;
  s->listed.at[t] |= 2;
  for (int j = 0; j < 3; j++) s->near_met.at[s->m->triangles[t][j]] = 1;
  if (c->out->met++ == 0) c->out->at = vs_rounding_corner(s, s->m->triangles[t][0]);
}

static bool take(vs_kernel *k, void *context, size_t index) {
  search *c = context;
  (void)k;
  for (size_t i = 0; i < c->met[index % VS_PIPELINE_WINDOW].folds.count; i++) {
    pair p = c->met[index % VS_PIPELINE_WINDOW].folds.at[i];
    for (int j = 0; j < 6; j++) c->s->folded.at[c->s->m->triangles[j < 3 ? p.a : p.b][j % 3]] = 1;
    c->folds = true;
  }
  for (size_t i = 0; i < c->met[index % VS_PIPELINE_WINDOW].at.count; i++) {
    pair p = c->met[index % VS_PIPELINE_WINDOW].at.at[i];
    count_once(c, p.a);
    count_once(c, p.b);
    c->out->met_before += p.before;
  }
  return true;
}

/* Counts triangles that have no area after rounding as intersecting, because they lie on edges of other triangles. Such
 * a triangle forms a run (group of triangles tested together) alone. */
static bool count_flat(vs_kernel *k, const search *c) {
  const runs *open = &c->all.kinds[OPEN];
  for (size_t i = 0; i < open->at.count; i++) {
    sheet f;
    if (!vs_kernel_poll(k, 1)) return false;
    if (!open->at.at[i].is_low) continue;
    load(c->s, open->at.at[i].first, &f);
    bool is_edge = vs_v3_equal(f.at[0], f.at[1]) || vs_v3_equal(f.at[1], f.at[2]) || vs_v3_equal(f.at[2], f.at[0]);
    if (f.flat && !(is_edge && c->s->places)) count_once(c, f.triangle);
  }
  return true;
}

static vs_vec3 rounded_corner(const void *state, uint32_t vertex) { return vs_rounding_corner(state, vertex); }

static bool count_met(vs_rounding *s, vs_rounded *out, bool *folds) {
  enum { LOW = 4 /* LOW: triangles with a height below 2 * LOW units of the last place count as low */, MARGIN = 128 };
  vs_kernel *k = s->k;
  vs_vec3 size = vs_v3_sub(s->bounds.max, s->bounds.min);
  double extent = fmax(fmax(size.x, fmax(size.y, size.z)), 4 * s->coarsest);
  search c = { .s = s,
               .out = out,
               .middle = vs_v3_scale(vs_v3_add(s->bounds.min, s->bounds.max), 0.5),
               .step = extent > 0 ? extent * 0x1p-28 : 1,
               .low = LOW * s->coarsest,
               .margin = (float)(MARGIN * s->coarsest + 16 * 0x1p-24 * extent) };
  const runs *level = &c.all.kinds[LEVEL], *open = &c.all.kinds[OPEN];
  out->met = out->met_before = 0;
  for (size_t t = 0; t < s->m->triangle_count; t++) s->listed.at[t] &= 1;
  vs_fans fans = {
    (const uint32_t(*)[3])s->m->triangles, s->m->triangle_count, s->m->vertex_count, s->gone.at, rounded_corner, s
  };
  s->alone.count = 0;
  bool ok = (s->searched || vs_rounding_find_alone(s, c.margin)) && vs_hubs_find(k, &fans, &c.around) &&
      vs_kernel_pipeline(k, (s->m->triangle_count + TRIANGLES - 1) / TRIANGLES, make_runs, take_runs, &c);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) drop_made(k, &c.found[i]);
  for (size_t i = 0; ok && c.around.of.count && i < open->at.count; i++) ok = VS_PUSH(k, c.hubs, open->at.at[i].hub);
  for (size_t i = 0; ok && i < c.busy.count; i++)
    ok = vs_kernel_poll(k, 1) && reach_of(k, &c, &open->at.at[c.busy.at[i]]);
  c.bvh.families = c.around.of.count ? c.hubs.at : NULL;
  ok = ok && vs_bvh_build(k, &c.bvh, open->boxes.at, (uint32_t)open->boxes.count) &&
       vs_bvh_build(k, &c.busy_bvh, c.busy_boxes.at, (uint32_t)c.busy.count) &&
       vs_kernel_pipeline(k, open_tasks(&c) + (c.busy.count ? (level->at.count + QUERIES - 1) / QUERIES : 0), look,
                          take, &c) &&
       count_flat(k, &c);
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(k, c.met[i].at);
    VS_DROP(k, c.met[i].folds);
  }
  vs_bvh_free(k, &c.bvh);
  vs_bvh_free(k, &c.busy_bvh);
  VS_DROP(k, c.busy);
  VS_DROP(k, c.busy_boxes);
  VS_DROP(k, c.reaches);
  VS_DROP(k, c.hubs);
  vs_hubs_free(k, &c.around);
  drop_made(k, &c.all);
  *folds = c.folds;
  s->searched = s->searched || ok;
  for (size_t t = 0; t < s->m->triangle_count; t++)
    if (s->changed.at[t]) s->changed.at[t] |= VS_SEEN;
  return ok;
}

/* Marks the triangles around folds (pairs of triangles that face each other at an edge) as suspect. *any: true if a
 * triangle got a new mark. Returns false if interrupted. */
static bool suspect_folds(vs_rounding *s, bool *any) {
  *any = false;
  for (size_t t = 0; t < s->m->triangle_count; t++) {
    const uint32_t *v = s->m->triangles[t];
    if (!vs_kernel_poll(s->k, 1)) return false;
    if (s->gone.at[t] || s->changed.at[t] || !(s->folded.at[v[0]] || s->folded.at[v[1]] || s->folded.at[v[2]]))
      continue;
    s->changed.at[t] = VS_SUSPECT;
    *any = true;
  }
  return true;
}

bool vs_rounding_count_met(vs_rounding *s, vs_rounded *out) {
  bool folds = false, any = false;
  if (!VS_ROOM(s->k, s->folded.at, s->folded.room, s->m->vertex_count + 1)) return false;
  memset(s->folded.at, 0, s->m->vertex_count);
  return count_met(s, out, &folds) && (!folds || suspect_folds(s, &any)) && (!any || count_met(s, out, &folds)) &&
         (!out->met || mark_around(s));
}
