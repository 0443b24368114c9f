/* Nests flat parts on sheets (nesting.h).
 *
 * Each part is divided into convex pieces. Let p be a piece of the part, and q a piece that lies on the sheet. A move
 * by the vector t brings p nearer to q than the gap if t is inside the sum of q and -p, grown by the gap. This sum is
 * convex. On a line of constant y the sums leave intervals of x, exactly. A part goes to the place that is furthest
 * left on any of the lines. There are lines where the part's box touches the sheet's or another part's box, and others
 * at equal distances. Then finer lines next to the best line improve the place.
 *
 * Parts are placed one after another, each on the first sheet where it fits. The order is then changed at random, and a
 * change is kept if the last sheet is filled less far. The random numbers depend only on the parts. */
#include "geometry/nets/nesting.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/nets/convex_pieces.h"
#include "model/store/array.h"
#include "model/vec.h"

enum {
  EVEN_LINES = 40,   /* number of lines along X, at equal distances, on which a place for a part is searched */
  MOST_LINES = 200,
  FINE_LINES = 6,    /* number of further lines on each side of the best line, on which a better place is searched */
  FINER = 2,         /* number of times that further, ever closer lines are searched to improve a place */
  MOST_CORNERS = 24, /* greatest number of corners of a part that keeps its exact outline; other parts get a simpler
                      * one */
  LATE = 30,         /* A new order is compared with the order this many changes before, see improve. */
  IDLE = 2000,       /* number of changes without an improvement after which the search ends */
  LONG_SIDES = 4     /* number of long sides of a part that are tried along the sheet's sides */
};

static const double pi = 3.14159265358979323846;

typedef struct { double x0, y0, x1, y1; } box;

/* A convex piece of a part that is turned by one of the allowed angles. `first`: index of its first point p in the
 * array of points, and of -p in the array of opposite points. */
typedef struct {
  size_t first, count;
  box box;
} piece;

/* A form: a part of one kind, turned by one of the allowed angles. */
typedef struct {
  size_t first, count; /* range of the form's convex pieces in the list of all pieces */
  box box;
  double angle;
} form;

/* A kind: all parts of one shape. */
typedef struct {
  size_t first, count; /* range of the kind's forms, one for each allowed angle, in the list of all forms */
  double area, extent; /* area: area of the part; extent: longer side of its bounding box */
  uint32_t part;       /* number of the first part that is of this kind */
} kind;

typedef struct {
  size_t piece;
  vs_vec2 move;
} laid_piece;

typedef struct {
  laid_piece *at;
  size_t count, room;
  box *parts; /* bounding boxes of the parts that lie on the sheet */
  size_t part_count, part_room;
  double width, free, reach;
  bool *full; /* full[k]: true if a part of kind k no longer fits on this sheet */
} sheet;

typedef struct { double from, to; } span;

typedef struct {
  span *at;
  size_t count, room;
} spans;

/* The sum of a piece on a sheet and the opposite of a form's piece: all moves by which the two pieces would overlap. */
typedef struct {
  size_t first, count, low, high; /* first, count: range of the sum's points; low, high: indices of its points with the
                                   * least and the greatest y */
  double y0, y1;
} sum;

typedef struct {
  uint32_t sheet;
  size_t form;
  vs_vec2 move;
} laid;

/* An order of the parts that is kept for later, the places that follow from it, and its cost. */
typedef struct {
  uint32_t *order;
  laid *laid;
  int wish;
  double cost, reach; /* cost: length of sheets that are filled, see place_all; reach: length to which the endless sheet
                       * is filled, or infinity */
} memory;

