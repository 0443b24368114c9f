/* Writes the text of the program in the target language. A stack of pieces that are still to be written lets programs
 * nest to any depth. */
#include "languages/translate/text_plan.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "languages/targets/colour_flow.h"
#include "languages/translate/value_kinds.h"
#include "languages/translate/lift_procedures.h"
#include "languages/translate/lower_forms.h"
#include "languages/translate/spell_names.h"
#include "languages/translate/words.h"
#include "languages/analysis/tree_report.h"
#include "model/characters.h"
#include "model/store/array.h"

enum { WIDE = 96 /* greatest number of columns of a line that is not broken */, INDENT = 2, MOST_INDENT = 30,
  MOST_TEXT = 64 << 20, REPLACEMENT = 0xFFFD /* code point that replaces a byte which is not a character */ };

static bool no_memory(tr_writer *w) { return know_fail(w->t->k, NULL, VS_OUTCOME_MACHINE, "out of memory"); }

void tr_put(tr_writer *w, const char *text, size_t length) {
  if (w->out_count + length > MOST_TEXT) {
    know_fail(w->t->k, NULL, VS_OUTCOME_MODEL, "the translation is too long");
    return;
  }
  if (!VS_GROW(w->out, w->out_room, w->out_count + length + 1)) {
    no_memory(w);
    return;
  }
  memcpy(w->out + w->out_count, text, length);
  w->out[w->out_count += length] = 0;
  for (size_t i = 0; i < length; i++) w->column = text[i] == '\n' ? 0 : w->column + 1;
}

static void put(tr_writer *w, const char *text) { tr_put(w, text, strlen(text)); }

static void put_line(tr_writer *w, uint32_t more) {
  put(w, "\n");
  for (uint32_t i = 0; i < (w->indent < MOST_INDENT ? w->indent : MOST_INDENT) * INDENT + more; i++) put(w, " ");
}

static void plan(tr_writer *w, tr_piece_kind kind, tr_index node, int level, const char *text) {
  if (!VS_GROW(w->plan, w->plan_room, w->plan_count + 1)) no_memory(w);
  else w->plan[w->plan_count++] = (tr_piece){(uint8_t)kind, (uint8_t)level, node, text};
}

void tr_plan_value(tr_writer *w, tr_index node, int level) { plan(w, TR_PIECE_VALUE, node, level, NULL); }

static void plan_text(tr_writer *w, const char *text, size_t length) {
  if (length) plan(w, TR_PIECE_TEXT, 0, 0, know_text(w->t->k, text, length));
}

/* Returns the escape of a character that cannot occur between quotes, or "" for all other characters. All targets
 * accept \uXXXX. */
static const char *escape_of(const tr_target *target, uint32_t code, char room[8]) {
  switch (code) {
  case '"': return "\\\"";
  case '\\': return "\\\\";
  case '\n': return "\\n";
  case '\t': return "\\t";
  case '\r': return "\\r";
  default:
    if (target->ascii ? code >= ' ' && code < 0x7F
                      : code >= 0x10000 || (!vs_character_is_control(code) && code != 0x2028 && code != 0x2029))
      return "";
    snprintf(room, 8, "\\u%04X", code < 0x10000 ? (unsigned)code : REPLACEMENT);
    return room;
  }
}

void tr_plan_quoted(tr_writer *w, const char *text) {
  plan(w, TR_PIECE_TEXT, 0, 0, "\"");
  const char *end = text + strlen(text), *from = text;
  for (const char *at = text; at < end;) {
    char room[8];
    uint32_t code = REPLACEMENT;
    size_t count = vs_character_read(at, (size_t)(end - at), &code);
    const char *escape = count ? escape_of(w->target, code, room) : "\\uFFFD";
    if (*escape) plan_text(w, from, (size_t)(at - from)), plan_text(w, escape, strlen(escape));
    at += count ? count : 1;
    if (*escape) from = at;
  }
  plan_text(w, from, (size_t)(end - from));
  plan(w, TR_PIECE_TEXT, 0, 0, "\"");
}

