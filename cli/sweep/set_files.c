/* Reads sets of parameters: a CSV file with the parameters' names in its first row, or JSON as the live view saves it,
 * a list of objects, or the customizer's file of OpenSCAD. */
#define _GNU_SOURCE
#include "cli/sweep/set_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli/lsp/json_input.h"
#include "model/store/array.h"

static bool ends_in(const char *text, const char *ending) {
  size_t n = strlen(text), e = strlen(ending);
  return n > e && !strcasecmp(text + n - e, ending);
}

bool sweep_is_set_file(const char *text) {
  return !strchr(text, '=') && (ends_in(text, ".csv") || ends_in(text, ".json"));
}

static bool wrong(const char *path, size_t line, const char *why) {
  if (line) fprintf(stderr, "vs sweep: %s:%zu: %s\n", path, line, why);
  else fprintf(stderr, "vs sweep: %s: %s\n", path, why);
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
  if (!ok) fprintf(stderr, "vs sweep: %s: %s\n", path, f && !text ? "out of memory" : strerror(errno));
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
  char *cell; size_t length, room; /* the last cell */
  bool ends_row;        /* whether the last cell was the last of its row */
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
static char *value_text(const lsp_json_reader *r, sweep_memory *m, const char *path, const char *name, lsp_json value) {
  char number[40];
  double x;
  bool truth;
  size_t length;
  const char *text = lsp_json_text(r, value, "", &length);
  if (text) return sweep_keep_text(m, text, length);
  if (lsp_json_is_truth(value, &truth)) return sweep_keep_text(m, truth ? "#t" : "#f", 2);
  if (lsp_json_is_number(r, value, &x)) {
    for (int digits = 15; digits <= 17; digits++) {
      sweep_write_number(x, digits, number);
      if (strtod(number, NULL) == x) break;
    }
    return sweep_keep_text(m, number, strlen(number));
  }
  fprintf(stderr, "vs sweep: %s: the value of %s is neither a number, a text nor a truth value\n", path, name);
  return NULL;
}

static bool is_object(const lsp_json_reader *r, lsp_json value) {
  const char *name;
  return lsp_json_member(r, value, 0, &name) != NULL;
}

static bool put_object(const lsp_json_reader *r, sweep_memory *m, const char *path, lsp_json object, sweep_axis *axis) {
  size_t count = 0;
  const char *name;
  lsp_json value;
  while (lsp_json_member(r, object, count, &name)) count++;
  if (!count)
    return wrong(path, 0, "a set has no parameters: expected a list of objects such as [{\"n\": 1}, {\"n\": 2}]");
  sweep_setting *at = sweep_keep(m, count, sizeof *at);
  for (size_t i = 0; at && (value = lsp_json_member(r, object, i, &name)) != NULL; i++) {
    at[i].name = sweep_keep_text(m, name, strlen(name));
    at[i].value = at[i].name ? value_text(r, m, path, name, value) : NULL;
    if (!at[i].value) return false;
  }
  return at && sweep_axis_put(axis, (sweep_set){at, count});
}

/* A list of sets, an object of named sets, or one set. OpenSCAD's customizer keeps named sets in "parameterSets". */
static bool put_sets(const lsp_json_reader *r, sweep_memory *m, const char *path, lsp_json whole, sweep_axis *axis) {
  const char *name;
  lsp_json scad = lsp_json_at(r, whole, "parameterSets"), sets = scad ? scad : whole, one;
  bool ok = true;
  if (lsp_json_count(r, sets)) {
    for (size_t i = 0; ok && i < lsp_json_count(r, sets); i++)
      ok = put_object(r, m, path, lsp_json_nth(r, sets, i), axis);
    return ok;
  }
  lsp_json first = lsp_json_member(r, sets, 0, &name);
  if (!first || !is_object(r, first)) return put_object(r, m, path, sets, axis);
  for (size_t i = 0; ok && (one = lsp_json_member(r, sets, i, &name)) != NULL; i++)
    ok = put_object(r, m, path, one, axis);
  return ok;
}

static bool read_json(sweep_memory *m, const char *path, const char *text, size_t length, sweep_axis *axis) {
  lsp_json_reader r;
  if (!lsp_json_open(&r)) return lsp_json_close(&r), wrong(path, 0, r.trouble);
  lsp_json whole = lsp_json_read(&r, text, length);
  bool ok = whole ? put_sets(&r, m, path, whole, axis) : wrong(path, 0, "the text is not JSON");
  lsp_json_free(&r, whole);
  lsp_json_close(&r);
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
