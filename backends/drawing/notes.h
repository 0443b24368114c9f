/* Declares the notes of a drawing: dimensions, labels, levels and axes. */
#ifndef VS_BACKENDS_DRAWING_NOTES_H
#define VS_BACKENDS_DRAWING_NOTES_H

#include "backends/drawing/sheet_marks.h"

/* Adds the program's notes to the pen's view, and the ground line. Returns false if memory is out, with the emitter's
 * error set. */
bool vs_sheet_notes(const vs_sheet_pen *pen);
/* Returns the approximate width of a text. `size` is the height of its capitals; the width is in the same unit. */
double vs_sheet_text_width(const char *text, double size);
/* Computes the room that the notes around view number `index` need at the view's present size. Draws the notes on a
 * temporary sheet and measures how far they extend beyond the view's lines. Returns false if memory is out, with the
 * emitter's error set. */
bool vs_sheet_notes_room(vs_emitter *e, const vs_sheet *s, uint32_t index);

#endif
