/* Lays out the sheet: scale, size, and the positions of views, frame, title block, scale bar and north arrow.
 *
 * Scale: a drawing is 1:100 if it then fits a sheet and is not too small on the smallest sheet. Otherwise it has the
 * largest round scale at which it fits a sheet. The views are placed in rows, in the order of their names, on the
 * smallest sheet that has room for them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/drawing/choose_views.h"
#include "backends/drawing/hatches.h"
#include "backends/drawing/notes.h"
#include "backends/drawing/sheet.h"
#include "backends/drawing/sheet_tables.h"

const vs_layer_row vs_drawn_rows[VS_DRAWN_LAYERS] = {
#define LAYER(upper, name, width, dash, gap, dot, grey, colour, weight) \
  { name, width, dash, gap, dot, grey, colour, weight },
#include "backends/drawing/layers.def"
};
const double vs_fault_color[3] = { 0.96, 0.72, 0.7 };

typedef struct { const char *name; double width, height; } paper;
static const paper papers[] = {
#define SHEET(name, width, height) { name, width, height },
#include "model/sheets.def"
};
enum { PAPERS = sizeof papers / sizeof *papers };

static const double scales[] = { 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 25, 50, 100, 200, 250, 500, 1000, 2000, 2500, 5000,
    10000, 20000, 25000, 50000, 100000,
                                 200000, 500000, 1e6 };
enum { SCALES = sizeof scales / sizeof *scales, HUNDRED = 10 };

static const double margin = 10, binding = 20, title_width = 130, title_height = 24, gap = 8, caption = 9;
static const double north_room = 22; /* height of the north arrow with the space around it, in mm */

/* ---- frame ---- */

/* Returns the vs_sheet_pen (data for adding marks) for marks that belong to no view. */
static vs_sheet_pen pen_of(vs_emitter *e, vs_sheet *s) { return (vs_sheet_pen){ e, s, (uint32_t)s->view_count }; }

static bool stroke(const vs_sheet_pen *pen, vs_sheet_point a, vs_sheet_point b) {
  return vs_sheet_stroke(pen, VS_DRAWN_SHEET, a, b);
}

static bool write(const vs_sheet_pen *pen, vs_sheet_point at, double size, double align, const char *text) {
  return vs_sheet_text(pen, &(vs_sheet_words){ .text = text, .at = at, .size = size, .align = align });
}

static vs_sheet_point point(double x, double y) { return (vs_sheet_point){ x, y }; }

/* ---- scale and place ---- */

/* Returns the width in mm that the sheet has for views and tables. */
static double free_width(const vs_sheet *s) { return s->right - s->left - 2 * gap; }
static double free_height(const vs_sheet *s) { return s->top - s->bottom - title_height - 2 * gap; }

/* Returns the width in mm that the sheet has for views, to the left of its tables. */
static double views_width(const vs_emitter *e, const vs_sheet *s) {
  const double tables = vs_sheet_tables_size(e->scene).x;
  return free_width(s) - (tables > 0 ? tables + gap : 0);
}

static bool is_flat(const vs_flat_view *v) { return v->look.parallel; }

/* Returns the number of millimetres on paper for a unit of the view's plane. A perspective view has no scale: it is as
 * wide as the paper allows. */
static double millimetres(const vs_emitter *e, const vs_sheet *s, const vs_flat_view *v, double scale) {
  if (is_flat(v)) return vs_drawing_unit(e->scene) / scale;
  double wide = v->high.x - v->low.x, high = v->high.y - v->low.y, share = s->view_count > 1 ? 0.45 : 1;
  const double border = 2;
  double across = share * (views_width(e, s) - 2 * border),
      up = share * (free_height(s) - 2 * border - caption);
  return fmin(across / fmax(wide, 1e-9 * high), up / fmax(high, 1e-9 * wide));
}

static double wide_of(const vs_flat_view *v) { return (v->high.x - v->low.x) * v->mm + v->room.left + v->room.right; }

/* Sets the size of view i at this scale, and computes the room that its notes need. Returns false if memory is out,
 * with the emitter's error set. */
