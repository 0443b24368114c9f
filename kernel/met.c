/* Owns the search for triangles that rounding has made meet. Beside what was suspect corners are looked at by threads; where something meets something the
 * caller's thread says what, in order. Shells that come near each other are looked at whole: what is flush but for the last place, as two hollows whose
 * edges all but touch, is in nobody's neighbourhood and need not be thin.
 *
 * Nearly all pairs are told apart by their boxes, or by the plane of one of them; apart.c has the rest. */
#include "kernel/apart.h"
#include "kernel/bvh.h"
#include "kernel/settling.h"
#include "kernel/table.h"
#include "model/disjoint.h"

#include <math.h>
#include <string.h>

enum { ROOM = 96 /* triangles around a corner and its neighbours */, TASK = 64 /* corners */ };

/* A triangle, mostly as rounded. */
typedef struct {
  uint32_t triangle;
  vs_vec3 at[3], normal, size; /* size: the same as normal of the products' sizes: 1e-14 of it is more than any error */
  double low[3], high[3];
  bool flat; /* two corners are one */
} sheet;

typedef struct {
  vs_settling *s;
  vs_settled *out;
  VS_LIST(uint32_t) corners; /* suspect, in order */
  struct { uint32_t at[TASK], count; } met[VS_PIPELINE_WINDOW]; /* those where something meets something */
} suspects;

static vs_vec3 magnitudes(vs_vec3 p, vs_vec3 q) {
  vs_vec3 a = vs_v3(fabs(p.x), fabs(p.y), fabs(p.z)), b = vs_v3(fabs(q.x), fabs(q.y), fabs(q.z));
  return vs_v3(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x);
}

static void measure(sheet *to) {
  const vs_vec3 *v = to->at;
  vs_vec3 e = vs_v3_sub(v[1], v[0]), f = vs_v3_sub(v[2], v[0]);
  to->normal = vs_v3_cross(e, f);
  to->size = magnitudes(e, f);
  to->low[0] = fmin(fmin(v[0].x, v[1].x), v[2].x), to->high[0] = fmax(fmax(v[0].x, v[1].x), v[2].x);
  to->low[1] = fmin(fmin(v[0].y, v[1].y), v[2].y), to->high[1] = fmax(fmax(v[0].y, v[1].y), v[2].y);
  to->low[2] = fmin(fmin(v[0].z, v[1].z), v[2].z), to->high[2] = fmax(fmax(v[0].z, v[1].z), v[2].z);
  to->flat = vs_v3_equal(v[0], v[1]) || vs_v3_equal(v[1], v[2]) || vs_v3_equal(v[2], v[0]);
}

static void load(const vs_settling *s, uint32_t t, sheet *to) {
  to->triangle = t;
  for (int i = 0; i < 3; i++) to->at[i] = vs_settling_corner(s, s->m->triangles[t][i]);
  measure(to);
}

static void load_exact(const vs_settling *s, uint32_t t, sheet *to) {
  to->triangle = t;
  for (int i = 0; i < 3; i++) to->at[i] = s->m->vertices[s->m->triangles[t][i]];
  measure(to);
}

/* Is b on one side of a's plane, but for corners that are a's as well? */
static bool beside(const sheet *a, const sheet *b) {
  bool above = false, below = false;
  int unsure = 0;
  for (int i = 0; i < 3; i++) {
    vs_vec3 d = vs_v3_sub(b->at[i], a->at[0]);
    double x = vs_v3_dot(a->normal, d), sure = 1e-14 * (a->size.x * fabs(d.x) + a->size.y * fabs(d.y) + a->size.z * fabs(d.z));
    if (x > sure) above = true;
    else if (x < -sure) below = true;
    else if (unsure++, !vs_v3_equal(b->at[i], a->at[0]) && !vs_v3_equal(b->at[i], a->at[1]) && !vs_v3_equal(b->at[i], a->at[2])) return false;
  }
  return above != below && unsure < 3;
}

static bool apart(const sheet *a, const sheet *b) {
  int shared;
  for (int i = 0; i < 3; i++)
    if (a->low[i] > b->high[i] || b->low[i] > a->high[i]) return true;
  return beside(a, b) || beside(b, a) || vs_triangles_apart(a->at, b->at, &shared);
}