typedef struct {
  const vs_nest_rule *rule;
  double slack; /* lengths below this value count as 0 */
  vs_vec2 *at, *mirrored;
  size_t points, point_room, mirrored_room;
  piece *pieces;
  size_t piece_count, piece_room;
  form *forms;
  size_t form_count, form_room;
  kind *kinds;
  size_t kind_count, kind_room;
  uint32_t *kind_of; /* kind_of[i]: number of the kind to which part i belongs */
  size_t parts;
  sheet *sheets;
  size_t sheet_count, sheet_room, used; /* used: number of sheets that contain parts */
  sum *sums;
  size_t sum_count, sum_room;
  vs_vec2 *sum_at;
  size_t sum_points, sum_point_room;
  vs_vec2 *draft; /* working memory for the corners of the sum of two convex pieces */
  size_t draft_room;
  double lines[MOST_LINES];
  size_t line_count;
  spans spans[MOST_LINES];
  uint32_t *order; /* numbers of the parts, in the order in which they are placed */
  laid *laid;      /* laid[i]: where part i was placed: number of its sheet, its form (rotation) and its move */
  memory best, now;
  uint64_t steps, most_steps;
  uint32_t chance;
  int wish;       /* number of the rule by which the best place on a sheet is chosen, see `wanted` */
  size_t endless; /* index of the sheet that is treated as if it had no end, or SIZE_MAX if there is none */
  vs_long_work work;
  bool stopped;
} nest;

/* ---- kinds and forms ---- */

static box no_box(void) { return (box){ INFINITY, INFINITY, -INFINITY, -INFINITY }; }
static void widen(box *b, vs_vec2 p) {
  b->x0 = fmin(b->x0, p.x), b->y0 = fmin(b->y0, p.y), b->x1 = fmax(b->x1, p.x), b->y1 = fmax(b->y1, p.y);
}
static vs_vec2 turned(vs_vec2 p, double s, double c) { return (vs_vec2){ c * p.x - s * p.y, s * p.x + c * p.y }; }

/* Copies the n points of a convex polygon to `out`, beginning with the leftmost of its lowest points. */
static void from_lowest(const vs_vec2 *in, size_t n, vs_vec2 *out) {
  size_t low = 0;
  for (size_t i = 1; i < n; i++)
    if (in[i].y < in[low].y || (in[i].y == in[low].y && in[i].x < in[low].x)) low = i;
  for (size_t i = 0; i < n; i++) out[i] = in[(low + i) % n];
}

/* Adds a form: the pieces c turned by the angle, unless the sheet is too small for it. Returns false when memory is
 * out. */
static bool add_form(nest *w, const vs_convex_pieces *c, double angle) {
  double s, co;
  form f = { .first = w->piece_count, .box = no_box(), .angle = angle };
  vs_sincos(angle, &s, &co);
  if (!VS_GROW(w->at, w->point_room, w->points + c->count) ||
      !VS_GROW(w->mirrored, w->mirrored_room, w->points + c->count) ||
      !VS_GROW(w->pieces, w->piece_room, w->piece_count + c->pieces) ||
      !VS_GROW(w->forms, w->form_room, w->form_count + 1) || !VS_GROW(w->draft, w->draft_room, c->count))
    return false;
  size_t points = w->points;
  for (size_t p = 0, first = 0; p < c->pieces; first += c->size[p++]) {
    size_t n = c->size[p];
    piece *made = &w->pieces[w->piece_count + p];
    *made = (piece){ points, n, no_box() };
    for (size_t i = 0; i < n; i++) w->draft[i] = turned(c->at[first + i], s, co), widen(&made->box, w->draft[i]);
    from_lowest(w->draft, n, w->at + points);
    for (size_t i = 0; i < n; i++) w->draft[i] = (vs_vec2){ -w->draft[i].x, -w->draft[i].y };
    from_lowest(w->draft, n, w->mirrored + points);
    widen(&f.box, (vs_vec2){ made->box.x0, made->box.y0 }), widen(&f.box, (vs_vec2){ made->box.x1, made->box.y1 });
    points += n;
  }
  double room = 2 * w->rule->margin - w->slack;
  f.count = c->pieces;
  if (f.box.x1 - f.box.x0 + room > w->rule->width || f.box.y1 - f.box.y0 + room > w->rule->height) return true;
  w->points = points, w->piece_count += c->pieces;
  w->forms[w->form_count++] = f;
  return true;
}

/* Writes to `out` the angles that are tried for a part that may be turned freely: eighths of a turn, and those that
 * make one of its long sides horizontal. Returns their number. */