static bool size_view(vs_emitter *e, vs_sheet *s, size_t i, double scale) {
  vs_flat_view *v = &s->views[i];
  v->scale = is_flat(v) ? (v->spec.scale > 0 ? v->spec.scale : scale) : 0;
  v->mm = millimetres(e, s, v, v->scale > 0 ? v->scale : 1);
  return vs_sheet_notes_room(e, s, (uint32_t)i);
}

/* Places the views from `first` to `end` - 1 in a row below the height `top`, centred in the width `free`, on a common
 * base line. Their titles are below the notes of all views. Returns the lower edge of the row in mm. */
static double place_row(vs_sheet *s, size_t first, size_t end, double top, double free) {
  double above = 0, below = 0, wide = gap * (double)(end - first - 1);
  for (size_t i = first; i < end; i++) {
    const vs_flat_view *v = &s->views[i];
    above = fmax(above, (v->high.y - v->low.y) * v->mm + v->room.above), below = fmax(below, v->room.below);
    wide += wide_of(v);
  }
  double x = s->left + gap + fmax(0, (free - wide) / 2);
  for (size_t i = first; i < end; i++) {
    vs_flat_view *v = &s->views[i];
    v->at = (vs_sheet_point){ x + v->room.left, top - above };
    v->title = top - above - below - caption + 3;
    x += wide_of(v) + gap;
  }
  return top - above - below - caption;
}

/* Places the views in rows. Sets *fits to true if they fit at this scale. Returns false if memory is out, with the
 * emitter's error set. */
static bool place_all(vs_emitter *e, vs_sheet *s, double scale, bool *fits) {
  double y = s->top - gap, least = s->bottom + title_height + gap, free = views_width(e, s);
  *fits = false;
  if (free <= 0 || vs_sheet_tables_size(e->scene).y > free_height(s) - north_room) return true;
  for (size_t i = 0; i < s->view_count; i++) {
    if (!size_view(e, s, i, scale)) return false;
    if (wide_of(&s->views[i]) > free + 1e-6) return true;
  }
  for (size_t first = 0, end; first < s->view_count; first = end) {
    double wide = wide_of(&s->views[first]);
    for (end = first + 1; end < s->view_count && wide + gap + wide_of(&s->views[end]) <= free + 1e-6; end++)
      wide += gap + wide_of(&s->views[end]);
    y = place_row(s, first, end, y, free);
    if (y < least - 1e-6) return true;
    y -= gap;
  }
  double shift = fmax(0, (y + gap - least) / 2); /* half of the remaining height is above the views, half below */
  for (size_t k = 0; k < s->view_count; k++) s->views[k].at.y -= shift, s->views[k].title -= shift;
  return *fits = true;
}

static void take_paper(vs_sheet *s, size_t i) {
  s->name = papers[i].name, s->width = papers[i].width, s->height = papers[i].height;
  s->left = binding, s->right = s->width - margin, s->bottom = margin, s->top = s->height - margin;
}

/* Sets *sheet to the sheet of the first view for which the program has set a sheet, and *scale to the scale of the
 * first view for which it has set a scale. */
static void asked(const vs_sheet *s, const char **sheet, double *scale) {
  *sheet = NULL, *scale = 0;
  for (size_t i = 0; i < s->view_count; i++) {
    if (!*sheet) *sheet = s->views[i].spec.sheet;
    if (*scale == 0 && is_flat(&s->views[i])) *scale = s->views[i].spec.scale;
  }
}

/* Places the views beside each other at true size, or at their scale, on a page without frame that is as large as they
 * are. A perspective view becomes 200 mm wide. */
