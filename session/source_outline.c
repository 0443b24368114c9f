/* Finds definitions, calls and words in a source text, without reading it as a program. It recognizes only strings,
 * characters, comments and the three kinds of parentheses. Only messages use the results, so a wrong guess can only
 * spoil a hint. */
#include "session/source_outline.h"

#include <string.h>

static bool is_open(char c) { return c == '(' || c == '[' || c == '{'; }
static bool is_close(char c) { return c == ')' || c == ']' || c == '}'; }
static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

size_t vs_outline_word(const char *at, const char *end) {
  const char *p = at;
  while (p < end && !is_blank(*p) && !is_open(*p) && !is_close(*p) && *p != '"' && *p != ';' && *p != '\'') p++;
  return (size_t)(p - at);
}

/* Returns the place after the |# that closes the block comment at `at`; nested comments are included. */
static const char *block_comment(const char *at, const char *end, uint32_t *line) {
  int depth = 0;
  while (at < end) {
    if (at + 1 < end && at[0] == '#' && at[1] == '|') depth++, at += 2;
    else if (at + 1 < end && at[0] == '|' && at[1] == '#') {
      at += 2;
      if (--depth == 0) return at;
    } else *line += *at++ == '\n';
  }
  return end;
}

const char *vs_outline_blanks(const char *at, const char *end, uint32_t *line) {
  while (at < end) {
    if (is_blank(*at)) *line += *at++ == '\n';
    else if (*at == ';') while (at < end && *at != '\n') at++;
    else if (at + 1 < end && at[0] == '#' && at[1] == '|') at = block_comment(at, end, line);
    else if (at + 1 < end && at[0] == '#' && at[1] == ';') at =
        vs_outline_datum(vs_outline_blanks(at + 2, end, line), end, line);
    else break;
  }
  return at;
}

/* Skips a token that is no list: a word, a string or a character. */
static const char *atom(const char *at, const char *end, uint32_t *line) {
  if (*at == '"') {
    for (at++; at < end && *at != '"'; at++) {
      *line += *at == '\n';
      if (*at == '\\' && at + 1 < end) *line += *++at == '\n';
    }
    return at < end ? at + 1 : end;
  }
  if (at + 2 < end && at[0] == '#' && at[1] == '\\') {
    size_t n = vs_outline_word(at + 3, end);
    return at + 3 + n;
  }
  size_t n = vs_outline_word(at, end);
  return at + (n ? n : 1);
}

const char *vs_outline_datum(const char *at, const char *end, uint32_t *line) {
  while (at < end && (*at == '\'' || *at == '`' || *at == ',' || *at == '@')) at = vs_outline_blanks(at + 1, end, line);
  if (at + 1 < end && *at == '#' && is_open(at[1])) at++;
  if (at >= end || !is_open(*at)) return at < end && !is_close(*at) ? atom(at, end, line) : end;
  size_t depth = 0;
  while (at < end) {
    at = vs_outline_blanks(at, end, line);
    if (at >= end) break;
    if (is_open(*at)) depth++, at++;
    else if (is_close(*at)) {
      at++;
      if (--depth == 0) return at;
    } else if (*at == '\'' || *at == '`' || *at == ',') at++;
    else at = atom(at, end, line);
  }
  return end;
}

void vs_outline_each(const char *text, size_t length, bool (*each)(void *context, const vs_outline_item *item),
    void *context) {
  const char *at = text, *end = text + length;
  uint32_t line = 1;
  for (;;) {
    at = vs_outline_blanks(at, end, &line);
    if (at >= end) return;
    if (is_close(*at)) {
      at++;
      continue;
    }
    vs_outline_item item = { .line = line };
    uint32_t unused = line;
    const char *in = is_open(*at) ? vs_outline_blanks(at + 1, end, &unused) : end;
    size_t head = vs_outline_word(in, end);
    bool library = head == 14 && !memcmp(in, "define-library", 14); /* library: whether the definition is
                                                                     * define-library, after which a list is the
                                                                     * library's name and not the form of a procedure */
    if (head >= 6 && !memcmp(in, "define", 6) && !library) {
      in = vs_outline_blanks(in + head, end, &unused);
      while (in < end && is_open(*in)) item.procedure = true, in = vs_outline_blanks(in + 1, end, &unused);
      item.name = in, item.length = vs_outline_word(in, end);
      const char *value = vs_outline_blanks(in + item.length, end, &unused);
      if (value + 7 < end && is_open(*value) && !memcmp(value + 1, "lambda", 6)) item.procedure = true;
      if (item.length && !each(context, &item)) return;
    }
    at = vs_outline_datum(at, end, &line);
  }
}