/* Triangles around a corner, and around those next to it: each once, in order. */
static size_t gather(const vs_settling *s, uint32_t v, uint32_t *list) {
  size_t n = 0;
  for (uint32_t i = 0; i < s->fans.at[v].count; i++)
    for (int j = 0; j < 3; j++) {
      const vs_fan *f = &s->fans.at[s->m->triangles[s->around.at[s->fans.at[v].first + i]][j]];
      for (uint32_t k = 0; k < f->count && n < ROOM; k++) {
        uint32_t t = s->around.at[f->first + k];
        size_t at = n;
        while (at > 0 && list[at - 1] > t) at--;
        if (at > 0 && list[at - 1] == t) continue;
        memmove(list + at + 1, list + at, (n++ - at) * sizeof *list);
        list[at] = t;
      }
    }
  return n;
}

/* Does anything around the corner meet anything? */
static bool meets(const vs_settling *s, uint32_t v) {
  uint32_t list[ROOM];
  sheet all[ROOM];
  size_t n = gather(s, v, list);
  for (size_t i = 0; i < n; i++) load(s, list[i], &all[i]);
  for (size_t i = 0; i < n; i++) {
    const uint32_t *t = s->m->triangles[list[i]];
    if (all[i].flat || (t[0] != v && t[1] != v && t[2] != v)) continue;
    for (size_t j = 0; j < n; j++)
      if (j != i && !all[j].flat && !apart(&all[i], &all[j])) return true;
  }
  return false;
}

static bool look(vs_kernel *k, void *context, size_t index) {
  suspects *s = context;
  size_t begin = index * TASK, end = s->corners.count - begin < TASK ? s->corners.count : begin + TASK;
  uint32_t *met = s->met[index % VS_PIPELINE_WINDOW].at, *count = &s->met[index % VS_PIPELINE_WINDOW].count;
  *count = 0;
  for (size_t i = begin; i < end; i++)
    if (meets(s->s, s->corners.at[i])) met[(*count)++] = s->corners.at[i];
  return vs_kernel_report(k, 1);
}

/* Counts what meets around the corners that a task found. */
static bool take(vs_kernel *k, void *context, size_t index) {
  suspects *all = context;
  vs_settling *s = all->s;
  (void)k;
  for (uint32_t i = 0; i < all->met[index % VS_PIPELINE_WINDOW].count; i++) {
    uint32_t v = all->met[index % VS_PIPELINE_WINDOW].at[i], list[ROOM];
    size_t n = gather(s, v, list);
    for (size_t a = 0; a < n; a++) {
      const uint32_t *t = s->m->triangles[list[a]];
      sheet one, other;
      load(s, list[a], &one);
      if (one.flat || (t[0] != v && t[1] != v && t[2] != v)) continue;
      for (size_t b = 0; b < n && !(s->listed.at[list[a]] & 2); b++) {
        if (b == a || (load(s, list[b], &other), other.flat) || apart(&one, &other)) continue;
        s->listed.at[list[a]] |= 2;
        for (size_t j = 0; j < n; j++)
          for (int l = 0; l < 3; l++) s->suspect.at[s->m->triangles[list[j]][l]] |= VS_NEAR_MET;
        if (all->out->met++ == 0) all->out->at = one.at[0];
      }
    }
  }
  return true;
}

/* ---- between shells ---- */

typedef struct { uint32_t a, b; } pair;
typedef struct {
  vs_settling *s;
  vs_settled *out;
  VS_LIST(_Atomic uint32_t) set; /* of a vertex: disjoint sets */
  VS_LIST(uint32_t) live;        /* triangles that are not gone */
  VS_LIST(vs_box) boxes;         /* of them, as rounded, and a little wider */
  VS_LIST(uint32_t) shells;      /* of them; VS_NONE where no other is near */
  VS_LIST(uint32_t) number;      /* of a vertex: its shell */
  vs_bvh bvh, near;              /* of triangles that are near another shell; of shells */
  vs_bounds all;
  double step;                   /* of boxes */
  struct { VS_LIST(pair) at; } met[VS_PIPELINE_WINDOW];
} between;

enum { TRIANGLES = 1 << 14, BLOCKS = 512 };

static bool unite_some(vs_kernel *k, void *context, size_t index) {
  between *b = context;
  size_t n = b->live.count, begin = index * TRIANGLES, end = n - begin < TRIANGLES ? n : begin + TRIANGLES;
  for (size_t i = begin; i < end; i++) {
    const uint32_t *v = b->s->m->triangles[b->live.at[i]];
    vs_unite_shared(b->set.at, v[0], v[1]);
    vs_unite_shared(b->set.at, v[0], v[2]);
  }
  return vs_kernel_report(k, 1);
}

