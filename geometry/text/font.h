/* Declares fonts: finds the file of a font by its name, and reads the outlines of its glyphs in the font's units. The
 * library FreeType, loaded for the first font, reads the file. Outlines are not hinted or scaled, so a letter is the
 * same at every size and on every machine.
 *
 * The store owns the fonts. Each glyph is read only once. */
#ifndef VS_GEOMETRY_TEXT_FONT_H
#define VS_GEOMETRY_TEXT_FONT_H

#include "model/node.h"

typedef struct vs_font vs_font;

/* A step of a glyph's outline. It starts at the end of the step before it and ends at `to`. Quadratic curves have the
 * control point b; cubic curves have the control points a and b. */
typedef enum { VS_STEP_MOVE, VS_STEP_LINE, VS_STEP_QUADRATIC, VS_STEP_CUBIC } vs_step_kind;
typedef struct { double x, y; } vs_font_point;
typedef struct { vs_step_kind kind; vs_font_point a, b, to; } vs_glyph_step;

typedef struct {
  double advance;       /* distance from this glyph's origin to that of the next glyph, in font units */
  size_t count, room;
  vs_glyph_step *steps; /* Steps of all contours of the glyph; each contour begins with VS_STEP_MOVE and is closed. The
                         * ink is where the winding number of the contours is not 0. */
} vs_glyph;

/* Returns a font, which the store owns. name: "" for the default font; a path if it contains a / or ends like a font
 * file; otherwise a family with its style ("DejaVu Sans Bold"). Returns NULL if there is no such font; e then lists the
 * available families. */
vs_font *vs_font_get(vs_store *s, const char *name, vs_error *e);
/* Registers a font under a name, by which vs_font_get then finds it. bytes, size: contents of a font file. Returns
 * false and sets e on failure. */
bool vs_font_add(vs_store *s, const char *name, const void *bytes, size_t size, vs_error *e);
bool vs_font_known(vs_store *s, const char *name); /* returns true if vs_font_get has found this font before; another
                                                    * call for it then fails only if memory is out */
bool vs_font_is_path(const char *name);

double vs_font_capital(const vs_font *f);    /* returns the height of a capital H in font units */
double vs_font_line(const vs_font *f);       /* returns the distance between the base lines of two lines of text, in
                                              * font units */
double vs_font_descent(const vs_font *f);    /* returns the depth of the font below the base line in font units, a
                                              * positive number */
/* Returns the index of the font's glyph for a character; 0 if the font has no such glyph. Glyph 0, a box in most fonts,
 * is then drawn. */
uint32_t vs_font_index(const vs_font *f, uint32_t character);
const vs_glyph *vs_font_glyph(vs_font *f, uint32_t index, vs_error *e); /* returns the glyph of font f with this index,
                                                                         * or NULL with e set on failure */
double vs_font_kerning(const vs_font *f, uint32_t left, uint32_t right); /* returns the kerning of two glyphs in font
                                                                          * units: the correction of the distance
                                                                          * between `left` and the next glyph,
                                                                          * `right` */

#endif
