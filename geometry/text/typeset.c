/* Arranges the glyphs of a text, and converts glyphs to loops.
 *
 * Every contour is sampled in the coordinates of its glyph, so that equal letters become equal loops. The ink of a
 * letter is where the winding number of its contours is not 0. If no two contours cross, a loop bounds ink if the
 * winding number is 0 on exactly one of its sides. Contours cross if the strokes of a letter overlap, or letters are
 * very close to each other. The loops are then first resolved in the plane (nonzero.h).
 *
 * The number n of chords follows from the second differences of the control points. A quadratic curve with the second
 * difference d = |p - 2b + q| is at most d/4 from its chord. With n equal pieces, the distance is at most d/(4 n^2).
 * For a cubic curve it is at most 3/4 of the larger of its two second differences over n^2. */
#include "geometry/text/typeset.h"

#include <stdlib.h>
#include <string.h>
#include <utf8proc.h>

#include "geometry/text/nonzero.h"
#include "model/store/array.h"

/* ---- typesetting ---- */

void vs_text_plan_free(vs_text_plan *p) {
  free(p->at);
  *p = (vs_text_plan){ 0 };
}

static bool text_push(vs_text_plan *p, const vs_glyph *g, double x, double y) {
  if (!VS_GROW(p->at, p->room, p->count + 1)) return false;
  p->at[p->count++] = (vs_text_glyph){ g, x, y };
  return true;
}

/* Returns true for characters that are never displayed, so that a font need not have a glyph for them: control
 * characters, joiners, direction marks, variation selectors. */
static bool text_is_silent(uint32_t c) {
  return c < 32 || c == 127 || (c >= 0x200B && c <= 0x200F) || (c >= 0x202A && c <= 0x202E) || c == 0x2060 ||
         c == 0xFEFF || (c >= 0xFE00 && c <= 0xFE0F);
}

typedef struct { vs_font *font; vs_text_plan *plan; double spacing, x, y; uint32_t before; bool any; } text_pen;

/* Adds the glyph of character c at the pen's position, and advances the pen. pen->x and pen->y are in font units.
 * Returns false and sets e on failure. */
static bool text_letter(text_pen *pen, uint32_t c, vs_error *e) {
  uint32_t index = vs_font_index(pen->font, c == '\t' ? ' ' : c);
  if (!index && text_is_silent(c) && c != '\t') return true;
  if (!index && !pen->plan->missing) pen->plan->missing = c;
  const vs_glyph *g = vs_font_glyph(pen->font, index, e);
  if (!g) return false;
  if (pen->any) pen->x += pen->spacing * vs_font_kerning(pen->font, pen->before, index);
  if (g->count && !text_push(pen->plan, g, pen->x, pen->y)) return vs_error_memory(e, NULL);
  pen->x += pen->spacing * g->advance * (c == '\t' ? 4 : 1);
  pen->before = index;
  pen->any = true;
  return true;
}

static double text_share(const char *align) { return !strcmp(align, "center") ? 0.5 : !strcmp(align, "right") ? 1 : 0; }

/* Returns how far the first base line lies below the text's point p, in font units. valign: vertical alignment; lines:
 * number of lines. */
static double text_drop(const vs_font *f, const char *valign, double lines) {
  double below = (lines - 1) * vs_font_line(f); /* distance between the first and the last base line, in font units */
  if (!strcmp(valign, "top")) return vs_font_capital(f);
  if (!strcmp(valign, "center")) return (vs_font_capital(f) - below) / 2;
  if (!strcmp(valign, "bottom")) return -below - vs_font_descent(f);
  return 0;
}

bool vs_text_lay(vs_store *s, const struct vs_letters *t, vs_text_plan *out, vs_error *e) {
  utf8proc_uint8_t *composed = NULL;
  *out = (vs_text_plan){ 0 };
  vs_font *font = vs_font_get(s, t->font, e);
  if (!font) return false;
  utf8proc_ssize_t bytes = utf8proc_map((const utf8proc_uint8_t *)t->string, 0, &composed,
                                        UTF8PROC_NULLTERM | UTF8PROC_STABLE | UTF8PROC_COMPOSE);
  if (bytes == UTF8PROC_ERROR_NOMEM) return vs_error_memory(e, NULL);
  if (bytes < 0) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the text is not UTF-8");
  text_pen pen = { .font = font, .plan = out, .spacing = t->spacing };
  double lines = 1, widest = 0, share = text_share(t->align);
  size_t line = 0; /* index of the first glyph of the current line */
  bool ok = true;
  for (utf8proc_ssize_t i = 0; ok && i <= bytes;) {
    utf8proc_int32_t c = '\n';
    if (i < bytes) i += utf8proc_iterate(composed + i, bytes - i, &c);
    else i++; /* ends the last line at the end of the text */
    if (c != '\n' && c != 0x2028) {
      ok = text_letter(&pen, (uint32_t)c, e);
      continue;
    }
    for (size_t k = line; k < out->count; k++) out->at[k].x -= share * pen.x;
    if (pen.x > widest) widest = pen.x;
    if (i <= bytes) lines++;
    line = out->count;
    pen.x = 0;
    pen.y -= vs_font_line(font);
    pen.any = false;
  }
  free(composed);
  if (!ok) {
    vs_text_plan_free(out);
    return false;
  }
  out->scale = t->size / vs_font_capital(font);
  out->width = widest * out->scale;
  double drop = text_drop(font, t->valign, lines);
  for (size_t k = 0; k < out->count; k++) {
    out->at[k].x *= out->scale;
    out->at[k].y = (out->at[k].y - drop) * out->scale;
  }
  return true;
}

