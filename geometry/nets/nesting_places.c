/* Implements the places of flat parts on sheets (nesting_places.h).
 *
 * Each part is divided into convex pieces. Let p be a piece of the part, and q a piece that lies on the sheet. A move
 * by the vector t brings p nearer to q than the gap if t is inside the sum of q and -p, grown by the gap. This sum is
 * convex. On a line of constant y the sums leave intervals of x, exactly. A part goes to the place that is furthest
 * left on any of the lines. There are lines where the part's box touches the sheet's or another part's box, and others
 * at equal distances. Then finer lines next to the best line improve the place. */
#include "geometry/nets/nesting_places.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/nets/convex_pieces.h"
#include "model/store/array.h"

enum {
  EVEN_LINES = 40,   /* number of horizontal lines at equal distances on which a place for a part is searched */
  MOST_LINES = 200,
  FINE_LINES = 6,    /* number of finer lines on each side of the best line that are searched to improve the place */
  FINER = 2,         /* number of times that a part's place is improved on finer lines */
  MOST_CORNERS = 24, /* number of corners above which a part gets a simpler outline */
  LEAST_PIECES = 4,  /* bounds of the number of convex pieces above which a part gets coarser hollows */
  MOST_PIECES = 24,
  LONG_SIDES = 4,    /* number of long sides of a part that are laid along the sheet's sides */
  MOST_TURNS = 8 + 4 * LONG_SIDES
};

/* The greatest deviations of a simpler outline, as shares of the part's size: everywhere, and in hollows, whose corners
 * make convex pieces. */
static const double closely = 1 / 1000.0, hollows[] = { 1 / 1000.0, 1 / 300.0, 1 / 100.0, 1 / 30.0 };
enum { LEVELS = sizeof hollows / sizeof *hollows };
static const double most_pairs = 1e6; /* pairs of pieces that the first order of all parts may compare */

static const double pi = 3.14159265358979323846;

typedef vs_nest_places nest;
typedef vs_nest_box box;
typedef vs_nest_piece piece;
typedef vs_nest_form form;
typedef vs_nest_kind kind;
typedef vs_nest_sheet sheet;

typedef struct { double from, to; } span;

typedef struct {
  span *at;
  size_t count, room;
} spans;

/* The sum of two convex pieces, one of a form (turned part) and one on a sheet: the moves by which the pieces would
 * overlap. */
typedef struct {
  size_t first, count, low, high; /* first, count: range of the sum's points; low, high: indices of its points of least
                                   * and greatest y */
  double y0, y1;
} sum;

struct vs_nest_lines {
  sum *sums;
  size_t sum_count, sum_room;
  vs_vec2 *sum_at;
  size_t sum_points, sum_point_room;
  vs_vec2 *draft; /* memory for the points of one piece */
  size_t draft_room;
  double at[MOST_LINES];
  size_t line_count;
  spans spans[MOST_LINES];
};

/* ---- kinds and forms ---- */

static box no_box(void) { return (box){ INFINITY, INFINITY, -INFINITY, -INFINITY }; }
static void widen(box *b, vs_vec2 p) {
  b->x0 = fmin(b->x0, p.x), b->y0 = fmin(b->y0, p.y), b->x1 = fmax(b->x1, p.x), b->y1 = fmax(b->y1, p.y);
}
vs_vec2 vs_nest_turned(vs_vec2 p, double s, double c) { return (vs_vec2){ c * p.x - s * p.y, s * p.x + c * p.y }; }

/* Copies the n points of a convex polygon, so that the leftmost of its lowest points comes first. */
static void from_lowest(const vs_vec2 *in, size_t n, vs_vec2 *out) {
  size_t low = 0;
  for (size_t i = 1; i < n; i++)
    if (in[i].y < in[low].y || (in[i].y == in[low].y && in[i].x < in[low].x)) low = i;
  for (size_t i = 0; i < n; i++) out[i] = in[(low + i) % n];
}

/* Adds a convex piece: the n points `in`, turned by the angle with the sine s and the cosine c, once mirrored at the
 * origin, and once grown by the gap. Returns false when memory is out. */
