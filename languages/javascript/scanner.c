/* Implements the scanner of scripts: reads tokens.
 *
 * A comment that begins with slash, star, percent is a token: it contains text in the target language, here Scheme. All
 * other comments, including annotations, are kept as comments. Line ends have a meaning in the grammar, so each token
 * records whether a line ended before it. */
#include "languages/javascript/scanner.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
  const char *text, *out;
} words[] = {
#define VS_SCRIPT_WORD(name, text, out) { text, out },
#include "languages/javascript/script_words.def"
#undef VS_SCRIPT_WORD
};

const char *vs_script_word_out(vs_script_word word) { return words[word].out; }

static int peek(const vs_scanner *c, size_t ahead) {
  return c->at + ahead < c->s->size ? (unsigned char)c->s->source[c->at + ahead] : -1;
}

static uint32_t column_of(vs_scanner *c, size_t offset) {
  if (c->column_at < c->line_start || c->column_at > offset) c->column_at = c->line_start, c->column = 1;
  for (; c->column_at < offset; c->column_at++) c->column += ((unsigned char)c->s->source[c->column_at] & 0xC0) != 0x80;
  return c->column;
}

static vs_script_place here(vs_scanner *c) {
  uint32_t column = column_of(c, c->at);
  return (vs_script_place){ (uint32_t)c->at, (uint32_t)c->at, c->line, column, c->line, column };
}

static void close_place(vs_scanner *c, vs_script_place *p) {
  p->to = (uint32_t)c->at, p->end_line = c->line, p->end_column = column_of(c, c->at);
}

/* Returns the length in bytes of the line end at the scanner's position, or 0 if there is none. U+2028 and U+2029 are
 * line ends, too. */
static size_t line_end(const vs_scanner *c) {
  int a = peek(c, 0);
  if (a == '\n') return 1;
  if (a == '\r') return peek(c, 1) == '\n' ? 2 : 1;
  return a == 0xE2 && peek(c, 1) == 0x80 && (peek(c, 2) == 0xA8 || peek(c, 2) == 0xA9) ? 3 : 0;
}

static bool advance(vs_scanner *c) { /* skips a byte or a line end; returns true for a line end */
  size_t n = line_end(c);
  if (!n) return c->at++, false;
  c->at += n;
  c->line++, c->line_start = c->at, c->line_has_code = false;
  return true;
}

/* Decodes the character at the beginning of text, and returns its length in bytes. Returns 0 if the bytes are not a
 * character. */
static size_t character(const char *text, size_t size, uint32_t *code) {
  const unsigned char *s = (const unsigned char *)text;
  static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
  size_t n = *s < 0x80 ? 1 : *s >> 5 == 6 ? 2 : *s >> 4 == 14 ? 3 : *s >> 3 == 30 ? 4 : 0;
  if (!n || n > size) return 0;
  uint32_t u = n == 1 ? *s : *s & (0x7Fu >> n);
  for (size_t i = 1; i < n; i++) {
    if (s[i] >> 6 != 2) return 0;
    u = u << 6 | (s[i] & 63);
  }
  *code = u;
  return u < least[n] || u > 0x10FFFF || (u >= 0xD800 && u < 0xE000) ? 0 : n;
}

bool vs_scanner_open(vs_scanner *c, vs_script *s) {
  *c = (vs_scanner){ .s = s, .line = 1, .column = 1 };
  if (s->size >= UINT32_MAX / 2)
    return vs_script_fail(s, here(c), "the text is longer than %u MB", UINT32_MAX / 2 >> 20);
  if (s->size >= 3 && !memcmp(s->source, "\xEF\xBB\xBF", 3)) c->at = c->line_start = c->column_at = 3;
  vs_scanner look = *c;
  while (look.at < s->size) {
    uint32_t u = 0;
    size_t n = character(s->source + look.at, s->size - look.at, &u);
    if (!n || !u) return vs_script_fail(s, here(&look), "the file is no text in UTF-8");
    if (line_end(&look))
      advance(&look);
    else
      look.at += n;
  }
  if (peek(c, 0) == '#' && peek(c, 1) == '!')
    while (c->at < s->size && !line_end(c)) c->at++;
  return true;
}

