/* Owns what the files of the drawing back-end share: a view worked out flat, and the sheet that several of them are
 * laid out on.
 *
 * The way of a drawing: choose_views.c says which views; flat_view.c makes each flat, in model units, by the kernel's
 * mesh and solids/hidden_lines.h; sheet.c finds scale
 * and sheet and puts marks on it, in millimetres from the sheet's lower left corner; notes.c adds dimensions and the
 * like; svg.c, pdf.c and dxf.c write the marks. */
#ifndef VS_BACKENDS_SHEET_H
#define VS_BACKENDS_SHEET_H

#include "backends/drawing/flat_view.h"

typedef enum { VS_MARK_LINE, VS_MARK_FILL, VS_MARK_TEXT } vs_mark_kind;
typedef struct {
  vs_mark_kind kind;
  vs_drawn_layer layer;
  uint32_t view;            /* of views; the count of them: of the sheet itself */
  uint32_t first, count;    /* LINE: points; FILL: loops */
  bool closed;
  double grey;              /* FILL */
  const char *text;         /* TEXT, interned */
  vs_sheet_point at;        /* where its base line begins, or has its middle or end */
  /* height of a capital, mm; degrees; 0 begins at `at`, 0.5 has its middle there, 1 ends there */
  double size, angle, align;
} vs_mark;

typedef struct {
  double width, height;     /* mm */
  const char *name;         /* "A3" */
  double left, right, bottom, top; /* the frame's */
  vs_mark *marks;
  vs_sheet_point *points;
  struct { uint32_t first, count; } *loops;
  size_t mark_count, mark_room, point_count, point_room, loop_count, loop_room;
  vs_flat_view *views;
  size_t view_count;
} vs_sheet;

/* Lays the views out and puts on all marks. */
bool vs_sheet_make(vs_emitter *e, vs_sheet *s, vs_flat_view *views, size_t count);
void vs_sheet_free(vs_emitter *e, vs_sheet *s);
bool vs_sheet_line(vs_emitter *e, vs_sheet *s, uint32_t view, vs_drawn_layer layer, const vs_sheet_point *at,
    size_t count, bool closed);
bool vs_sheet_text(vs_emitter *e, vs_sheet *s, uint32_t view, vs_drawn_layer layer, vs_sheet_point at, double size,
    double angle, double align, const char *text);
vs_sheet_point vs_sheet_place(const vs_flat_view *v, vs_sheet_point p); /* of the view's plane on the sheet */

#endif