static bool add_piece(nest *w, const vs_vec2 *in, size_t n, double s, double c) {
  double gap = w->rule->gap;
  size_t most = vs_convex_grown_most(n);
  vs_nest_lines *l = w->lines;
  if (!VS_GROW(w->grown, w->grown_room, w->grown_points + most) ||
      !VS_GROW(w->mirrored, w->mirrored_room, w->points + n) ||
      !VS_GROW(w->pieces, w->piece_room, w->piece_count + 1) || !VS_GROW(l->draft, l->draft_room, n + most))
    return false;
  vs_vec2 *turned = l->draft, *grown = l->draft + n;
  piece *made = &w->pieces[w->piece_count++];
  *made = (piece){ w->points, n, w->grown_points, n, no_box() };
  for (size_t i = 0; i < n; i++) widen(&made->box, turned[i] = vs_nest_turned(in[i], s, c));
  if (gap > 0) made->grown_count = vs_convex_grow(turned, n, gap, grown);
  from_lowest(gap > 0 ? grown : turned, made->grown_count, w->grown + made->grown_first);
  for (size_t i = 0; i < n; i++) turned[i] = (vs_vec2){ -turned[i].x, -turned[i].y };
  from_lowest(turned, n, w->mirrored + made->first);
  w->points += n, w->grown_points += made->grown_count;
  return true;
}

/* Adds the form (turned part) that consists of the pieces c turned by the angle, unless the sheet is too small for it.
 * Returns false when memory is out. */
static bool add_form(nest *w, const vs_convex_pieces *c, double angle) {
  double s, co, room = 2 * w->rule->margin - w->slack;
  form f = { .first = w->piece_count, .count = c->pieces, .box = no_box(), .angle = angle };
  size_t points = w->points, grown = w->grown_points;
  vs_sincos(angle, &s, &co);
  for (size_t p = 0, first = 0; p < c->pieces; first += c->size[p++]) {
    if (!add_piece(w, c->at + first, c->size[p], s, co)) return false;
    const box *b = &w->pieces[f.first + p].box;
    widen(&f.box, (vs_vec2){ b->x0, b->y0 }), widen(&f.box, (vs_vec2){ b->x1, b->y1 });
  }
  if (f.box.x1 - f.box.x0 + room > w->rule->width || f.box.y1 - f.box.y0 + room > w->rule->height) {
    w->points = points, w->grown_points = grown, w->piece_count = f.first;
    return true;
  }
  if (!VS_GROW(w->forms, w->form_room, w->form_count + 1)) return false;
  w->forms[w->form_count++] = f;
  return true;
}

/* Tests whether the area's outer border is nearly a circle, so that turns change nothing. */
static bool is_round(const vs_area *a, const box *b) {
  double x = (b->x0 + b->x1) / 2, y = (b->y0 + b->y1) / 2, least = INFINITY, most = 0;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++]) {
    if (a->hole[l]) continue;
    if (l > 0 || a->size[l] < 36) return false;
    for (size_t i = 0; i < a->size[l]; i++) {
      double r = hypot(a->at[first + i].x - x, a->at[first + i].y - y);
      least = fmin(least, r), most = fmax(most, r);
    }
  }
  return most - least < 0.005 * most;
}

/* Writes angles for a part that may be turned freely: eighths of a turn, and angles that lay its long sides level.
 * `long_side`: length from which a side is long. Returns their number, at most MOST_TURNS. */
