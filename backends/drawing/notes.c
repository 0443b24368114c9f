/* Draws the notes of a drawing: dimensions, labels, levels (marks of heights), axes, and the ground line in elevations
 * and sections.
 *
 * A note appears only in views that show its length or height correctly. A dimension appears in a view that shows its
 * length unshortened; a horizontal dimension appears in a plan, or in a section through both of its ends. A level
 * appears in a view that shows heights. An axis appears on plans, and as a vertical line in views along it. Dimensions
 * are next to the model. Beyond the dimensions are the levels on the left and the circles of axes below. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/drawing/choose_views.h"
#include "backends/drawing/notes.h"

static const double bubble = 4, cap = 2.2, level_cap = 1.8; /* bubble: radius of the circle at an axis; cap, level_cap:
                                                             * heights of capital letters; all in mm */
static const double away = 9; /* distance from the model to a dimension, in mm */

static bool is_upright(const vs_flat_view *v) { return v->look.parallel && fabs(v->look.forward.z) < 1e-6;
    } /* true for views that look horizontally: elevations and sections */
static bool shows(const vs_flat_view *v, const vs_scene_note *n) { return v->look.parallel &&
    (!n->view || strcmp(n->view, v->spec.name) == 0); }

/* Returns true if the view's cut has removed both ends of the dimension n. */
static bool is_removed(const vs_flat_view *v, const vs_scene_note *n, double slack) {
  const vs_scene_view *s = &v->spec;
  return v->has_cut && vs_v3_dot(vs_v3_sub(n->p, s->cut_point), s->cut_normal) < -slack &&
         vs_v3_dot(vs_v3_sub(n->q, s->cut_point), s->cut_normal) < -slack;
}

/* Returns true if both ends of the dimension n lie in the plane of the view's cut. */
static bool is_in_cut(const vs_flat_view *v, const vs_scene_note *n, double slack) {
  const vs_scene_view *s = &v->spec;
  return v->has_cut && fabs(vs_v3_dot(vs_v3_sub(n->p, s->cut_point), s->cut_normal)) <= slack &&
         fabs(vs_v3_dot(vs_v3_sub(n->q, s->cut_point), s->cut_normal)) <= slack;
}

/* Returns true if the view v shows the dimension n, whose length the view does not shorten. A dimension with #:view
 * appears in that view alone. No view shows a dimension if its cut has removed both ends. */
static bool shows_dimension(const vs_flat_view *v, const vs_scene_note *n) {
  vs_vec3 d = vs_v3_sub(n->q, n->p);
  double slack = 1e-6 * vs_v3_length(d);
  if (n->view) return true;
  if (is_removed(v, n, slack)) return false;
  return !is_upright(v) || fabs(d.z) > slack || is_in_cut(v, n, slack);
}

/* Returns true if the view v shows the scene's note n. */
static bool fits(const vs_emitter *e, const vs_flat_view *v, const vs_scene_note *n) {
  if (!shows(v, n)) return false;
  vs_vec3 d = vs_v3_sub(n->q, n->p);
  double along = fabs(vs_v3_dot(d, v->look.forward)), length = vs_v3_length(d);
  switch (n->kind) {
  case VS_NOTE_DIMENSION: return along <= 1e-6 * length && shows_dimension(v, n);
  case VS_NOTE_LABEL: return v->labelled[n - e->scene->notes];
  case VS_NOTE_LEVEL: return is_upright(v);
  case VS_NOTE_AXIS: return (!is_upright(v) && along <= 1e-6 * length) || along >= length * (1 - 1e-9);
  }
  return false;
}

/* Writes a length of the model as text: metres and feet with two decimals, smaller units with at most four digits. */
static void length_text(const vs_emitter *e, double length, char *text, size_t room) {
  bool fine = vs_drawing_unit(e->scene) < 100;
  snprintf(text, room, fine ? "%.4g" : "%.2f", fine ? round(length * 10) / 10 : length);
}

static void level_text(const vs_emitter *e, const vs_scene_note *n, char *text, size_t room) {
  char number[40];
  length_text(e, fabs(n->p.z), number, sizeof number);
  const char *own = n->text ? n->text : "";
  snprintf(text, room, "%s%s%s%.*s", n->p.z < 0 ? "-" : n->p.z > 0 ? "+" : "\302\261", number, n->text ? "  " : "",
      (int)vs_character_cut(own, 100), own);
}

double vs_sheet_text_width(const char *text, double size) {
  size_t letters = 0;
  for (; *text; text++) letters += ((unsigned char)*text & 0xc0) != 0x80;
  return 0.9 * size * (double)letters;
}

