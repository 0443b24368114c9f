/* Contains the declarations that the files of the drawing back-end share: a flat view, and the sheet on which views are
 * placed.
 *
 * Steps of a drawing: choose_views.c chooses the views. flat_view.c makes each view flat, in model units, with the
 * kernel's mesh and solids/hidden_lines.h. sheet.c chooses scale and sheet and puts marks on it, in millimetres from
 * the sheet's lower left corner. notes.c adds dimensions and other notes. svg.c, pdf.c and dxf.c write the marks. */
#ifndef VS_BACKENDS_DRAWING_SHEET_H
#define VS_BACKENDS_DRAWING_SHEET_H

#include "backends/drawing/sheet_marks.h"

/* Places the views and adds all marks. */
bool vs_sheet_make(vs_emitter *e, vs_sheet *s, vs_flat_view *views, size_t count);
/* Writes the view, the scale and the sheet in words; room for 200 bytes is enough. */
void vs_sheet_describe(const vs_sheet *s, char *out, size_t room);
void vs_sheet_free(vs_emitter *e, vs_sheet *s);

#endif
