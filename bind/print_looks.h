/* Declares the text of a material, written by print_looks.c. Also contains the functions by which print_looks.c and
 * print.c pass parts of a text to its receiver. */
#ifndef VS_BIND_PRINT_LOOKS_H
#define VS_BIND_PRINT_LOOKS_H

#include <string.h>

#include "bind/print.h"
#include "model/looks/material.h"

/* Writes an expression that creates the material: its name if it is predefined, otherwise make-material with the
 * keywords whose values are not the defaults. Returns false if put returns false. */
bool vs_bind_print_material(const vs_material *m, vs_put_text *put, void *to);
/* Writes the beginning of a call that gives a material to objects: (with-material or (color, and the material. Returns
 * false if put returns false. */
bool vs_bind_print_painting(const vs_material *m, vs_put_text *put, void *to);

typedef struct { vs_put_text *put; void *to; } sink; /* the receiver of a text: a callback `put` and its argument
                                                      * `to` */

/* text and the next functions pass a text, a number, or a string in quotation marks to the callback, and return its
 * result. */
static inline bool text(const sink *k, const char *s) { return k->put(k->to, s, strlen(s)); }
static inline bool number(const sink *k, double d) {
  char t[32];
  vs_bind_number_text(t, d);
  return text(k, t);
}
static inline bool quoted(const sink *k, const char *s) {
  if (!text(k, "\"")) return false;
  for (; *s; s++)
    if (((*s == '"' || *s == '\\') && !text(k, "\\")) || !k->put(k->to, s, 1)) return false;
  return text(k, "\"");
}

#endif
