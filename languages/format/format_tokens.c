/* Reads a program's text into tokens and lists. The text must be one that the language's reader accepts; any other text
 * also gives tokens, but their lists have no meaning. */
#include "languages/format/format_tokens.h"

#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"

/* ---- the end of each kind of token ---- */

static int at(const format_tokens *t, size_t i) { return i < t->length ? (unsigned char)t->text[i] : -1; }

static bool ends_line(const format_tokens *t, size_t i) {
  return at(t, i) == '\n' || (at(t, i) == '\r' && at(t, i + 1) != '\n');
}

/* Returns the length in bytes of the blank character at i, or 0 if there is none. Blank characters are those of the
 * language's reader. */
static size_t blank(const format_tokens *t, size_t i) {
  int c = at(t, i);
  if (c < 0) return 0;
  if (c <= ' ') return 1;
  if (c == 0xC2 && at(t, i + 1) == 0xA0) return 2;
  if (c < 0xE2 || c > 0xEF || t->length - i < 3) return 0;
  uint32_t u = (uint32_t)(c & 15) << 12 | (uint32_t)(at(t, i + 1) & 63) << 6 | (uint32_t)(at(t, i + 2) & 63);
  return u == 0xFEFF || u == 0x3000 || (u >= 0x2000 && u <= 0x200B) || u == 0x2028 ? 3 : 0;
}

static bool delimiter(const format_tokens *t, size_t i) {
  int c = at(t, i);
  return c < 0 || (c && strchr("()[]{}\";,'`", c)) || blank(t, i);
}

static size_t line_end(const format_tokens *t, size_t i) {
  while (i < t->length && t->text[i] != '\n' && t->text[i] != '\r') i++;
  return i;
}

static size_t block_end(const format_tokens *t, size_t i) {
  for (size_t depth = 0; i < t->length;) {
    if (at(t, i) == '#' && at(t, i + 1) == '|') depth++, i += 2;
    else if (at(t, i) == '|' && at(t, i + 1) == '#') {
      i += 2;
      if (--depth == 0) return i;
    } else i++;
  }
  return t->length;
}

/* Returns the end of a string or of a part of a name that begins at i and ends with the character `mark`. */
static size_t delimited_end(const format_tokens *t, size_t i, char mark) {
  for (i++; i < t->length; i++) {
    if (t->text[i] == mark) return i + 1;
    if (t->text[i] == '\\' && i + 1 < t->length) i++;
  }
  return t->length;
}

static size_t word_end(const format_tokens *t, size_t i) {
  size_t from = i;
  while (!delimiter(t, i)) i = t->text[i] == '|' ? delimited_end(t, i, '|') : i + 1;
  return i > from ? i : from + 1;
}

static size_t character_end(const format_tokens *t, size_t i) {
  i += 2;
  if (i >= t->length) return t->length;
  bool line = ends_line(t, i);
  for (i++; i < t->length && ((unsigned char)t->text[i] & 0xC0) == 0x80;) i++;
  while (!line && !delimiter(t, i)) i++;
  return i;
}

static bool starts(const format_tokens *t, size_t i, const char *word) {
  size_t n = strlen(word);
  return t->length - i >= n && !memcmp(t->text + i, word, n);
}

/* Returns the kind of the token that begins with # at i, and sets *to to its end. */
static format_kind hash_token(const format_tokens *t, size_t i, size_t *to) {
  int c = at(t, i + 1);
  if (c == '|') return *to = block_end(t, i), FORMAT_TOKEN_BLOCK;
  if (c == ';') return *to = i + 2, FORMAT_TOKEN_PREFIX;
  if (c == '(' || c == '[') return *to = i + 2, FORMAT_TOKEN_OPEN;
  if (c == 'u' && at(t, i + 2) == '8' && (at(t, i + 3) == '(' || at(t, i + 3) == '['))
    return *to = i + 4, FORMAT_TOKEN_OPEN;
  if (c == '\\') return *to = character_end(t, i), FORMAT_TOKEN_ATOM;
  if (starts(t, i, "#lang") && at(t, i + 5) >= 0 && at(t, i + 5) <= ' ')
    return *to = line_end(t, i), FORMAT_TOKEN_LINE;
  if (c == '!' && i == 0 && (at(t, 2) == '/' || at(t, 2) == ' ')) return *to = line_end(t, i), FORMAT_TOKEN_LINE;
  size_t digits = i + 1;
  while (at(t, digits) >= '0' && at(t, digits) <= '9') digits++;
  if (digits > i + 1 && at(t, digits) == '=') return *to = digits + 1, FORMAT_TOKEN_PREFIX;
  if (digits > i + 1 && at(t, digits) == '#') return *to = digits + 1, FORMAT_TOKEN_ATOM;
  return *to = word_end(t, i), FORMAT_TOKEN_ATOM;
}

