/* Declares the conversion of the numbers and strings of a program's text to the form of other languages. */
#ifndef VS_LANGUAGES_TRANSLATE_LITERALS_H
#define VS_LANGUAGES_TRANSLATE_LITERALS_H

#include "languages/analysis/analysis.h"

/* Returns a number such as "1.5", "-3" or "1/3" in decimal form, or "" if it has none. The form has no plus sign, and
 * no point without digits on both sides. */
const char *tr_number_text(knowledge *k, const char *text, size_t length);
/* Returns the contents of the string, whose text includes its quotes and escapes. Returns NULL if the contents have a
 * NUL, or the text has an escape that Scheme does not have. */
const char *tr_string_text(knowledge *k, const char *text, size_t length);

#endif
