/* Owns the interface of number_spelling.c: the one spelling of numbers. */
#ifndef VS_BACKENDS_NUMBER_SPELLING_H
#define VS_BACKENDS_NUMBER_SPELLING_H

#include "backends/writer.h"

/* The number's text, NUL-terminated; its length. Not finite: "0" (callers check first; a format must not be broken by
 * it). */
size_t vs_number_text(double x, char out[VS_NUMBER_ROOM]);
/* The same without a NUL; the place behind it. Writes within VS_NUMBER_ROOM bytes, some behind the text. */
char *vs_number_write(char *to, double x);

#endif