void tr_plan_comment(tr_writer *w, const char *text) {
  plan(w, TR_PIECE_TEXT, 0, 0, w->target->comment);
  plan(w, TR_PIECE_TEXT, 0, 0, " ");
  char spelled[VS_SPELLED_ROOM];
  for (const char *at = text, *end = text + strlen(text); at < end;)
    plan_text(w, spelled, vs_spell_line(&at, end, spelled));
}

void tr_plan(tr_writer *w, const char *format, ...) {
  va_list list;
  va_start(list, format);
  for (const char *at = format; *at;) {
    size_t length = strcspn(at, "%");
    plan_text(w, at, length);
    at += length;
    if (!*at) break;
    char what = at[1];
    at += 2;
    switch (what) {
    case 's': plan(w, TR_PIECE_TEXT, 0, 0, va_arg(list, const char *)); break;
    case 'v': tr_plan_value(w, va_arg(list, tr_index), TR_LOOSE); break;
    case 't': tr_plan_value(w, va_arg(list, tr_index), TR_TIGHT); break;
    case 'b': plan(w, TR_PIECE_TEST, va_arg(list, tr_index), TR_EITHER, NULL); break;
    case 'o': plan(w, TR_PIECE_SINGLE, va_arg(list, tr_index), 0, NULL); break;
    case 'l': plan(w, TR_PIECE_STATEMENTS, va_arg(list, tr_index), 0, NULL); break;
    case 'd': plan(w, TR_PIECE_DRAW, va_arg(list, tr_index), 0, NULL); break;
    case 'n': plan(w, TR_PIECE_LINE, 0, 0, NULL); break;
    case '>': plan(w, TR_PIECE_IN, 0, 0, NULL); break;
    case '<': plan(w, TR_PIECE_OUT, 0, 0, NULL); break;
    case '_': plan(w, TR_PIECE_SOFT, 0, 0, NULL); break;
    default: plan(w, TR_PIECE_TEXT, 0, 0, "%"); break;
    }
  }
  va_end(list);
}

static void flush(tr_writer *w) {
  if (!VS_GROW(w->pieces, w->piece_room, w->piece_count + w->plan_count)) {
    no_memory(w);
    return;
  }
  while (w->plan_count) w->pieces[w->piece_count++] = w->plan[--w->plan_count];
}

void tr_write_planned(tr_writer *w) {
  flush(w);
  while (w->piece_count && !*w->t->k->trouble) {
    tr_piece p = w->pieces[--w->piece_count];
    switch ((tr_piece_kind)p.kind) {
    case TR_PIECE_TEXT: put(w, p.text); break;
    case TR_PIECE_LINE: put_line(w, 0); break;
    case TR_PIECE_IN: w->indent++; break;
    case TR_PIECE_OUT: w->indent--; break;
    case TR_PIECE_SOFT:
      if (w->column > WIDE + (uint32_t)p.level) put_line(w, 2 * INDENT);
      else put(w, " ");
      break;
    case TR_PIECE_BEHIND: tr_comment_behind(w, tr_at(w->t, p.node)->source); break;
    case TR_PIECE_COMMENTS: tr_comments_inside(w, tr_at(w->t, p.node)->source, p.level != 0); break;
    default:
      w->emit(w, &p);
      flush(w);
    }
  }
}

void tr_plan_comments(tr_writer *w, tr_index node, tr_piece_kind kind, bool end) { plan(w, kind, node, end, NULL); }

void tr_plan_commented(tr_writer *w, const char *format, tr_index node) {
  tr_plan_comments(w, node, TR_PIECE_COMMENTS, false);
  tr_plan(w, format, node);
  tr_plan_comments(w, node, TR_PIECE_BEHIND, false);
}

/* ---- rows of translated_words.def ---- */