static size_t own_angles(const vs_area *a, double *out) {
  double longest[LONG_SIDES] = { 0 }, angle[LONG_SIDES];
  size_t count = 8;
  for (size_t k = 0; k < 8; k++) out[k] = (double)k * pi / 4;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      double length = hypot(q.x - p.x, q.y - p.y), turn = -atan2(q.y - p.y, q.x - p.x);
      size_t k = LONG_SIDES;
      turn -= floor(turn / (pi / 4) + 1e-9) * (pi / 4);
      bool known = turn < 1e-9;
      for (size_t j = 0; j < LONG_SIDES; j++)
        if (longest[j] > 0 && fabs(angle[j] - turn) < 1e-6) known = true;
      if (known) continue;
      while (k > 0 && longest[k - 1] < length) k--;
      if (k == LONG_SIDES) continue;
      for (size_t j = LONG_SIDES - 1; j > k; j--) longest[j] = longest[j - 1], angle[j] = angle[j - 1];
      longest[k] = length, angle[k] = turn;
    }
  for (size_t k = 0; k < LONG_SIDES && longest[k] > 0; k++)
    for (size_t j = 0; j < 4; j++) out[count++] = angle[k] + (double)j * pi / 2;
  return count;
}

static bool equal_areas(const vs_area *a, const vs_area *b, double slack) {
  bool same = a->count == b->count && a->loop_count == b->loop_count;
  for (size_t l = 0; same && l < a->loop_count; l++) same = a->size[l] == b->size[l];
  for (size_t i = 1; same && i < a->count; i++)
    same = fabs(a->at[i].x - a->at[0].x - b->at[i].x + b->at[0].x) < slack &&
           fabs(a->at[i].y - a->at[0].y - b->at[i].y + b->at[0].y) < slack;
  return same;
}

/* Adds a kind that consists of parts like a, and its forms, one for each allowed angle. In each form, the part's first
 * corner is at the origin. Returns false when memory is out. */
static bool add_kind(nest *w, const vs_area *a, uint32_t part) {
  double angles[8 + 4 * LONG_SIDES];
  const vs_nest_rule *r = w->rule;
  kind k = { .first = w->form_count, .part = part };
  vs_area simple = { 0 };
  vs_convex_pieces c = { 0 };
  box b = no_box();
  for (size_t i = 0; i < a->count; i++) widen(&b, a->at[i]);
  k.extent = fmax(b.x1 - b.x0, b.y1 - b.y0);
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      k.area += ((p.x - b.x0) * (q.y - b.y0) - (q.x - b.x0) * (p.y - b.y0)) / 2;
    }
  bool ok = vs_area_outer_corners(a, a->count > MOST_CORNERS ? k.extent / 1000 : 0, &simple) &&
            vs_area_convex_pieces(&simple, &c);
  for (size_t i = 0; i < c.count; i++) c.at[i].x -= a->at[0].x, c.at[i].y -= a->at[0].y;
  size_t n = r->angle_count ? r->angle_count : own_angles(&simple, angles);
  for (size_t i = 0; ok && i < n; i++) ok = add_form(w, &c, r->angle_count ? r->angles[i] : angles[i]);
  k.count = w->form_count - k.first;
  ok = ok && VS_GROW(w->kinds, w->kind_room, w->kind_count + 1);
  if (ok) w->kinds[w->kind_count++] = k;
  vs_area_free(&simple);
  vs_convex_pieces_free(&c);
  return ok;
}

/* ---- sums and lines ---- */

static bool add_sum(nest *w, const piece *q, vs_vec2 at, const piece *p) {
  size_t most = vs_convex_grown_most(q->count + p->count);
  double gap = w->rule->gap;
  if (!VS_GROW(w->draft, w->draft_room, most) || !VS_GROW(w->sum_at, w->sum_point_room, w->sum_points + most) ||
      !VS_GROW(w->sums, w->sum_room, w->sum_count + 1))
    return false;
  vs_vec2 *out = w->sum_at + w->sum_points;
  size_t n = vs_convex_sum(w->at + q->first, q->count, w->mirrored + p->first, p->count, gap > 0 ? w->draft : out);
  if (gap > 0) n = vs_convex_grow(w->draft, n, gap, out);
  sum s = { .first = w->sum_points, .count = n };
  for (size_t i = 0; i < n; i++) {
    out[i].x += at.x, out[i].y += at.y;
    if (out[i].y < out[s.low].y) s.low = i;
    if (out[i].y > out[s.high].y) s.high = i;
  }
  s.y0 = out[s.low].y, s.y1 = out[s.high].y;
  w->sums[w->sum_count++] = s;
  w->sum_points += n;
  w->steps += 2 * n;
  return true;
}

