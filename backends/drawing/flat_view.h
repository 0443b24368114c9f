/* Declares a flat view of a model in model units: cut and projected, with its lines joined. */
#ifndef VS_BACKENDS_DRAWING_FLAT_VIEW_H
#define VS_BACKENDS_DRAWING_FLAT_VIEW_H

#include "backends/backend.h"
#include "backends/mesh/loose.h"
#include "backends/view.h"

typedef struct { double x, y; } vs_sheet_point;

typedef enum {
#define LAYER(upper, name, width, dash, gap, dot, grey, colour, weight) VS_DRAWN_##upper,
#include "backends/drawing/layers.def"
  VS_DRAWN_LAYERS
} vs_drawn_layer;
typedef struct { const char *name; double width, dash, gap, dot, grey; int colour, weight; } vs_layer_row;
extern const vs_layer_row vs_drawn_rows[VS_DRAWN_LAYERS];
extern const double vs_fault_color[3]; /* of the fill of an object that breaks a rule, for .svg and .pdf */

/* Space that notes need around a view, in millimetres on paper. */
typedef struct { double left, right, below, above; } vs_sheet_room;

/* ---- a flat view: in model units, in the coordinates of the view's plane ---- */

typedef struct {
  uint32_t first, count; /* first: index of the line's first point. count: number of its points */
  bool closed;
  vs_drawn_layer layer;
  uint32_t own; /* number of the program's layer that the line belongs to; 0: none */
} vs_flat_line;
/* The content of a fill: a cut face of a material, the earth, or an object that breaks a rule. */
typedef enum { VS_FILL_CUT, VS_FILL_EARTH, VS_FILL_FAULT } vs_fill_kind;
/* Loops that bound a fill; the even-odd rule decides which points are inside. material: that of a cut face, or NULL. */
typedef struct { uint32_t first_loop, loop_count; const vs_material *material; vs_fill_kind kind; } vs_flat_fill;

typedef struct {
  vs_scene_view spec;     /* specification of the view by the program; spec.name is its name on the sheet */
  vs_look look;
  bool has_cut;           /* true if the view has a cut: the cut of spec, or a cut that the drawing chooses */
  vs_sheet_point *points;
  vs_flat_line *lines;
  vs_flat_fill *fills;
  struct { uint32_t first, count; } *loops;
  size_t point_count, point_room, line_count, line_room, fill_count, fill_room, loop_count, loop_room;
  vs_sheet_point low, high; /* low, high: corners of the view's bounding box, in model units */
  double cut_area;        /* total area of the fills, in square model units */
  bool *labelled;         /* labelled[i]: whether the scene's note i is a label whose position is visible in the view;
                           * NULL: there are no such labels */
  /* Position on the sheet, set by sheet.c: a point of the view has the position at + (point - low) * mm, in
   * millimetres. The factor mm is the number of millimetres on paper for a model unit; scale is n for the scale 1:n. */
  double mm, scale;
  vs_sheet_point at;
  double title;           /* height of the title's base line on the sheet, in mm */
  vs_sheet_room room;     /* space that the notes around the view need, measured when mm had the value room_mm */
  double room_mm;         /* value of `mm` for which `room` was measured; 0: it was not measured */
} vs_flat_view;

/* Data that all views of a drawing use: the uncut solids, which are computed for the first view without a cut, and the
 * layers of the program. The caller frees both. */
typedef struct {
  vs_solid solid;
  bool made;
  const char **layers; /* the program's layers, interned; layer number n is layers[n - 1] */
  size_t layer_count, layer_room;
} vs_flat_whole;
bool vs_flat_view_make(vs_emitter *e, vs_flat_view *v, const vs_loose *loose, vs_flat_whole *whole);
void vs_flat_view_free(vs_emitter *e, vs_flat_view *v);
/* Returns the projection of the point p of the model onto the view's plane. The projection must be parallel, because a
 * point behind the eye of a perspective view has no image. */
vs_sheet_point vs_flat_view_project(const vs_flat_view *v, vs_vec3 p);

#endif
