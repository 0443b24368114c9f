/* Owns the putting of marks on a sheet. */
#include "backends/drawing/sheet_marks.h"

#include <string.h>

vs_sheet_point vs_sheet_place(const vs_flat_view *v, vs_sheet_point p) {
  return (vs_sheet_point){ (p.x - v->low.x) * v->mm + v->at.x, (p.y - v->low.y) * v->mm + v->at.y };
}

bool vs_sheet_line(vs_emitter *e, vs_sheet *s, uint32_t view, vs_drawn_layer layer, const vs_sheet_point *at,
    size_t count, bool closed) {
  if (!vs_emit_grow(e, &s->marks, &s->mark_room, s->mark_count + 1, sizeof *s->marks) ||
      !vs_emit_grow(e, &s->points, &s->point_room, s->point_count + count, sizeof *s->points))
    return false;
  s->marks[s->mark_count++] = (vs_mark){ .kind = VS_MARK_LINE, .layer = layer, .view = view,
      .first = (uint32_t)s->point_count, .count = (uint32_t)count, .closed = closed };
  memcpy(s->points + s->point_count, at, count * sizeof *at);
  s->point_count += count;
  return true;
}

/* The text as letters on a line: what is none has no shape on paper, and programs refuse files that hold it. */
static const char *on_paper(vs_store *store, const char *text) {
  size_t length = strlen(text), room = 3 * length + VS_SPELLED_ROOM, used = 0;
  char *letters = vs_store_realloc(store, NULL, 0, room);
  if (!letters) return NULL;
  for (const char *at = text, *end = text + length; at < end;) used += vs_spell_line(&at, end, letters + used);
  const char *kept = vs_store_text(store, letters, used);
  vs_store_realloc(store, letters, room, 0);
  return kept;
}

bool vs_sheet_text(vs_emitter *e, vs_sheet *s, uint32_t view, vs_drawn_layer layer, vs_sheet_point at, double size,
    double angle, double align, const char *text) {
  const char *kept = on_paper(e->scene->store, text);
  if (!kept) return vs_emit_no_memory(e);
  if (!vs_emit_grow(e, &s->marks, &s->mark_room, s->mark_count + 1, sizeof *s->marks)) return false;
  s->marks[s->mark_count++] = (vs_mark){ .kind = VS_MARK_TEXT, .layer = layer, .view = view, .text = kept, .at = at,
      .size = size, .angle = angle, .align = align };
  return true;
}