/* Makes the sums of form f with pieces on sheet s: those that can limit the place of f within the box `room`. Returns
 * false when memory is out. */
static bool make_sums(nest *w, const sheet *s, const form *f, box room) {
  double gap = w->rule->gap;
  w->sum_count = w->sum_points = 0;
  for (size_t i = 0; i < s->count; i++) {
    const piece *q = &w->pieces[s->at[i].piece];
    vs_vec2 at = s->at[i].move;
    for (size_t k = 0; k < f->count; k++) {
      const piece *p = &w->pieces[f->first + k];
      if (q->box.x1 + at.x - p->box.x0 + gap < room.x0 || q->box.x0 + at.x - p->box.x1 - gap > room.x1 ||
          q->box.y1 + at.y - p->box.y0 + gap < room.y0 || q->box.y0 + at.y - p->box.y1 - gap > room.y1)
        continue;
      if (!add_sum(w, q, at, p)) return false;
    }
    w->steps += f->count;
  }
  return true;
}

static int by_number(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

static void add_line(nest *w, double y, box room) {
  if (w->line_count < MOST_LINES && y >= room.y0 && y <= room.y1) w->lines[w->line_count++] = y;
}

/* Sorts the lines by y, and removes repeated ones. */
static void sort_lines(nest *w) {
  size_t kept = 0;
  qsort(w->lines, w->line_count, sizeof *w->lines, by_number);
  for (size_t i = 0; i < w->line_count; i++)
    if (!kept || w->lines[i] > w->lines[kept - 1] + w->slack) w->lines[kept++] = w->lines[i];
  w->line_count = kept;
}

static void first_lines(nest *w, const sheet *s, const form *f, box room) {
  double gap = w->rule->gap;
  w->line_count = 0;
  add_line(w, room.y0, room), add_line(w, room.y1, room);
  for (int i = 1; i < EVEN_LINES; i++) add_line(w, room.y0 + (room.y1 - room.y0) * i / EVEN_LINES, room);
  for (size_t i = s->part_count; i-- > 0;) {
    add_line(w, s->parts[i].y1 + gap - f->box.y0, room);
    add_line(w, s->parts[i].y0 - gap - f->box.y1, room);
  }
  sort_lines(w);
}

static void fine_lines(nest *w, double low, double y, double high, box room) {
  w->line_count = 0;
  for (int i = 1; i <= FINE_LINES; i++) {
    add_line(w, y + (low - y) * i / (FINE_LINES + 1), room);
    add_line(w, y + (high - y) * i / (FINE_LINES + 1), room);
  }
  sort_lines(w);
}

/* Adds to each line the interval of x that the sum s excludes, because the part would overlap a piece there. Returns
 * false when memory is out. */
static bool add_spans(nest *w, const sum *s) {
  const vs_vec2 *at = w->sum_at + s->first;
  size_t n = s->count, right = s->low, left = s->low, i = 0, high = w->line_count;
  double low = s->y0 + w->slack;
  while (i < high) {
    size_t mid = (i + high) / 2;
    if (w->lines[mid] <= low) i = mid + 1;
    else high = mid;
  }
  for (; i < w->line_count && w->lines[i] < s->y1 - w->slack; i++) {
    double y = w->lines[i];
    size_t after = right + 1 < n ? right + 1 : 0, before = left ? left - 1 : n - 1;
    while (at[after].y < y) right = after, after = right + 1 < n ? right + 1 : 0;
    while (at[before].y < y) left = before, before = left ? left - 1 : n - 1;
    vs_vec2 a = at[right], b = at[after], c = at[left], d = at[before];
    spans *l = &w->spans[i];
    if (!VS_GROW(l->at, l->room, l->count + 1)) return false;
    l->at[l->count++] = (span){ c.x + (d.x - c.x) * (y - c.y) / (d.y - c.y),
                                a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y) };
    w->steps += 2;
  }
  return true;
}

