/* Owns what a drawing shows besides the model. */
#ifndef VS_BACKENDS_DRAWING_NOTES_H
#define VS_BACKENDS_DRAWING_NOTES_H

#include "backends/drawing/sheet_marks.h"

/* Puts on what the program asked for in the pen's view, and the ground's line. Fails when memory runs out, as the
 * emitter's error says. */
bool vs_sheet_notes(const vs_sheet_pen *pen);
/* How much room a view's notes need on its left and right, and below and above it, in millimetres. */
typedef struct { double across, up; } vs_sheet_room;
vs_sheet_room vs_sheet_notes_room(const vs_emitter *e, const vs_flat_view *v);

#endif
