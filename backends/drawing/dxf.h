/* Declares the writing of a sheet as .dxf. */
#ifndef VS_BACKENDS_DRAWING_DXF_H
#define VS_BACKENDS_DRAWING_DXF_H

#include "backends/drawing/sheet_marks.h"

bool vs_sheet_write_dxf(vs_emitter *e, const vs_sheet *s);

#endif
