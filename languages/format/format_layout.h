/* Declares the layout of tokens: which of them begin a line, and at which column each is. */
#ifndef VS_LANGUAGES_FORMAT_FORMAT_LAYOUT_H
#define VS_LANGUAGES_FORMAT_FORMAT_LAYOUT_H

#include "languages/format/format_tokens.h"

/* Sets the members line, column, end and breaks of all tokens. Lines longer than FORMAT_WIDTH are broken where that
 * makes them shorter. */
void format_layout(format_tokens *t);

#endif