static size_t blank(const vs_scanner *c) {
  int a = peek(c, 0);
  if (a == ' ' || a == '\t' || a == '\v' || a == '\f') return 1;
  if (a == 0xC2 && peek(c, 1) == 0xA0) return 2;
  if (a == 0xEF && peek(c, 1) == 0xBB && peek(c, 2) == 0xBF) return 3;
  if (a == 0xE3 && peek(c, 1) == 0x80 && peek(c, 2) == 0x80) return 3;
  return a == 0xE2 && peek(c, 1) == 0x80 && peek(c, 2) >= 0x80 && peek(c, 2) <= 0x8A ? 3 : 0;
}

static bool keep_comment(vs_scanner *c, vs_script_place at, bool alone) {
  vs_script *s = c->s;
  close_place(c, &at);
  if (!vs_script_room(s, &s->comments, &s->comment_room, s->comment_count + 1, sizeof *s->comments)) return false;
  s->comments[s->comment_count++] = (vs_script_comment){ at, alone };
  return true;
}

/* Reads a comment from slash-star to star-slash. Sets *native if it contains text in the target language, and is
 * therefore a token. */
static bool block(vs_scanner *c, bool *newline, bool *native) {
  vs_script_place at = here(c);
  bool alone = !c->line_has_code, lines = false;
  c->at += 2;
  *native = peek(c, 0) == '%';
  if (*native) c->at++;
  size_t from = c->at;
  while (!(peek(c, 0) == '*' && peek(c, 1) == '/')) {
    if (peek(c, 0) < 0) return vs_script_fail(c->s, at, "this comment is never closed");
    if (advance(c)) lines = true;
  }
  size_t to = c->at;
  c->at += 2;
  if (!*native) return *newline |= lines, keep_comment(c, at, alone);
  if (to > from && c->s->source[to - 1] == '%') to--;
  vs_token *t = &c->token;
  t->kind = VS_TOKEN_NATIVE;
  t->text = (uint32_t)c->s->text_count;
  t->length = (uint32_t)(to - from);
  t->at = at;
  close_place(c, &t->at);
  c->line_has_code = true;
  return vs_script_text(c->s, c->s->source + from, to - from);
}

/* Returns true for letters, digits, $, _ and characters above ASCII other than blanks. */
static bool name_part(const vs_scanner *c) {
  int a = peek(c, 0);
  return (a >= 'a' && a <= 'z') || (a >= 'A' && a <= 'Z') || (a >= '0' && a <= '9') || a == '$' || a == '_' ||
         (a >= 0x80 && !blank(c) && !line_end(c));
}

static bool name(vs_scanner *c) {
  size_t from = c->at;
  while (name_part(c)) c->at++;
  if (peek(c, 0) == '\\') return vs_script_fail(c->s, here(c), "a name holds no \\u: write the character");
  size_t n = c->at - from;
  const char *text = c->s->source + from;
  vs_token *t = &c->token;
  t->kind = VS_TOKEN_NAME;
  for (unsigned i = 0; i < VS_WORD_COUNT; i++)
    if (strlen(words[i].text) == n && !memcmp(words[i].text, text, n)) t->kind = VS_TOKEN_WORD, t->word = (uint8_t)i;
  return (t->name = vs_script_name_of(c->s, text, n)) != 0;
}