static bool place_bare(vs_emitter *e, vs_sheet *s, double scale) {
  static const double border = 5, perspective = 200;
  double x = border, above = 0, below = 0;
  s->name = "none", s->bare = true;
  for (size_t i = 0; i < s->view_count; i++) {
    vs_flat_view *v = &s->views[i];
    double wide = v->high.x - v->low.x;
    v->scale = !is_flat(v) ? 0 : v->spec.scale > 0 ? v->spec.scale : scale > 0 ? scale : 1;
    v->mm = v->scale > 0 ? vs_drawing_unit(e->scene) / v->scale : wide > 0 ? perspective / wide : 1;
    if (!vs_sheet_notes_room(e, s, (uint32_t)i)) return false;
    v->at.x = x + v->room.left;
    x += wide_of(v) + (i + 1 < s->view_count ? gap : border);
    above = fmax(above, (v->high.y - v->low.y) * v->mm + v->room.above), below = fmax(below, v->room.below);
  }
  for (size_t i = 0; i < s->view_count; i++) s->views[i].at.y = border + below;
  s->width = x, s->height = above + below + 2 * border;
  s->left = s->bottom = 0, s->right = s->width, s->top = s->height;
  return true;
}

/* Chooses the smallest sheet among papers[low] to papers[high - 1] on which the views fit at this scale. Sets *fits to
 * true if there is such a sheet. Returns false if memory is out, with the emitter's error set. */
static bool try_papers(vs_emitter *e, vs_sheet *s, size_t low, size_t high, double scale, bool *fits) {
  *fits = false;
  for (size_t i = low; i < high && !*fits; i++)
    if (take_paper(s, i), !place_all(e, s, scale, fits)) return false;
  return true;
}

static bool choose(vs_emitter *e, vs_sheet *s) {
  const char *sheet;
  double scale;
  asked(s, &sheet, &scale);
  if (sheet && strcmp(sheet, "none") == 0) return place_bare(e, s, scale);
  size_t low = 0, high = PAPERS;
  for (size_t i = 0; sheet && i < PAPERS; i++)
    if (strcmp(papers[i].name, sheet) == 0) low = i, high = i + 1;
  bool large = false; /* large: whether the drawing is too small on the smallest sheet at 1:100; larger scales are then
                       * tried first */
  if (scale == 0) {
    double across = 0;
    for (size_t i = 0; i < s->view_count; i++) {
      const vs_flat_view *v = &s->views[i];
      if (is_flat(v)) across = fmax(across, fmax(v->high.x - v->low.x,
          v->high.y - v->low.y) * vs_drawing_unit(e->scene) / 100);
    }
    large = across < 60;
  }
  size_t fixed = !sheet && scale == 0 ? PAPERS - 1 : high; /* sheet A0 is used only if the program sets it */
  bool fits = false, ok = true;
  if (scale > 0) ok = try_papers(e, s, low, high, scale, &fits);
  else if (!large) ok = try_papers(e, s, low, fixed, scales[HUNDRED], &fits);
  for (size_t k = large ? 0 : HUNDRED + 1; scale == 0 && ok && !fits && k < SCALES; k++)
    ok = try_papers(e, s, large || sheet ? low : 1, large && !sheet ? 1 : sheet ? high : 3, scales[k], &fits);
  if (!ok || fits) return ok;
  char name[48] = "a sheet";
  if (sheet) snprintf(name, sizeof name, "the sheet %.8s", sheet);
  if (scale > 0) return vs_error_set(e->error, VS_ERROR_MODEL, NULL,
      "the drawing does not fit %s at 1:%g; remove #:scale%s, and vs chooses a scale that fits", name, scale,
          sheet ? " or #:sheet" : "");
  return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "the drawing does not fit %s at any scale", name);
}

/* ---- marks around the views ---- */

static const char *scale_text(double scale, char text[32]) {
  if (scale <= 0) return "";
  if (scale >= 1) snprintf(text, 32, "1:%g", scale);
  else snprintf(text, 32, "%g:1", 1 / scale);
  return text;
}

