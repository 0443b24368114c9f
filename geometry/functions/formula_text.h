/* Declares the conversion of tapes to formulas in the languages of other programs. */
#ifndef VS_GEOMETRY_FUNCTIONS_FORMULA_TEXT_H
#define VS_GEOMETRY_FUNCTIONS_FORMULA_TEXT_H

#include "geometry/functions/tape.h"

typedef enum {
  VS_FORMULA_POVRAY,
  VS_FORMULA_OPENSCAD,
  VS_FORMULA_JAVASCRIPT,
  VS_FORMULA_LANGUAGES
} vs_formula_language;

enum { VS_FORMULA_MOST = 100000 }; /* greatest number of characters of a formula; a formula repeats a step that is used
                                    * several times, so it may become very long */

/* Returns one output of the tape (list of operations) as text, which the caller frees. On failure returns NULL;
 * *no_word is true if the text would be too long or contain a field, and false if memory is out. */
char *vs_formula_text(const vs_tape *t, uint32_t output, vs_formula_language language, const char *const *names,
                      bool *no_word);

#endif