static tr_index argument(const translation *t, tr_index primitive, uint32_t nth) {
  for (tr_index i = t->nodes[primitive].first; i; i = t->nodes[i].next)
    if (t->nodes[i].kind != TR_KEYWORD && !nth--) return i;
  return 0;
}

/* Returns the node of the keyword's value, or 0 if the keyword is not given. */
static tr_index keyword(const translation *t, tr_index primitive, const char *name, size_t length) {
  for (tr_index i = t->nodes[primitive].first; i; i = t->nodes[i].next)
    if (t->nodes[i].kind == TR_KEYWORD && strlen(t->nodes[i].text) == length &&
        !strncmp(t->nodes[i].text, name, length)) return t->nodes[i].first;
  return 0;
}

/* Plans the keywords of a primitive by the last part of its row, such as "segments=$fn:n": the program's word, the
 * target's word, and the target's word inside braces. */
static void plan_keys(tr_writer *w, tr_index primitive, const char *keys, bool alone) {
  const translation *t = w->t;
  bool any = false, braces = *w->target->key == ':';
  const char *open = alone ? "" : braces ? ", { " : ", ";
  for (tr_index i = t->nodes[primitive].first; i; i = t->nodes[i].next) {
    if (t->nodes[i].kind != TR_KEYWORD) continue;
    for (const char *at = keys; *at;) {
      size_t length = strcspn(at, " "), name = strcspn(at, "= ");
      if (name == strlen(t->nodes[i].text) && !strncmp(at, t->nodes[i].text, name)) {
        const char *said = at[name] == '=' ? at + name + 1 : at, *end = at + length;
        const char *colon = memchr(said, ':', (size_t)(end - said));
        if (said == end) break; /* if the row has no word after the =, as in "pattern=", the target has no equivalent */
        if (!*w->target->key) { /* a target without keywords in calls: only the colour of a material is written */
          if (!strncmp(said, "c", (size_t)(end - said))) tr_plan(w, "%v", t->nodes[i].first);
          break;
        }
        if (colon && braces) said = colon + 1; /* inside braces, uses the word after the colon, as n of $fn:n */
        else if (colon) end = colon;
        tr_plan(w, "%s%s%s%v", any ? ", " : open, know_text(t->k, said, (size_t)(end - said)), w->target->key,
                t->nodes[i].first);
        any = true;
      }
      at += length + (at[length] == ' ');
    }
  }
  if (any && braces && !alone) tr_plan(w, " }");
}

/* Plans an angle in degrees. A number that the program converts from degrees keeps its digits. */
static void plan_degrees(tr_writer *w, tr_index angle) {
  const tr_node *n = tr_at(w->t, angle);
  if (n->kind == TR_PRIMITIVE && !strcmp(n->text, "degrees->radians")) tr_plan(w, "%v", n->first);
  else if (n->kind == TR_NUMBER && !strcmp(n->text, "0")) tr_plan(w, "0");
  else tr_plan(w, "deg(%v)", angle);
}

/* Plans 'x or 'xy as a vector: the direction of the axis, or the normal of the plane. Returns false if the argument is
 * not such a word. */
static bool plan_axis(tr_writer *w, tr_index argument, char letter) {
  const tr_node *n = tr_at(w->t, argument);
  if (n->kind != TR_STRING || !letter || !strchr("AZL", letter)) return false;
  bool x = letter == 'L' ? !strcmp(n->text, "yz") : *n->text == 'x';
  bool y = letter == 'L' ? !strcmp(n->text, "xz") : *n->text == 'y';
  tr_plan(w, "%s", x ? w->target->x : y ? w->target->y : w->target->z);
  return true;
}

