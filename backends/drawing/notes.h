/* Declares the notes of a drawing: dimensions, labels, levels and axes. */
#ifndef VS_BACKENDS_DRAWING_NOTES_H
#define VS_BACKENDS_DRAWING_NOTES_H

#include "backends/drawing/sheet_marks.h"

/* Adds the program's notes to the pen's view, and the ground line. Returns false if memory is out, with the emitter's
 * error set. */
bool vs_sheet_notes(const vs_sheet_pen *pen);
/* The space that a view's notes need, in millimetres. across: on the left and on the right; up: below and above. */
typedef struct { double across, up; } vs_sheet_room;
vs_sheet_room vs_sheet_notes_room(const vs_emitter *e, const vs_flat_view *v);

#endif
