/* Implements vs_text (text.h), a growing UTF-8 buffer, and the coding of single characters. */
#include "vm/values/text.h"

#include <stdarg.h>
#include <stdio.h>

#include "vm/machine/native.h"
#include "vm/values/heap.h"

void vs_text_open(vs_scheme *vm, vs_text *t, size_t limit) {
  *t = (vs_text){.vm = vm, .limit = limit};
}

void vs_text_close(vs_text *t) {
  if (t->at) vs_mem(t->vm, t->at, t->room, 0);
  t->at = NULL;
  t->count = t->room = 0;
}

/* Makes room for n more bytes in the buffer. Returns false when memory is out. */
static bool text_reserve(vs_text *t, size_t n) {
  VS_ASSERT(t->count <= t->room);
  if (t->room - t->count >= n) return true;
  if (n > SIZE_MAX / 4 - t->count) return vs_fail_memory(t->vm);
  size_t room = t->room < 64 ? 64 : t->room;
  while (room < t->count + n) room += room / 2;
  char *at = vs_mem(t->vm, t->at, t->room, room);
  if (!at) return vs_fail_memory(t->vm);
  t->at = at;
  t->room = room;
  return true;
}

bool vs_text_put(vs_text *t, const char *bytes, size_t n) {
  if (t->limit && t->count + n > t->limit) {
    t->cut = true;
    n = t->count < t->limit ? t->limit - t->count : 0;
    while (n && ((unsigned char)bytes[n] & 0xC0) == 0x80) n--;      /* does not cut a character into two parts */
  }
  if (!n) return true;
  if (!text_reserve(t, n)) return false;
  memcpy(t->at + t->count, bytes, n);
  t->count += n;
  return true;
}

bool vs_text_puts(vs_text *t, const char *s) { return vs_text_put(t, s, strlen(s)); }

bool vs_text_printf(vs_text *t, const char *format, ...) {
  char text[500];
  va_list list;
  va_start(list, format);
  vsnprintf(text, sizeof text, format, list);
  va_end(list);
  return vs_text_puts(t, text);
}

bool vs_text_char(vs_text *t, uint32_t c) {
  char s[4];
  return vs_text_put(t, s, vs_utf8_encode(c, s));
}

bool vs_text_string(vs_text *t, vs_value string) {
  const vs_string *s = vs_as_string(string);
  const uint8_t *store = vs_as_bytes(s->store)->at;
  if (s->h.flags & VS_F_WIDE) {
    const uint32_t *at = (const uint32_t *)(const void *)store;
    for (uint32_t i = 0; i < s->length; i++)
      if (!vs_text_char(t, at[i]) || !vs_poll_turn(t->vm, i, 4)) return false;
    return true;
  }
  for (uint32_t i = 0; i < s->length;) {
    uint32_t from = i;
    while (i < s->length && store[i] < 0x80 && i - from < 65536) i++;
    if (i > from && (!vs_text_put(t, (const char *)store + from, i - from) ||
                     (i - from >= 1024 && !vs_poll(t->vm, (i - from) / 4))))
      return false;
    if (i < s->length && store[i] >= 0x80 && (!vs_text_char(t, store[i]) || !vs_poll_turn(t->vm, i++, 4))) return false;
  }
  return true;
}

bool vs_text_end(vs_text *t) {
  if (!text_reserve(t, 1)) return false;
  t->at[t->count] = 0;
  return true;
}

bool vs_text_to_string(vs_text *t, vs_value *out) {
  return vs_string_from_utf8(t->vm, t->at ? t->at : "", t->count, out);
}

size_t vs_utf8_decode(const char *text, size_t n, uint32_t *out) {
  const unsigned char *s = (const unsigned char *)text;
  if (n == 0) return 0;
  if (s[0] < 0x80) return *out = s[0], 1;
  size_t count = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
  if (s[0] < 0xC2 || s[0] > 0xF4 || count > n) return 0;
  uint32_t c = s[0] & (0x7Fu >> count);
  for (size_t i = 1; i < count; i++) {
    if ((s[i] & 0xC0) != 0x80) return 0;
    c = c << 6 | (s[i] & 0x3Fu);
  }
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (c < least[count] || c > 0x10FFFF || (c >= 0xD800 && c <= 0xDFFF)) return 0;
  *out = c;
  return count;
}

size_t vs_utf8_encode(uint32_t c, char out[4]) {
  VS_ASSERT(c <= 0x10FFFF);
  if (c < 0x80) return out[0] = (char)c, 1;
  if (c < 0x800) {
    out[0] = (char)(0xC0 | c >> 6);
    out[1] = (char)(0x80 | (c & 0x3F));
    return 2;
  }
  if (c < 0x10000) {
    out[0] = (char)(0xE0 | c >> 12);
    out[1] = (char)(0x80 | (c >> 6 & 0x3F));
    out[2] = (char)(0x80 | (c & 0x3F));
    return 3;
  }
  out[0] = (char)(0xF0 | c >> 18);
  out[1] = (char)(0x80 | (c >> 12 & 0x3F));
  out[2] = (char)(0x80 | (c >> 6 & 0x3F));
  out[3] = (char)(0x80 | (c & 0x3F));
  return 4;
}