static void plan_solids(tr_writer *w, tr_index primitive, uint32_t from, bool apart) {
  tr_index first = argument(w->t, primitive, from), second = argument(w->t, primitive, from + 1);
  if (first && !second && !apart) {
    tr_plan(w, "%o", first);
    return;
  }
  tr_plan(w, apart ? "{%>" : "%s{%>", w->target->together);
  for (uint32_t i = from; (first = argument(w->t, primitive, i)) != 0; i++)
    tr_plan(w, apart || *w->target->together ? "%n%o" : "%l", first);
  tr_plan(w, "%<%n}");
}

bool tr_row_has_block(const char *text) { return strchr(text, '@') != NULL; }

void tr_plan_row(tr_writer *w, tr_index primitive, int level) {
  const translation *t = w->t;
  tr_word row = tr_word_row(w->target, t->nodes[primitive].row);
  const char *at = row.text;
  if (*at == '=') { /* a row that begins with = is an operator between the arguments */
    int own = at[1] - '0';
    bool brackets = own < level;
    if (brackets) tr_plan(w, "(");
    for (uint32_t i = 0; argument(t, primitive, i); i++) {
      if (i) plan_text(w, at + 2, strlen(at + 2) - 1), plan(w, TR_PIECE_SOFT, 0, 16, NULL);
      tr_plan_value(w, argument(t, primitive, i), i ? own + 1 : own);
    }
    if (brackets) tr_plan(w, ")");
    return;
  }
  int own = TR_TIGHT;
  if (isdigit((unsigned char)at[0]) && at[1] == ':') own = at[0] - '0', at += 2;
  if (own < level) tr_plan(w, "(");
  while (*at) {
    size_t length = strcspn(at, "$%~@#");
    plan_text(w, at, length);
    at += length;
    if (!*at) break;
    char mark = *at, what = at[1];
    uint32_t nth = isdigit((unsigned char)what) ? (uint32_t)(what - '1') : 0;
    at += what ? 2 : 1;
    if (mark == '$' && what == '[') {
      size_t name = strcspn(at, "|"), end = strcspn(at, "]");
      tr_index given = keyword(t, primitive, at, name);
      if (given) tr_plan(w, "%v", given);
      else plan_text(w, at + name + 1, end - name - 1);
      at += end + 1;
    } else if (mark == '$' && what == 'l') plan(w, TR_PIECE_VALUE, primitive, TR_AS_LIST, NULL);
    else if (mark == '$' && what == '*') {
      for (uint32_t i = 0; argument(t, primitive, i); i++) tr_plan(w, i ? ",%_%v" : "%v", argument(t, primitive, i));
    } else if (mark == '$' && what == 'n') {
      char text[16];
      int size = snprintf(text, sizeof text, "%u", t->nodes[primitive].count);
      plan_text(w, text, (size_t)size);
    } else if (mark == '$' && what == 'k') plan_keys(w, primitive, row.keys, at - 2 > row.text && at[-3] == '{');
    else if (mark == '$' && isdigit((unsigned char)what)) {
      tr_index a = argument(t, primitive, nth);
      if (a && !plan_axis(w, a, tr_word_letter(row.arguments, nth))) tr_plan(w, "%v", a);
    } else if (mark == '%' && isdigit((unsigned char)what)) {
      if (argument(t, primitive, nth)) tr_plan(w, "%t", argument(t, primitive, nth));
    } else if (mark == '~' && isdigit((unsigned char)what)) {
      if (argument(t, primitive, nth)) plan_degrees(w, argument(t, primitive, nth));
    } else if (mark == '@' && what == '*') {
      nth = isdigit((unsigned char)*at) ? (uint32_t)(*at++ - '1') : 0;
      plan_solids(w, primitive, nth, true);
    } else if (mark == '@') {
      bool more = *at == '+';
      at += more;
      if (more) plan_solids(w, primitive, nth, false);
      else tr_plan(w, "%o", argument(t, primitive, nth));
    } else if (mark == '#' && isdigit((unsigned char)what)) {
      if (argument(t, primitive, nth)) tr_plan_value(w, argument(t, primitive, nth), own);
    } else { /* other characters are copied to the target's text */
      plan_text(w, at - (what ? 2 : 1), 1);
      at -= what != 0;
    }
  }
  if (own < level) tr_plan(w, ")");
}