static format_kind token_at(const format_tokens *t, size_t i, size_t *to) {
  *to = i + 1;
  switch (t->text[i]) {
  case '(': case '[': return FORMAT_TOKEN_OPEN;
  case ')': case ']': return FORMAT_TOKEN_CLOSE;
  case '\'': case '`': return FORMAT_TOKEN_PREFIX;
  case ',':
    if (at(t, i + 1) == '@') *to = i + 2;
    return FORMAT_TOKEN_PREFIX;
  case '"': return *to = delimited_end(t, i, '"'), FORMAT_TOKEN_ATOM;
  case ';': return *to = line_end(t, i), FORMAT_TOKEN_LINE;
  case '#': return hash_token(t, i, to);
  default: return *to = word_end(t, i), FORMAT_TOKEN_ATOM;
  }
}

/* ---- the style of a list ---- */

typedef struct { const char *name; uint8_t style, leading; } list_style;

enum {
#define FORMAT_SHAPE(shape, style, leading) STYLE_OF_##shape = FORMAT_STYLE_##style, LEADING_OF_##shape = leading,
#include "languages/format/format_forms.def"
};

static const list_style words[] = {
#define FORMAT_WORD(name, style, leading) { name, FORMAT_STYLE_##style, leading },
#include "languages/format/format_forms.def"
#define KNOW_FORM(name, shape) { name, STYLE_OF_##shape, LEADING_OF_##shape },
#include "languages/analysis/binding_forms.def"
};

static const list_style prefixes[] = {
#define FORMAT_PREFIX(text, style, leading) { text, FORMAT_STYLE_##style, leading },
#include "languages/format/format_forms.def"
};

static list_style style_of_word(const char *word, size_t n) {
  for (size_t i = 0; i < sizeof words / sizeof *words; i++)
    if (*words[i].name == *word && strlen(words[i].name) == n && !memcmp(words[i].name, word, n)) return words[i];
  for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; i++) {
    size_t length = strlen(prefixes[i].name);
    if (n > length && !memcmp(prefixes[i].name, word, length)) return prefixes[i];
  }
  return (list_style){ "", FORMAT_STYLE_CALL, 0 };
}

/* Sets the list's style, by its first element. atom: whether this element is an atom. */
static void begin_list(const format_tokens *t, format_list *l, const format_token *first, bool atom) {
  char c = t->text[first->from];
  bool clause = t->text[t->tokens[l->open].from] == '[';
  if (l->data || clause || !atom || (c >= '0' && c <= '9') || c == '"' || c == '#') return;
  list_style s = style_of_word(t->text + first->from, first->to - first->from);
  l->style = s.style, l->leading = s.leading;
}

/* ---- tokens and lists ---- */

/* pending: whether the last token, apart from comments, is a prefix such as a quote */
typedef struct { format_tokens *t; uint32_t list; bool pending; } collector;

/* Returns true if a list that begins with the bracket `open` in list number `list` is quoted data. */
static bool is_data(const format_tokens *t, uint32_t list, char open) {
  if (open == '#') return true;
  const format_token *before = t->count ? &t->tokens[t->count - 1] : NULL;
  if (!before || before->kind != FORMAT_TOKEN_PREFIX) return t->lists[list].data;
  char c = t->text[before->from];
  return c == '\'' || c == '`' || (c != ',' && t->lists[list].data);
}

