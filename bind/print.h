/* Declares the text of an object, written by print.c. */
#ifndef VS_BIND_PRINT_H
#define VS_BIND_PRINT_H

#include "model/node.h"

bool vs_bind_print_node(const vs_node *n, bool (*put)(void *to, const char *s, size_t n), void *to);
void vs_bind_number_text(char out[32], double d); /* Writes the shortest text that reads back as d; an integral value
                                                   * has no decimal point. */

#endif
