/* Evaluates --where for each part of a sweep, and sorts the parts by --sort. */
#define _GNU_SOURCE
#include "cli/sweep/row_choice.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/nearby.h"
#include "model/store/array.h"
#include "visualscheme.h"

/* ---- --where as an expression ---- */

/* The comparisons of the short form, longer ones first, and the procedures that they mean. */
static const struct { const char *sign, *form, *end;
} comparisons[] = {
  { "<=", "(<= ", ")" },
  { ">=", "(>= ", ")" },
  { "!=", "(not ((lambda (x y) (if (and (number? x) (number? y)) (= x y) (equal? x y))) ", "))" },
  { "<", "(< ", ")" },
  { ">", "(> ", ")" },
  { "=", "((lambda (x y) (if (and (number? x) (number? y)) (= x y) (equal? x y))) ", ")" },
};
enum { COMPARISONS = sizeof comparisons / sizeof *comparisons };

/* Finds the first comparison in the text. Returns its place, or NULL. */
static const char *find_comparison(const char *at, const char *end, size_t *which) {
  for (; at < end; at++)
    for (size_t i = 0; i < COMPARISONS; i++) {
      size_t n = strlen(comparisons[i].sign);
      if ((size_t)(end - at) >= n && !memcmp(at, comparisons[i].sign, n)) return *which = i, at;
    }
  return NULL;
}

static void trim(const char **from, const char **to) {
  while (*from < *to && **from == ' ') ++*from;
  while (*from < *to && (*to)[-1] == ' ') --*to;
}

/* Writes an operand of a comparison: a number as it is, and a name between bars (|name|), because a name may contain
 * spaces. */
static bool put_operand(FILE *to, const char *from, const char *end) {
  char *stop, text[200];
  trim(&from, &end);
  snprintf(text, sizeof text, "%.*s", (int)(end - from), from);
  if (from == end || (size_t)(end - from) >= sizeof text || memchr(from, '|', (size_t)(end - from))) return false;
  strtod(text, &stop);
  if (!*stop || *text == '"' || *text == '#') fputs(text, to);
  else fprintf(to, "|%s|", text);
  return true;
}

/* Returns the text of --where as an expression of the language, which the caller frees. Returns NULL if the text cannot
 * be read. */
static char *expression_of(const char *where) {
  char *text = NULL;
  size_t size;
  if (where[strspn(where, " ")] == '(') return strdup(where);
  FILE *to = open_memstream(&text, &size);
  if (!to) return NULL;
  bool ok = true;
  fputs("(and", to);
  for (const char *at = where; ok; at++) {
    const char *end = strchrnul(at, ',');
    size_t which;
    const char *sign = find_comparison(at, end, &which);
    if (sign) fprintf(to, " %s", comparisons[which].form);
    ok = sign && put_operand(to, at, sign) && fputc(' ', to) != EOF &&
         put_operand(to, sign + strlen(comparisons[which].sign), end);
    if (ok) fputs(comparisons[which].end, to);
    at = end;
    if (!*at) break;
  }
  fputc(')', to);
  if (fclose(to) == 0 && ok) return text;
  free(text);
  return NULL;
}

bool sweep_where_reads(const char *where) {
  char *text = expression_of(where);
  if (!text)
    fprintf(stderr,
            "vs sweep: --where %s: expected comparisons with commas between them, as in area<100,cost<=5, or an "
            "expression, as in '(< area (* 2 cost))'\n",
            where);
  free(text);
  return text != NULL;
}

/* ---- evaluating --where ---- */

typedef struct { char value[8]; char message[400]; } answer;

static void take_value(void *context, const char *text, size_t length) {
  answer *a = context;
  snprintf(a->value, sizeof a->value, "%.*s", (int)(length < 7 ? length : 7), text);
}
static void take_message(void *context, const vs_diagnostic *d) {
  answer *a = context;
  if (d->severity == VS_SEVERITY_ERROR && !*a->message) snprintf(a->message, sizeof a->message, "%s", d->message);
}

/* Writes a parameter's value as a constant of the language: a number or truth value as typed, other text as a
 * string. */
static void put_constant(FILE *to, const char *value) {
  char *stop;
  strtod(value, &stop);
  bool number =
      *value && (!*stop || (*stop == '/' && stop > value && strspn(stop + 1, "0123456789") == strlen(stop + 1)));
  if (number || !strcmp(value, "#t") || !strcmp(value, "#f")) {
    fputs(value, to);
    return;
  }
  fputc('"', to);
  for (; *value; value++) {
    if (*value == '"' || *value == '\\') fputc('\\', to);
    fputc(*value, to);
  }
  fputc('"', to);
}

static void put_name(FILE *to, const char *name) {
  fputc('|', to);
  for (; *name; name++) {
    if (*name == '|' || *name == '\\') fputc('\\', to);
    fputc(*name, to);
  }
  fputc('|', to);
}

/* Writes the expression as the body of a let that binds the part's parameters and numbers. A missing number becomes
 * NaN, so every comparison with it is false. */
static void put_row(FILE *to, const sweep_table *t, const sweep_part *p, const char *expression) {
  fputs("(let (", to);
  for (size_t i = 0; i < t->column_count; i++) {
    const char *value = sweep_value(p, t->columns[i]);
    fputc('[', to), put_name(to, t->columns[i]), fputc(' ', to);
    put_constant(to, value ? value : "+nan.0");
    fputs("] ", to);
  }
  for (size_t k = 0; k < t->number_count; k++) {
    double x = sweep_number_of(p, k);
    fputc('[', to), put_name(to, t->numbers[k]);
    if (isnan(x)) fputs(" +nan.0] ", to);
    else fprintf(to, " %.17g] ", x);
  }
  fprintf(to, ") %s)", expression);
}

