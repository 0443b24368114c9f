/* Owns the interface of number_spelling.c: the one spelling of numbers. */
#ifndef VS_BACKENDS_NUMBER_SPELLING_H
#define VS_BACKENDS_NUMBER_SPELLING_H

#include "backends/writer.h"

/* Writes the number's text, NUL-terminated, and returns its length. Writes "0" for a number that is not finite: callers
 * check first, but a bad number must not break the file. */
size_t vs_number_text(double x, char out[VS_NUMBER_ROOM]);
/* The same without a NUL; returns the position after the text. It writes within VS_NUMBER_ROOM bytes, some of them
 * after the text. */
char *vs_number_write(char *to, double x);

#endif
