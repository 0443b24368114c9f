/* Declares the tables of a sheet. They form a column at the sheet's right side, above the title block. */
#ifndef VS_BACKENDS_DRAWING_SHEET_TABLES_H
#define VS_BACKENDS_DRAWING_SHEET_TABLES_H

#include "backends/drawing/sheet_marks.h"

/* Returns the size of all tables together in mm: .x is the width, .y the height; 0 if there are no tables. */
vs_sheet_point vs_sheet_tables_size(const vs_scene *scene);
/* Draws the tables, with their lower right corner at `corner`. Returns false if memory is out, with the emitter's error
 * set. */
bool vs_sheet_tables(const vs_sheet_pen *pen, vs_sheet_point corner);

#endif
