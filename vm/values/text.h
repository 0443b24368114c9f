/* Declares vs_text: a growing UTF-8 buffer, whose memory counts for the memory limit. The printer, number texts and
 * string ports write into it.
 *
 *   vs_text t;
 *   vs_text_open(vm, &t, 0);
 *   bool ok = vs_text_puts(&t, "x = ") && vs_print(vm, v, VS_PRINT_WRITE, &t)
 * && vs_string_from_utf8(vm, t.at, t.count, out);
 *   vs_text_close(&t);
 * It contains no Scheme values, so collections do not affect it. */
#ifndef VS_VM_VALUES_TEXT_H
#define VS_VM_VALUES_TEXT_H

#include "vm/values/gc.h"

typedef struct vs_text {
  vs_scheme *vm;
  char *at;              /* the bytes; a NUL follows only if vs_text_end was called last */
  size_t count, room;
  size_t limit;          /* number of bytes after which further text is omitted and `cut` is set (for messages); 0: no
                          * limit */
  bool cut;
} vs_text;

void vs_text_open(vs_scheme *vm, vs_text *t, size_t limit);
void vs_text_close(vs_text *t);                                    /* Frees the buffer. It may also be called after a
                                                                    * failure, or twice. */
bool vs_text_put(vs_text *t, const char *bytes, size_t n);         /* Appends bytes. When memory is out, sets
                                                                    * vm->condition and returns false. */
bool vs_text_puts(vs_text *t, const char *s);
/* Appends formatted text, at most 500 bytes of it; for sentences of messages. */
bool vs_text_printf(vs_text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool vs_text_char(vs_text *t, uint32_t c);                         /* Appends the code point c. */
bool vs_text_string(vs_text *t, vs_value string);                  /* Appends the characters of a Scheme string. */
bool vs_text_end(vs_text *t);                                      /* Appends a NUL, which `count` does not include. */
bool vs_text_to_string(vs_text *t, vs_value *out);                 /* Sets *out to a new mutable string with the
                                                                    * buffer's text. */

/* Decodes a UTF-8 character. Returns its number of bytes (1 to 4), or 0 if the bytes are invalid or incomplete. */
size_t vs_utf8_decode(const char *s, size_t n, uint32_t *out);
/* Encodes the code point c, at most 0x10FFFF. Returns its number of bytes. */
size_t vs_utf8_encode(uint32_t c, char out[4]);

#endif
