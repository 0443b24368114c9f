/* Implements scanning of bytes, for the readers of mesh files. */
#include "geometry/files/byte_scan.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool vs_scan_fail(const vs_byte_scan *s, const char *format, ...) {
  char text[300];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (s->line) return vs_error_set(s->error, VS_ERROR_MODEL, NULL, "%.100s: line %u: %s", s->name, s->line, text);
  return vs_error_set(s->error, VS_ERROR_MODEL, NULL, "%.100s: byte %zu: %s", s->name, s->at, text);
}

bool vs_scan_poll(vs_byte_scan *s) {
  if ((++s->ticks & 0xffff) || !s->poll.ask || s->poll.ask(s->poll.context)) return true;
  return vs_error_set(s->error, VS_ERROR_INTERRUPT, NULL, "interrupted");
}

static bool scan_blank(unsigned char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == 0;
}

bool vs_scan_line_end(vs_byte_scan *s) {
  VS_ASSERT(s->at <= s->size);
  while (s->at < s->size && scan_blank(s->bytes[s->at])) s->at++;
  return s->at == s->size || s->bytes[s->at] == '\n';
}

void vs_scan_next_line(vs_byte_scan *s) {
  const unsigned char *end = s->at < s->size ? memchr(s->bytes + s->at, '\n', s->size - s->at) : NULL;
  VS_ASSERT(s->at <= s->size);
  s->at = end ? (size_t)(end - s->bytes) + 1 : s->size;
  s->line++;
}

void vs_scan_word(vs_byte_scan *s, bool lines, char comment, char word[VS_SCAN_WORD]) {
  size_t n = 0;
  for (;;) {
    bool end = vs_scan_line_end(s);
    if (!end && comment && s->bytes[s->at] == (unsigned char)comment) {
      const unsigned char *stop = memchr(s->bytes + s->at, '\n', s->size - s->at);
      s->at = stop ? (size_t)(stop - s->bytes) : s->size;
      end = true;
    }
    if (!end) break;
    if (!lines || s->at == s->size) {
      word[0] = 0;
      return;
    }
    s->at++;
    s->line++;
  }
  for (; s->at < s->size && !scan_blank(s->bytes[s->at]) && s->bytes[s->at] != '\n'; s->at++)
    if (n + 1 < VS_SCAN_WORD) word[n++] = (char)s->bytes[s->at];
  word[n] = 0;
}

/* Sets an error that states the expected text and the word that the file has instead, in printable form. Returns
 * false. */
static bool scan_refuse(const vs_byte_scan *s, const char *expected, const char *word) {
  char shown[VS_SCAN_WORD];
  size_t n = 0;
  for (; word[n] && n < 32; n++) shown[n] = word[n] >= ' ' && word[n] < 127 ? word[n] : '?';
  shown[n] = 0;
  return *word ? vs_scan_fail(s, "expected %s, got \"%s\"", expected, shown)
               : vs_scan_fail(s, "expected %s, but %s", expected, s->at == s->size ? "the file ends" : "the line ends");
}

bool vs_scan_real(vs_byte_scan *s, bool lines, char comment, double *out) {
  char word[VS_SCAN_WORD], *end;
  vs_scan_word(s, lines, comment, word);
  *out = strtod(word, &end);
  if (!*word || *end || word[1] == 'x' || word[1] == 'X') return scan_refuse(s, "a number", word);
  return isfinite(*out) || s->nowhere || scan_refuse(s, "a finite number", word);
}

bool vs_scan_integer(vs_byte_scan *s, bool lines, char comment, int64_t *out) {
  char word[VS_SCAN_WORD], *end;
  vs_scan_word(s, lines, comment, word);
  *out = strtoll(word, &end, 10);
  return (*word && !*end) || scan_refuse(s, "a whole number", word);
}

bool vs_scan_point(vs_byte_scan *s, bool lines, char comment, vs_vec3 *out) {
  return vs_scan_real(s, lines, comment, &out->x) && vs_scan_real(s, lines, comment, &out->y) &&
         vs_scan_real(s, lines, comment, &out->z);
}
