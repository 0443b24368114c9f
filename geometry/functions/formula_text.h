/* Owns tapes as formulas in the languages of other programs. */
#ifndef VS_GEOMETRY_FUNCTIONS_FORMULA_TEXT_H
#define VS_GEOMETRY_FUNCTIONS_FORMULA_TEXT_H

#include "geometry/functions/tape.h"

typedef enum {
  VS_FORMULA_POVRAY,
  VS_FORMULA_OPENSCAD,
  VS_FORMULA_JAVASCRIPT,
  VS_FORMULA_LANGUAGES
} vs_formula_language;

enum { VS_FORMULA_MOST = 100000 }; /* characters: a tape's repeated steps are written out each time */

/* Output number `output` as text, the inputs by these names. Returns text that the caller frees, or NULL with *no_word
 * saying whether it would have more than VS_FORMULA_MOST characters or holds a field, or memory is out. The tape has
 * that output. */
char *vs_formula_text(const vs_tape *t, uint32_t output, vs_formula_language language, const char *const *names,
                      bool *no_word);

#endif
