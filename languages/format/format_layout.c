/* Determines which tokens begin a line, and the column of each token.
 *
 * A pass places all tokens. After it, each line that is too long is broken: first between the elements of its outermost
 * list, later between those of inner lists. Passes are repeated until none breaks a line. If the result is laid out
 * again, its line ends are those of the last pass, so nothing changes. */
#include "languages/format/format_layout.h"

#include "languages/format/format_program.h"

enum { DEEPEST = FORMAT_WIDTH - 20 /* DEEPEST: if a list begins right of this column, breaking it helps little, so it is
                                    * not broken */ };

static bool is_comment(const format_token *x) { return x->kind == FORMAT_TOKEN_LINE || x->kind == FORMAT_TOKEN_BLOCK; }

/* ---- the author's line ends ---- */

static bool begins_line(const format_tokens *t, size_t i) {
  const format_token *x = &t->tokens[i], *before = i ? x - 1 : NULL;
  if (!before || before->kind == FORMAT_TOKEN_LINE) return true;
  if (x->kind == FORMAT_TOKEN_CLOSE || before->kind == FORMAT_TOKEN_PREFIX) return false;
  if (before->kind == FORMAT_TOKEN_OPEN && !is_comment(x)) return false;
  return x->lines > 0;
}

/* ---- placing ---- */

/* Returns the column of the nth element of the list if a line begins with it. */
static uint32_t indentation(const format_list *l, uint32_t nth) {
  if (nth == 0 || l->style == FORMAT_STYLE_DATA) return l->content;
  if (l->style == FORMAT_STYLE_CALL) return nth > 1 && l->first_argument ? l->first_argument : l->column + 2;
  return l->column + (nth <= l->leading ? 4 : 2);
}

/* Returns the number of blanks between token i and the token before it, if they are on one line. */
static uint32_t distance(const format_tokens *t, size_t i) {
  const format_token *x = &t->tokens[i], *before = x - 1;
  if (x->kind == FORMAT_TOKEN_LINE) return 1;
  if (before->kind == FORMAT_TOKEN_PREFIX) return t->text[x->from] == '@' && t->text[before->from] == ',';
  return before->kind != FORMAT_TOKEN_OPEN && x->kind != FORMAT_TOKEN_CLOSE;
}

static uint32_t home(const format_tokens *t, const format_token *x) {
  return x->kind == FORMAT_TOKEN_OPEN ? t->lists[x->list].parent : x->list;
}

/* Sets the token's end, the column after it. Returns the number of line ends within the token. */
static uint32_t measure(const format_tokens *t, format_token *x) {
  uint32_t lines = 0;
  x->end = x->column;
  for (uint32_t i = x->from; i < x->to; i++) {
    char c = t->text[i];
    if (c == '\n' || (c == '\r' && (i + 1 == x->to || t->text[i + 1] != '\n'))) lines++, x->end = 0;
    else x->end += ((unsigned char)c & 0xC0) != 0x80;
  }
  return lines;
}

static void place(format_tokens *t) {
  uint32_t line = 0;
  for (size_t i = 0; i < t->count; i++) {
    format_token *x = &t->tokens[i];
    format_list *l = &t->lists[home(t, x)];
    if (x->breaks) x->column = indentation(l, x->nth);
    else x->column = x[-1].end + distance(t, i);
    line += x->breaks && i;
    x->line = line;
    if (x->leads && x->nth == 1 && !is_comment(x) && l != t->lists)
      l->first_argument = line == t->tokens[l->open].line ? x->column : 0;
    line += measure(t, x);
    if (x->kind != FORMAT_TOKEN_OPEN) continue;
    l = &t->lists[x->list];
    l->column = x->column, l->content = x->end, l->first_argument = 0;
  }
}

/* ---- lines that are too long ---- */

static bool is_keyword(const format_tokens *t, const format_token *x) {
  return x->kind == FORMAT_TOKEN_ATOM && x->to - x->from > 2 && t->text[x->from] == '#' && t->text[x->from + 1] == ':';
}

/* Returns true if a line may be ended before token i, and this moves the token to the left. */
static bool may_break(const format_tokens *t, size_t i) {
  const format_token *x = &t->tokens[i];
  const format_list *l = &t->lists[home(t, x)];
  if (!i || x->breaks || !x->leads || is_comment(x) || x->kind == FORMAT_TOKEN_CLOSE || is_comment(x - 1)) return false;
  bool dot = x[-1].kind == FORMAT_TOKEN_ATOM && x[-1].to - x[-1].from == 1 && t->text[x[-1].from] == '.';
  if (dot || (is_keyword(t, x - 1) && x->nth > 1)) return false;
  uint32_t least = l->style == FORMAT_STYLE_DATA ? 1 : l->style == FORMAT_STYLE_CALL ? 2 : (uint32_t)l->leading + 1;
  return x->nth >= least && l->column <= DEEPEST && indentation(l, x->nth) < x->column;
}

