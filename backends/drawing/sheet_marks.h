/* Owns the marks of a drawing: the sheet that holds them, and the functions that add lines and texts to it, in
 * millimetres from its lower left corner. */
#ifndef VS_BACKENDS_DRAWING_SHEET_MARKS_H
#define VS_BACKENDS_DRAWING_SHEET_MARKS_H

#include "backends/drawing/flat_view.h"

typedef enum { VS_MARK_LINE, VS_MARK_FILL, VS_MARK_TEXT } vs_mark_kind;
typedef struct {
  vs_mark_kind kind;
  vs_drawn_layer layer;
  uint32_t view;            /* the index of its view; the number of views: the sheet itself */
  uint32_t first, count;    /* LINE: points; FILL: loops */
  bool closed;
  double grey;              /* FILL */
  const char *text;         /* TEXT, interned */
  vs_sheet_point at;        /* a point of the text's base line: begin, middle or end */
  /* height of a capital, mm; degrees; 0: `at` is the begin, 0.5: the middle, 1: the end */
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

/* Adds marks of one view to a sheet. */
typedef struct {
  vs_emitter *e;
  vs_sheet *sheet;
  uint32_t view;            /* the index of the view; the number of views: marks of the sheet itself */
} vs_sheet_pen;

/* A line of text; the members are those of a mark. */
typedef struct {
  const char *text;
  vs_sheet_point at;
  double size, angle, align;
} vs_sheet_words;

/* Each adds one mark. Fails when memory is out, with the emitter's error set. Points are in mm; a stroke's ends are a
 * and b, and a rectangle's opposite corners. */
bool vs_sheet_line(const vs_sheet_pen *pen, vs_drawn_layer layer, const vs_sheet_point *at, size_t count, bool closed);
bool vs_sheet_stroke(const vs_sheet_pen *pen, vs_drawn_layer layer, vs_sheet_point a, vs_sheet_point b);
bool vs_sheet_rectangle(const vs_sheet_pen *pen, vs_drawn_layer layer, vs_sheet_point a, vs_sheet_point b);
bool vs_sheet_text(const vs_sheet_pen *pen, const vs_sheet_words *words);
vs_sheet_point vs_sheet_place(const vs_flat_view *v, vs_sheet_point p); /* the sheet's position of a point of the view's
                                                                         * plane */

#endif