/* ---- comments ---- */

/* Writes a comment's text so that no character ends the comment early. In scripts, U+2028 also ends a line. */
static void put_on_line(tr_writer *w, const char *text, const char *end) {
  char spelled[VS_SPELLED_ROOM];
  while (text < end) {
    const char *from = text;
    while (text < end && (unsigned char)*text >= ' ' && (unsigned char)*text < 0x7F) text++;
    if (text > from) tr_put(w, from, (size_t)(text - from));
    if (text < end) tr_put(w, spelled, vs_spell_line(&text, end, spelled));
  }
}

static void put_comment(tr_writer *w, know_index comment, bool behind) {
  size_t length;
  const char *text = know_comment_text(w->t->k, comment, &length);
  const char *end = text + length;
  while (text <= end) {
    const char *stop = memchr(text, '\n', (size_t)(end - text));
    if (!stop) stop = end;
    size_t line = (size_t)(stop - text);
    while (line && isspace((unsigned char)text[line - 1])) line--;
    put(w, behind ? " " : "");
    put(w, w->target->comment);
    if (line) put(w, " "), put_on_line(w, text, text + line);
    if (!behind) put_line(w, 0);
    else return;
    text = stop + 1;
  }
}

/* Returns the place of the analysis's node `source` in the program's text. */
static const know_place *place(const tr_writer *w, know_index source) {
  const knowledge *k = w->t->k;
  while (source && k->nodes[source].origin && !k->nodes[source].made) source = k->nodes[source].origin;
  return &k->nodes[source].at;
}

void tr_gap_before(tr_writer *w, know_index source) {
  const know_place *at = place(w, source);
  const know_file *f = &w->t->k->files[at->file];
  know_index c = w->comment < f->first_comment || w->comment > f->comment_end ? f->first_comment : w->comment;
  bool comment = c < f->comment_end && w->t->k->comments[c].from < at->from;
  uint32_t from = comment ? w->t->k->comments[c].from : at->from, lines = 0;
  while (from && strchr(" \t\r\n", f->text[from - 1])) lines += f->text[--from] == '\n';
  if (lines != 1 && w->out_count) put_line(w, 0);
}

void tr_comments_before(tr_writer *w, know_index source) {
  const know_place *at = place(w, source);
  const know_file *f = &w->t->k->files[at->file];
  bool any = false;
  if (w->comment < f->first_comment || w->comment > f->comment_end) w->comment = f->first_comment;
  for (; w->comment < f->comment_end && w->t->k->comments[w->comment].from < at->from; w->comment++) {
    const know_comment *c = &w->t->k->comments[w->comment];
    if (any && c->line > c[-1].end_line + 1) put_line(w, 0);
    put_comment(w, w->comment, false);
    any = true;
  }
  if (any && w->t->k->comments[w->comment - 1].end_line + 1 < at->line) put_line(w, 0);
}

void tr_comments_inside(tr_writer *w, know_index source, bool end) {
  const know_place *at = place(w, source);
  const know_file *f = &w->t->k->files[at->file];
  if (w->comment < f->first_comment || w->comment > f->comment_end) return;
  for (; w->comment < f->comment_end && w->t->k->comments[w->comment].from < (end ? at->to : at->from); w->comment++) {
    put_line(w, 0);
    put_comment(w, w->comment, false);
    while (w->out_count && (w->out[w->out_count - 1] == ' ' || w->out[w->out_count - 1] == '\n')) w->out_count--;
  }
}

void tr_comment_behind(tr_writer *w, know_index source) {
  const know_place *at = place(w, source);
  const know_file *f = &w->t->k->files[at->file];
  if (w->comment < f->first_comment || w->comment >= f->comment_end) return;
  const know_comment *c = &w->t->k->comments[w->comment];
  if (c->from < at->to || c->line != at->end_line || c->line != c->end_line) return;
  put_comment(w, w->comment, true);
  w->comment++;
}

