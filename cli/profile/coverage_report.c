/* Reports how often each line of a program ran. */
#include "cli/profile/coverage_report.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "cli/json.h"
#include "cli/profile/profile_lines.h"
#include "model/store/array.h"

enum { MOST_MISSED = 100 /* number of places that are printed for a file */, TEXT = 50 };

static int by_place(const void *a, const void *b) {
  const coverage_form *x = a, *y = b;
  int files = strcmp(x->file, y->file);
  if (files) return files;
  if (x->line != y->line) return x->line < y->line ? -1 : 1;
  return x->column < y->column ? -1 : x->column > y->column;
}

static int by_order(const void *a, const void *b) {
  const coverage_form *x = a, *y = b;
  int places = by_place(a, b);
  return places ? places : x->order < y->order ? -1 : x->order > y->order;
}

/* Makes one form of those with the same place, which a macro has made of one form. The first of them contains the
 * others: a loop runs once, and its parts run at each turn. */
static void join_places(coverage *c) {
  size_t kept = 0;
  for (size_t i = 0; i < c->count; i++) {
    coverage_form *last = kept ? &c->forms[kept - 1] : NULL;
    if (!last || by_place(last, &c->forms[i])) c->forms[kept++] = c->forms[i];
    else if (!last->count) last->count = c->forms[i].count;
  }
  c->count = kept;
  for (size_t i = 0; i < kept; i++) c->ran += c->forms[i].count > 0;
}

bool coverage_read(coverage *c, vs_scheme *scheme) {
  vs_coverage_info form;
  *c = (coverage){ 0 };
  for (size_t i = 0; vs_coverage_get(scheme, i, &form); i++) {
    if (!form.at.file) continue;
    if (!VS_GROW(c->forms, c->room, c->count + 1)) return false;
    c->forms[c->count++] = (coverage_form){ form.at.file, form.at.line, form.at.column, form.count, i };
  }
  if (c->count) qsort(c->forms, c->count, sizeof *c->forms, by_order);
  join_places(c);
  return true;
}

void coverage_free(coverage *c) {
  free(c->forms);
  *c = (coverage){ 0 };
}

/* ---- lines ---- */

/* The forms that begin in one line. most: the greatest of their counts; missed: the first that did not run, or NULL. */
typedef struct { uint32_t line; size_t end; uint64_t most; const coverage_form *missed; } line_forms;

/* Returns the forms of the line in which form i begins; i is the first of them. */
static line_forms line_at(const coverage *c, size_t i) {
  const coverage_form *at = &c->forms[i];
  line_forms l = { .line = at->line, .end = i };
  for (; l.end < c->count && c->forms[l.end].line == at->line && !strcmp(c->forms[l.end].file, at->file); l.end++) {
    const coverage_form *f = &c->forms[l.end];
    if (f->count > l.most) l.most = f->count;
    if (!f->count && !l.missed) l.missed = f;
  }
  return l;
}

/* Prints the text of the file, each line after the count of its forms. Returns false if the file cannot be read. */
static bool print_lines(const coverage *c, size_t from, size_t to, FILE *out) {
  FILE *text = fopen(c->forms[from].file, "rb");
  char *row = NULL;
  size_t room = 0;
  if (!text) return false;
  for (uint32_t line = 1; getline(&row, &room, text) >= 0; line++) {
    char times[40] = "";
    row[strcspn(row, "\r\n")] = 0;
    if (from < to && c->forms[from].line == line) {
      line_forms l = line_at(c, from);
      if (l.most) snprintf(times, sizeof times, "%" PRIu64 "%s", l.most, l.missed ? " *" : "");
      else snprintf(times, sizeof times, "never");
      from = l.end;
    }
    fprintf(out, "%10s %5u  %s\n", times, (unsigned)line, row);
  }
  free(row);
  fclose(text);
  return true;
}

/* Prints the places of the forms from number `from` to `to` - 1 that did not run: one for each series of lines. */
static void print_missed(const coverage *c, size_t from, size_t to, FILE *out) {
  size_t places = 0;
  bool within = false; /* whether no form of the line before ran */
  for (size_t i = from; i < to;) {
    line_forms l = line_at(c, i);
    if (l.missed && !(within && !l.most) && places++ < MOST_MISSED) {
      char text[TEXT + 1];
      const coverage_form *at = l.missed;
      profile_line_text(at->file, at->line, at->column, text, sizeof text);
      fprintf(out, "%s:%u:%u: did not run: %s\n", at->file, (unsigned)at->line, (unsigned)at->column, text);
    }
    within = !l.most;
    i = l.end;
  }
  if (places > MOST_MISSED) fprintf(out, "and %zu more places\n", places - MOST_MISSED);
}

static size_t file_end(const coverage *c, size_t from) {
  size_t to = from;
  while (to < c->count && !strcmp(c->forms[to].file, c->forms[from].file)) to++;
  return to;
}

static void print_share(const char *what, size_t ran, size_t all, FILE *out) {
  fprintf(out, "%s: %zu of %zu forms ran (%.1f %%)\n", what, ran, all, all ? 100.0 * (double)ran / (double)all : 100.0);
}

void coverage_print(const coverage *c, bool whole, FILE *to) {
  for (size_t i = 0, end; i < c->count; i = end) {
    end = file_end(c, i);
    fprintf(to, "%10s        %s\n", "times", c->forms[i].file);
    if (print_lines(c, i, end, to)) fputc('\n', to);
  }
  size_t files = 0;
  for (size_t i = 0, end; i < c->count; i = end, files++) {
    end = file_end(c, i);
    print_missed(c, i, end, to);
  }
  for (size_t i = 0, end; i < c->count; i = end) {
    size_t ran = 0;
    end = file_end(c, i);
    for (size_t k = i; k < end; k++) ran += c->forms[k].count > 0;
    print_share(c->forms[i].file, ran, end - i, to);
  }
  if (files > 1) print_share("all files", c->ran, c->count, to);
  if (!c->count) fputs("the program has no form that could run\n", to);
  if (!whole) fputs("the run ended early; the forms after its end are not counted\n", to);
}

void coverage_print_json(const coverage *c, FILE *to) {
  fputc('[', to);
  for (size_t i = 0; i < c->count; i++) {
    const coverage_form *f = &c->forms[i];
    fputs(i ? ",\n{\"file\":" : "\n{\"file\":", to);
    cli_json_text(to, f->file);
    fprintf(to, ",\"line\":%u,\"column\":%u,\"count\":%" PRIu64 "}", (unsigned)f->line, (unsigned)f->column,
            f->count);
  }
  fputc(']', to);
}
