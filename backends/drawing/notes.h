/* Declares the notes of a drawing: dimensions, labels, levels and axes. */
#ifndef VS_BACKENDS_DRAWING_NOTES_H
#define VS_BACKENDS_DRAWING_NOTES_H

#include "backends/drawing/sheet_marks.h"

/* Adds the program's notes to the pen's view, and the ground line. Returns false if memory is out, with the emitter's
 * error set. */
bool vs_sheet_notes(const vs_sheet_pen *pen);
/* Sets the room of the sheet's view `index` at the view's present size. Draws the notes on a sheet of their own and
 * measures how far they reach beyond the view's lines. Returns false if memory is out, with the emitter's error set. */
bool vs_sheet_notes_room(vs_emitter *e, const vs_sheet *s, uint32_t index);

#endif