static bool open_list(collector *c, format_token *x) {
  format_tokens *t = c->t;
  if (!VS_GROW(t->lists, t->list_room, t->list_count + 1)) return false;
  uint32_t parent = c->list, list = (uint32_t)t->list_count++;
  t->lists[parent].flat = false;
  t->lists[list] = (format_list){ .parent = parent, .depth = t->lists[parent].depth + 1, .open = (uint32_t)t->count,
                                  .style = FORMAT_STYLE_DATA, .flat = true };
  t->lists[list].data = is_data(t, parent, t->text[x->from]);
  x->list = c->list = list;
  return true;
}

/* Sets the token's number among the elements of its list. */
static void number_element(collector *c, format_token *x) {
  format_list *l = &c->t->lists[c->list];
  x->nth = l->elements;
  x->leads = !c->pending;
  if (x->kind == FORMAT_TOKEN_LINE || x->kind == FORMAT_TOKEN_BLOCK) return;
  bool atom = x->kind == FORMAT_TOKEN_ATOM;
  bool dropped = x->kind == FORMAT_TOKEN_PREFIX && x->to - x->from == 2 && c->t->text[x->from] == '#';
  if (!x->leads || (dropped && c->t->text[x->from + 1] == ';')) return;
  if (atom && x->to - x->from == 1 && c->t->text[x->from] == '.') return;
  if (x->nth == 0 && c->list) begin_list(c->t, l, x, atom);
  if (x->nth == 1 && atom && l->style == FORMAT_STYLE_NAMED) l->leading = 2;
  l->elements++;
}

static bool add_token(collector *c, format_token x) {
  format_tokens *t = c->t;
  if (!VS_GROW(t->tokens, t->room, t->count + 1)) return false;
  x.list = c->list;
  if (x.kind == FORMAT_TOKEN_CLOSE) {
    x.nth = t->lists[c->list].elements;
    if (c->list) c->list = t->lists[c->list].parent;
  } else number_element(c, &x);
  if (x.kind == FORMAT_TOKEN_OPEN && !open_list(c, &x)) return false;
  if (x.kind != FORMAT_TOKEN_LINE && x.kind != FORMAT_TOKEN_BLOCK) c->pending = x.kind == FORMAT_TOKEN_PREFIX;
  t->tokens[t->count++] = x;
  return true;
}

/* Returns the end of the comment from `from` to `to`, without blanks at the end of its line. */
static size_t trimmed(const format_tokens *t, size_t from, size_t to) {
  while (to > from + 1 && (unsigned char)t->text[to - 1] <= ' ') to--;
  return to;
}

bool format_tokens_read(format_tokens *t, const char *text, size_t length) {
  *t = (format_tokens){ .text = text, .length = length };
  collector c = { .t = t };
  if (!VS_GROW(t->lists, t->list_room, 1)) return false;
  t->lists[t->list_count++] = (format_list){ .style = FORMAT_STYLE_DATA, .flat = true };
  uint32_t lines = 0, column = 0;
  for (size_t i = 0; i < length;) {
    size_t n = blank(t, i), to = i + n;
    if (!n) {
      format_kind kind = token_at(t, i, &to);
      size_t end = kind == FORMAT_TOKEN_LINE ? trimmed(t, i, to) : to;
      if (!add_token(&c, (format_token){ .from = (uint32_t)i, .to = (uint32_t)end, .lines = lines,
                                         .source_column = column, .kind = (uint8_t)kind })) return false;
      lines = 0;
    }
    for (; i < to; i++) {
      if (ends_line(t, i)) lines += n > 0, column = 0;
      else column += ((unsigned char)text[i] & 0xC0) != 0x80;
    }
  }
  return true;
}

void format_tokens_free(format_tokens *t) {
  free(t->tokens);
  free(t->lists);
  *t = (format_tokens){ 0 };
}

bool format_tokens_equal(const format_tokens *a, const format_tokens *b) {
  if (a->count != b->count) return false;
  for (size_t i = 0; i < a->count; i++) {
    const format_token *x = &a->tokens[i], *y = &b->tokens[i];
    if (x->kind != y->kind || x->to - x->from != y->to - y->from) return false;
    if (memcmp(a->text + x->from, b->text + y->from, x->to - x->from) != 0) return false;
  }
  return true;
}
