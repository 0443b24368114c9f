/* Converts the numbers and strings of a program's text to the form of other languages. */
#include "languages/translate/literals.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copies decimal digits with at most one point to `out`, and moves *at past them. Returns false if there are no
 * digits. */
static bool digits(const char **at, const char *end, char *out, size_t room, bool point) {
  size_t n = 0;
  bool any = false, seen = false;
  for (; *at < end && ((**at >= '0' && **at <= '9') || (**at == '.' && point && !seen)); (*at)++) {
    if (n + 3 >= room) return false;
    if (**at == '.') {
      if (!any) out[n++] = '0';
      seen = true;
      if (*at + 1 == end || (*at)[1] < '0' || (*at)[1] > '9') continue;
    } else any = true;
    out[n++] = **at;
  }
  out[n] = 0;
  return any;
}

const char *tr_number_text(knowledge *k, const char *text, size_t length) {
  char whole[400], more[400], out[900];
  const char *at = text, *end = text + length;
  bool minus = length && *at == '-', exponent = false;
  if (length && (*at == '-' || *at == '+')) at++;
  if (!digits(&at, end, whole, sizeof whole, true)) return "";
  int n = snprintf(out, sizeof out, "%s%s", minus ? "-" : "", whole);
  if (at < end && *at == '/') {
    at++;
    if (strchr(whole, '.') || !digits(&at, end, more, sizeof more, false)) return "";
    n = snprintf(out, sizeof out, "%s%s/%s", minus ? "-" : "", whole, more);
  } else if (at < end && (*at == 'e' || *at == 'E')) {
    at++;
    exponent = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) at++;
    if (!digits(&at, end, more, sizeof more, false)) return "";
    n = snprintf(out, sizeof out, "%s%se%s%s", minus ? "-" : "", whole, exponent ? "-" : "", more);
  }
  return at == end && n > 0 && n < (int)sizeof out ? know_text(k, out, (size_t)n) : "";
}

static size_t utf8(uint32_t c, char *out) {
  if (c < 0x80) return out[0] = (char)c, 1;
  if (c < 0x800) return out[0] = (char)(0xC0 | c >> 6), out[1] = (char)(0x80 | (c & 63)), 2;
  if (c < 0x10000) {
    out[0] = (char)(0xE0 | c >> 12), out[1] = (char)(0x80 | (c >> 6 & 63)), out[2] = (char)(0x80 | (c & 63));
    return 3;
  }
  out[0] = (char)(0xF0 | (c >> 18 & 7)), out[1] = (char)(0x80 | (c >> 12 & 63)), out[2] = (char)(0x80 | (c >> 6 & 63));
  return out[3] = (char)(0x80 | (c & 63)), 4;
}

const char *tr_string_text(knowledge *k, const char *text, size_t length) {
  char *out = know_alloc(k, length + 1);
  size_t n = 0;
  if (!out) return "";
  for (size_t i = 1; i + 1 < length; i++) {
    if (text[i] != '\\') {
      out[n++] = text[i];
      continue;
    }
    static const char names[] = "ntrab", means[] = "\n\t\r\a\b";
    char c = text[++i];
    const char *plain = strchr(names, c);
    if (c == 'x') {
      char *end;
      uint32_t code = (uint32_t)strtoul(text + i + 1, &end, 16);
      if (!code || code > 0x10FFFF || *end != ';') return NULL;
      n += utf8(code, out + n), i = (size_t)(end - text);
    } else if (c == '\n' || c == ' ' || c == '\t') { /* a backslash before a line end: the string continues in the next
                                                      * line, without the line end and the blanks around it */
      while (i + 1 < length && (text[i + 1] == ' ' || text[i + 1] == '\t' || text[i + 1] == '\n')) i++;
    } else if (!c || strchr("0vf", c)) return NULL;
    else out[n++] = plain && c ? means[plain - names] : c;
  }
  out[n] = 0;
  return out;
}
