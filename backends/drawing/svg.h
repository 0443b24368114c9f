/* Declares the writing of a sheet as .svg. */
#ifndef VS_BACKENDS_DRAWING_SVG_H
#define VS_BACKENDS_DRAWING_SVG_H

#include "backends/drawing/sheet_marks.h"

bool vs_sheet_write_svg(vs_emitter *e, const vs_sheet *s);

#endif
