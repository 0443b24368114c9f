/* Owns the numbers and strings of a program's text in the form of other languages. */
#ifndef VS_LANGUAGES_TRANSLATE_LITERALS_H
#define VS_LANGUAGES_TRANSLATE_LITERALS_H

#include "languages/analysis/analysis.h"

/* Returns the decimal form of "1.5", "-3", "1/3", without a lone sign or point. "": a number of another kind. */
const char *tr_number_text(knowledge *k, const char *text, size_t length);
/* Returns the contents of the string; text includes its quotes and escapes. NULL: it contains NUL, or an escape that
 * Scheme lacks. */
const char *tr_string_text(knowledge *k, const char *text, size_t length);

#endif