/* Returns the column after the element that begins with token i, including a keyword's value and the brackets that
 * close after it. */
static uint32_t unit_end(const format_tokens *t, size_t i) {
  while (i + 1 < t->count && (t->tokens[i].kind == FORMAT_TOKEN_PREFIX || is_keyword(t, &t->tokens[i])) &&
         t->tokens[i + 1].kind != FORMAT_TOKEN_CLOSE && !t->tokens[i + 1].breaks) i++;
  while (i + 1 < t->count && t->tokens[i + 1].kind == FORMAT_TOKEN_CLOSE && !t->tokens[i + 1].breaks) i++;
  return t->tokens[i].end;
}

/* Breaks the line of the tokens from `from` to `to` - 1 between atoms, each time as far right as possible. */
static bool fill(format_tokens *t, size_t from, size_t to) {
  bool changed = false;
  uint32_t moved = 0; /* number of columns by which the line ends that were inserted move the tokens to the left */
  for (size_t i = from; i < to; i++) {
    format_token *x = &t->tokens[i];
    if (unit_end(t, i) < x->column || unit_end(t, i) - moved <= FORMAT_WIDTH || !may_break(t, i)) continue;
    uint32_t column = indentation(&t->lists[home(t, x)], x->nth);
    if (column + moved >= x->column) continue;
    x->breaks = changed = true;
    moved = x->column - column;
  }
  return changed;
}

/* Returns true if a list of lists may be broken before token i. Consecutive atoms stay on one line, except keywords. */
static bool may_divide(const format_tokens *t, size_t i) {
  const format_token *x = &t->tokens[i], *last = x;
  if (t->lists[home(t, x)].flat || !may_break(t, i)) return false;
  while (last->kind == FORMAT_TOKEN_PREFIX && last + 1 < t->tokens + t->count) last++;
  return last->kind != FORMAT_TOKEN_ATOM || x[-1].kind != FORMAT_TOKEN_ATOM || is_keyword(t, x);
}

static bool break_line(format_tokens *t, size_t from, size_t to) {
  uint32_t depth = UINT32_MAX;
  for (size_t i = from; i < to; i++) {
    const format_list *l = &t->lists[home(t, &t->tokens[i])];
    if (l->depth < depth && may_divide(t, i)) depth = l->depth;
  }
  if (depth == UINT32_MAX) return fill(t, from, to);
  for (size_t i = from; i < to; i++)
    if (t->lists[home(t, &t->tokens[i])].depth == depth && may_divide(t, i)) t->tokens[i].breaks = true;
  return true;
}

static bool break_lines(format_tokens *t) {
  bool changed = false;
  for (size_t from = 0, to; from < t->count; from = to) {
    bool too_long = false;
    for (to = from; to < t->count && t->tokens[to].line == t->tokens[from].line; to++) {
      const format_token *x = &t->tokens[to];
      bool within = to + 1 == t->count || x[1].line == x->line || x[1].breaks; /* within: whether the token ends on the
                                                                                * line on which it begins */
      too_long = too_long || (x->kind != FORMAT_TOKEN_LINE && within && x->end > FORMAT_WIDTH);
    }
    if (too_long && break_line(t, from, to)) changed = true;
  }
  return changed;
}

/* ---- comments after code on a line ---- */

static bool is_trailing(const format_tokens *t, size_t i) {
  return t->tokens[i].kind == FORMAT_TOKEN_LINE && !t->tokens[i].breaks;
}

/* Aligns comments after code on consecutive lines, if the author has aligned them. */
static void align_comments(format_tokens *t) {
  for (size_t i = 0; i < t->count; i++) {
    if (!is_trailing(t, i)) continue;
    uint32_t column = t->tokens[i].column;
    size_t last = i;
    for (size_t k = i + 1; k < t->count && t->tokens[k].line <= t->tokens[last].line + 1; k++) {
      if (!is_trailing(t, k)) continue;
      if (t->tokens[k].source_column != t->tokens[i].source_column) break;
      if (t->tokens[k].column > column) column = t->tokens[k].column;
      last = k;
    }
    for (size_t k = i; k <= last; k++)
      if (is_trailing(t, k)) t->tokens[k].end += column - t->tokens[k].column, t->tokens[k].column = column;
    i = last;
  }
}

void format_layout(format_tokens *t) {
  for (size_t i = 0; i < t->count; i++) t->tokens[i].breaks = begins_line(t, i);
  do place(t);
  while (break_lines(t));
  align_comments(t);
}
