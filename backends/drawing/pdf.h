/* Declares the writing of a sheet as .pdf. */
#ifndef VS_BACKENDS_DRAWING_PDF_H
#define VS_BACKENDS_DRAWING_PDF_H

#include "backends/drawing/sheet_marks.h"

bool vs_sheet_write_pdf(vs_emitter *e, const vs_sheet *s);

#endif
