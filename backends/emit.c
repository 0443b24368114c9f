/* Owns the writer and the one spelling of numbers. See emit.h. */
#include "backends/emit.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void vs_writer_init(vs_writer *w, vs_sink_fn *sink, void *context) {
  w->sink = sink;
  w->context = context;
  w->used = 0;
  w->bytes = 0;
  w->limit = 0;
  w->line = 1;
  w->failed = w->full = false;
}

bool vs_writer_flush(vs_writer *w) {
  if (w->failed) return false;
  if (w->used > 0 && !w->sink(w->context, w->buffer, w->used)) w->failed = true;
  w->used = 0;
  return !w->failed;
}

bool vs_put(vs_writer *w, const void *bytes, size_t count) {
  if (w->failed) return false;
  if (count == 0) return true; /* bytes may be NULL then */
  w->bytes += count;
  if (w->limit > 0 && w->bytes > w->limit) {
    w->full = w->failed = true;
    return false;
  }
  const char *from = bytes;
  for (const char *p = from, *end = from + count; (p = memchr(p, '\n', (size_t)(end - p))) != NULL; p++) w->line++;
  while (count > 0) {
    size_t part = VS_WRITER_ROOM - w->used;
    if (part > count) part = count;
    memcpy(w->buffer + w->used, from, part);
    w->used += part;
    from += part;
    count -= part;
    if (w->used == VS_WRITER_ROOM && !vs_writer_flush(w)) return false;
  }
  return true;
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
  char text[VS_NUMBER_ROOM];
  return vs_put(w, text, vs_number_text(x, text));
}

bool vs_put_u32(vs_writer *w, uint32_t x) {
  char text[12], *p = text + sizeof text;
  do *--p = (char)('0' + x % 10); while ((x /= 10) > 0);
  return vs_put(w, p, (size_t)(text + sizeof text - p));
}

unsigned char *vs_le_u32(unsigned char *to, uint32_t x) {
  for (int i = 0; i < 4; i++) *to++ = (unsigned char)(x >> (8 * i));
  return to;
}

unsigned char *vs_le_float(unsigned char *to, double x) {
  float number = (float)x + 0.0f; /* + 0: -0 becomes 0 */
  uint32_t bits;
  memcpy(&bits, &number, sizeof bits);
  return vs_le_u32(to, bits);
}

unsigned char *vs_le_double(unsigned char *to, double x) {
  double number = x + 0.0;
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return vs_le_u32(vs_le_u32(to, (uint32_t)bits), (uint32_t)(bits >> 32));
}

bool vs_put_triple(vs_writer *w, const char *open, vs_vec3 v, const char *between, const char *close) {
  return vs_puts(w, open) && vs_put_number(w, v.x) && vs_puts(w, between) && vs_put_number(w, v.y) && vs_puts(w, between) && vs_put_number(w, v.z)
      && vs_puts(w, close);
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

/* Most coordinates are whole or have a few decimals. Such an x is k / 10^d with |k| < 10^12, where x * 10^d rounds to k and k / 10^d
 * rounds back to x: then the digits of k are the answer and printf is not needed. Everything else goes through %.12g. */
static size_t number_plain(double x, char *out) {
  static const double power[] = { 1, 10, 100, 1000, 1e4, 1e5, 1e6 };
  double size = fabs(x);
  if (!(size < 1e6 && size >= 1e-3)) return 0; /* below, the exponent's form is shorter */
  for (int decimals = 0; decimals <= 6; decimals++) {
    double scaled = size * power[decimals];
    uint64_t k = (uint64_t)scaled;
    if ((double)k / power[decimals] != size) {
      k++; /* the product may have been rounded down to just below a whole number */
      if ((double)k / power[decimals] != size) continue;
    }
    char digits[24], *p = digits + sizeof digits;
    for (int i = 0; i < decimals; i++, k /= 10) *--p = (char)('0' + k % 10);
    if (decimals > 0) *--p = '.';
    do *--p = (char)('0' + k % 10); while ((k /= 10) > 0);
    if (x < 0) *--p = '-';
    size_t length = (size_t)(digits + sizeof digits - p);
    memcpy(out, p, length);
    out[length] = '\0';
    return length;
  }
  return 0;
}

size_t vs_number_text(double x, char out[VS_NUMBER_ROOM]) {
  if (x == 0 || !isfinite(x)) {
    out[0] = '0';
    out[1] = '\0';
    return 1;
  }
  size_t plain = number_plain(x, out);
  if (plain > 0) return plain;
  char text[64];
  int length = snprintf(text, sizeof text, "%.12g", x);
  /* The host's locale may have put a comma there; and the exponent is spelled without plus sign and leading zeros. */
  size_t used = 0;
  for (int i = 0; i < length && used + 1 < VS_NUMBER_ROOM; i++) {
    char c = text[i];
    bool digit = c >= '0' && c <= '9';
    if (c == 'e') {
      out[used++] = c;
      i++;
      if (text[i] == '-') out[used++] = '-';
      while (i + 1 < length && (text[i] == '-' || text[i] == '+' || text[i] == '0')) i++;
      i--;
    } else if (digit || c == '-') {
      out[used++] = c;
    } else if (used == 0 || out[used - 1] != '.') {
      out[used++] = '.'; /* whatever the locale's sign is, however many bytes */
    }
  }
  out[used] = '\0';
  return used;
}

void vs_put_xml(vs_writer *w, const char *text) {
  for (; *text != '\0'; text++) switch (*text) {
    case '<': vs_puts(w, "&lt;"); break;
    case '>': vs_puts(w, "&gt;"); break;
    case '&': vs_puts(w, "&amp;"); break;
    case '"': vs_puts(w, "&quot;"); break;
    case '\'': vs_puts(w, "&#39;"); break;
    default: /* control characters are not XML at all */
      if ((unsigned char)*text >= ' ') vs_put(w, text, 1);
      else vs_puts(w, " ");
    }
}
