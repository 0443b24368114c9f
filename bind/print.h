/* Declares the text of an object, written by print.c. */
#ifndef VS_BIND_PRINT_H
#define VS_BIND_PRINT_H

#include "model/node.h"

/* Function that receives n bytes of a text. Returns false to stop the writing. */
typedef bool vs_put_text(void *to, const char *s, size_t n);

/* Writes the expression that creates the node. Returns false if put returns false, or if memory is out. */
bool vs_bind_print_node(const vs_node *n, vs_put_text *put, void *to);
void vs_bind_number_text(char out[32], double d); /* Writes the shortest text that reads back as d; an integral value
                                                   * has no decimal point. */

#endif
