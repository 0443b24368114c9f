/* Declares fonts: the file of a name, and the outlines of its glyphs in the font's own units, read by FreeType, which
 * is loaded for the first font. Nothing is hinted or scaled: a letter is the same at every size and on every machine.
 *
 * The store owns the fonts. A glyph is read once. */
#ifndef VS_GEOMETRY_TEXT_FONT_H
#define VS_GEOMETRY_TEXT_FONT_H

#include "model/node.h"

typedef struct vs_font vs_font;

/* A step of an outline, from the end of the step before. Quadratic: b is the control point; cubic: a and b. */
typedef enum { VS_STEP_MOVE, VS_STEP_LINE, VS_STEP_QUADRATIC, VS_STEP_CUBIC } vs_step_kind;
typedef struct { double x, y; } vs_font_point;
typedef struct { vs_step_kind kind; vs_font_point a, b, to; } vs_glyph_step;

typedef struct {
  double advance;       /* to the next glyph's origin */
  size_t count, room;
  vs_glyph_step *steps; /* contours; each begins with a MOVE and closes itself; ink is where their winding number is not
                         * 0 */
} vs_glyph;

/* Returns a font, which the store owns. name: "" is the default font. A name with a / or the ending of a font file
 * is a path. Any other is a family with its style ("DejaVu Sans Bold"). NULL: e has the reason, and the available
 * families. */
vs_font *vs_font_get(vs_store *s, const char *name, vs_error *e);
/* Registers the font in these bytes: vs_font_get then finds it under this name. */
bool vs_font_add(vs_store *s, const char *name, const void *bytes, size_t size, vs_error *e);
bool vs_font_known(vs_store *s, const char *name); /* found before: only lack of memory makes vs_font_get fail */
bool vs_font_is_path(const char *name);

double vs_font_capital(const vs_font *f);    /* height of a capital H */
double vs_font_line(const vs_font *f);       /* distance of lines */
double vs_font_descent(const vs_font *f);    /* depth below the base line, positive */
/* Returns the glyph's index; 0: the font has none, and shows glyph 0 instead. */
uint32_t vs_font_index(const vs_font *f, uint32_t character);
const vs_glyph *vs_font_glyph(vs_font *f, uint32_t index, vs_error *e); /* NULL: failed */
double vs_font_kerning(const vs_font *f, uint32_t left, uint32_t right); /* a number to add to left's advance */

#endif