static bool number(vs_scanner *c) {
  const char *s = c->s->source;
  size_t from = c->at;
  vs_token *t = &c->token;
  t->kind = VS_TOKEN_NUMBER;
  if (peek(c, 0) == '0' && (peek(c, 1) | 32) == 'x') {
    c->at += 2;
    size_t digits = c->at;
    t->number = 0;
    for (int a; a = peek(c, 0), (a >= '0' && a <= '9') || ((a | 32) >= 'a' && (a | 32) <= 'f'); c->at++)
      t->number = t->number * 16 + (a <= '9' ? a - '0' : (a | 32) - 'a' + 10);
    if (c->at == digits) return vs_script_fail(c->s, t->at, "0x needs digits after it");
    if (c->at - digits > 13)
      return vs_script_fail(c->s, t->at, "a number of more than 13 hexadecimal digits: write it in decimal");
  } else {
    if (peek(c, 0) == '0' && peek(c, 1) >= '0' && peek(c, 1) <= '9')
      return vs_script_fail(c->s, t->at, "a number does not begin with 0: octal numbers are not part of this language");
    while (peek(c, 0) >= '0' && peek(c, 0) <= '9') c->at++;
    if (peek(c, 0) == '.')
      for (c->at++; peek(c, 0) >= '0' && peek(c, 0) <= '9';) c->at++;
    if ((peek(c, 0) | 32) == 'e') {
      size_t sign = peek(c, 1) == '+' || peek(c, 1) == '-';
      if (peek(c, 1 + sign) >= '0' && peek(c, 1 + sign) <= '9')
        for (c->at += 1 + sign; peek(c, 0) >= '0' && peek(c, 0) <= '9';) c->at++;
    }
    /* No NUL follows the number in the text, so strtod reads a copy. A number that is too long for the copy is refused;
     * its further digits could change only the last bit. */
    char copy[800];
    size_t n = c->at - from;
    if (n >= sizeof copy) return vs_script_fail(c->s, t->at, "a number of more than %zu characters", sizeof copy - 1);
    memcpy(copy, s + from, n);
    copy[n] = 0;
    t->number = strtod(copy, NULL);
  }
  if (name_part(c)) return vs_script_fail(c->s, here(c), "a name follows a number without a blank");
  return true;
}

static bool put_character(vs_scanner *c, uint32_t u) {
  char b[4];
  size_t n = 0;
  if (u < 0x80)
    b[n++] = (char)u;
  else if (u < 0x800)
    b[n++] = (char)(0xC0 | u >> 6), b[n++] = (char)(0x80 | (u & 63));
  else if (u < 0x10000)
    b[n++] = (char)(0xE0 | u >> 12), b[n++] = (char)(0x80 | (u >> 6 & 63)), b[n++] = (char)(0x80 | (u & 63));
  else
    b[n++] = (char)(0xF0 | u >> 18), b[n++] = (char)(0x80 | (u >> 12 & 63)), b[n++] = (char)(0x80 | (u >> 6 & 63)),
    b[n++] = (char)(0x80 | (u & 63));
  return vs_script_text(c->s, b, n);
}

/* Reads exactly `digits` hexadecimal digits as *u. Returns false if there are fewer. */
static bool hexadecimal(vs_scanner *c, unsigned digits, uint32_t *u) {
  *u = 0;
  for (unsigned i = 0; i < digits; i++) {
    int a = peek(c, i);
    if (!((a >= '0' && a <= '9') || ((a | 32) >= 'a' && (a | 32) <= 'f'))) return false;
    *u = *u * 16 + (uint32_t)(a <= '9' ? a - '0' : (a | 32) - 'a' + 10);
  }
  c->at += digits;
  return true;
}

static bool escape(vs_scanner *c) {
  static const char letters[] = "bfnrtv", meant[] = "\b\f\n\r\t\v";
  vs_script_place at = here(c);
  c->at++;
  int a = peek(c, 0);
  if (a < 0) return vs_script_fail(c->s, at, "the text ends within a string");
  if (line_end(c)) return advance(c), true;
  const char *known = a > 0 && a < 0x80 ? strchr(letters, a) : NULL;
  if (known) return c->at++, put_character(c, (uint32_t)(unsigned char)meant[known - letters]);
  if (a >= '0' && a <= '9') {
    if (a == '0' && !(peek(c, 1) >= '0' && peek(c, 1) <= '9')) return c->at++, put_character(c, 0);
    return vs_script_fail(c->s, at, "an octal escape is not part of this language: write \\x and two digits");
  }
  if (a == 'x' || a == 'u') {
    uint32_t u, low;
    c->at++;
    if (!hexadecimal(c, a == 'x' ? 2 : 4, &u))
      return vs_script_fail(c->s, at, "\\%c needs %d hexadecimal digits", a, a == 'x' ? 2 : 4);
    if (u >= 0xD800 && u < 0xDC00 && peek(c, 0) == '\\' && peek(c, 1) == 'u') {
      c->at += 2;
      if (hexadecimal(c, 4, &low) && low >= 0xDC00 && low < 0xE000)
        return put_character(c, 0x10000 + ((u & 0x3FF) << 10) + (low & 0x3FF));
    }
    if (u >= 0xD800 && u < 0xE000) return vs_script_fail(c->s, at, "half of a surrogate pair is no character");
    return put_character(c, u);
  }
  size_t from = c->at++; /* after a backslash, a character without a special meaning is itself */
  while ((peek(c, 0) & 0xC0) == 0x80) c->at++;
  return vs_script_text(c->s, c->s->source + from, c->at - from);
}

