/* Owns what the files of the drawing back-end share: a view worked out flat, and the sheet that several of them are
 * laid out on.
 *
 * The way of a drawing: choose_views.c says which views; flat_view.c makes each flat, in model units, by the kernel's
 * mesh and solids/hidden_lines.h; sheet.c finds scale and sheet and puts marks on it, in millimetres from the sheet's
 * lower left corner; notes.c adds dimensions and the like; svg.c, pdf.c and dxf.c write the marks. */
#ifndef VS_BACKENDS_DRAWING_SHEET_H
#define VS_BACKENDS_DRAWING_SHEET_H

#include "backends/drawing/sheet_marks.h"

/* Lays the views out and puts on all marks. */
bool vs_sheet_make(vs_emitter *e, vs_sheet *s, vs_flat_view *views, size_t count);
void vs_sheet_free(vs_emitter *e, vs_sheet *s);

#endif
