/* Declares the text of a material, written by print_looks.c. */
#ifndef VS_BIND_PRINT_LOOKS_H
#define VS_BIND_PRINT_LOOKS_H

#include "model/looks/material.h"

/* Receives n bytes of a text. Returns false to stop. */
typedef bool vs_put_text(void *to, const char *s, size_t n);

/* Writes an expression that makes the material again: its name if it is predefined, else make-material with the
 * keywords whose values are not the defaults. Returns false if put does. */
bool vs_bind_print_material(const vs_material *m, vs_put_text *put, void *to);
/* Writes the beginning of the call that gives a material to objects: with-material or color, and the material. Returns
 * false if put does. */
bool vs_bind_print_painting(const vs_material *m, vs_put_text *put, void *to);
/* Writes a string in quotation marks. Returns false if put does. */
bool vs_bind_print_quoted(const char *s, vs_put_text *put, void *to);

#endif