static bool string(vs_scanner *c, int quote) {
  vs_token *t = &c->token;
  t->kind = VS_TOKEN_STRING;
  t->text = (uint32_t)c->s->text_count;
  for (c->at++; peek(c, 0) != quote;) {
    if (peek(c, 0) < 0 || line_end(c)) return vs_script_fail(c->s, t->at, "this string is never closed in its line");
    if (peek(c, 0) == '\\') {
      if (!escape(c)) return false;
    } else if (vs_script_text(c->s, c->s->source + c->at, 1))
      c->at++;
    else
      return false;
  }
  c->at++;
  t->length = (uint32_t)(c->s->text_count - t->text);
  return true;
}

static bool mark(vs_scanner *c) {
  static const char *const marks[] = {
    ">>>=", "===", "!==", ">>>", "<<=", ">>=", "==", "!=", "<=", ">=", "&&", "||", "++",
    "--",   "<<",  ">>",  "+=",  "-=",  "*=",  "/=", "%=", "&=", "|=", "^=", "=>", "..."
  };
  vs_token *t = &c->token;
  t->kind = VS_TOKEN_MARK;
  size_t left = c->s->size - c->at;
  for (size_t i = 0; i < sizeof marks / sizeof *marks; i++) {
    size_t n = strlen(marks[i]);
    if (n <= left && !memcmp(c->s->source + c->at, marks[i], n)) {
      memcpy(t->mark, marks[i], n + 1);
      c->at += n;
      return true;
    }
  }
  int a = peek(c, 0);
  if (a == '`')
    return vs_script_fail(c->s, t->at, "text between ` is not part of this language (ECMAScript 3): write \"a\" + b");
  if (!strchr("{}()[];,<>+-*/%&|^!~?:=.", a))
    return vs_script_fail(c->s, t->at,
                          a > ' ' && a < 127 ? "the character %c has no meaning here"
                                             : "a character with code %d has no meaning here",
                          a);
  t->mark[0] = (char)a, t->mark[1] = 0;
  c->at++;
  return true;
}

bool vs_scanner_next(vs_scanner *c) {
  bool newline = false;
  c->token = (vs_token){ .kind = VS_TOKEN_END };
  for (;;) {
    size_t n = blank(c);
    if (n)
      c->at += n;
    else if (line_end(c))
      advance(c), newline = true;
    else if (peek(c, 0) == '/' && peek(c, 1) == '/') {
      vs_script_place at = here(c);
      bool alone = !c->line_has_code;
      while (c->at < c->s->size && !line_end(c)) c->at++;
      if (!keep_comment(c, at, alone)) return false;
    } else if (peek(c, 0) == '/' && peek(c, 1) == '*') {
      bool native;
      if (!block(c, &newline, &native)) return false;
      if (native) return c->token.newline = newline, true;
    } else
      break;
  }
  vs_token *t = &c->token;
  t->newline = newline;
  t->at = here(c);
  int a = peek(c, 0);
  if (a < 0) return true;
  c->line_has_code = true;
  bool ok = (a >= '0' && a <= '9') || (a == '.' && peek(c, 1) >= '0' && peek(c, 1) <= '9') ? number(c)
            : a == '"' || a == '\''                                                        ? string(c, a)
            : a == '\\' || name_part(c)                                                    ? name(c)
                                                                                           : mark(c);
  close_place(c, &t->at);
  return ok;
}
