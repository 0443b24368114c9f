/* Owns the fills of cut faces. */
#ifndef VS_BACKENDS_DRAWING_HATCHES_H
#define VS_BACKENDS_DRAWING_HATCHES_H

#include "backends/drawing/sheet_marks.h"

/* Puts on the fill of a cut face, and the lines over it. */
bool vs_sheet_fill(vs_emitter *e, vs_sheet *s, uint32_t view, const vs_flat_fill *fill);

#endif
