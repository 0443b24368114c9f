/* Offers the edits that the messages of an analysis advise. An edit is offered only if the analysis of the edited text
 * no longer has the message, and has no more messages than before. */
#include "cli/lsp/lsp_actions.h"

#include <stdlib.h>
#include <string.h>

#include "cli/lsp/lsp_words.h"
#include "languages/analysis/notation.h"

enum { MOST_TRIES = 24 /* greatest number of edits to try for a message */, MOST_TEXT = 400, MOST_CLOSED = 60 };

static const char *const leads[] = {
#define LSP_LEAD(words) words,
#include "cli/lsp/lsp_leads.def"
};

/* The edits for a message of the document. */
typedef struct {
  lsp_server *s;
  lsp_document *d;
  const know_finding *finding; /* the message; NULL: the text cannot be read, and d->draft->message says why */
  lsp_span at;                 /* place of the message */
  const char *comma;
  unsigned tried, offered;
} remedy;

typedef struct { lsp_span at; const char *text; size_t length; } edit;

/* ---- trying an edit ---- */

/* Returns true if the analysis of the edited text still has the finding's message at its place. */
static bool still_found(const cli_draft *after, const know_finding *finding, uint32_t from) {
  for (size_t i = 0; i < after->found.count; i++) {
    const know_finding *f = &after->found.at[i];
    if (!f->at.file && f->at.from == from && f->check == finding->check && !strcmp(f->details, finding->details))
      return true;
  }
  return false;
}

static bool is_later(const know_place *a, const know_place *b) {
  return a->line > b->line || (a->line == b->line && a->column > b->column);
}

/* Returns true if the edit removes the message, and adds no message. */
static bool mends(remedy *r, const edit *e) {
  const lsp_document *d = r->d;
  size_t length = 0;
  char *text = NULL;
  FILE *to = r->tried++ < MOST_TRIES ? open_memstream(&text, &length) : NULL;
  if (!to) return false;
  fwrite(d->text, 1, e->at.from, to);
  fwrite(e->text, 1, e->length, to);
  fwrite(d->text + e->at.to, 1, d->length - e->at.to, to);
  cli_draft after = { 0 };
  vs_options o = lsp_document_options(r->d, r->s->interpreter);
  bool good = fclose(to) == 0 && cli_draft_read(&after, &o, d->path, text, length);
  if (good && !r->finding) good = after.known || is_later(&after.at, &d->draft->at);
  else if (good)
    good = after.known && after.found.count <= d->draft->found.count &&
           !still_found(&after, r->finding, r->finding->at.from);
  cli_draft_free(&after);
  free(text);
  return good;
}

static void put_action(remedy *r, const char *title, const edit *e) {
  FILE *to = r->s->to;
  lsp_counted counted = { 0 };
  fprintf(to, "%s{\"title\":", r->comma);
  lsp_put(to, title);
  fprintf(to, ",\"kind\":\"quickfix\",\"isPreferred\":%s,\"diagnostics\":[", r->offered++ ? "false" : "true");
  lsp_write_diagnostic(to, r->d, r->finding, &counted);
  fputs("],\"edit\":{\"changes\":{", to);
  lsp_put(to, r->d->uri);
  fputs(":[{", to);
  lsp_put_range(to, "range", r->d->text, r->d->length, e->at);
  fputs(",\"newText\":", to);
  know_json_text(to, e->text, e->length);
  fputs("}]}}}", to);
  r->comma = ",";
}

static bool offer(remedy *r, const char *title, const edit *e) {
  if (!mends(r, e)) return false;
  put_action(r, title, e);
  return true;
}

static bool offer_text(remedy *r, const edit *e) {
  char title[MOST_TEXT + 20];
  snprintf(title, sizeof title, "Write %.*s", (int)e->length, e->text);
  return offer(r, title, e);
}

/* ---- the text that a message advises ---- */

/* Returns the length of the word or the form at `at`, which must end before `end`; 0: there is none. */
static size_t datum(const char *at, const char *end) {
  if (at == end || !strchr("([\"", *at)) return lsp_word(at, end);
  int depth = 0;
  bool quoted = false;
  for (const char *c = at; c < end; c++) {
    if (quoted && *c == '\\') c++;
    else if (*c == '"') quoted = !quoted;
    else if (!quoted && strchr("([", *c)) depth++;
    else if (!quoted && strchr(")]", *c)) depth--;
    if (!depth && !quoted) return (size_t)(c + 1 - at);
  }
  return 0;
}

static bool is_in(const char *word, size_t n, const char *text, size_t length) {
  for (size_t i = 0; i + n <= length; i++)
    if (!memcmp(text + i, word, n)) return true;
  return false;
}

