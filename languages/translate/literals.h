/* Owns the numbers and strings of a program's text as other languages read them. */
#ifndef VS_LANGUAGES_TRANSLATE_LITERALS_H
#define VS_LANGUAGES_TRANSLATE_LITERALS_H

#include "languages/analysis/analysis.h"

/* "1.5", "-3", "1/3": decimal, without signs and points that stand alone. "": a number of another kind. */
const char *tr_number_text(knowledge *k, const char *text, size_t length);
/* The contents of the string; text is with its quotes and escapes. NULL: it holds NUL, or an escape that is none of
 * Scheme's. */
const char *tr_string_text(knowledge *k, const char *text, size_t length);

#endif
