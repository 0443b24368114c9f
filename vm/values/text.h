/* Owns vs_text: a growing UTF-8 buffer in accounted memory. The printer, number text and string ports write into it.
 *
 *   vs_text t;
 *   vs_text_open(vm, &t, 0);
 *   bool ok = vs_text_puts(&t, "x = ") && vs_print(vm, v, VS_PRINT_WRITE, &t)
 *     && vs_string_from_utf8(vm, t.at, t.count, out);
 *   vs_text_close(&t);
 * It contains no Scheme values, so collections do not affect it. */
#ifndef VS_VM_VALUES_TEXT_H
#define VS_VM_VALUES_TEXT_H

#include "vm/values/gc.h"

typedef struct vs_text {
  vs_scheme *vm;
  char *at;              /* ends with a zero byte only if vs_text_end was the last call */
  size_t count, room;
  size_t limit;          /* number of bytes after which text is dropped and `cut` set (for messages); 0: no limit */
  bool cut;
} vs_text;

void vs_text_open(vs_scheme *vm, vs_text *t, size_t limit);
void vs_text_close(vs_text *t);                                    /* frees; also after a failure, or twice */
bool vs_text_put(vs_text *t, const char *bytes, size_t n);         /* false: out of memory, in vm->condition */
bool vs_text_puts(vs_text *t, const char *s);
bool vs_text_char(vs_text *t, uint32_t c);                         /* c is a code point */
bool vs_text_string(vs_text *t, vs_value string);                  /* the characters of a Scheme string */
bool vs_text_end(vs_text *t);                                      /* adds a zero byte that `count` does not include */
bool vs_text_to_string(vs_text *t, vs_value *out);                 /* makes a new mutable string */

/* Decodes a character of UTF-8. Returns its bytes (1 to 4); 0 if the sequence is bad or incomplete. */
size_t vs_utf8_decode(const char *s, size_t n, uint32_t *out);
/* Encodes the code point c, at most 0x10FFFF; returns its bytes. */
size_t vs_utf8_encode(uint32_t c, char out[4]);

#endif