static size_t own_angles(const vs_area *a, double long_side, double *out) {
  double longest[LONG_SIDES] = { 0 }, angle[LONG_SIDES];
  size_t count = 8;
  for (size_t k = 0; k < 8; k++) out[k] = (double)k * pi / 4;
  for (size_t l = 0, first = 0; l < a->loop_count; first += a->size[l++])
    for (size_t i = 0; i < a->size[l]; i++) {
      vs_vec2 p = a->at[first + i], q = a->at[first + (i + 1) % a->size[l]];
      double length = hypot(q.x - p.x, q.y - p.y), turn = -atan2(q.y - p.y, q.x - p.x);
      size_t k = LONG_SIDES;
      turn -= floor(turn / (pi / 4) + 1e-9) * (pi / 4);
      bool known = turn < 1e-9 || length < long_side;
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

/* Divides an outline into convex pieces. An outline of many corners gets a simpler one around it: to a thousandth of
 * its size, and if that has more than `most` pieces, coarser in hollows. *simple: the outline that is divided. Returns
 * false when memory is out; the caller frees the results. */
static bool few_pieces(const vs_area *a, double extent, size_t most, vs_area *simple, vs_convex_pieces *c) {
  bool many = a->count > MOST_CORNERS, ok = true;
  for (size_t l = 0; ok && (l == 0 || (many && c->pieces > most && l < LEVELS)); l++) {
    vs_area_free(simple);
    vs_convex_pieces_free(c);
    ok = vs_area_outer_corners(a, many ? extent * closely : 0, extent * hollows[l], simple) &&
         vs_area_convex_pieces(simple, c);
  }
  return ok;
}

/* Adds a new kind (parts with equal shape) with its forms, the part turned by each allowed angle. most: the number of
 * convex pieces above which it gets a simpler outline. Returns false when memory is out. */
static bool add_kind(nest *w, const vs_area *a, uint32_t part, size_t most) {
  double angles[MOST_TURNS];
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
  bool ok = few_pieces(a, k.extent, most, &simple, &c);
  for (size_t i = 0; i < c.count; i++) c.at[i].x -= a->at[0].x, c.at[i].y -= a->at[0].y;
  size_t n = r->angle_count ? r->angle_count : own_angles(&simple, k.extent / 8, angles);
  if (is_round(a, &b)) n = 1;
  for (size_t i = 0; ok && i < n; i++) ok = add_form(w, &c, r->angle_count ? r->angles[i] : angles[i]);
  k.count = w->form_count - k.first;
  ok = ok && VS_GROW(w->kinds, w->kind_room, w->kind_count + 1);
  if (ok) w->kinds[w->kind_count++] = k;
  vs_area_free(&simple);
  vs_convex_pieces_free(&c);
  return ok;
}

bool vs_nest_find_kinds(vs_nest_places *w, const vs_area *parts, size_t *unfit) {
  size_t turns = w->rule->angle_count ? w->rule->angle_count : MOST_TURNS;
  double pieces = sqrt(2 * most_pairs / (double)turns) / (double)(w->parts + 1); /* for each part */
  size_t most = (size_t)fmin(fmax(pieces, LEAST_PIECES), MOST_PIECES);
  *unfit = w->parts;
  if (!w->lines && !(w->lines = vs_zeros(1, sizeof *w->lines))) return false;
  for (size_t i = 0; i < w->parts; i++) {
    size_t k = 0;
    while (k < w->kind_count && !equal_areas(&parts[i], &parts[w->kinds[k].part], w->slack)) k++;
    if (k == w->kind_count && !add_kind(w, &parts[i], (uint32_t)i, most)) return false;
    w->kind_of[i] = (uint32_t)k;
    if (!w->kinds[k].count) return *unfit = i, true;
  }
  return true;
}

/* ---- sums and lines ---- */

static bool add_sum(nest *w, const piece *q, vs_vec2 at, const piece *p) {
  vs_nest_lines *l = w->lines;
  if (!VS_GROW(l->sum_at, l->sum_point_room, l->sum_points + q->grown_count + p->count) ||
      !VS_GROW(l->sums, l->sum_room, l->sum_count + 1))
    return false;
  vs_vec2 *out = l->sum_at + l->sum_points;
  size_t n = vs_convex_sum(w->grown + q->grown_first, q->grown_count, w->mirrored + p->first, p->count, out);
  sum s = { .first = l->sum_points, .count = n };
  for (size_t i = 0; i < n; i++) {
    out[i].x += at.x, out[i].y += at.y;
    if (out[i].y < out[s.low].y) s.low = i;
    if (out[i].y > out[s.high].y) s.high = i;
  }
  s.y0 = out[s.low].y, s.y1 = out[s.high].y;
  l->sums[l->sum_count++] = s;
  l->sum_points += n;
  w->steps += 2 * n;
  return true;
}

/* Makes the sums of form f (turned part) with the pieces on sheet s that can limit its place within the box `room`. A
 * sum contains the moves that would cause an overlap. Returns false when memory is out. */
static bool make_sums(nest *w, const sheet *s, const form *f, box room) {
  double gap = w->rule->gap;
  w->lines->sum_count = w->lines->sum_points = 0;
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
  vs_nest_lines *l = w->lines;
  if (l->line_count < MOST_LINES && y >= room.y0 && y <= room.y1) l->at[l->line_count++] = y;
}

/* Sorts the horizontal lines, on which places are searched, by y, and removes repeated ones. */
static void sort_lines(nest *w) {
  vs_nest_lines *l = w->lines;
  size_t kept = 0;
  qsort(l->at, l->line_count, sizeof *l->at, by_number);
  for (size_t i = 0; i < l->line_count; i++)
    if (!kept || l->at[i] > l->at[kept - 1] + w->slack) l->at[kept++] = l->at[i];
  l->line_count = kept;
}

static void first_lines(nest *w, const sheet *s, const form *f, box room) {
  double gap = w->rule->gap;
  w->lines->line_count = 0;
  add_line(w, room.y0, room), add_line(w, room.y1, room);
  for (int i = 1; i < EVEN_LINES; i++) add_line(w, room.y0 + (room.y1 - room.y0) * i / EVEN_LINES, room);
  for (size_t i = s->part_count; i-- > 0;) {
    add_line(w, s->parts[i].y1 + gap - f->box.y0, room);
    add_line(w, s->parts[i].y0 - gap - f->box.y1, room);
  }
  sort_lines(w);
}

static void fine_lines(nest *w, double low, double y, double high, box room) {
  w->lines->line_count = 0;
  for (int i = 1; i <= FINE_LINES; i++) {
    add_line(w, y + (low - y) * i / (FINE_LINES + 1), room);
    add_line(w, y + (high - y) * i / (FINE_LINES + 1), room);
  }
  sort_lines(w);
}

/* Adds an interval to those of a line. An interval that overlaps the last one, as those of two neighbouring pieces do,
 * extends it. Returns false when memory is out. */
static bool add_span(spans *on, span made) {
  span *last = on->count ? &on->at[on->count - 1] : NULL;
  if (last && made.from < last->to && made.to > last->from) {
    *last = (span){ fmin(last->from, made.from), fmax(last->to, made.to) };
    return true;
  }
  if (!VS_GROW(on->at, on->room, on->count + 1)) return false;
  on->at[on->count++] = made;
  return true;
}

/* Adds to each horizontal line the interval of x in which the part would overlap a piece, as given by s. Returns false
 * when memory is out. */
static bool add_spans(nest *w, const sum *s) {
  vs_nest_lines *lines = w->lines;
  const vs_vec2 *at = lines->sum_at + s->first;
  size_t n = s->count, right = s->low, left = s->low, i = 0, high = lines->line_count;
  double low = s->y0 + w->slack;
  while (i < high) {
    size_t mid = (i + high) / 2;
    if (lines->at[mid] <= low) i = mid + 1;
    else high = mid;
  }
  for (; i < lines->line_count && lines->at[i] < s->y1 - w->slack; i++) {
    double y = lines->at[i];
    size_t after = right + 1 < n ? right + 1 : 0, before = left ? left - 1 : n - 1;
    while (at[after].y < y) right = after, after = right + 1 < n ? right + 1 : 0;
    while (at[before].y < y) left = before, before = left ? left - 1 : n - 1;
    vs_vec2 a = at[right], b = at[after], c = at[left], d = at[before];
    span made = { c.x + (d.x - c.x) * (y - c.y) / (d.y - c.y), a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y) };
    if (!add_span(&lines->spans[i], made)) return false;
    w->steps += 2;
  }
  return true;
}

static int by_start(const void *a, const void *b) {
  const span *p = a, *q = b;
  return p->from < q->from ? -1 : p->from > q->from;
}

/* Returns the least x from x0 to x1 that lies in no interval of the line l, or infinity. */
static double leftmost(nest *w, spans *l, double x0, double x1) {
  double x = x0;
  size_t kept = 0;
  for (size_t i = 0; i < l->count; i++)
    if (l->at[i].to > x0 + w->slack && l->at[i].from < x1) l->at[kept++] = l->at[i];
  if (kept > 1) qsort(l->at, kept, sizeof *l->at, by_start);
  w->steps += 6 * kept;
  for (size_t i = 0; i < kept && l->at[i].from < x - w->slack; i++) x = fmax(x, l->at[i].to);
  for (bool again = true; again;) { /* repeats the search, because an interval that begins just before x may have been
                                     * skipped within the slack */
    again = false;
    for (size_t i = 0; i < kept; i++)
      if (l->at[i].from < x - w->slack && l->at[i].to > x + w->slack) x = l->at[i].to, again = true;
  }
  return x <= x1 + w->slack ? fmin(fmax(x, x0), fmax(x0, x1)) : INFINITY;
}

/* ---- places ---- */

/* A possible place of a part on a sheet. cost: how unfavourable it is; form: index of the turned part. */
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

/* Replaces *best by the best place of a form (turned part) on the horizontal lines, if that is better. *line: index of
 * its line. Returns false when memory is out. */
static bool look_on_lines(nest *w, size_t form_index, box room, spot *best, size_t *line) {
  vs_nest_lines *l = w->lines;
  const form *f = &w->forms[form_index];
  for (size_t i = 0; i < l->line_count; i++) l->spans[i].count = 0;
  for (size_t i = 0; i < l->sum_count; i++)
    if (!add_spans(w, &l->sums[i])) return false;
  for (size_t i = 0; i < l->line_count; i++) {
    double x = leftmost(w, &l->spans[i], room.x0, room.x1);
    double cost = x < INFINITY ? wanted(w, f, x, l->at[i]) : INFINITY;
    if (cost < best->cost - w->slack) *best = (spot){ cost, x, l->at[i], form_index }, *line = i;
  }
  return true;
}

/* Replaces *best by the best place of one form (turned part) on sheet s, if that place is better. Returns false when
 * memory is out. */
static bool look_for_form(nest *w, const sheet *s, size_t form_index, spot *best) {
  const vs_nest_lines *l = w->lines;
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
  double low = line ? l->at[line - 1] : room.y0, high = line + 1 < l->line_count ? l->at[line + 1] : room.y1;
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
  for (size_t i = 0; i < f->count; i++) s->at[s->count++] = (vs_nest_laid_piece){ f->first + i, move };
  s->parts[s->part_count++] =
      (box){ f->box.x0 + move.x, f->box.y0 + move.y, f->box.x1 + move.x, f->box.y1 + move.y };
  s->free -= w->kinds[w->kind_of[part]].area;
  s->reach = fmax(s->reach, f->box.x1 + move.x);
  return true;
}

/* Makes the sheet with this index if it does not exist, or removes all parts from it. Returns false when memory is
 * out. */
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

bool vs_nest_lay_part(vs_nest_places *w, uint32_t part, size_t *used) {
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
      w->laid[part] = (vs_nest_laid){ (uint32_t)i, best.form, { best.x, best.y } };
      return lay(w, s, part, best.form, w->laid[part].move);
    }
    s->full[k] = true;
    if (!s->part_count) return false; /* cannot occur, because each kind fits on an empty sheet */
  }
}

bool vs_nest_lay_again(vs_nest_places *w, uint32_t part, size_t *used) {
  const vs_nest_laid *l = &w->laid[part];
  while (*used <= l->sheet)
    if (!empty_sheet(w, (*used)++)) return false;
  return lay(w, &w->sheets[l->sheet], part, l->form, l->move);
}

double vs_nest_filled(const vs_nest_places *w, const vs_nest_sheet *s) {
  double m = w->rule->margin, whole = (w->rule->width - 2 * m) * (w->rule->height - 2 * m);
  return (s->reach + w->rule->width * (whole - s->free) / whole) / 2;
}

void vs_nest_places_free(vs_nest_places *w) {
  for (size_t i = 0; i < w->sheet_count; i++) free(w->sheets[i].at), free(w->sheets[i].parts), free(w->sheets[i].full);
  for (size_t i = 0; w->lines && i < MOST_LINES; i++) free(w->lines->spans[i].at);
  if (w->lines) free(w->lines->sums), free(w->lines->sum_at), free(w->lines->draft), free(w->lines);
  free(w->grown), free(w->mirrored), free(w->pieces), free(w->forms), free(w->kinds), free(w->kind_of), free(w->sheets);
  free(w->laid);
}