/* ---- helpers ---- */

/* Returns true if the text calls the function `word`. script: the text is a script, in which the function may also be
 * passed as a value. */
static bool word_in(const char *text, size_t length, const char *word, bool script) {
  size_t n = strlen(word);
  for (size_t i = 0; i + n < length; i++) {
    if (text[i] != *word || memcmp(text + i, word, n)) continue;
    if (script ? isalnum((unsigned char)text[i + n]) || text[i + n] == '_' : text[i + n] != '(') continue;
    if (!i || !(isalnum((unsigned char)text[i - 1]) || text[i - 1] == '_')) return true;
  }
  return false;
}

/* Writes the helper functions that the program uses, those that these helpers use, and those marked `export`, which are
 * for other programs. */
static void put_helpers(tr_writer *w) {
  enum { MOST = 256 };
  bool used[MOST] = {false};
  for (bool more = true, first = true; more; first = false) {
    more = false;
    for (size_t i = 0; i < MOST && tr_helper_name(w->target, i); i++) {
      const char *own = tr_helper_text(w->target, i), *name = tr_helper_name(w->target, i);
      if (first) used[i] = !strncmp(own, "export ", 7) || word_in(w->out, w->out_count, name, w->t->k->script);
      for (size_t j = 0; !used[i] && j < MOST && tr_helper_name(w->target, j); j++) {
        const char *text = tr_helper_text(w->target, j);
        if (j != i && used[j] && word_in(text, strlen(text), name, false)) used[i] = more = true;
      }
      more = more || (first && used[i]);
    }
  }
  if (!w->target->helpers_first) {
    for (size_t i = 0, n = 0; i < MOST && tr_helper_name(w->target, i); i++) {
      if (!used[i]) continue;
      if (!n++) put(w, "\n"), put(w, w->target->comment),
        put(w, " The parts of VisualScheme's language that the program uses.\n");
      put(w, tr_helper_text(w->target, i));
      put(w, "\n");
    }
    return;
  }
  char *body = w->out;
  size_t length = w->out_count;
  w->out = NULL, w->out_count = w->out_room = 0;
  for (size_t i = MOST; i-- > 0;)
    if (used[i]) put(w, tr_helper_text(w->target, i)), put(w, "\n");
  tr_put(w, body ? body : "", length);
  free(body);
}

char *tr_write_program(translation *t, uint32_t segments, size_t *length) {
  tr_writer w = {.t = t, .target = t->target, .segments = segments};
  bool copied = t->k->script && t->target->script;
  bool ok = copied ? tr_lower_nothing(t) : tr_lower(t) && tr_find_kinds(t) && tr_lift(t) && tr_spell_names(t);
  if (ok && !copied) tr_find_colours(t);
  if (ok && copied) t->target->script(&w);
  else if (ok) t->target->program(&w);
  if (ok && !*t->k->trouble && !t->complaint_count) put_helpers(&w);
  free(w.pieces);
  free(w.plan);
  *length = w.out_count;
  if (ok && !*t->k->trouble && !t->complaint_count) return w.out;
  free(w.out);
  return NULL;
}

void tr_plan_number(tr_writer *w, const char *text, int level) {
  bool fraction = strchr(text, '/') && level > TR_PRODUCT, minus = *text == '-' && level > TR_SIGN - 1;
  tr_plan(w, fraction || minus ? "(%s)" : "%s", text);
}

void tr_write_statement(tr_writer *w, size_t before, know_index source) {
  tr_write_planned(w);
  if (w->out_count > before && w->out[before] == '\n') { /* the program must not begin with an empty line */
    memmove(w->out + before, w->out + before + 1, w->out_count - before);
    w->out_count--;
  }
  if (w->out_count <= before) return;
  tr_comment_behind(w, source);
  tr_put(w, "\n", 1);
}
