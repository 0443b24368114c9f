/* Owns fonts: which file a name means, and the outlines of its glyphs in the font's own units, read by FreeType, which
 * is loaded when the first font is asked for. Nothing is hinted or scaled, so that a letter is the same at every size
 * and on every machine.
 *
 * Fonts live in the store and go with it. A glyph is read once. */
#ifndef VS_GEOMETRY_TEXT_FONT_H
#define VS_GEOMETRY_TEXT_FONT_H

#include "model/node.h"

typedef struct vs_font vs_font;

/* A step of an outline: from where the last one ended. Quadratic: b is the control point; cubic: a and b. */
typedef enum { VS_STEP_MOVE, VS_STEP_LINE, VS_STEP_QUADRATIC, VS_STEP_CUBIC } vs_step_kind;
typedef struct { double x, y; } vs_font_point;
typedef struct { vs_step_kind kind; vs_font_point a, b, to; } vs_glyph_step;

typedef struct {
  double advance;       /* to the next glyph's origin */
  size_t count, room;
  vs_glyph_step *steps; /* contours, each begins with a MOVE and closes itself; what they wind round (not zero times) is
                         * ink */
} vs_glyph;

/* name: "" is the default font; what holds a / or ends as a font file is a path; all else is a family, with its style
 * ("DejaVu Sans Bold"). NULL: e says what was wrong, and which families there are. */
vs_font *vs_font_get(vs_store *s, const char *name, vs_error *e);
/* The font in these bytes is from now on what vs_font_get finds under this name. */
bool vs_font_add(vs_store *s, const char *name, const void *bytes, size_t size, vs_error *e);
bool vs_font_known(vs_store *s, const char *name); /* found before: getting it cannot fail but for memory */
bool vs_font_is_path(const char *name);

double vs_font_capital(const vs_font *f);    /* height of a capital H */
double vs_font_line(const vs_font *f);       /* from line to line */
double vs_font_descent(const vs_font *f);    /* what hangs below the base line, positive */
/* of its glyph; 0: the font has none, and glyph 0 is what it shows instead */
uint32_t vs_font_index(const vs_font *f, uint32_t character);
const vs_glyph *vs_font_glyph(vs_font *f, uint32_t index, vs_error *e); /* NULL: failed */
double vs_font_kerning(const vs_font *f, uint32_t left, uint32_t right); /* to be added to left's advance */

#endif
