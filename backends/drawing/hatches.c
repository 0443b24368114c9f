/* Draws the fills of cut faces: a grey that depends on the material's name, and hatch lines, clipped to the face. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backends/drawing/hatches.h"

typedef struct { const char *name; double grey, angle, spacing; bool crossed; } hatch;
static const hatch rows[] = {
#define HATCH(name, grey, angle, spacing, crossed) { name, grey, angle, spacing, crossed },
#include "backends/drawing/hatches.def"
};
static const double earth_spacing = 2.5; /* distance between the earth's hatch lines in mm */
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

/* Parallel lines that hatch an area of the sheet. The function `across` returns a point's distance from line 0, divided
 * by the spacing of the lines. The function `along` returns the position of the point along its line, in mm. */
typedef struct {
  const vs_sheet_pen *pen;
  vs_drawn_layer layer;
  uint32_t first_loop, loop_count;
  double cosine, sine;      /* cosine and sine of the lines' angle */
  double spacing;           /* distance between neighbouring lines in mm */
  double begin;             /* number of the first hatch line that intersects the area's border */
  crossings *lines;
  size_t count;
} hatching;

static double across(const hatching *h, vs_sheet_point p) { return (p.y * h->cosine - p.x * h->sine) / h->spacing; }
static double along(const hatching *h, vs_sheet_point p) { return p.x * h->cosine + p.y * h->sine; }

/* Adds the intersections of hatch lines with the side from p to q of the area's border. A side includes only one of its
 * two ends, so a corner on a hatch line counts once if the border crosses the line there. */
static bool cross_side(const hatching *h, vs_sheet_point p, vs_sheet_point q) {
  double a = across(h, p), b = across(h, q), u = along(h, p), w = along(h, q);
  for (double k = ceil(fmin(a, b)); k < fmax(a, b); k++) {
    crossings *row = &h->lines[(size_t)(k - h->begin)];
    if (!vs_emit_grow(h->pen->e, &row->at, &row->room, row->count + 1, sizeof *row->at)) return false;
    row->at[row->count++] = u + (w - u) * ((k - a) / (b - a));
  }
  return true;
}

static bool cross_loops(const hatching *h) {
  const vs_sheet *s = h->pen->sheet;
  bool ok = true;
  for (uint32_t l = h->first_loop; l < h->first_loop + h->loop_count; l++) {
    const vs_sheet_point *at = s->points + s->loops[l].first;
    for (uint32_t i = 0; ok && i < s->loops[l].count; i++) ok = cross_side(h, at[i], at[(i + 1) % s->loops[l].count]);
  }
  return ok;
}

/* Draws the parts of hatch line i inside the area: from each odd intersection with the border to the next intersection.
 * Omits very short parts. */
static bool draw_line(const hatching *h, size_t i) {
  const crossings *row = &h->lines[i];
  double c = h->cosine, n = h->sine, off = (h->begin + (double)i) * h->spacing;
  bool ok = true;
  if (row->count > 1) qsort(row->at, row->count, sizeof *row->at, compare);
  for (size_t k = 0; ok && k + 1 < row->count; k += 2) {
    double from = row->at[k], to = row->at[k + 1];
    ok = to - from < 0.05 || vs_sheet_stroke(h->pen, h->layer,
                                             (vs_sheet_point){ from * c - off * n, from * n + off * c },
                                             (vs_sheet_point){ to * c - off * n, to * n + off * c });
  }
  return ok;
}

/* Draws hatch lines at whole multiples of the spacing, so that they continue from face to face. The time is
 * proportional to the number of lines plus the number of their intersections with borders. */
static bool draw_lines(hatching *h) {
  vs_emitter *e = h->pen->e;
  const vs_sheet *s = h->pen->sheet;
  double least = INFINITY, most = -INFINITY;
  for (uint32_t l = h->first_loop; l < h->first_loop + h->loop_count; l++)
    for (uint32_t i = 0; i < s->loops[l].count; i++) {
      double at = across(h, s->points[s->loops[l].first + i]);
      least = fmin(least, at), most = fmax(most, at);
    }
  double end = floor(most);
  h->begin = ceil(least);
  if (!(end >= h->begin) || end - h->begin > 1e5) return true;
  h->count = (size_t)(end - h->begin) + 1;
  h->lines = vs_store_realloc(e->scene->store, NULL, 0, h->count * sizeof *h->lines);
  if (!h->lines) return vs_emit_no_memory(e);
  memset(h->lines, 0, h->count * sizeof *h->lines);
  bool ok = cross_loops(h);
  for (size_t i = 0; i < h->count; i++) {
    ok = ok && draw_line(h, i);
    vs_emit_release(e, h->lines[i].at, h->lines[i].room, sizeof *h->lines[i].at);
  }
  vs_store_realloc(e->scene->store, h->lines, h->count * sizeof *h->lines, 0);
  return ok;
}

/* Draws hatch lines in the area bounded by the loops from first_loop to the sheet's last loop. The angle of the lines
 * is in radians. */
static bool lines_across(const vs_sheet_pen *pen, vs_drawn_layer layer, uint32_t first_loop, double angle,
                         double spacing) {
  hatching h = { .pen = pen,
                 .layer = layer,
                 .first_loop = first_loop,
                 .loop_count = (uint32_t)pen->sheet->loop_count - first_loop,
                 .cosine = cos(angle),
                 .sine = sin(angle),
                 .spacing = spacing };
  return draw_lines(&h);
}

bool vs_sheet_fill(const vs_sheet_pen *pen, const vs_flat_fill *fill) {
  vs_emitter *e = pen->e;
  vs_sheet *s = pen->sheet;
  const vs_flat_view *v = &s->views[pen->view];
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
  const double pi = 3.14159265358979323846;
  if (fill->kind == VS_FILL_EARTH) return lines_across(pen, VS_DRAWN_EARTH, first, pi / 4, earth_spacing);
  const bool fault = fill->kind == VS_FILL_FAULT;
  if (!vs_emit_grow(e, &s->marks, &s->mark_room, s->mark_count + 1, sizeof *s->marks)) return false;
  s->marks[s->mark_count++] = (vs_mark){ .kind = VS_MARK_FILL, .layer = fault ? VS_DRAWN_FAULT : VS_DRAWN_FILL,
      .view = pen->view, .first = first, .count = fill->loop_count, .grey = h->grey };
  if (fault) return true;
  const double angle = h->angle * (pi / 180);
  if (h->spacing > 0 && !lines_across(pen, VS_DRAWN_HATCH, first, angle, h->spacing)) return false;
  return !h->crossed || lines_across(pen, VS_DRAWN_HATCH, first, angle + pi / 2, h->spacing);
}
