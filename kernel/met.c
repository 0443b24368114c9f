/* Owns the search for triangles that rounding has made meet, beside all that was suspect. Suspect corners are looked at by threads; where something meets
 * something the caller's thread says what, in order.
 *
 * Nearly all pairs are told apart by their boxes, or by the plane of one of them; apart.c has the rest. */
#include "kernel/apart.h"
#include "kernel/settling.h"

#include <math.h>
#include <string.h>

enum { ROOM = 96 /* triangles around a corner and its neighbours */, TASK = 64 /* corners */ };

/* A triangle as rounded. */
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

static void load(const vs_settling *s, uint32_t t, sheet *to) {
  to->triangle = t;
  for (int i = 0; i < 3; i++) to->at[i] = vs_settling_corner(s, s->m->triangles[t][i]);
  const vs_vec3 *v = to->at;
  vs_vec3 e = vs_v3_sub(v[1], v[0]), f = vs_v3_sub(v[2], v[0]);
  to->normal = vs_v3_cross(e, f);
  to->size = magnitudes(e, f);
  to->low[0] = fmin(fmin(v[0].x, v[1].x), v[2].x), to->high[0] = fmax(fmax(v[0].x, v[1].x), v[2].x);
  to->low[1] = fmin(fmin(v[0].y, v[1].y), v[2].y), to->high[1] = fmax(fmax(v[0].y, v[1].y), v[2].y);
  to->low[2] = fmin(fmin(v[0].z, v[1].z), v[2].z), to->high[2] = fmax(fmax(v[0].z, v[1].z), v[2].z);
  to->flat = vs_v3_equal(v[0], v[1]) || vs_v3_equal(v[1], v[2]) || vs_v3_equal(v[2], v[0]);
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