static int by_start(const void *a, const void *b) {
  const span *p = a, *q = b;
  return p->from < q->from ? -1 : p->from > q->from;
}

/* Returns the least x from x0 to x1 that lies in no interval of the line; infinity if there is none. */
static double leftmost(nest *w, spans *l, double x0, double x1) {
  double x = x0;
  size_t kept = 0;
  for (size_t i = 0; i < l->count; i++)
    if (l->at[i].to > x0 + w->slack && l->at[i].from < x1) l->at[kept++] = l->at[i];
  if (kept > 1) qsort(l->at, kept, sizeof *l->at, by_start);
  w->steps += 6 * kept;
  for (size_t i = 0; i < kept && l->at[i].from < x - w->slack; i++) x = fmax(x, l->at[i].to);
  for (bool again = true; again;) { /* repeats the search: an interval that begins less than `slack` before x may have
                                     * been skipped */
    again = false;
    for (size_t i = 0; i < kept; i++)
      if (l->at[i].from < x - w->slack && l->at[i].to > x + w->slack) x = l->at[i].to, again = true;
  }
  return x <= x1 + w->slack ? fmin(fmax(x, x0), fmax(x0, x1)) : INFINITY;
}

/* ---- places ---- */

/* A possible place on a sheet. cost: how unfavourable it is; form: index of the form that is placed. */
typedef struct { double cost, x, y; size_t form; } spot;

static double wanted(const nest *w, const form *f, double x, double y) {
  double right = x + f->box.x1, left = x + f->box.x0, high = y + f->box.y1;
  switch (w->wish) {
    case 0: return right + 1e-3 * high;
    case 1: return (left + right) / 2 + 1e-3 * high;
    case 2: return right + 0.1 * high;
    default: return left + 0.3 * right + 1e-3 * high;
  }
}

/* Searches the best place of a form on all lines. If it is better than *best, replaces *best and sets *line to the
 * index of its line. Returns false when memory is out. */
static bool look_on_lines(nest *w, size_t form_index, box room, spot *best, size_t *line) {
  const form *f = &w->forms[form_index];
  for (size_t i = 0; i < w->line_count; i++) w->spans[i].count = 0;
  for (size_t i = 0; i < w->sum_count; i++)
    if (!add_spans(w, &w->sums[i])) return false;
  for (size_t i = 0; i < w->line_count; i++) {
    double x = leftmost(w, &w->spans[i], room.x0, room.x1);
    double cost = x < INFINITY ? wanted(w, f, x, w->lines[i]) : INFINITY;
    if (cost < best->cost - w->slack) *best = (spot){ cost, x, w->lines[i], form_index }, *line = i;
  }
  return true;
}

/* Searches the best place of one form on sheet s, and replaces *best if it is better. Returns false when memory is
 * out. */
static bool look_for_form(nest *w, const sheet *s, size_t form_index, spot *best) {
  const form *f = &w->forms[form_index];
  const vs_nest_rule *r = w->rule;
  box room = { r->margin - f->box.x0, r->margin - f->box.y0, s->width - r->margin - f->box.x1,
               r->height - r->margin - f->box.y1 };
  room.x1 = fmax(room.x0, room.x1), room.y1 = fmax(room.y0, room.y1);
  size_t line = MOST_LINES;
  if (!make_sums(w, s, f, room)) return false;
  first_lines(w, s, f, room);
  if (!look_on_lines(w, form_index, room, best, &line)) return false;
  if (line == MOST_LINES) return true;
  double low = line ? w->lines[line - 1] : room.y0, high = line + 1 < w->line_count ? w->lines[line + 1] : room.y1;
  for (int k = 0; k < FINER; k++) {
    double y = best->y;
    line = MOST_LINES;
    fine_lines(w, low, y, high, room);
    if (!look_on_lines(w, form_index, room, best, &line)) return false;
    double step = fmax(high - y, y - low) / (FINE_LINES + 1);
    low = fmax(room.y0, best->y - step), high = fmin(room.y1, best->y + step);
  }
  return true;
}

