/* Implements the functions that add marks (lines, fills and texts) to a sheet. */
#include "backends/drawing/sheet_marks.h"

#include <string.h>

vs_sheet_point vs_sheet_place(const vs_flat_view *v, vs_sheet_point p) {
  return (vs_sheet_point){ (p.x - v->low.x) * v->mm + v->at.x, (p.y - v->low.y) * v->mm + v->at.y };
}

/* Adds a mark to the pen's sheet. */
static bool add(const vs_sheet_pen *pen, vs_mark mark) {
  vs_sheet *s = pen->sheet;
  if (!vs_emit_grow(pen->e, &s->marks, &s->mark_room, s->mark_count + 1, sizeof *s->marks)) return false;
  mark.view = pen->view;
  s->marks[s->mark_count++] = mark;
  return true;
}

bool vs_sheet_line(const vs_sheet_pen *pen, vs_drawn_layer layer, const vs_sheet_point *at, size_t count,
                   bool closed) {
  vs_sheet *s = pen->sheet;
  if (!add(pen, (vs_mark){ .kind = VS_MARK_LINE, .layer = layer, .first = (uint32_t)s->point_count,
                           .count = (uint32_t)count, .closed = closed }) ||
      !vs_emit_grow(pen->e, &s->points, &s->point_room, s->point_count + count, sizeof *s->points))
    return false;
  memcpy(s->points + s->point_count, at, count * sizeof *at);
  s->point_count += count;
  return true;
}

bool vs_sheet_stroke(const vs_sheet_pen *pen, vs_drawn_layer layer, vs_sheet_point a, vs_sheet_point b) {
  vs_sheet_point at[2] = { a, b };
  return vs_sheet_line(pen, layer, at, 2, false);
}

bool vs_sheet_rectangle(const vs_sheet_pen *pen, vs_drawn_layer layer, vs_sheet_point a, vs_sheet_point b) {
  vs_sheet_point at[4] = { a, { b.x, a.y }, b, { a.x, b.y } };
  return vs_sheet_line(pen, layer, at, 4, true);
}

/* Returns the text as a single line of printable characters. Other characters cannot be drawn, and programs refuse
 * files that contain them. */
static const char *on_paper(vs_store *store, const char *text) {
  size_t length = strlen(text), room = 3 * length + VS_SPELLED_ROOM, used = 0;
  char *letters = vs_store_realloc(store, NULL, 0, room);
  if (!letters) return NULL;
  for (const char *at = text, *end = text + length; at < end;) used += vs_spell_line(&at, end, letters + used);
  const char *kept = vs_store_text(store, letters, used);
  vs_store_realloc(store, letters, room, 0);
  return kept;
}

bool vs_sheet_text(const vs_sheet_pen *pen, const vs_sheet_words *words) {
  const char *kept = on_paper(pen->e->scene->store, words->text);
  if (!kept) return vs_emit_no_memory(pen->e);
  return add(pen, (vs_mark){ .kind = VS_MARK_TEXT, .layer = VS_DRAWN_TEXT, .text = kept, .at = words->at,
                             .size = words->size, .angle = words->angle, .align = words->align });
}
