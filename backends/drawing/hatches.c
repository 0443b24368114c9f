/* Owns the fills of cut faces: a grey by the material's name, and lines over it, cut to the face. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backends/drawing/hatches.h"

typedef struct { const char *name; double grey, angle, spacing; bool crossed; } hatch;
static const hatch rows[] = {
#define HATCH(name, grey, angle, spacing, crossed) { name, grey, angle, spacing, crossed },
#include "backends/drawing/hatches.def"
};
static const hatch plain = { "", 0.3, 0, 0, false };

static const hatch *hatch_of(const vs_material *m) {
  for (size_t i = 0; m && i < sizeof rows / sizeof *rows; i++)
    if (strcmp(m->name, rows[i].name) == 0) return &rows[i];
  return &plain;
}

typedef struct { double *at; size_t count, room; } crossings;
static int compare(const void *p, const void *q) {
  double a = *(const double *)p, b = *(const double *)q;
  return a < b ? -1 : a > b;
}

/* Lines at an angle (radians) across the mark's loops, those at whole multiples of the spacing, so that they run on
 * from face to face. Each is sorted crossings with the borders, in pairs; cost: lines and borders that cross. */
static bool lines_across(vs_emitter *e, vs_sheet *s, uint32_t view, uint32_t first_loop, uint32_t loop_count,
    double angle, double spacing) {
  double c = cos(angle), n = sin(angle), least = INFINITY, most = -INFINITY;
  struct { crossings *at; size_t count; } all = { NULL, 0 };
  bool ok = true;
  for (uint32_t l = first_loop; l < first_loop + loop_count; l++)
    for (uint32_t i = 0; i < s->loops[l].count; i++) {
      vs_sheet_point p = s->points[s->loops[l].first + i];
      double across = (p.y * c - p.x * n) / spacing;
      least = fmin(least, across), most = fmax(most, across);
    }
  double begin = ceil(least), end = floor(most);
  if (!(end >= begin) || end - begin > 1e5) return true;
  all.count = (size_t)(end - begin) + 1;
  all.at = vs_store_realloc(e->scene->store, NULL, 0, all.count * sizeof *all.at);
  if (!all.at) return vs_emit_no_memory(e);
  memset(all.at, 0, all.count * sizeof *all.at);
  for (uint32_t l = first_loop; ok && l < first_loop + loop_count; l++)
    for (uint32_t i = 0; ok && i < s->loops[l].count; i++) {
      vs_sheet_point p = s->points[s->loops[l].first + i],
          q = s->points[s->loops[l].first + (i + 1) % s->loops[l].count];
      double a = (p.y * c - p.x * n) / spacing, b = (q.y * c - q.x * n) / spacing, u = p.x * c + p.y * n,
          w = q.x * c + q.y * n;
      /* half open: a corner on a line counts once where the border goes on to the other side, twice or never where it
       * turns back */
      for (double k = ceil(fmin(a, b)); ok && k < fmax(a, b); k++) {
        crossings *row = &all.at[(size_t)(k - begin)];
        ok = vs_emit_grow(e, &row->at, &row->room, row->count + 1, sizeof *row->at);
        if (ok) row->at[row->count++] = u + (w - u) * ((k - a) / (b - a));
      }
    }
  for (size_t i = 0; i < all.count; i++) {
    crossings *row = &all.at[i];
    double across = (begin + (double)i) * spacing;
    if (row->count > 1) qsort(row->at, row->count, sizeof *row->at, compare);
    for (size_t k = 0; ok && k + 1 < row->count; k += 2) {
      vs_sheet_point line[2];
      for (int j = 0; j < 2; j++) line[j] = (vs_sheet_point){ row->at[k + (size_t)j] * c - across * n,
          row->at[k + (size_t)j] * n + across * c };
      ok = row->at[k + 1] - row->at[k] < 0.05 || vs_sheet_line(e, s, view, VS_DRAWN_HATCH, line, 2, false);
    }
    vs_emit_release(e, row->at, row->room, sizeof *row->at);
  }
  vs_store_realloc(e->scene->store, all.at, all.count * sizeof *all.at, 0);
  return ok;
}

bool vs_sheet_fill(vs_emitter *e, vs_sheet *s, uint32_t view, const vs_flat_fill *fill) {
  const vs_flat_view *v = &s->views[view];
  const hatch *h = hatch_of(fill->material);
  uint32_t first = (uint32_t)s->loop_count;
  for (uint32_t l = fill->first_loop; l < fill->first_loop + fill->loop_count; l++) {
    if (!vs_emit_grow(e, &s->loops, &s->loop_room, s->loop_count + 1, sizeof *s->loops) ||
        !vs_emit_grow(e, &s->points, &s->point_room, s->point_count + v->loops[l].count, sizeof *s->points))
      return false;
    s->loops[s->loop_count].first = (uint32_t)s->point_count, s->loops[s->loop_count++].count = v->loops[l].count;
    for (uint32_t i = 0; i < v->loops[l].count; i++) s->points[s->point_count++] = vs_sheet_place(v,
        v->points[v->loops[l].first + i]);
  }
  if (!vs_emit_grow(e, &s->marks, &s->mark_room, s->mark_count + 1, sizeof *s->marks)) return false;
  s->marks[s->mark_count++] = (vs_mark){ .kind = VS_MARK_FILL, .layer = VS_DRAWN_FILL, .view = view, .first = first,
      .count = fill->loop_count, .grey = h->grey };
  double angle = h->angle * (3.14159265358979323846 / 180);
  if (h->spacing > 0 && !lines_across(e, s, view, first, fill->loop_count, angle, h->spacing)) return false;
  return !h->crossed || lines_across(e, s, view, first, fill->loop_count, angle + 3.14159265358979323846 / 2,
      h->spacing);
}