static bool is_of_language(const remedy *r, const char *word, size_t n) {
  char name[MOST_TEXT];
  vs_name_info info;
  snprintf(name, sizeof name, "%.*s", (int)n, word);
  return vs_name_get(r->s->language, name, &info);
}

/* Returns true if every word of `text` is in `other`. Excepted are names of the language, 0 and 1 instead of a
 * form or, if r is NULL, words after an opening parenthesis. */
static bool words_are_in(const remedy *r, const char *text, size_t length, const char *other, size_t other_length) {
  const char *end = text + length;
  for (const char *at = text; at < end;) {
    size_t n = lsp_word(at, end);
    bool first = at > text && strchr("([", at[-1]), common = *other == '(' && n == 1 && strchr("01", *at);
    if (n && !(r ? common || is_of_language(r, at, n) : first) && !is_in(at, n, other, other_length)) return false;
    at += n ? n : 1;
  }
  return true;
}

/* Returns true if the advice contains the words of the replaced text, and is therefore no general example. name:
 * whether the replaced text is a name that the message concerns. */
static bool is_made_of(const remedy *r, bool name, const edit *e) {
  const char *replaced = r->d->text + e->at.from;
  size_t length = e->at.to - e->at.from;
  return !is_in("...", 3, e->text, e->length) && words_are_in(r, e->text, e->length, replaced, length) &&
         (name || words_are_in(NULL, replaced, length, e->text, e->length));
}

/* Returns true for the finding's node, the nodes in it, and the list whose first element it is. */
static bool concerns(const remedy *r, const know_node *n) {
  const know_node *first = n->kind == KNOW_LIST && n->first ? know_at(&r->d->draft->k, n->first) : n;
  return (n->at.from >= r->at.from && n->at.to <= r->at.to) ||
         (first->at.from == r->at.from && first->at.to == r->at.to);
}

/* Offers to replace the finding's text by the advice, or the smallest part of that text that the advice can replace. */
static void offer_advice(remedy *r, const char *advice, size_t n) {
  const knowledge *k = &r->d->draft->k;
  bool done = false;
  for (know_index i = (know_index)k->text_nodes; i && !done && n < MOST_TEXT; i--) {
    const know_node *node = know_at(k, i);
    lsp_span at = { node->at.from, node->at.to };
    if (node->at.file || node->made || at.to <= at.from || !concerns(r, node)) continue;
    const char *replaced = r->d->text + at.from;
    size_t length = at.to - at.from;
    bool same = length == n && !memcmp(replaced, advice, n);
    bool name = node->kind == KNOW_SYMBOL && at.from == r->at.from && at.to == r->at.to;
    if (node->kind == KNOW_KEYWORD) name = is_in(replaced, length, r->finding->details, strlen(r->finding->details));
    bool first = name && node->parent && know_at(k, node->parent)->first == i;
    if (same || (first && *advice == '(')) continue; /* a form can only replace the whole call */
    if (!(name && *advice != '(') && !is_made_of(r, name, &(edit){ at, advice, n })) continue;
    done = offer_text(r, &(edit){ at, advice, n });
  }
}

static void offer_advices(remedy *r, const char *message) {
  const char *end = message + strlen(message), *here = strstr(message, " is the name here");
  if (here) {
    const char *name = here;
    while (name > message && name[-1] != ' ') name--;
    offer_advice(r, name, (size_t)(here - name));
  }
  for (size_t i = 0; i < sizeof leads / sizeof *leads; i++)
    for (const char *at = strstr(message, leads[i]); at; at = strstr(at + 1, leads[i])) {
      const char *text = at + strlen(leads[i]);
      if (strchr("(;:", *leads[i]) && !strchr("(\"0123456789", *text)) continue; /* the text continues the message, and
                                                                                  * is no advice */
      size_t n = datum(text, end);
      if (!strncmp(leads[i], "did", 3) && n && text[n - 1] == '?') n--;
      if (n) offer_advice(r, text, n);
    }
}

/* ---- names and comments ---- */

/* Offers to put _ before a name that is not used, since names that begin with _ may be unused. */
static void offer_underscore(remedy *r) {
  const char *name = r->d->text + r->at.from;
  size_t n = lsp_word(name, r->d->text + r->at.to);
  char text[MOST_TEXT];
  if (!n || n + 2 > sizeof text || r->at.from + n != r->at.to) return;
  int length = snprintf(text, sizeof text, "_%.*s", (int)n, name);
  offer_text(r, &(edit){ r->at, text, (size_t)length });
}