/* ---- sampling of curves ---- */

static double text_turn(vs_font_point a, vs_font_point b, vs_font_point c) { /* returns the angle in radians by which a
                                                                              * path from a over b to c turns at b */
  double x = b.x - a.x, y = b.y - a.y, u = c.x - b.x, v = c.y - b.y;
  return fabs(atan2(x * v - y * u, x * u + y * v));
}

static double text_bend(vs_font_point a, vs_font_point b, vs_font_point c) {
  return hypot(a.x - 2 * b.x + c.x, a.y - 2 * b.y + c.y);
}

static int text_pieces(vs_font_point from, const vs_glyph_step *step, double tolerance, int segments) {
  double turn, apart;
  if (step->kind < VS_STEP_QUADRATIC) return 1;
  if (step->kind == VS_STEP_QUADRATIC) {
    turn = text_turn(from, step->b, step->to);
    apart = text_bend(from, step->b, step->to) / 4;
  } else {
    turn = text_turn(from, step->a, step->b) + text_turn(step->a, step->b, step->to);
    apart = 0.75 * fmax(text_bend(from, step->a, step->b), text_bend(step->a, step->b, step->to));
  }
  double pieces = ceil(turn / 6.283185307179586 * (segments > 0 ? segments : 32) - 1e-9);
  if (segments <= 0) pieces = fmax(pieces, ceil(sqrt(apart / tolerance) - 1e-9));
  return pieces < 1 ? 1 : pieces > 4096 ? 4096 : (int)pieces;
}

static vs_font_point text_at(vs_font_point p, const vs_glyph_step *s, double t) {
  double r = 1 - t;
  if (t == 1 || s->kind < VS_STEP_QUADRATIC) return s->to;
  if (s->kind == VS_STEP_QUADRATIC)
    return (vs_font_point){ r * r * p.x + 2 * r * t * s->b.x + t * t * s->to.x,
                            r * r * p.y + 2 * r * t * s->b.y + t * t * s->to.y };
  double w[4] = { r * r * r, 3 * r * r * t, 3 * r * t * t, t * t * t };
  return (vs_font_point){ w[0] * p.x + w[1] * s->a.x + w[2] * s->b.x + w[3] * s->to.x,
                          w[0] * p.y + w[1] * s->a.y + w[2] * s->b.y + w[3] * s->to.y };
}

/* Appends the contours of one glyph to the loops, in model units relative to the text's point. `tolerance`: largest
 * distance of a chord from its curve, in font units, unless the number of segments in a full turn is given by segments
 * > 0. */
static bool text_glyph_loops(const vs_text_glyph *at, double scale, double tolerance, int segments,
                             vs_flat_loops *all) {
  const vs_glyph *g = at->glyph;
  vs_font_point now = { 0, 0 };
  bool ok = true;
  for (size_t i = 0; ok && i < g->count; i++) {
    const vs_glyph_step *s = &g->steps[i];
    int pieces = text_pieces(now, s, tolerance, segments);
    if (s->kind == VS_STEP_MOVE) ok = vs_flat_loops_begin(all);
    for (int k = 1; ok && k <= pieces; k++) {
      vs_font_point p = text_at(now, s, (double)k / pieces);
      ok = vs_flat_loops_add(all, (vs_vec2){ at->x + p.x * scale, at->y + p.y * scale });
    }
    now = s->to;
  }
  return ok;
}

/* ---- loops ---- */