static vs_box box_of(const between *b, const vs_bounds *w) {
  vs_vec3 low = vs_v3_scale(vs_v3_sub(w->min, b->all.min), 1 / b->step), high = vs_v3_scale(vs_v3_sub(w->max, b->all.min), 1 / b->step);
  return (vs_box){ { (int32_t)low.x - 1, (int32_t)low.y - 1, (int32_t)low.z - 1 }, { (int32_t)high.x + 1, (int32_t)high.y + 1, (int32_t)high.z + 1 } };
}

typedef struct { uint32_t shell; bool other; } own;
static bool found_other(void *context, uint32_t shell) {
  own *o = context;
  o->other = shell != o->shell;
  return !o->other;
}

static bool box_some(vs_kernel *k, void *context, size_t index) {
  between *b = context;
  size_t n = b->live.count, begin = index * TRIANGLES, end = n - begin < TRIANGLES ? n : begin + TRIANGLES;
  for (size_t i = begin; i < end; i++) {
    const uint32_t *v = b->s->m->triangles[b->live.at[i]];
    vs_bounds w = vs_bounds_empty();
    for (int j = 0; j < 3; j++) vs_bounds_add(&w, vs_settling_corner(b->s, v[j]));
    own o = { b->number.at[v[0]], false };
    b->boxes.at[i] = box_of(b, &w);
    vs_bvh_query(&b->near, &b->boxes.at[i], found_other, &o);
    b->shells.at[i] = o.other ? o.shell : VS_NONE;
    if (!vs_kernel_poll(k, 1)) return false;
  }
  return true;
}

static bool found_one(void *context, uint32_t a, uint32_t b) {
  (void)a, (void)b;
  *(bool *)context = true;
  return false; /* enough */
}

/* Do the boxes of any two shells meet? Else nothing of theirs does. */
static bool shells_near(vs_kernel *k, between *b, bool *near) {
  const vs_settling *s = b->s;
  uint32_t n = (uint32_t)s->m->vertex_count, count = 0;
  VS_LIST(vs_bounds) bounds = { 0 };
  VS_LIST(vs_box) boxes = { 0 };
  uint32_t *number;
  bool ok = VS_ROOM(k, b->number.at, b->number.room, (size_t)n + 1);
  number = b->number.at;
  for (uint32_t v = 0; ok && v < n; v++) { /* roots are the smallest of their sets */
    uint32_t root = vs_find_shared(b->set.at, v);
    if (root == v) ok = VS_PUSH(k, bounds, vs_bounds_empty());
    if (!ok) break;
    number[v] = root == v ? count++ : number[root];
    vs_bounds_add(&bounds.at[number[v]], s->m->vertices[v]);
    ok = vs_kernel_poll(k, 1);
  }
  *near = false;
  if (ok && count > 1) {
    ok = VS_ROOM(k, boxes.at, boxes.room, (size_t)count + 1);
    for (uint32_t i = 0; ok && i < count; i++) {
      vs_bounds *w = &bounds.at[i];
      double wide = s->coarsest;
      *w = (vs_bounds){ vs_v3_sub(w->min, vs_v3(wide, wide, wide)), vs_v3_add(w->max, vs_v3(wide, wide, wide)) };
      vs_bounds_meet(w, &b->all);
      boxes.at[i] = box_of(b, w);
    }
    ok = ok && vs_bvh_build(k, &b->near, boxes.at, count) && (vs_bvh_pairs(&b->near, 0, UINT32_MAX, found_one, near) || *near);
  }
  VS_DROP(k, bounds);
  VS_DROP(k, boxes);
  return ok;
}

typedef struct { vs_kernel *k; between *b; size_t at; } looking;
static bool look_pair(void *context, uint32_t a, uint32_t b) {
  looking *l = context;
  const vs_settling *s = l->b->s;
  sheet x, y;
  if (!vs_kernel_poll(l->k, 1)) return false;
  load(s, l->b->live.at[a < b ? a : b], &x);
  load(s, l->b->live.at[a < b ? b : a], &y);
  if (x.flat || y.flat || apart(&x, &y)) return true;
  load_exact(s, x.triangle, &x);
  load_exact(s, y.triangle, &y);
  if (!apart(&x, &y)) return true; /* they touch as it is */
  return VS_PUSH(l->k, l->b->met[l->at].at, ((pair){ x.triangle, y.triangle }));
}

static bool look_between(vs_kernel *k, void *context, size_t index) {
  between *b = context;
  looking l = { k, b, index % VS_PIPELINE_WINDOW };
  b->met[l.at].at.count = 0;
  return vs_bvh_pairs(&b->bvh, (uint32_t)index * BLOCKS, ((uint32_t)index + 1) * BLOCKS, look_pair, &l) && vs_kernel_report(k, 1);
}