/* Offers to add a comment that allows the finding, on its line or on a line before it. */
static void offer_comment(remedy *r, const char *check) {
  const char *text = r->d->text;
  char title[100], comment[160];
  size_t from = r->at.from, to = from + strcspn(text + from, "\r\n");
  while (from && !strchr("\r\n", text[from - 1])) from--;
  size_t indent = strspn(text + from, " \t");
  snprintf(title, sizeof title, "Allow %s here", check);
  int n = snprintf(comment, sizeof comment, " ; check: allow %s", check);
  if (offer(r, title, &(edit){ { (uint32_t)to, (uint32_t)to }, comment, (size_t)n }) || indent > 40) return;
  n = snprintf(comment, sizeof comment, "%.*s; check: allow %s\n", (int)indent, text + from, check);
  offer(r, title, &(edit){ { (uint32_t)from, (uint32_t)from }, comment, (size_t)n });
}

/* ---- texts that cannot be read ---- */

/* Returns the byte at which the form that begins at `from` probably ends: before the next line that begins with a
 * parenthesis. */
static size_t probable_end(const lsp_document *d, size_t from) {
  size_t to = d->length;
  for (size_t i = from + 1; i < d->length && to == d->length; i++)
    if (strchr("([;", d->text[i]) && strchr("\r\n", d->text[i - 1])) to = i;
  while (to > from && strchr(" \t\r\n", d->text[to - 1])) to--;
  return to;
}

/* Offers to add the closing parentheses that a form lacks. */
static void offer_closing(remedy *r) {
  const lsp_document *d = r->d;
  size_t from = r->at.from, to = probable_end(d, from), length = 0;
  char missing[MOST_CLOSED + 1] = "", *text = NULL;
  for (size_t n = 0; n < MOST_CLOSED; n++) {
    FILE *form = open_memstream(&text, &length);
    if (!form) return;
    fprintf(form, "%.*s%s", (int)(to - from), d->text + from, missing);
    vs_read_status status = { .state = VS_READ_BAD };
    if (fclose(form) == 0) status = vs_read_check(r->s->language, text, length);
    free(text);
    if (status.state == VS_READ_COMPLETE) break;
    if (status.state == VS_READ_INCOMPLETE) missing[n] = ')';
    else if (n && missing[n - 1] == ')') missing[--n] = ']';
    else return;
  }
  if (*missing) offer_text(r, &(edit){ { (uint32_t)to, (uint32_t)to }, missing, strlen(missing) });
}

static void offer_reading(remedy *r) {
  const lsp_document *d = r->d;
  const char *message = d->draft->message, *end = message + strlen(message), *at;
  if (strstr(message, "is missing") && r->at.from < d->length) offer_closing(r);
  if ((at = strstr(message, " belongs here")) && at - message >= 2 && at[-2] == ' ')
    offer_text(r, &(edit){ r->at, at - 1, 1 });
  if ((at = strstr(message, " instead of "))) {
    const char *right = at, *wrong = at + strlen(" instead of ");
    while (right > message && right[-1] != ' ') right--;
    size_t n = (size_t)(end - wrong);
    uint32_t line = r->at.from;
    while (line && d->text[line - 1] != '\n') line--;
    const char *found = strstr(d->text + line, wrong);
    uint32_t from = found ? (uint32_t)(found - d->text) : 0;
    if (found) offer_text(r, &(edit){ { from, from + (uint32_t)n }, right, (size_t)(at - right) });
  }
}

/* ---- the answer ---- */

static bool touches(lsp_span a, lsp_span b) { return a.from <= b.to && b.from <= a.to; }

static void mend(remedy *r) {
  const know_finding *f = r->finding;
  if (!f) {
    offer_reading(r);
    return;
  }
  offer_advices(r, f->details);
  if (f->check == KNOW_CHECK_UNUSED || f->check == KNOW_CHECK_UNUSED_PARAMETER) offer_underscore(r);
  if (f->check != KNOW_CHECK_SYNTAX) offer_comment(r, lsp_check_name(f->check));
}

void lsp_actions(lsp_server *s, cli_data parameters) {
  lsp_document *d = lsp_find(s, parameters);
  fputc('[', s->to);
  if (d && know_reads(d->path)) {
    bool known = lsp_document_study(d, s->interpreter);
    lsp_span asked = lsp_range_of(&s->json, d, cli_data_at(&s->json, parameters, "range"));
    remedy r = { .s = s, .d = d, .comma = "" };
    r.at = lsp_place(d->text, d->length, &d->draft->at);
    if (!known && touches(r.at, asked)) mend(&r);
    for (size_t i = 0; known && i < d->draft->found.count; i++) {
      r.finding = &d->draft->found.at[i], r.at = lsp_finding_span(d, r.finding), r.tried = r.offered = 0;
      if (!r.finding->at.file && touches(r.at, asked)) mend(&r);
    }
  }
  fputc(']', s->to);
}