/* Draws a scale bar of five parts, whose length is a round number of model units. */
static bool scale_bar(const vs_sheet_pen *pen, double x, double y, const vs_flat_view *v) {
  double part = pow(10, floor(log10(12 / v->mm)));
  if (part * 5 * v->mm <= 12) part *= 5;
  else if (part * 2 * v->mm <= 12) part *= 2;
  char text[40];
  for (int i = 0; i <= 5; i++) {
    double at = x + i * part * v->mm;
    if (!stroke(pen, point(at, y), point(at, y + 1.6))) return false;
    snprintf(text, sizeof text, i == 5 ? "%g %s" : "%g", i * part, pen->e->scene->units);
    if ((i == 0 || i == 1 || i == 5) && !write(pen, point(at, y + 2.6), 1.8, 0.5, text)) return false;
    /* The bar's dark parts are close parallel lines, because every program shows these. */
    for (int k = 0; i < 5 && k < 4 && i % 2 == 0; k++)
      if (!stroke(pen, point(at, y + 0.25 * k), point(at + part * v->mm, y + 0.25 * k))) return false;
    if (i < 5 && i % 2 && !stroke(pen, point(at, y), point(at + part * v->mm, y))) return false;
  }
  return true;
}

static bool north(const vs_sheet_pen *pen, double x, double y, const vs_flat_view *v) {
  vs_vec3 up = vs_v3(0, 1, 0);
  double dx = vs_v3_dot(up, v->look.right), dy = vs_v3_dot(up, v->look.up), length = hypot(dx, dy);
  if (!(length > 0.1)) return true;
  dx /= length, dy /= length;
  vs_sheet_point arrow[4] = { { x - 5 * dx - 2.5 * dy, y - 5 * dy + 2.5 * dx }, { x + 5 * dx, y + 5 * dy },
      { x - 5 * dx + 2.5 * dy, y - 5 * dy - 2.5 * dx }, { x - 3 * dx, y - 3 * dy } };
  return vs_sheet_line(pen, VS_DRAWN_SHEET, arrow, 4, true) &&
      write(pen, point(x + 7.5 * dx, y + 7.5 * dy - 1.2), 2.5, 0.5, "N");
}

/* Returns the view whose scale the title block shows: the first view with a scale. Sets *several to true if the views
 * have different scales. */
static const vs_flat_view *scaled_view(const vs_sheet *s, bool *several) {
  const vs_flat_view *scaled = NULL;
  *several = false;
  for (size_t i = 0; i < s->view_count; i++) {
    *several = *several || (scaled && is_flat(&s->views[i]) && s->views[i].scale != scaled->scale);
    if (!scaled && is_flat(&s->views[i])) scaled = &s->views[i];
  }
  return scaled;
}

static bool title_block(vs_emitter *e, vs_sheet *s) {
  const vs_sheet_pen pen = pen_of(e, s);
  double x = s->right - title_width, y = s->bottom, top = y + title_height, middle = y + title_height / 2,
      column = x + 78, last = column + 26;
  char text[160], scale[32];
  const char *title = e->scene->title, *dot = strrchr(title, '.');
  bool ok = vs_sheet_rectangle(&pen, VS_DRAWN_SHEET, point(x, y), point(s->right, top)) &&
            stroke(&pen, point(x, middle), point(s->right, middle)) &&
            stroke(&pen, point(column, y), point(column, top)) && stroke(&pen, point(last, y), point(last, middle));
  size_t length = vs_character_cut(title, 60);
  if (dot && dot > title && (size_t)(dot - title) < length) length = (size_t)(dot - title);
  snprintf(text, sizeof text, "%.*s", (int)length, title);
  ok = ok && write(&pen, point(x + 3, middle + 1.8 + 2.4), 3.5, 0, text);
  const char *what = s->view_count == 1 ? s->views[0].spec.name : "views";
  ok = ok && write(&pen, point(x + 3, y + 4.4), 3, 0, what) &&
       write(&pen, point(column + 3, middle + 7.6), 1.6, 0, "scale") &&
       write(&pen, point(column + 3, y + 8), 1.6, 0, "sheet") &&
       write(&pen, point(column + 29, y + 8), 1.6, 0, "units");
  bool several;
  const vs_flat_view *scaled = scaled_view(s, &several);
  const char *stated = several ? "as shown" : scaled ? scale_text(scaled->scale, scale) : "none";
  ok = ok && write(&pen, point(column + 3, middle + 2.4), 3.5, 0, stated) &&
       write(&pen, point(column + 3, y + 2.6), 3, 0, s->name) &&
       write(&pen, point(column + 29, y + 2.6), 3, 0, e->scene->units);
  if (ok && scaled && s->left + 80 < x) ok = scale_bar(&pen, s->left + 8, y + 6, scaled);
  return ok;
}