/* Returns the distance in mm that the marks of levels extend to the left of the view. */
static double levels_width(const vs_emitter *e, const vs_flat_view *v) {
  double most = 12;
  char text[160];
  for (size_t i = 0; i < e->scene->note_count; i++) {
    const vs_scene_note *n = &e->scene->notes[i];
    if (n->kind != VS_NOTE_LEVEL || !fits(e, v, n)) continue;
    level_text(e, n, text, sizeof text);
    most = fmax(most, vs_sheet_text_width(text, level_cap) + 4);
  }
  return most;
}

static vs_sheet_point middle_of(const vs_flat_view *v) {
  return (vs_sheet_point){ (v->low.x + v->high.x) / 2, (v->low.y + v->high.y) / 2 };
}

/* Returns the width in mm that automatically placed dimensions need on paper: below the view if `below` is true,
 * otherwise at its left. */
static double dimensions_width(const vs_emitter *e, const vs_flat_view *v, bool below) {
  vs_sheet_point middle = middle_of(v);
  for (size_t i = 0; i < e->scene->note_count; i++) {
    const vs_scene_note *n = &e->scene->notes[i];
    if (n->kind != VS_NOTE_DIMENSION || !isnan(n->offset) || !fits(e, v, n)) continue;
    vs_sheet_point p = vs_flat_view_project(v, n->p), q = vs_flat_view_project(v, n->q);
    bool level = fabs(q.y - p.y) < fabs(q.x - p.x);
    if (level == below && (below ? p.y < middle.y : p.x < middle.x)) return away + 2;
  }
  return 0;
}

static const vs_flat_view *view_of(const vs_sheet_pen *pen) { return &pen->sheet->views[pen->view]; }

static bool stroke(const vs_sheet_pen *pen, vs_sheet_point a, vs_sheet_point b) {
  return vs_sheet_stroke(pen, VS_DRAWN_DIMENSION, a, b);
}

/* Draws a tick at an end of a dimension line; t is the vector from the tick's middle to its end. */
static bool tick(const vs_sheet_pen *pen, vs_sheet_point at, vs_sheet_point t) {
  return vs_sheet_stroke(pen, VS_DRAWN_CUT, (vs_sheet_point){ at.x - t.x, at.y - t.y },
                         (vs_sheet_point){ at.x + t.x, at.y + t.y });
}

static vs_sheet_point seen_at(const vs_flat_view *v, vs_vec3 p) { return vs_sheet_place(v, vs_flat_view_project(v,
    p)); }

/* Draws a dimension. Its line is parallel to the segment from p to q, on the side away from the view's centre, at the
 * note's distance or 10 mm. Ticks cross the line at 45 degrees. */
static bool dimension(const vs_sheet_pen *pen, const vs_scene_note *n) {
  const vs_flat_view *v = view_of(pen);
  vs_sheet_point p = seen_at(v, n->p), q = seen_at(v, n->q);
  double dx = q.x - p.x, dy = q.y - p.y, length = hypot(dx, dy);
  if (length < 1e-6) return true;
  dx /= length, dy /= length;
  vs_sheet_point middle = { v->at.x + (v->high.x - v->low.x) * v->mm / 2,
      v->at.y + (v->high.y - v->low.y) * v->mm / 2 };
  double nx = -dy, ny = dx, out = away;
  if (isnan(n->offset)) {
    if ((p.x - middle.x) * nx + (p.y - middle.y) * ny < -1e-9) out = -out;
  } else {
    out = n->offset * v->mm;
  }
  vs_sheet_point a = { p.x + nx * out, p.y + ny * out }, b = { q.x + nx * out, q.y + ny * out };
  double sign = out < 0 ? -1 : 1, gap = fmin(1.5, fabs(out) / 2), over = 1.5;
  vs_sheet_point a0 = { p.x + nx * sign * gap, p.y + ny * sign * gap },
      a1 = { a.x + nx * sign * over, a.y + ny * sign * over };
  vs_sheet_point b0 = { q.x + nx * sign * gap, q.y + ny * sign * gap },
      b1 = { b.x + nx * sign * over, b.y + ny * sign * over };
  vs_sheet_point t = { (dx + nx) * 1.1, (dy + ny) * 1.1 };
  if (!stroke(pen, a, b) || !stroke(pen, a0, a1) || !stroke(pen, b0, b1) || !tick(pen, a, t) || !tick(pen, b, t))
    return false;
  char text[40];
  length_text(pen->e, vs_v3_length(vs_v3_sub(n->q, n->p)), text, sizeof text);
  bool back = dx < -1e-9 || (fabs(dx) <= 1e-9 && dy < 0); /* back: whether the text is rotated by 180 degrees, so that
                                                           * it can be read from below or from the right */
  double ux = back ? -dx : dx, uy = back ? -dy : dy, angle = atan2(uy, ux) * (180 / 3.14159265358979323846);
  vs_sheet_point at = { (a.x + b.x) / 2 - uy * 1, (a.y + b.y) / 2 + ux * 1 };
  return vs_sheet_text(pen, &(vs_sheet_words){ n->text ? n->text : text, at, cap, angle, 0.5 });
}

