/* Implements the writer of text (writer.h). */
#include "backends/writer.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "backends/number_spelling.h"

void vs_writer_init(vs_writer *w, vs_sink_fn *sink, void *context) {
  w->sink = sink;
  w->context = context;
  w->used = 0;
  w->bytes = 0;
  w->limit = 0;
  w->counted = 0;
  w->line = 1;
  w->failed = w->full = w->keeps_lines = false;
  w->going = NULL;
  w->going_context = NULL;
  w->tap = NULL;
  w->tap_context = NULL;
  w->tap_from = 0;
}

uint32_t vs_writer_line(vs_writer *w) {
  const char *p = w->buffer + w->counted, *end = w->buffer + w->used;
  for (; p < end && (p = memchr(p, '\n', (size_t)(end - p))) != NULL; p++) w->line++;
  w->counted = w->used;
  return w->line;
}

bool vs_writer_flush(vs_writer *w) {
  if (w->failed) return false;
  if (w->keeps_lines) vs_writer_line(w);
  if (w->tap != NULL) w->tap(w->tap_context, w->buffer + w->tap_from, w->used - w->tap_from);
  w->tap_from = 0;
  if (w->used > 0 && !w->sink(w->context, w->buffer, w->used)) w->failed = true;
  if (w->going != NULL && !w->going(w->going_context)) w->failed = true;
  w->used = w->counted = 0;
  return !w->failed;
}

static bool writer_counts(vs_writer *w, size_t count) {
  w->bytes += count;
  if (w->limit == 0 || w->bytes <= w->limit) return true;
  w->full = w->failed = true;
  return false;
}

bool vs_writer_filled(vs_writer *w, const char *end) {
  size_t count = (size_t)(end - (w->buffer + w->used));
  if (!writer_counts(w, count)) return false;
  w->used += count;
  return true;
}

bool vs_put(vs_writer *w, const void *bytes, size_t count) {
  if (w->failed) return false;
  if (count == 0) return true; /* bytes may be NULL if count is 0 */
  if (!writer_counts(w, count)) return false;
  /* writes a large block directly to the sink, unless a tap must receive a copy or lines are counted */
  if (count >= VS_WRITER_ROOM / 2 && w->tap == NULL && !w->keeps_lines) {
    if (!vs_writer_flush(w)) return false;
    if (!w->sink(w->context, bytes, count)) w->failed = true;
    return !w->failed;
  }
  for (const char *from = bytes;;) {
    size_t part = VS_WRITER_ROOM - w->used;
    if (part > count) part = count;
    memcpy(w->buffer + w->used, from, part);
    w->used += part;
    from += part;
    count -= part;
    if (count == 0) return true;
    if (!vs_writer_flush(w)) return false;
  }
}

bool vs_puts(vs_writer *w, const char *text) { return vs_put(w, text, strlen(text)); }

bool vs_putf(vs_writer *w, const char *format, ...) {
  char text[1024];
  va_list rest;
  va_start(rest, format);
  int length = vsnprintf(text, sizeof text, format, rest);
  va_end(rest);
  if (length < 0 || (size_t)length >= sizeof text) {
    w->failed = true;
    return false;
  }
  return vs_put(w, text, (size_t)length);
}

bool vs_put_number(vs_writer *w, double x) {
  char *to = vs_writer_room(w, VS_NUMBER_ROOM);
  return to != NULL && vs_writer_filled(w, vs_number_write(to, x));
}

bool vs_put_u32(vs_writer *w, uint32_t x) {
  char text[12], *p = text + sizeof text;
  do *--p = (char)('0' + x % 10); while ((x /= 10) > 0);
  return vs_put(w, p, (size_t)(text + sizeof text - p));
}

unsigned char *vs_le_double(unsigned char *to, double x) {
  double number = x + 0.0;
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return vs_le_u32(vs_le_u32(to, (uint32_t)bits), (uint32_t)(bits >> 32));
}

bool vs_put_triple(vs_writer *w, const char *open, vs_vec3 v, const char *between, const char *close) {
  return vs_puts(w, open) && vs_put_number(w, v.x) && vs_puts(w, between) && vs_put_number(w, v.y) &&
         vs_puts(w, between) && vs_put_number(w, v.z) && vs_puts(w, close);
}

bool vs_put_spaces(vs_writer *w, size_t count) {
  static const char spaces[] = "                                ";
  while (count > 0 && !w->failed) {
    size_t part = count < sizeof spaces - 1 ? count : sizeof spaces - 1;
    vs_put(w, spaces, part);
    count -= part;
  }
  return !w->failed;
}

bool vs_put_base64(vs_writer *w, const unsigned char *bytes, size_t count) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t i = 0; i < count && !w->failed; i += 3) {
    size_t left = count - i;
    const uint32_t x = (uint32_t)bytes[i] << 16 | (uint32_t)(left > 1 ? bytes[i + 1] : 0) << 8 |
                       (left > 2 ? bytes[i + 2] : 0);
    const char four[4] = { digits[x >> 18], digits[x >> 12 & 63], left > 1 ? digits[x >> 6 & 63] : '=',
                           left > 2 ? digits[x & 63] : '=' };
    vs_put(w, four, 4);
  }
  return !w->failed;
}

void vs_put_spelled(vs_writer *w, vs_speller *spell, const char *text) {
  char spelled[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + strlen(text); at < end && !w->failed;)
    vs_put(w, spelled, spell(&at, end, spelled));
}

void vs_put_xml(vs_writer *w, const char *text) { vs_put_spelled(w, vs_spell_xml_value, text); }
