/* Owns what a text is in space: its letters set side by side, and their outlines as loops.
 *
 * Set means: composed (a letter and the accent after it are one glyph where the font has it), kerned, from left to
 * right; a line break begins a line below, a tab is four spaces. Lengths are in model units from the text's point p
 * on. */
#ifndef VS_GEOMETRY_TEXT_TYPESET_H
#define VS_GEOMETRY_TEXT_TYPESET_H

#include "geometry/text/font.h"
#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"

typedef struct { const vs_glyph *glyph; double x, y; /* of its origin, model units */ } vs_text_glyph;
typedef struct {
  vs_text_glyph *at; /* those with ink alone */
  size_t count, room;
  double scale;      /* from font units */
  double width;      /* of the longest line, to where a next letter would begin */
  uint32_t missing;  /* the first character that the font has no glyph for, or 0 */
} vs_text_plan;

void vs_text_plan_free(vs_text_plan *p);
bool vs_text_lay(vs_store *s, const struct vs_letters *t, vs_text_plan *out, vs_error *e);

/* Loops under `placed` as vs_region_outline has them, but with nothing but loops and hole filled in, and turned as if
 * seen unplaced from above: none crosses another, holes follow their outer loops (GEOS is asked where letters
 * overlap). */
bool vs_text_loops(const vs_node *text, const vs_affine *placed, const vs_fineness *f, vs_outline *out, vs_error *e);
/* Exact bounds of the ink under `placed`, added to b. */
bool vs_text_bounds(const vs_node *text, const vs_affine *placed, vs_bounds *b, vs_error *e);

#endif
