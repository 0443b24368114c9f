/* Declares the layout of a program in Scheme in one style. */
#ifndef VS_LANGUAGES_FORMAT_FORMAT_PROGRAM_H
#define VS_LANGUAGES_FORMAT_FORMAT_PROGRAM_H

#include <stddef.h>

enum { FORMAT_WIDTH = 100 /* FORMAT_WIDTH: greatest column of code on a line, unless the line cannot be broken */ };

/* Returns the text, laid out in one style, which the caller frees, and sets *formatted to its length. The text must be
 * one that the language's reader accepts. Returns NULL when memory is out. Returns an unchanged copy if the layout
 * would change the tokens. */
char *format_program(const char *text, size_t length, size_t *formatted);

#endif
