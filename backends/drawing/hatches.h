/* Declares the fills of cut faces. */
#ifndef VS_BACKENDS_DRAWING_HATCHES_H
#define VS_BACKENDS_DRAWING_HATCHES_H

#include "backends/drawing/sheet_marks.h"

/* Adds a cut face of the pen's view: its grey and its hatch lines. Returns false if memory is out, with the emitter's
 * error set. */
bool vs_sheet_fill(const vs_sheet_pen *pen, const vs_flat_fill *fill);

#endif
