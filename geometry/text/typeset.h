/* Declares text in space: its letters side by side, and their outlines as loops.
 *
 * Typesetting composes (a letter and the accent after it are one glyph if the font has it), kerns, and goes from left
 * to right. A line break begins a line below; a tab is four spaces. Lengths are in model units relative to the text's
 * point p. */
#ifndef VS_GEOMETRY_TEXT_TYPESET_H
#define VS_GEOMETRY_TEXT_TYPESET_H

#include "geometry/text/font.h"
#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"

typedef struct { const vs_glyph *glyph; double x, y; /* position of its origin, model units */ } vs_text_glyph;
typedef struct {
  vs_text_glyph *at; /* only glyphs with ink */
  size_t count, room;
  double scale;      /* from font units */
  double width;      /* of the longest line, to the position of a next letter */
  uint32_t missing;  /* the first character without a glyph in the font, or 0 */
} vs_text_plan;

void vs_text_plan_free(vs_text_plan *p);
bool vs_text_lay(vs_store *s, const struct vs_letters *t, vs_text_plan *out, vs_error *e);

/* Makes loops under `placed` as vs_region_outline does; it sets only loops and hole, oriented as seen from above
 * without `placed`: none crosses another, holes follow their outer loops (GEOS is called if letters overlap). */
bool vs_text_loops(const vs_node *text, const vs_affine *placed, const vs_fineness *f, vs_outline *out, vs_error *e);
/* Adds the exact bounds of the ink under `placed` to b. */
bool vs_text_bounds(const vs_node *text, const vs_affine *placed, vs_bounds *b, vs_error *e);

#endif
