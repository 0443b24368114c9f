/* Owns the fills of cut faces. */
#ifndef VS_BACKENDS_DRAWING_HATCHES_H
#define VS_BACKENDS_DRAWING_HATCHES_H

#include "backends/drawing/sheet_marks.h"

/* Adds the fill of a cut face of the pen's view, and the lines over it. Fails when memory is out, with the emitter's
 * error set. */
bool vs_sheet_fill(const vs_sheet_pen *pen, const vs_flat_fill *fill);

#endif
