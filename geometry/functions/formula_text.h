/* Declares tapes as formulas in the languages of other programs. */
#ifndef VS_GEOMETRY_FUNCTIONS_FORMULA_TEXT_H
#define VS_GEOMETRY_FUNCTIONS_FORMULA_TEXT_H

#include "geometry/functions/tape.h"

typedef enum {
  VS_FORMULA_POVRAY,
  VS_FORMULA_OPENSCAD,
  VS_FORMULA_JAVASCRIPT,
  VS_FORMULA_LANGUAGES
} vs_formula_language;

enum { VS_FORMULA_MOST = 100000 }; /* characters: a tape's repeated steps are written each time */

/* Returns output number `output` as text, with these names of the inputs; the caller frees the text. NULL: with
 * *no_word true, the text would exceed VS_FORMULA_MOST characters or contain a field; else memory is out. The tape has
 * this output. */
char *vs_formula_text(const vs_tape *t, uint32_t output, vs_formula_language language, const char *const *names,
                      bool *no_word);

#endif
