/* Owns what a drawing shows besides the model. */
#ifndef VS_BACKENDS_DRAWING_NOTES_H
#define VS_BACKENDS_DRAWING_NOTES_H

#include "backends/drawing/sheet_marks.h"

/* Puts on what the program asked for in the view, and the ground's line. */
bool vs_sheet_notes(vs_emitter *e, vs_sheet *s, uint32_t view);
/* How much room a view's notes need on its left and right, and below and above it, in millimetres. */
typedef struct { double across, up; } vs_sheet_room;
vs_sheet_room vs_sheet_notes_room(const vs_emitter *e, const vs_flat_view *v);

#endif
