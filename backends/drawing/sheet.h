/* Contains the declarations that the files of the drawing back-end share: a flat view, and the sheet on which views are
 * placed.
 *
 * A drawing is made in four steps. The file choose_views.c chooses the views. Then flat_view.c makes each view flat, in
 * model units, from the kernel's mesh without hidden lines (solids/hidden_lines.h). Next, sheet.c chooses scale and
 * sheet and places the views, and notes.c adds dimensions and other notes, in millimetres from the sheet's lower left
 * corner. Finally, svg.c, pdf.c or dxf.c writes the resulting lines, fills and texts. */
#ifndef VS_BACKENDS_DRAWING_SHEET_H
#define VS_BACKENDS_DRAWING_SHEET_H

#include "backends/drawing/sheet_marks.h"

/* Places the views on the sheet and adds all lines, fills and texts. */
bool vs_sheet_make(vs_emitter *e, vs_sheet *s, vs_flat_view *views, size_t count);
/* Writes the views, the scale and the sheet as text; 200 bytes of room suffice. */
void vs_sheet_describe(const vs_sheet *s, char *out, size_t room);
void vs_sheet_free(vs_emitter *e, vs_sheet *s);

#endif
