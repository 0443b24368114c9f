/* Reads and writes the characters of strings, which have 1 or 4 bytes each (value.h). */
#ifndef VS_VM_VALUES_STRING_CHARS_H
#define VS_VM_VALUES_STRING_CHARS_H

#include "vm/machine/native.h"

/* Returns the code point of character k of the string s. */
static inline uint32_t vs_string_at(vs_value s, size_t k) {
  const uint8_t *at = vs_as_bytes(vs_as_string(s)->store)->at;
  uint32_t c;
  VS_ASSERT(k < vs_as_string(s)->length);
  if (!(vs_object_of(s)->flags & VS_F_WIDE)) return at[k];
  memcpy(&c, at + 4 * k, 4);
  return c;
}

/* Sets character k of the string s to the code point c. The string must be wide enough for c: the fill of
 * vs_make_string needed as many bytes, or vs_string_set has converted the string. */
static inline void vs_string_put(vs_value s, size_t k, uint32_t c) {
  uint8_t *at = vs_as_bytes(vs_as_string(s)->store)->at;
  VS_ASSERT(k < vs_as_string(s)->length);
  VS_ASSERT(c <= 0xFF || vs_object_of(s)->flags & VS_F_WIDE);
  if (vs_object_of(s)->flags & VS_F_WIDE) memcpy(at + 4 * k, &c, 4);
  else at[k] = (uint8_t)c;
  vs_as_string(s)->hash = 0;
}

#endif