static bool take_between(vs_kernel *k, void *context, size_t index) {
  between *b = context;
  vs_settling *s = b->s;
  (void)k;
  for (size_t i = 0; i < b->met[index % VS_PIPELINE_WINDOW].at.count; i++) {
    pair p = b->met[index % VS_PIPELINE_WINDOW].at.at[i];
    for (int end = 0; end < 2; end++) {
      uint32_t t = end ? p.b : p.a;
      if (s->listed.at[t] & 2) continue;
      s->listed.at[t] |= 2;
      for (int j = 0; j < 3; j++) s->suspect.at[s->m->triangles[t][j]] |= VS_NEAR_MET;
      if (b->out->met++ == 0) b->out->at = vs_settling_corner(s, s->m->triangles[t][0]);
    }
  }
  return true;
}

bool vs_settling_count_between(vs_settling *s, vs_settled *out) {
  vs_kernel *k = s->k;
  const vs_mesh *m = s->m;
  between b = { .s = s, .out = out, .all = vs_mesh_bounds(m) };
  size_t n = m->vertex_count, room = m->triangle_count + 1, tasks;
  bool near = false, ok = VS_ROOM(k, b.set.at, b.set.room, n + 1) && VS_ROOM(k, b.live.at, b.live.room, room);
  vs_vec3 wide = vs_v3(s->coarsest, s->coarsest, s->coarsest);
  b.all = (vs_bounds){ vs_v3_sub(b.all.min, wide), vs_v3_add(b.all.max, wide) };
  b.step = fmax(fmax(b.all.max.x - b.all.min.x, b.all.max.y - b.all.min.y), b.all.max.z - b.all.min.z) * 0x1p-28;
  if (!(b.step > 0)) b.step = 1;
  for (uint32_t v = 0; ok && v < n; v++) atomic_init(&b.set.at[v], v);
  for (uint32_t t = 0; ok && t < m->triangle_count; t++)
    if (!s->gone.at[t]) b.live.at[b.live.count++] = t;
  tasks = (b.live.count + TRIANGLES - 1) / TRIANGLES;
  ok = ok && vs_kernel_run(k, tasks, unite_some, &b) && shells_near(k, &b, &near);
  if (ok && near) {
    ok = VS_ROOM(k, b.boxes.at, b.boxes.room, room) && VS_ROOM(k, b.shells.at, b.shells.room, room) && vs_kernel_run(k, tasks, box_some, &b);
    size_t kept = 0;
    for (size_t i = 0; ok && i < b.live.count; i++) {
      if (b.shells.at[i] == VS_NONE) continue;
      b.live.at[kept] = b.live.at[i];
      b.boxes.at[kept] = b.boxes.at[i];
      b.shells.at[kept++] = b.shells.at[i];
    }
    b.live.count = kept;
    b.bvh.families = b.shells.at;
    ok = ok && vs_bvh_build(k, &b.bvh, b.boxes.at, (uint32_t)b.live.count) &&
         vs_kernel_pipeline(k, ((size_t)vs_bvh_blocks(&b.bvh) + BLOCKS - 1) / BLOCKS, look_between, take_between, &b);
  }
  for (int i = 0; i < VS_PIPELINE_WINDOW; i++) VS_DROP(k, b.met[i].at);
  vs_bvh_free(k, &b.bvh);
  vs_bvh_free(k, &b.near);
  VS_DROP(k, b.number);
  VS_DROP(k, b.set);
  VS_DROP(k, b.live);
  VS_DROP(k, b.boxes);
  VS_DROP(k, b.shells);
  return ok;
}

/* ---- beside what was suspect ---- */

bool vs_settling_count_met(vs_settling *s, vs_settled *out) {
  suspects all = { .s = s, .out = out };
  bool ok = true;
  out->met = 0;
  for (size_t t = 0; t < s->m->triangle_count; t++) s->listed.at[t] &= 1;
  for (size_t i = 0; i < s->look.count; i++) {
    uint32_t t = s->look.at[i];
    if (s->gone.at[t] || !vs_settling_is_noise(s, t)) continue;
    for (int j = 0; j < 3; j++) s->suspect.at[s->m->triangles[t][j]] |= VS_NEAR_THIN;
  }
  for (uint32_t v = 0; ok && v < s->m->vertex_count; v++)
    if (s->suspect.at[v] & VS_NEAR_THIN) ok = VS_PUSH(s->k, all.corners, v);
  ok = ok && vs_kernel_pipeline(s->k, (all.corners.count + TASK - 1) / TASK, look, take, &all);
  VS_DROP(s->k, all.corners);
  return ok;
}
