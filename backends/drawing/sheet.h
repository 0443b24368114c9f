/* Owns what the files of the drawing back-end share: a view worked out flat, and the sheet that several of them are
 * laid out on.
 *
 * The way of a drawing: choose_views.c says which views; flat_view.c makes each flat, in model units, by the kernel's
 * mesh and solids/hidden_lines.h; sheet.c finds scale
 * and sheet and puts marks on it, in millimetres from the sheet's lower left corner; notes.c adds dimensions and the
 * like; svg.c, pdf.c and dxf.c write the marks. */
#ifndef VS_BACKENDS_SHEET_H
#define VS_BACKENDS_SHEET_H

#include "backends/backend.h"
#include "backends/mesh/loose.h"
#include "backends/view.h"
#include "solids/hidden_lines.h"

typedef struct { double x, y; } vs_sheet_point;

typedef enum {
#define LAYER(upper, name, width, dash, gap, dot, grey, colour, weight) VS_DRAWN_##upper,
#include "backends/drawing/layers.def"
  VS_DRAWN_LAYERS
} vs_drawn_layer;
typedef struct { const char *name; double width, dash, gap, dot, grey; int colour, weight; } vs_layer_row;
extern const vs_layer_row vs_drawn_rows[VS_DRAWN_LAYERS];

/* ---- a view made flat: in model units, in the view's own plane ---- */

typedef struct { uint32_t first, count; bool closed; vs_drawn_layer layer; } vs_flat_line;     /* of points */
typedef struct { uint32_t first_loop, loop_count; const vs_material *material; } vs_flat_fill;
    /* by the even-odd rule */

typedef struct {
  vs_scene_view spec;     /* its name is what the sheet calls it */
  vs_look look;
  bool has_cut;           /* spec's cut, or the one found for it */
  vs_sheet_point *points;
  vs_flat_line *lines;
  vs_flat_fill *fills;
  struct { uint32_t first, count; } *loops;
  size_t point_count, point_room, line_count, line_room, fill_count, fill_room, loop_count, loop_room;
  vs_sheet_point low, high; /* of all of it */
  double cut_area;        /* of the fills */
  /* where sheet.c puts it: millimetres = (place - low) * mm + at */
  double mm, scale;
  vs_sheet_point at;
} vs_flat_view;

bool vs_flat_view_make(vs_emitter *e, vs_flat_view *v, const vs_loose *loose, const vs_solid *whole);
void vs_flat_view_free(vs_emitter *e, vs_flat_view *v);
/* Where a place of the model is seen, in the view's plane. Of a parallel view: a place behind a perspective view's
 * eye has none. */
vs_sheet_point vs_flat_view_project(const vs_flat_view *v, vs_vec3 p);

/* ---- which views ---- */

/* The views that are to be drawn, the caller's to free by vs_emit_release. False: failed, and the error says why. */
bool vs_drawing_choose(vs_emitter *e, vs_flat_view **out, size_t *count, size_t *room);
/* Width of a model unit in millimetres. */
double vs_drawing_unit(const vs_scene *scene);

/* ---- the sheet ---- */

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

/* hatches.c: fills of cut materials, and the lines over them. */
bool vs_sheet_fill(vs_emitter *e, vs_sheet *s, uint32_t view, const vs_flat_fill *fill);
/* notes.c: what the program asked for, and the ground's line. */
bool vs_sheet_notes(vs_emitter *e, vs_sheet *s, uint32_t view);
/* How much room a view's notes need beside it, in millimetres. */
double vs_sheet_notes_room(const vs_emitter *e, const vs_flat_view *v);

/* ---- the formats ---- */
bool vs_sheet_write_svg(vs_emitter *e, const vs_sheet *s);
bool vs_sheet_write_pdf(vs_emitter *e, const vs_sheet *s);
bool vs_sheet_write_dxf(vs_emitter *e, const vs_sheet *s);

#endif