static bool level(const vs_sheet_pen *pen, const vs_scene_note *n) {
  const vs_flat_view *v = view_of(pen);
  double end = v->at.x - 2 - dimensions_width(pen->e, v, false), y = seen_at(v, n->p).y,
         x = end - levels_width(pen->e, v);
  vs_sheet_point mark[3] = { { x + 2, y }, { x + 0.7, y + 1.9 }, { x + 3.3, y + 1.9 } };
  char text[160];
  level_text(pen->e, n, text, sizeof text);
  return vs_sheet_line(pen, VS_DRAWN_DIMENSION, mark, 3, true) &&
         stroke(pen, (vs_sheet_point){ x, y }, (vs_sheet_point){ end, y }) &&
         vs_sheet_text(pen, &(vs_sheet_words){ .text = text, .at = { x, y + 2.8 }, .size = level_cap });
}

static bool circle(const vs_sheet_pen *pen, vs_sheet_point c, double r) {
  enum { CORNERS = 48 };
  vs_sheet_point at[CORNERS];
  for (int i = 0; i < CORNERS; i++) {
    double a = 2 * 3.14159265358979323846 * i / CORNERS;
    at[i] = (vs_sheet_point){ c.x + r * cos(a), c.y + r * sin(a) };
  }
  return vs_sheet_line(pen, VS_DRAWN_DIMENSION, at, CORNERS, true);
}

static bool axis(const vs_sheet_pen *pen, const vs_scene_note *n) {
  const vs_flat_view *v = view_of(pen);
  vs_sheet_point p = seen_at(v, n->p), q = seen_at(v, n->q), first = p;
  double dx = q.x - p.x, dy = q.y - p.y, length = hypot(dx, dy);
  if (length < 1e-3) { /* the view looks along the axis, which becomes a vertical line over the height of the view */
    p.y = v->at.y - 3 - dimensions_width(pen->e, v, true);
    q = (vs_sheet_point){ p.x, v->at.y + (v->high.y - v->low.y) * v->mm + 3 };
    dx = 0, dy = 1, first = p;
  } else {
    dx /= length, dy /= length;
  }
  vs_sheet_point c = { first.x - dx * bubble, first.y - dy * bubble };
  return vs_sheet_stroke(pen, VS_DRAWN_AXIS, p, q) && circle(pen, c, bubble) &&
         vs_sheet_text(pen, &(vs_sheet_words){ n->text, { c.x, c.y - cap / 2 }, cap, 0, 0.5 });
}

/* Draws a label: its lines below each other, their middle at the point of the label. */
static bool label(const vs_sheet_pen *pen, const vs_scene_note *n) {
  vs_sheet_point at = seen_at(view_of(pen), n->p);
  for (const char *c = n->text; *c; c++) at.y += *c == '\n' ? 0.8 * cap : 0;
  bool ok = true;
  for (const char *line = n->text, *end; ok && *line; line = *end ? end + 1 : end, at.y -= 1.6 * cap) {
    end = line + strcspn(line, "\n");
    const char *text = vs_store_text(pen->e->scene->store, line, (size_t)(end - line));
    ok = text ? vs_sheet_text(pen, &(vs_sheet_words){ text, at, cap, 0, 0.5 }) : vs_emit_no_memory(pen->e);
  }
  return ok;
}

/* Draws the ground line where a section cuts the earth: those sides of the earth's area that are at the height of the
 * ground. */
static bool ground_of_earth(const vs_sheet_pen *pen, const vs_flat_fill *fill) {
  const vs_flat_view *v = view_of(pen);
  double y = vs_flat_view_project(v, vs_v3(0, 0, pen->e->scene->ground_z)).y, near = 1e-9 * fabs(v->high.y - v->low.y);
  bool ok = true;
  for (uint32_t l = fill->first_loop; ok && l < fill->first_loop + fill->loop_count; l++)
    for (uint32_t i = 0, n = v->loops[l].count; ok && i < n; i++) {
      vs_sheet_point p = v->points[v->loops[l].first + i], q = v->points[v->loops[l].first + (i + 1) % n];
      if (fabs(p.y - y) <= near && fabs(q.y - y) <= near)
        ok = vs_sheet_stroke(pen, VS_DRAWN_GROUND, vs_sheet_place(v, p), vs_sheet_place(v, q));
    }
  return ok;
}

