/* Declares fonts: finds the file of a font by its name, and reads the outlines of its glyphs in the font's own units.
 * FreeType reads the file; it is loaded for the first font. Outlines are not hinted or scaled, so a letter is the same
 * at every size and on every machine.
 *
 * The store owns the fonts. Each glyph is read only once. */
#ifndef VS_GEOMETRY_TEXT_FONT_H
#define VS_GEOMETRY_TEXT_FONT_H

#include "model/node.h"

typedef struct vs_font vs_font;

/* A step of an outline. It starts at the end of the previous step and ends at `to`. Quadratic curves have the control
 * point b; cubic curves have the control points a and b. */
typedef enum { VS_STEP_MOVE, VS_STEP_LINE, VS_STEP_QUADRATIC, VS_STEP_CUBIC } vs_step_kind;
typedef struct { double x, y; } vs_font_point;
typedef struct { vs_step_kind kind; vs_font_point a, b, to; } vs_glyph_step;

typedef struct {
  double advance;       /* distance to the origin of the next glyph, in font units */
  size_t count, room;
  vs_glyph_step *steps; /* the steps of all contours; each contour begins with VS_STEP_MOVE and is closed. The ink is
                         * where the winding number of the contours is not 0 */
} vs_glyph;

/* Returns a font, which the store owns. The name "" is the default font. A name that contains a / or ends like a font
 * file is a path. Any other name is a family with its style ("DejaVu Sans Bold"). Returns NULL if there is no such
 * font; e then contains the available families. */
vs_font *vs_font_get(vs_store *s, const char *name, vs_error *e);
/* Registers a font with the given contents of a font file. vs_font_get then finds it under this name. */
bool vs_font_add(vs_store *s, const char *name, const void *bytes, size_t size, vs_error *e);
bool vs_font_known(vs_store *s, const char *name); /* returns true if the font was found before; vs_font_get for this
                                                    * font then fails only if memory is out */
bool vs_font_is_path(const char *name);

double vs_font_capital(const vs_font *f);    /* height of a capital H in font units */
double vs_font_line(const vs_font *f);       /* distance of two lines of text in font units */
double vs_font_descent(const vs_font *f);    /* depth below the base line in font units, positive */
/* Returns the index of the glyph for a character. Returns 0 if the font has no glyph for it; glyph 0 is then drawn
 * instead. */
uint32_t vs_font_index(const vs_font *f, uint32_t character);
const vs_glyph *vs_font_glyph(vs_font *f, uint32_t index, vs_error *e); /* returns the glyph with the index, or NULL
                                                                         * with e set on failure */
double vs_font_kerning(const vs_font *f, uint32_t left, uint32_t right); /* returns the correction of the left glyph's
                                                                          * advance before the right glyph, in font
                                                                          * units */

#endif
