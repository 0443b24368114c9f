/* Reads sets of parameters: a CSV file with the parameters' names in its first row, or JSON as the live view saves it,
 * a list of objects, or the customizer's file of OpenSCAD. */
#define _GNU_SOURCE
#include "cli/sweep/set_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/json_data.h"
#include "model/store/array.h"

static bool ends_in(const char *text, const char *ending) {
  size_t n = strlen(text), e = strlen(ending);
  return n > e && !strcasecmp(text + n - e, ending);
}

bool sweep_is_set_file(const char *text) {
  return !strchr(text, '=') && (ends_in(text, ".csv") || ends_in(text, ".json"));
}

static bool wrong(const char *path, size_t line, const char *why) {
  if (line) fprintf(stderr, "vs: %s:%zu: %s\n", path, line, why);
  else fprintf(stderr, "vs: %s: %s\n", path, why);
  return false;
}

/* Returns the text of the file, which the caller frees, or NULL after a message. */
static char *read_text(const char *path, size_t *length) {
  FILE *f = fopen(path, "rb");
  char *text = NULL;
  size_t room = 0;
  *length = 0;
  while (f && VS_GROW(text, room, *length + (1 << 14))) {
    size_t n = fread(text + *length, 1, room - *length - 1, f);
    *length += n;
    if (n == 0) break;
  }
  bool ok = f && text && !ferror(f);
  if (!ok) fprintf(stderr, "vs: %s: %s\n", path, f && !text ? "out of memory" : strerror(errno));
  else text[*length] = 0;
  if (f) fclose(f);
  if (!ok) free(text), text = NULL;
  return text;
}

/* ---- CSV (RFC 4180) ---- */

typedef struct {
  const char *path, *at, *end;
  size_t line;          /* number of the current line, from 1 */
  char comma;           /* the separator: a comma, or a semicolon if the first row has more of these */
  char *cell; size_t length, room; /* text of the cell that was read last */
  bool ends_row;        /* whether the cell that was read last ends its row */
} csv;

static bool put_byte(csv *c, char byte) {
  if (!VS_GROW(c->cell, c->room, c->length + 2)) return sweep_no_memory();
  c->cell[c->length++] = byte;
  return true;
}

/* Reads the next cell; the text is not at its end. Returns false after a message. */
static bool read_cell(csv *c) {
  size_t began = c->line;
  bool quoted = *c->at == '"';
  c->length = 0;
  if (quoted) c->at++;
  while (c->at < c->end) {
    char byte = *c->at;
    if (quoted && byte == '"' && c->at + 1 < c->end && c->at[1] == '"') c->at++;
    else if (quoted && byte == '"') {
      quoted = false, c->at++;
      continue;
    } else if (!quoted && (byte == c->comma || byte == '\n' || byte == '\r')) break;
    if (byte == '\n') c->line++;
    if (!put_byte(c, byte)) return false;
    c->at++;
  }
  if (quoted) return wrong(c->path, began, "a cell has no closing quotation mark");
  if (!put_byte(c, 0)) return false;
  c->length--;
  c->ends_row = c->at == c->end || *c->at != c->comma;
  if (c->at < c->end && *c->at == c->comma) c->at++;
  else {
    if (c->at < c->end && *c->at == '\r') c->at++;
    if (c->at < c->end && *c->at == '\n') c->at++;
    c->line++;
  }
  return true;
}

static char separator_of(const char *text) {
  size_t commas = 0, semicolons = 0;
  for (; *text && *text != '\n'; text++) commas += *text == ',', semicolons += *text == ';';
  return semicolons > commas ? ';' : ',';
}

/* Reads the names of the first row. */
static bool read_head(csv *c, sweep_memory *m, const char ***names, size_t *count) {
  size_t room = 0;
  do {
    if (!read_cell(c)) return false;
    if (!c->length) return wrong(c->path, 1, "a column has no name");
    if (!VS_GROW(*names, room, *count + 1)) return sweep_no_memory();
    if (!((*names)[*count] = sweep_keep_text(m, c->cell, c->length))) return false;
    for (size_t i = 0; i < *count; i++)
      if (!strcmp((*names)[i], (*names)[*count])) return wrong(c->path, 1, "two columns have one name");
    ++*count;
  } while (!c->ends_row);
  return true;
}

/* Reads a row. An empty cell leaves its parameter at the model's value; an empty line is no row. */
static bool read_row(csv *c, sweep_memory *m, const char **names, size_t count, sweep_axis *axis) {
  size_t line = c->line, cells = 0;
  sweep_setting *at = sweep_keep(m, count, sizeof *at);
  sweep_set set = {at, 0};
  if (!at) return false;
  do {
    if (!read_cell(c)) return false;
    if (cells == count) return wrong(c->path, line, "the row has more cells than the first row");
    if (c->length) {
      char *value = sweep_keep_text(m, c->cell, c->length);
      if (!value) return false;
      at[set.count++] = (sweep_setting){names[cells], value};
    }
    cells++;
  } while (!c->ends_row);
  if (cells == 1 && !set.count) return true;
  if (cells < count) return wrong(c->path, line, "the row has fewer cells than the first row");
  return sweep_axis_put(axis, set);
}

static bool read_csv(sweep_memory *m, const char *path, char *text, size_t length, sweep_axis *axis) {
  size_t mark = length >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3) ? 3 : 0; /* spreadsheets begin with a byte order mark */
  csv c = {.path = path, .at = text + mark, .end = text + length, .line = 1, .comma = separator_of(text)};
  const char **names = NULL;
  size_t count = 0;
  bool ok = c.at < c.end ? read_head(&c, m, &names, &count) : wrong(path, 0, "the file is empty");
  while (ok && c.at < c.end) {
    ok = read_row(&c, m, names, count, axis);
    if (ok && axis->count > SWEEP_MOST) ok = wrong(path, 0, "the file has more than 100000 rows");
  }
  free(names), free(c.cell);
  return ok;
}