static bool ground(const vs_sheet_pen *pen) {
  const vs_emitter *e = pen->e;
  const vs_flat_view *v = view_of(pen);
  if (!e->scene->has_ground || !is_upright(v)) return true;
  for (size_t i = 0; i < v->fill_count; i++)
    if (v->fills[i].kind == VS_FILL_EARTH) return ground_of_earth(pen, &v->fills[i]);
  double y = seen_at(v, vs_v3(0, 0, e->scene->ground_z)).y, x0 = v->at.x, x1 = x0 + (v->high.x - v->low.x) * v->mm,
      more = 8;
  return vs_sheet_stroke(pen, VS_DRAWN_GROUND, (vs_sheet_point){ x0 - more, y }, (vs_sheet_point){ x1 + more, y });
}

bool vs_sheet_notes(const vs_sheet_pen *pen) {
  const vs_emitter *e = pen->e;
  bool ok = ground(pen);
  for (size_t i = 0; ok && i < e->scene->note_count; i++) {
    const vs_scene_note *n = &e->scene->notes[i];
    if (!fits(e, view_of(pen), n)) continue;
    switch (n->kind) {
    case VS_NOTE_DIMENSION: ok = dimension(pen, n); break;
    case VS_NOTE_LABEL: ok = label(pen, n); break;
    case VS_NOTE_LEVEL: ok = level(pen, n); break;
    case VS_NOTE_AXIS: ok = axis(pen, n); break;
    }
  }
  return ok;
}

/* Enlarges the room around a view so that it contains the point p, in millimetres from the view's lower left corner.
 * wide, high: size of the view in mm. */
static void include(vs_sheet_room *room, vs_sheet_point p, double wide, double high) {
  room->left = fmax(room->left, -p.x), room->right = fmax(room->right, p.x - wide);
  room->below = fmax(room->below, -p.y), room->above = fmax(room->above, p.y - high);
}

/* Enlarges the room around a view so that it contains a text; descenders reach below the base line. A text longer than
 * LONGEST_TEXT millimetres may extend beyond the sheet's frame, because otherwise no sheet would be large enough. */
enum { LONGEST_TEXT = 150 };

static void include_text(vs_sheet_room *room, const vs_mark *m, double wide, double high) {
  double turn = m->angle * (3.14159265358979323846 / 180), c = cos(turn), n = sin(turn);
  double length = fmin(vs_sheet_text_width(m->text, m->size), LONGEST_TEXT);
  for (int i = 0; i < 4; i++) {
    double along = length * (i % 2 - m->align), up = m->size * (i < 2 ? -0.35 : 1.1);
    include(room, (vs_sheet_point){ m->at.x + along * c - up * n, m->at.y + along * n + up * c }, wide, high);
  }
}

bool vs_sheet_notes_room(vs_emitter *e, const vs_sheet *s, uint32_t index) {
  vs_flat_view *v = &s->views[index];
  if (v->room_mm == v->mm) return true;
  vs_sheet own = { .views = s->views, .view_count = s->view_count };
  vs_sheet_point kept = v->at;
  v->at = (vs_sheet_point){ 0, 0 };
  bool ok = vs_sheet_notes(&(vs_sheet_pen){ e, &own, index });
  v->at = kept;
  double wide = (v->high.x - v->low.x) * v->mm, high = (v->high.y - v->low.y) * v->mm, border = 2;
  vs_sheet_room room = { 0, 0, 0, 0 };
  for (size_t i = 0; ok && i < own.mark_count; i++) {
    const vs_mark *m = &own.marks[i];
    if (m->kind == VS_MARK_TEXT) include_text(&room, m, wide, high);
    else for (uint32_t k = 0; k < m->count; k++) include(&room, own.points[m->first + k], wide, high);
  }
  v->room = (vs_sheet_room){ room.left + border, room.right + border, room.below + border, room.above + border };
  v->room_mm = v->mm;
  vs_emit_release(e, own.marks, own.mark_room, sizeof *own.marks);
  vs_emit_release(e, own.points, own.point_room, sizeof *own.points);
  vs_emit_release(e, own.loops, own.loop_room, sizeof *own.loops);
  return ok;
}
