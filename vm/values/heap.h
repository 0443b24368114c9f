/* Declares the creation of basic objects and the table of symbols, implemented in heap.c. */
#ifndef VS_VM_VALUES_HEAP_H
#define VS_VM_VALUES_HEAP_H

#include "vm/values/value.h"

bool vs_cons_at(vs_scheme *vm, vs_value car, vs_value cdr, vs_pos pos, vs_value *out);       /* Creates a pair with a
                                                                                              * place in the source. */
bool vs_make_bytes(vs_scheme *vm, size_t n, vs_value *out);                                  /* Creates a bytevector of
                                                                                              * n zero bytes. */
/* Creates a string of `length` characters, each the code point `fill`. */
bool vs_make_string(vs_scheme *vm, size_t length, uint32_t fill, vs_value *out);             /* each character has four
                                                                                              * bytes if fill > 255,
                                                                                              * otherwise one */
/* Creates a string from UTF-8; invalid bytes become U+FFFD. */
bool vs_string_from_utf8(vs_scheme *vm, const char *s, size_t bytes, vs_value *out);
bool vs_make_box(vs_scheme *vm, vs_value v, vs_value *out);
bool vs_make_cell(vs_scheme *vm, vs_value name, vs_value v, vs_value *out);
/* Creates a flat record of n doubles. tag is below VS_FLAT_TAGS, n at most VS_FLAT_FIELDS. */
bool vs_make_flat(vs_scheme *vm, uint32_t tag, const double *at, size_t n, vs_value *out);
bool vs_make_keywords(vs_scheme *vm, const vs_value *names, size_t n, vs_value *out);
bool vs_intern_c(vs_scheme *vm, const char *name, vs_value *out);

#endif
