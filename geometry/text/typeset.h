/* Declares text in space: the positions of its glyphs, and their outlines as loops.
 *
 * A letter and a following accent become one glyph if the font has such a glyph. Letters are kerned and go from left to
 * right. A line break begins a new line below; a tab is four spaces. Lengths are in model units, relative to the text's
 * point p. */
#ifndef VS_GEOMETRY_TEXT_TYPESET_H
#define VS_GEOMETRY_TEXT_TYPESET_H

#include "geometry/text/font.h"
#include "geometry/plane/outline.h"
#include "geometry/tolerance.h"

typedef struct { const vs_glyph *glyph; double x, y; /* x, y: position of the glyph's origin in model units, relative to
                                                      * the text's point */ } vs_text_glyph;
typedef struct {
  vs_text_glyph *at; /* the glyphs of the text that have ink */
  size_t count, room;
  double scale;      /* factor that converts font units to model units */
  double width;      /* length of the longest line in model units, up to where another letter would follow */
  uint32_t missing;  /* first character of the text for which the font has no glyph, or 0 */
} vs_text_plan;

void vs_text_plan_free(vs_text_plan *p);
bool vs_text_lay(vs_store *s, const struct vs_letters *t, vs_text_plan *out, vs_error *e);

/* Makes the loops that bound the text's ink (printed area), mapped by `placed`; sets only out->loops and out->hole.
 * Loops do not cross. Before the mapping, outer loops are counter-clockwise as seen from above, each followed by its
 * holes. Returns false and sets e on failure. */
bool vs_text_loops(const vs_node *text, const vs_affine *placed, const vs_fineness *f, vs_outline *out, vs_error *e);
/* Enlarges b by the exact bounds of the text's ink, mapped by `placed`. Returns false and sets e on failure. */
bool vs_text_bounds(const vs_node *text, const vs_affine *placed, vs_bounds *b, vs_error *e);

#endif