static bool text_outline(const vs_flat_loops *flat, vs_vec3 p, const vs_affine *placed, vs_outline *out) {
  out->loops = vs_zeros(flat->count, sizeof *out->loops);
  out->hole = vs_zeros(flat->count, sizeof *out->hole);
  if (!out->loops || !out->hole) return false;
  for (size_t i = 0; i < flat->count; i++) {
    const vs_flat_loop *l = &flat->loops[i];
    vs_polyline *to = &out->loops[out->count++];
    out->hole[i] = l->hole;
    to->at = vs_fresh(l->count, sizeof *to->at);
    if (!to->at) return false;
    to->count = to->room = l->count;
    to->closed = true;
    for (size_t k = 0; k < l->count; k++) {
      vs_vec2 v = flat->at[l->first + k];
      to->at[k] = vs_affine_point(placed, vs_v3(p.x + v.x, p.y + v.y, p.z));
    }
  }
  return true;
}

bool vs_text_loops(const vs_node *text, const vs_affine *placed, const vs_fineness *f, vs_outline *out, vs_error *e) {
  const struct vs_letters *t = VS_AS(letters, text);
  vs_fineness inner = vs_fineness_placed(f, placed);
  vs_flat_loops flat = { 0 };
  vs_text_plan plan;
  *out = (vs_outline){ 0 };
  if (!vs_text_lay(text->store, t, &plan, e)) return false;
  bool ok = true;
  for (size_t i = 0; ok && i < plan.count; i++)
    ok = text_glyph_loops(&plan.at[i], plan.scale, inner.tolerance / plan.scale, inner.segments, &flat);
  ok = ok || vs_error_memory(e, NULL);
  ok = ok && vs_nonzero(&flat, e) && (text_outline(&flat, t->p, placed, out) || vs_error_memory(e, NULL));
  if (!ok) vs_outline_free(out);
  vs_flat_loops_free(&flat);
  vs_text_plan_free(&plan);
  return ok;
}

/* ---- bounds ---- */

static vs_vec3 text_lift(const vs_text_glyph *g, double scale, vs_vec3 p, const vs_affine *placed, vs_font_point at) {
  return vs_affine_point(placed, vs_v3(p.x + g->x + at.x * scale, p.y + g->y + at.y * scale, p.z));
}

/* Finds the parameters, between 0 and 1, at which a coordinate of a Bezier curve is greatest or least: the zeros of its
 * derivative. `c`: this coordinate of the curve's control points, 4 if `cubic` is true, else 3. Writes the parameters
 * to t and returns their number. */
static int text_turns(const double *c, bool cubic, double t[2]) {
  double a = cubic ? c[3] - 3 * c[2] + 3 * c[1] - c[0] : 0,
         b = cubic ? 2 * (c[2] - 2 * c[1] + c[0]) : c[2] - 2 * c[1] + c[0], d = c[1] - c[0];
  if (fabs(a) < 1e-12 * (fabs(b) + fabs(d))) { /* the derivative is linear, so its zero solves b t + d = 0 */
    if (b == 0) return 0;
    t[0] = -d / b;
    return 1;
  }
  double under = b * b - 4 * a * d;
  if (under < 0) return 0;
  t[0] = (-b - sqrt(under)) / (2 * a);
  t[1] = (-b + sqrt(under)) / (2 * a);
  return 2;
}

bool vs_text_bounds(const vs_node *text, const vs_affine *placed, vs_bounds *b, vs_error *e) {
  const struct vs_letters *letters = VS_AS(letters, text);
  vs_text_plan plan;
  if (!vs_text_lay(text->store, letters, &plan, e)) return false;
  for (size_t i = 0; i < plan.count; i++) {
    const vs_text_glyph *g = &plan.at[i];
    vs_font_point now = { 0, 0 };
    for (size_t k = 0; k < g->glyph->count; k++) {
      const vs_glyph_step *s = &g->glyph->steps[k];
      bool cubic = s->kind == VS_STEP_CUBIC;
      vs_bounds_add(b, text_lift(g, plan.scale, letters->p, placed, s->to));
      vs_font_point control[4] = { now, cubic ? s->a : s->b, cubic ? s->b : s->to, s->to };
      for (int axis = 0; axis < 3 && s->kind >= VS_STEP_QUADRATIC; axis++) {
        double c[4], t[2];
        for (int j = 0; j < 4; j++) {
          vs_vec3 v = text_lift(g, plan.scale, letters->p, placed, control[j]);
          c[j] = axis == 0 ? v.x : axis == 1 ? v.y : v.z;
        }
        for (int j = text_turns(c, cubic, t); j-- > 0;)
          if (t[j] > 0 && t[j] < 1)
            vs_bounds_add(b, text_lift(g, plan.scale, letters->p, placed, text_at(now, s, t[j])));
      }
      now = s->to;
    }
  }
  vs_text_plan_free(&plan);
  return true;
}
