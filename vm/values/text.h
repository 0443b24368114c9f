/* Owns vs_text: a growing UTF-8 buffer in accounted memory, what the printer, number text and string ports write into.

     vs_text t; vs_text_open(vm, &t, 0);
     bool ok = vs_text_puts(&t, "x = ") && vs_print(vm, v, VS_PRINT_WRITE, &t) && vs_string_from_utf8(vm, t.at, t.count,
     out); vs_text_close(&t);
   It holds no Scheme values, so collections do not concern it. */
#ifndef VS_VM_VALUES_TEXT_H
#define VS_VM_VALUES_TEXT_H

#include "vm/values/gc.h"

typedef struct vs_text {
  vs_scheme *vm;
  char *at;              /* not zero-terminated unless vs_text_end was called last */
  size_t count, room;
  size_t limit;          /* bytes after which text is dropped and `cut` set (for messages); 0 = none */
  bool cut;
} vs_text;

void vs_text_open(vs_scheme *vm, vs_text *t, size_t limit);
void vs_text_close(vs_text *t);                                    /* frees; fine after a failure, fine twice */
bool vs_text_put(vs_text *t, const char *bytes, size_t n);         /* false: memory error in vm->condition */
bool vs_text_puts(vs_text *t, const char *s);
bool vs_text_char(vs_text *t, uint32_t c);                         /* a code point */
bool vs_text_string(vs_text *t, vs_value string);                  /* a Scheme string's characters */
bool vs_text_end(vs_text *t);                                      /* a zero byte behind, not counted */
bool vs_text_to_string(vs_text *t, vs_value *out);                 /* a fresh mutable string */

/* A character of UTF-8: bytes used (1..4), 0 at a bad or cut sequence. */
size_t vs_utf8_decode(const char *s, size_t n, uint32_t *out);
/* Returns how many bytes the code point c, at most 0x10FFFF, has. */
size_t vs_utf8_encode(uint32_t c, char out[4]);

#endif