static bool captions(vs_emitter *e, vs_sheet *s) {
  const vs_sheet_pen sheet = pen_of(e, s);
  bool ok = true;
  for (size_t i = 0; ok && i < s->view_count; i++) {
    const vs_flat_view *v = &s->views[i];
    double x = v->at.x + (v->high.x - v->low.x) * v->mm / 2;
    char text[160], scale[32];
    snprintf(text, sizeof text, "%.*s%s%s", (int)vs_character_cut(v->spec.name, 100), v->spec.name,
        v->scale > 0 ? "   " : "", scale_text(v->scale, scale));
    ok = write(&(vs_sheet_pen){ e, s, (uint32_t)i }, point(x, v->title), 2.5, 0.5, text);
    if (ok && i == 0 && v->look.parallel && fabs(v->look.forward.z) > 0.999)
      ok = north(&sheet, s->right - 12, s->top - 14, v);
  }
  return ok;
}

/* ---- the sheet ---- */

static bool put_view(vs_emitter *e, vs_sheet *s, uint32_t i) {
  const vs_sheet_pen pen = { e, s, i };
  vs_flat_view *v = &s->views[i];
  bool ok = true;
  for (size_t k = 0; ok && k < v->fill_count; k++) ok = vs_sheet_fill(&pen, &v->fills[k]);
  for (size_t k = 0; ok && k < v->line_count; k++) {
    const vs_flat_line *l = &v->lines[k];
    size_t first = s->point_count;
    ok = vs_sheet_line(&pen, l->layer, v->points + l->first, l->count, l->closed);
    if (ok) s->marks[s->mark_count - 1].own = l->own;
    for (size_t n = first; ok && n < s->point_count; n++) s->points[n] = vs_sheet_place(v, s->points[n]);
  }
  return ok && vs_sheet_notes(&pen);
}

static bool put_tables(vs_emitter *e, vs_sheet *s) {
  const vs_sheet_pen pen = pen_of(e, s);
  return vs_sheet_tables(&pen, point(s->right - gap, s->bottom + title_height + gap));
}

bool vs_sheet_make(vs_emitter *e, vs_sheet *s, vs_flat_view *views, size_t count) {
  s->views = views, s->view_count = count;
  const vs_sheet_pen pen = pen_of(e, s);
  bool ok = choose(e, s) &&
            (s->bare || (vs_sheet_rectangle(&pen, VS_DRAWN_FRAME, point(s->left, s->bottom), point(s->right, s->top)) &&
                         title_block(e, s) && captions(e, s) && put_tables(e, s)));
  for (size_t i = 0; ok && i < count; i++) ok = put_view(e, s, (uint32_t)i);
  return ok;
}

void vs_sheet_describe(const vs_sheet *s, char *out, size_t room) {
  bool several;
  char scale[32];
  const vs_flat_view *scaled = scaled_view(s, &several);
  int n = s->view_count == 1 ? snprintf(out, room, "view \"%.*s\"", (int)vs_character_cut(s->views[0].spec.name, 100),
                                        s->views[0].spec.name)
                             : snprintf(out, room, "%zu views", s->view_count);
  snprintf(out + n, room - (size_t)n, "%s%s, %s%s", several ? ", scales as shown" : scaled ? ", scale " : "",
           several || !scaled ? "" : scale_text(scaled->scale, scale), s->bare ? "no sheet" : "sheet ",
           s->bare ? "" : s->name);
}

void vs_sheet_free(vs_emitter *e, vs_sheet *s) {
  vs_emit_release(e, s->marks, s->mark_room, sizeof *s->marks);
  vs_emit_release(e, s->points, s->point_room, sizeof *s->points);
  vs_emit_release(e, s->loops, s->loop_room, sizeof *s->loops);
}