static bool lay(nest *w, sheet *s, uint32_t part, size_t form_index, vs_vec2 move) {
  const form *f = &w->forms[form_index];
  if (!VS_GROW(s->at, s->room, s->count + f->count) || !VS_GROW(s->parts, s->part_room, s->part_count + 1))
    return false;
  for (size_t i = 0; i < f->count; i++) s->at[s->count++] = (laid_piece){ f->first + i, move };
  s->parts[s->part_count++] =
      (box){ f->box.x0 + move.x, f->box.y0 + move.y, f->box.x1 + move.x, f->box.y1 + move.y };
  s->free -= w->kinds[w->kind_of[part]].area;
  s->reach = fmax(s->reach, f->box.x1 + move.x);
  return true;
}

/* Makes sheet number `index` an empty sheet: makes a new one, or removes all parts from it. Returns false when memory
 * is out. */
static bool empty_sheet(nest *w, size_t index) {
  if (!VS_GROW(w->sheets, w->sheet_room, index + 1)) return false;
  if (index == w->sheet_count) {
    w->sheets[w->sheet_count++] = (sheet){ .full = vs_zeros(w->kind_count, sizeof(bool)) };
    if (!w->sheets[index].full) return false;
  }
  sheet *s = &w->sheets[index];
  memset(s->full, 0, w->kind_count * sizeof *s->full);
  s->count = s->part_count = 0, s->reach = 0;
  s->width = index == w->endless ? 1e6 * w->rule->width : w->rule->width;
  s->free = (w->rule->width - 2 * w->rule->margin) * (w->rule->height - 2 * w->rule->margin);
  return true;
}

/* Places a part on the first sheet where it fits. *used: number of sheets so far, which increases if a new sheet is
 * needed. */
static bool place_part(nest *w, uint32_t part, size_t *used) {
  uint32_t k = w->kind_of[part];
  const kind *of = &w->kinds[k];
  for (size_t i = 0;; i++) {
    if (i == *used) {
      if (!empty_sheet(w, i)) return false;
      ++*used;
    }
    sheet *s = &w->sheets[i];
    spot best = { .cost = INFINITY };
    if (s->full[k] || (i != w->endless && i + 1 < *used && of->area > s->free * (1 + 1e-9))) continue;
    for (size_t f = 0; f < of->count; f++)
      if (!look_for_form(w, s, of->first + f, &best)) return false;
    if (best.cost < INFINITY) {
      w->laid[part] = (laid){ (uint32_t)i, best.form, { best.x, best.y } };
      return lay(w, s, part, best.form, w->laid[part].move);
    }
    s->full[k] = true;
    if (!s->part_count) return false; /* not reached, because each kind fits on an empty sheet */
  }
}

/* Returns the length to which a sheet is filled: the mean of where its rightmost part ends and of the length that the
 * area of its parts requires. */
static double filled(const nest *w, const sheet *s) {
  double m = w->rule->margin, whole = (w->rule->width - 2 * m) * (w->rule->height - 2 * m);
  return (s->reach + w->rule->width * (whole - s->free) / whole) / 2;
}

/* Places the parts in the order `order`, from index `from` on; earlier parts keep their places. Sets *cost to the
 * length of all sheets but the last, plus the length to which the last sheet is filled. Returns false when memory is
 * out or the caller interrupts. */
static bool place_all(nest *w, size_t from, double *cost) {
  size_t used = 0;
  for (size_t i = 0; i < from; i++) {
    const laid *l = &w->laid[w->order[i]];
    while (used <= l->sheet)
      if (!empty_sheet(w, used++)) return false;
    if (!lay(w, &w->sheets[l->sheet], w->order[i], l->form, l->move)) return false;
  }
  for (size_t i = from; i < w->parts; i++) {
    if (!place_part(w, w->order[i], &used)) return false;
    double done = (double)w->steps / (double)w->most_steps;
    if (w->work.going && !w->work.going(w->work.context, done < 1 ? done : 1)) return !(w->stopped = true);
  }
  w->used = used;
  *cost = INFINITY;
  for (size_t i = 0; i < used; i++) /* if no sheet is endless, the sheet that is filled least counts as the last one */
    if (i == w->endless || w->endless >= used) *cost = fmin(*cost, filled(w, &w->sheets[i]));
  *cost += (double)(used - 1) * w->rule->width;
  return true;
}