/* Sets *yes to whether the expression is true for the part. Returns false after a message. */
static bool ask(vs_scheme *s, answer *a, const sweep_table *t, const sweep_part *p, const char *where, bool *yes) {
  char *expression = expression_of(where), *text = NULL;
  size_t size;
  FILE *to = expression ? open_memstream(&text, &size) : NULL;
  if (to) put_row(to, t, p, expression);
  free(expression);
  if (!to || fclose(to) != 0) return sweep_no_memory();
  *a = (answer){0};
  vs_outcome outcome = vs_eval_text(s, "--where", 1, text, size, VS_EVAL_PRINT);
  free(text);
  if (outcome != VS_OUTCOME_DONE) return fprintf(stderr, "vs sweep: --where %s: %s\n", where, a->message), false;
  *yes = strcmp(a->value, "#f") != 0;
  return true;
}

static bool filter(const sweep_table *t, const char *where, size_t *rows, size_t *count) {
  answer a = {0};
  vs_options o = vs_options_default();
  o.host = (vs_host){.context = &a, .diagnose = take_message, .value = take_value};
  vs_scheme *s = vs_new(&o);
  size_t kept = 0;
  bool ok = s != NULL || sweep_no_memory();
  for (size_t i = 0; ok && i < *count; i++) {
    bool yes = false;
    const sweep_part *p = &t->parts[rows[i]];
    ok = p->fate == SWEEP_FAILED || ask(s, &a, t, p, where, &yes);
    if (yes) rows[kept++] = rows[i];
  }
  vs_free(s);
  if (ok) *count = kept;
  return ok;
}

/* ---- --sort ---- */

/* The value of a row in the column by which rows are sorted: a number, otherwise a text. */
typedef struct { double number; const char *text; size_t row, place; } sorted;

static int by_value(const void *a, const void *b) {
  const sorted *x = a, *y = b;
  bool nx = !isnan(x->number), ny = !isnan(y->number);
  if (nx && ny && x->number != y->number) return x->number < y->number ? -1 : 1;
  if (nx != ny) return nx ? -1 : 1;
  int order = nx || !x->text || !y->text ? (x->text != NULL) < (y->text != NULL) ? 1 : 0 : strcmp(x->text, y->text);
  return order ? order : x->place < y->place ? -1 : x->place > y->place;
}

static bool has_column(const sweep_table *t, const char *name, size_t *number) {
  *number = SIZE_MAX;
  for (size_t i = 0; i < t->number_count; i++)
    if (!strcmp(t->numbers[i], name)) return *number = i, true;
  for (size_t i = 0; i < t->column_count; i++)
    if (!strcmp(t->columns[i], name)) return true;
  cli_nearby near = cli_nearby_start(name);
  for (size_t i = 0; i < t->number_count; i++) cli_nearby_offer(&near, t->numbers[i]);
  for (size_t i = 0; i < t->column_count; i++) cli_nearby_offer(&near, t->columns[i]);
  fprintf(stderr, "vs sweep: --sort %s: the sweep has no such number or parameter", name);
  if (near.best) fprintf(stderr, "; perhaps %s", near.best);
  fputc('\n', stderr);
  return false;
}

/* Sorts the rows by one column, and keeps the order of rows with equal values. Rows without a value are last. */
static bool sort_by(const sweep_table *t, const char *name, bool falling, size_t *rows, size_t count) {
  size_t column;
  sorted *at;
  if (!has_column(t, name, &column)) return false;
  if (!VS_FRESH(at, count)) return sweep_no_memory();
  for (size_t i = 0; i < count; i++) {
    const sweep_part *p = &t->parts[rows[i]];
    const char *text = column == SIZE_MAX ? sweep_value(p, name) : NULL;
    char *stop = NULL;
    double x = column != SIZE_MAX ? sweep_number_of(p, column) : text ? strtod(text, &stop) : NAN;
    if (stop && *stop) x = NAN;
    at[i] = (sorted){falling ? -x : x, text, rows[i], i};
  }
  qsort(at, count, sizeof *at, by_value);
  for (size_t i = 0; i < count; i++) rows[i] = at[i].row;
  free(at);
  return true;
}

/* Sorts by each column of "area,-cost", the last first, so that the first decides. */
static bool sort_rows(const sweep_table *t, const char *sort, size_t *rows, size_t count) {
  char *names = strdup(sort);
  bool ok = names != NULL || sweep_no_memory();
  while (ok) {
    char *comma = strrchr(names, ','), *name = comma ? comma + 1 : names;
    ok = sort_by(t, name + (*name == '-'), *name == '-', rows, count);
    if (!comma) break;
    *comma = 0;
  }
  free(names);
  return ok;
}

bool sweep_choose_rows(const sweep_table *t, const char *where, const char *sort, size_t *rows, size_t *count) {
  *count = 0;
  for (size_t i = 0; i < t->count; i++)
    if (t->parts[i].fate != SWEEP_NOT_TRIED) rows[(*count)++] = i;
  return (!where || filter(t, where, rows, count)) && (!sort || sort_rows(t, sort, rows, *count));
}