/* ---- JSON ---- */

/* Returns the value as text for -D, or NULL after a message. */
static char *value_text(const cli_data_reader *r, sweep_memory *m, const char *path, const char *name, cli_data value) {
  char number[40];
  double x;
  bool truth;
  size_t length;
  const char *text = cli_data_text(r, value, "", &length);
  if (text) return sweep_keep_text(m, text, length);
  if (cli_data_is_truth(value, &truth)) return sweep_keep_text(m, truth ? "#t" : "#f", 2);
  if (cli_data_is_number(r, value, &x)) {
    for (int digits = 15; digits <= 17; digits++) {
      sweep_write_number(x, digits, number);
      if (strtod(number, NULL) == x) break;
    }
    return sweep_keep_text(m, number, strlen(number));
  }
  fprintf(stderr, "vs: %s: the value of %s is neither a number, a text nor a truth value\n", path, name);
  return NULL;
}

static bool put_object(const cli_data_reader *r, sweep_memory *m, const char *path, cli_data object, sweep_axis *axis) {
  size_t count = 0;
  for (cli_data_member k = cli_data_first(r, object); k; k = cli_data_next(r, object, k)) count++;
  if (!count)
    return wrong(path, 0, "a set has no parameters: expected a list of objects such as [{\"n\": 1}, {\"n\": 2}]");
  sweep_setting *at = sweep_keep(m, count, sizeof *at);
  size_t i = 0;
  for (cli_data_member k = cli_data_first(r, object); at && k; k = cli_data_next(r, object, k), i++) {
    const char *name = cli_data_key(r, k);
    at[i].name = sweep_keep_text(m, name, strlen(name));
    at[i].value = at[i].name ? value_text(r, m, path, name, cli_data_value(r, k)) : NULL;
    if (!at[i].value) return false;
  }
  return at && sweep_axis_put(axis, (sweep_set){at, count});
}

/* Adds the sets of a JSON value: a list of sets, an object of named sets, or a single set. OpenSCAD's customizer keeps
 * named sets in "parameterSets". */
static bool put_sets(const cli_data_reader *r, sweep_memory *m, const char *path, cli_data whole, sweep_axis *axis) {
  cli_data scad = cli_data_at(r, whole, "parameterSets"), sets = scad ? scad : whole;
  bool ok = true;
  if (cli_data_count(r, sets)) {
    for (size_t i = 0; ok && i < cli_data_count(r, sets); i++)
      ok = put_object(r, m, path, cli_data_nth(r, sets, i), axis);
    return ok;
  }
  cli_data_member first = cli_data_first(r, sets);
  if (!first || !cli_data_first(r, cli_data_value(r, first))) return put_object(r, m, path, sets, axis);
  for (cli_data_member k = first; ok && k; k = cli_data_next(r, sets, k))
    ok = put_object(r, m, path, cli_data_value(r, k), axis);
  return ok;
}

static bool read_json(sweep_memory *m, const char *path, const char *text, size_t length, sweep_axis *axis) {
  cli_data_reader r;
  if (!cli_data_open(&r)) return cli_data_close(&r), wrong(path, 0, r.trouble);
  cli_data whole = cli_data_read(&r, text, length);
  bool ok = whole ? put_sets(&r, m, path, whole, axis) : wrong(path, 0, "the text is not JSON");
  cli_data_free(&r, whole);
  cli_data_close(&r);
  return ok;
}

static const char *text_of(sweep_memory *m, const char *path, const sweep_set *set) {
  char *text = NULL;
  size_t size = 0;
  FILE *to = open_memstream(&text, &size);
  if (!to) return sweep_no_memory(), NULL;
  bool comma = false;
  for (size_t i = 0; i < set->count; i++) {
    fprintf(to, "%s%s=%s", i ? "," : "", set->at[i].name, set->at[i].value);
    comma = comma || strchr(set->at[i].value, ',');
  }
  const char *kept = fclose(to) == 0 ? sweep_keep_text(m, text, size) : NULL;
  free(text);
  return comma ? wrong(path, 0, "vs render has no values with commas; vs sweep does"), NULL : kept;
}

bool sweep_set_file_texts(sweep_memory *m, const char *path, const char ***sets, size_t *count) {
  sweep_axis axis = {0};
  bool ok = sweep_set_file_read(m, path, &axis);
  const char **all = ok ? sweep_keep(m, *count + axis.count + 1, sizeof *all) : NULL;
  for (size_t i = 0; all && i < *count; i++) all[i] = (*sets)[i];
  ok = all != NULL;
  for (size_t i = 0; ok && i < axis.count; i++)
    ok = !axis.sets[i].count || (all[(*count)++] = text_of(m, path, &axis.sets[i])) != NULL;
  if (ok) *sets = all;
  free(axis.sets);
  return ok;
}

bool sweep_set_file_read(sweep_memory *m, const char *path, sweep_axis *axis) {
  size_t length;
  char *text = read_text(path, &length);
  if (!text) return false;
  bool ok = ends_in(path, ".csv") ? read_csv(m, path, text, length, axis) : read_json(m, path, text, length, axis);
  free(text);
  return ok && (axis->count > 0 || wrong(path, 0, "the file has no sets of parameters"));
}