/* ---- search ---- */

static uint32_t chance(nest *w, uint32_t below) {
  w->chance = w->chance * 1664525u + 1013904223u;
  return (uint32_t)(((uint64_t)(w->chance >> 8) * below) >> 24);
}

typedef struct { double key; uint32_t part; } ranked;

static int by_key(const void *a, const void *b) {
  const ranked *p = a, *q = b;
  if (p->key != q->key) return p->key > q->key ? -1 : 1;
  return p->part < q->part ? -1 : p->part > q->part;
}

/* Sorts `order` by size, the largest parts first. by: number of the measure of size: area, extent, or both. */
static bool rank_parts(nest *w, int by) {
  ranked *r = vs_fresh(w->parts, sizeof *r);
  for (uint32_t i = 0; r && i < w->parts; i++) {
    const kind *k = &w->kinds[w->kind_of[i]];
    r[i] = (ranked){ by == 0 ? k->area : by == 1 ? k->extent : k->area * k->extent, i };
    r[i].key += 1e-9 * (double)(w->kind_count - w->kind_of[i]) * r[i].key; /* the small addition makes parts of one kind
                                                                            * neighbours in the order */
  }
  if (!r) return false;
  qsort(r, w->parts, sizeof *r, by_key);
  for (size_t i = 0; i < w->parts; i++) w->order[i] = r[i].part;
  free(r);
  return true;
}

/* Stores in m the present order of the parts, their places, and the cost. */
static void remember(nest *w, memory *m, double cost) {
  m->cost = cost, m->wish = w->wish;
  m->reach = w->endless == SIZE_MAX ? INFINITY : w->endless < w->used ? w->sheets[w->endless].reach : 0;
  memcpy(m->laid, w->laid, w->parts * sizeof *m->laid);
  memcpy(m->order, w->order, w->parts * sizeof *m->order);
}

static void recall(nest *w, const memory *m) {
  w->wish = m->wish;
  memcpy(w->laid, m->laid, w->parts * sizeof *m->laid);
  memcpy(w->order, m->order, w->parts * sizeof *m->order);
}

/* Changes `order`: exchanges two parts, or moves one part. Returns the first index that has changed. */
static size_t change_order(nest *w) {
  uint32_t n = (uint32_t)w->parts, i = 0, j = 0;
  for (int k = 0; k < 20 && w->kind_of[w->order[i]] == w->kind_of[w->order[j]]; k++) i = chance(w, n), j = chance(w, n);
  uint32_t part = w->order[i];
  if (chance(w, 2)) {
    w->order[i] = w->order[j], w->order[j] = part;
  } else {
    if (i < j) memmove(w->order + i, w->order + i + 1, (j - i) * sizeof *w->order);
    else memmove(w->order + j + 1, w->order + j, (i - j) * sizeof *w->order);
    w->order[j] = part;
  }
  return i < j ? i : j;
}

/* Changes the order repeatedly, and keeps a change if its cost is at most the present cost or the cost LATE changes
 * before. Ends when the work reaches most_steps, after IDLE changes without an improvement, or when the parts on the
 * endless sheet fit within its real size. */
static bool improve(nest *w, uint64_t most_steps) {
  double cost, late[LATE];
  recall(w, &w->best);
  remember(w, &w->now, w->best.cost);
  for (size_t i = 0; i < LATE; i++) late[i] = w->best.cost;
  double end = w->rule->width - w->rule->margin;
  for (size_t i = 0, last = 0; w->kind_count > 1 && w->steps < most_steps && !(w->best.reach <= end); i++) {
    if (i - last > IDLE) break;
    recall(w, &w->now);
    if (!chance(w, 8)) w->wish = (int)chance(w, 4);
    size_t from = change_order(w);
    if (!place_all(w, w->wish == w->now.wish ? from : 0, &cost)) return false;
    if (cost <= fmax(w->now.cost, late[i % LATE])) remember(w, &w->now, cost);
    late[i % LATE] = w->now.cost;
    if (cost < w->best.cost) remember(w, &w->best, cost), last = i;
  }
  return true;
}

