/* Implements the reading of UTF-8 characters, and their writing in the notation of each format (characters.h). */
#include "model/characters.h"

#include "model/assert.h"

#include <stdio.h>
#include <string.h>

enum { REPLACEMENT = 0xFFFD };

size_t vs_character_read(const char *text, size_t left, uint32_t *code) {
  static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
  const unsigned char *s = (const unsigned char *)text;
  VS_ASSERT(left > 0);
  if (s[0] < 0x80) return *code = s[0], 1;
  size_t count = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
  if (s[0] < 0xC2 || s[0] > 0xF4 || count > left) return 0;
  uint32_t c = s[0] & (0x7Fu >> count);
  for (size_t i = 1; i < count; i++) {
    if ((s[i] & 0xC0) != 0x80) return 0;
    c = c << 6 | (s[i] & 0x3Fu);
  }
  if (c < least[count] || c > 0x10FFFF || (c >= 0xD800 && c <= 0xDFFF)) return 0;
  return *code = c, count;
}

size_t vs_character_cut(const char *text, size_t most) {
  size_t length = strlen(text);
  if (length <= most) return length;
  for (length = most; length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80;) length--;
  return length;
}

bool vs_character_is_control(uint32_t code) {
  return code < ' ' || (code >= 0x7F && code < 0xA0) || (code & 0xFFFE) == 0xFFFE || (code >= 0xFDD0 && code < 0xFDF0);
}

static bool ends_line(uint32_t code) {
  return (code >= '\n' && code <= '\r') || (code >= 0x1C && code <= 0x1E) || code == 0x85 || code == 0x2028 ||
         code == 0x2029;
}

bool vs_character_is_blank(uint32_t code) {
  return code == ' ' || code == '\t' || ends_line(code) || code == 0x1F || code == 0xA0 || code == 0x1680 ||
         (code >= 0x2000 && code <= 0x200B) || code == 0x202F || code == 0x205F || code == 0x3000 || code == 0xFEFF;
}

static size_t say(char out[VS_SPELLED_ROOM], const char *text) {
  size_t length = strlen(text);
  memcpy(out, text, length);
  return length;
}

static size_t replace(char out[VS_SPELLED_ROOM]) { return say(out, "\xEF\xBF\xBD"); }

/* Returns the code point of the character at *at, and moves *at past it. Bytes that are not UTF-8 give the replacement
 * character U+FFFD. *from, *count: bytes of the returned character. *at must be less than end. */
static uint32_t next(const char **at, const char *end, const char **from, size_t *count) {
  uint32_t code = REPLACEMENT;
  VS_ASSERT(*at < end);
  *from = *at;
  *count = vs_character_read(*at, (size_t)(end - *at), &code);
  if (*count == 0) *from = "\xEF\xBF\xBD", *count = 3, ++*at;
  else *at += *count;
  return code;
}

/* Copies the bytes of one character to out, and returns their number. */
static size_t copy(char out[VS_SPELLED_ROOM], const char *from, size_t count) {
  VS_ASSERT(count <= VS_SPELLED_ROOM);
  memcpy(out, from, count);
  return count;
}

size_t vs_spell_plain(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  const char *from;
  size_t count;
  next(at, end, &from, &count);
  return copy(out, from, count);
}

size_t vs_spell_line(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  const char *from;
  size_t count;
  uint32_t code = next(at, end, &from, &count);
  if (code == '\t' || ends_line(code)) return say(out, " ");
  return vs_character_is_control(code) ? replace(out) : copy(out, from, count);
}

size_t vs_spell_word(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  const char *from;
  size_t count;
  uint32_t code = next(at, end, &from, &count);
  return vs_character_is_blank(code) || vs_character_is_control(code) ? say(out, "_") : copy(out, from, count);
}

size_t vs_spell_xml(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  const char *from;
  size_t count;
  uint32_t code = next(at, end, &from, &count);
  switch (code) {
  case '<': return say(out, "&lt;");
  case '>': return say(out, "&gt;");
  case '&': return say(out, "&amp;");
  case '"': return say(out, "&quot;");
  case '\t': case '\n': case '\r': return copy(out, from, count);
  default: return vs_character_is_control(code) ? replace(out) : copy(out, from, count);
  }
}

size_t vs_spell_xml_value(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  switch (**at) {
  case '\'': return ++*at, say(out, "&#39;");
  case '\t': return ++*at, say(out, "&#9;");
  case '\n': return ++*at, say(out, "&#10;");
  case '\r': return ++*at, say(out, "&#13;");
  default: return vs_spell_xml(at, end, out);
  }
}

size_t vs_spell_json(const char **at, const char *end, char out[VS_SPELLED_ROOM]) {
  const char *from;
  size_t count;
  uint32_t code = next(at, end, &from, &count);
  if (code == '"' || code == '\\') return out[0] = '\\', out[1] = (char)code, 2;
  if (code < 0x10000 && (vs_character_is_control(code) || code == 0x2028 || code == 0x2029))
    return (size_t)snprintf(out, VS_SPELLED_ROOM, "\\u%04x", (unsigned)code);
  return copy(out, from, count);
}
