/* Declares the conversion of the numbers and strings of a program's text to the form of other languages. */
#ifndef VS_LANGUAGES_TRANSLATE_LITERALS_H
#define VS_LANGUAGES_TRANSLATE_LITERALS_H

#include "languages/analysis/analysis.h"

/* Returns the decimal form of a number such as "1.5", "-3" or "1/3", or "" for a number of another kind. The form has
 * no plus sign, and no point without digits on both sides. */
const char *tr_number_text(knowledge *k, const char *text, size_t length);
/* Returns the contents of the string, whose text includes quotes and escapes. Returns NULL if it contains NUL, or an
 * escape that Scheme does not have. */
const char *tr_string_text(knowledge *k, const char *text, size_t length);

#endif
