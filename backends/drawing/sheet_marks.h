/* Declares the marks (lines, fills and texts) of a drawing, the sheet that contains them, and the functions that add
 * them. Positions are in millimetres from the sheet's lower left corner. */
#ifndef VS_BACKENDS_DRAWING_SHEET_MARKS_H
#define VS_BACKENDS_DRAWING_SHEET_MARKS_H

#include "backends/drawing/flat_view.h"

typedef enum { VS_MARK_LINE, VS_MARK_FILL, VS_MARK_TEXT } vs_mark_kind;
typedef struct {
  vs_mark_kind kind;
  vs_drawn_layer layer;
  uint32_t own;             /* number of the program's layer that the mark belongs to; 0: none */
  uint32_t view;            /* index of the mark's view; equal to the number of views for a mark of the sheet itself */
  uint32_t first, count;    /* for a LINE: first index and number of its points; for a FILL: first index and number of
                             * its loops */
  bool closed;
  double grey;              /* for a FILL: its grey, from 0 (black) to 1 (white) */
  const char *text;         /* for a TEXT: the text, interned */
  vs_sheet_point at;        /* of a TEXT: the point on its base line where it begins, has its middle or ends, as `align`
                             * says */
  /* Size: height of a capital in mm. Angle: in degrees. Align: `at` is the text's beginning (0), middle (0.5) or end
   * (1). */
  double size, angle, align;
} vs_mark;

typedef struct {
  double width, height;     /* size of the paper in mm */
  const char *name;         /* name of the paper, such as "A3" */
  bool bare;                /* whether there is no sheet of paper: the page is as large as the views and their notes */
  double left, right, bottom, top; /* edges of the frame in mm */
  vs_mark *marks;
  vs_sheet_point *points;
  struct { uint32_t first, count; } *loops;
  size_t mark_count, mark_room, point_count, point_room, loop_count, loop_room;
  vs_flat_view *views;
  size_t view_count;
  const char *const *layers; /* layers of the program; layer number n is layers[n - 1] */
  size_t layer_count;
} vs_sheet;

/* Data for the functions that add marks: the sheet, and the view to which new marks belong. */
typedef struct {
  vs_emitter *e;
  vs_sheet *sheet;
  uint32_t view;            /* index of the view; equal to the number of views for marks of the sheet itself */
} vs_sheet_pen;

/* A line of text: position, size in mm, angle and alignment as in vs_mark. */
typedef struct {
  const char *text;
  vs_sheet_point at;
  double size, angle, align;
} vs_sheet_words;

/* vs_sheet_line, vs_sheet_stroke, vs_sheet_rectangle and vs_sheet_text add a mark, with points in mm. They return false
 * if memory is out, with the emitter's error set. */
bool vs_sheet_line(const vs_sheet_pen *pen, vs_drawn_layer layer, const vs_sheet_point *at, size_t count, bool closed);
bool vs_sheet_stroke(const vs_sheet_pen *pen, vs_drawn_layer layer, vs_sheet_point a, vs_sheet_point b);
bool vs_sheet_rectangle(const vs_sheet_pen *pen, vs_drawn_layer layer, vs_sheet_point a, vs_sheet_point b);
bool vs_sheet_text(const vs_sheet_pen *pen, const vs_sheet_words *words);
vs_sheet_point vs_sheet_place(const vs_flat_view *v, vs_sheet_point p); /* returns the position on the sheet, in mm, of
                                                                         * the point p of the view's plane */

#endif
