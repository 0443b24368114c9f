/* Declares the conversion of numbers to text, which all formats use (number_spelling.c). */
#ifndef VS_BACKENDS_NUMBER_SPELLING_H
#define VS_BACKENDS_NUMBER_SPELLING_H

#include "backends/writer.h"

/* Writes the text of x, NUL-terminated, and returns its length. Writes "0" for a number that is not finite. Callers
 * check for such numbers before; the "0" keeps the file readable. */
size_t vs_number_text(double x, char out[VS_NUMBER_ROOM]);
/* Writes the text of x without a NUL, and returns the position after the text. It may overwrite up to VS_NUMBER_ROOM
 * bytes from `to` on, even after the text. */
char *vs_number_write(char *to, double x);

#endif
