/* Declares the layout of a program in Scheme in one style. */
#ifndef VS_LANGUAGES_FORMAT_FORMAT_PROGRAM_H
#define VS_LANGUAGES_FORMAT_FORMAT_PROGRAM_H

#include <stddef.h>

enum { FORMAT_WIDTH = 100 /* the code of a line ends at this column, if a line end can be put before it */ };

/* Returns the text in the one style, which the caller frees, and sets *formatted to its length. The language's reader
 * must accept the text. Fails, with NULL, when memory is out. A text that cannot be laid out without a change of
 * its tokens is returned as it is. */
char *format_program(const char *text, size_t length, size_t *formatted);

#endif