/* Finds an order of the parts. The parts' area requires a certain number of sheets; at first, the last of these is
 * treated as endless. If parts still lie beyond its real end, they are placed on further sheets. */
static bool search(nest *w) {
  double cost, area = 0, whole = (w->rule->width - 2 * w->rule->margin) * (w->rule->height - 2 * w->rule->margin);
  for (size_t i = 0; i < w->parts; i++) area += w->kinds[w->kind_of[i]].area;
  w->endless = (size_t)fmax(0, ceil(area / whole * (1 - 1e-9)) - 1);
  w->best.cost = INFINITY;
  for (int k = 0; k < 12 && (k == 0 || w->steps < w->most_steps / 2); k++) {
    w->wish = k / 3;
    if (!rank_parts(w, k % 3) || !place_all(w, 0, &cost)) return false;
    if (cost < w->best.cost) remember(w, &w->best, cost);
  }
  if (!improve(w, w->most_steps / 2)) return false;
  w->endless = SIZE_MAX;
  recall(w, &w->best);
  if (!place_all(w, 0, &cost)) return false;
  remember(w, &w->best, cost);
  return improve(w, w->most_steps);
}

/* Divides the parts into kinds with equal shape. Sets *unfit to the first part that is too large for the sheet. */
static bool find_kinds(nest *w, const vs_area *parts, size_t *unfit) {
  *unfit = w->parts;
  for (size_t i = 0; i < w->parts; i++) {
    size_t k = 0;
    while (k < w->kind_count && !equal_areas(&parts[i], &parts[w->kinds[k].part], w->slack)) k++;
    if (k == w->kind_count && !add_kind(w, &parts[i], (uint32_t)i)) return false;
    w->kind_of[i] = (uint32_t)k;
    if (!w->kinds[k].count) return *unfit = i, true;
  }
  return true;
}

static void nest_free(nest *w) {
  for (size_t i = 0; i < w->sheet_count; i++) free(w->sheets[i].at), free(w->sheets[i].parts), free(w->sheets[i].full);
  for (size_t i = 0; i < MOST_LINES; i++) free(w->spans[i].at);
  free(w->at), free(w->mirrored), free(w->pieces), free(w->forms), free(w->kinds), free(w->kind_of), free(w->sheets);
  free(w->sums), free(w->sum_at), free(w->draft), free(w->order), free(w->laid);
  free(w->best.order), free(w->best.laid), free(w->now.order), free(w->now.laid);
  free(w);
}

bool vs_areas_nest(const vs_area *parts, size_t count, const vs_nest_rule *rule, vs_long_work work,
                   vs_nest_place *places, size_t *sheets, size_t *unfit, bool *stopped) {
  nest *w = vs_zeros(1, sizeof *w);
  *stopped = false, *sheets = 0, *unfit = count;
  if (!w) return false;
  w->rule = rule, w->parts = count, w->work = work, w->chance = 1;
  w->slack = 1e-10 * fmax(rule->width, rule->height);
  w->most_steps = (uint64_t)(rule->effort * 3e8) + 1;
  bool ok = VS_FRESH(w->kind_of, count) && VS_FRESH(w->order, count) && VS_FRESH(w->laid, count) &&
            VS_FRESH(w->best.order, count) && VS_FRESH(w->best.laid, count) && VS_FRESH(w->now.order, count) &&
            VS_FRESH(w->now.laid, count);
  ok = ok && find_kinds(w, parts, unfit);
  if (ok && count && *unfit == count) {
    ok = search(w);
    for (size_t i = 0; ok && i < count; i++) {
      const laid *l = &w->best.laid[i];
      const form *f = &w->forms[l->form];
      double s, c;
      vs_sincos(f->angle, &s, &c);
      vs_vec2 corner = turned(parts[i].at[0], s, c);
      places[i] = (vs_nest_place){ l->sheet, f->angle, { l->move.x - corner.x, l->move.y - corner.y } };
      if (l->sheet >= *sheets) *sheets = l->sheet + 1;
    }
  }
  *stopped = w->stopped;
  nest_free(w);
  return ok;
}
