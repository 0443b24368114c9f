/* Reads JSON by the library jansson. Inline functions of its header that need the library are not used: they would
 * require the library when the program is linked. */
#include "cli/json_data.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "cli/json.h"
#include "geometry/dynamic.h"
#include "languages/analysis/notation.h"
#include "model/store/array.h"

#define FUNCTIONS(F)                                                                 \
  F(load, json_loadb, json_t *, (const char *, size_t, size_t, json_error_t *))      \
  F(discard, json_delete, void, (json_t *))                                          \
  F(get, json_object_get, json_t *, (const json_t *, const char *))                  \
  F(count, json_array_size, size_t, (const json_t *))                                \
  F(nth, json_array_get, json_t *, (const json_t *, size_t))                         \
  F(text, json_string_value, const char *, (const json_t *))                         \
  F(length, json_string_length, size_t, (const json_t *))                            \
  F(number, json_integer_value, json_int_t, (const json_t *))                        \
  F(real, json_real_value, double, (const json_t *))                                 \
  F(first, json_object_iter, void *, (json_t *))                                     \
  F(next, json_object_iter_next, void *, (json_t *, void *))                         \
  F(key, json_object_iter_key, const char *, (void *))                               \
  F(value, json_object_iter_value, json_t *, (void *))
VS_DYNAMIC_FUNCTIONS(FUNCTIONS);

bool cli_data_open(cli_data_reader *r) {
  vs_error e = { 0 };
  *r = (cli_data_reader){ .functions = vs_zeros(1, sizeof(dynamic_functions)) };
  if (r->functions && vs_dynamic_load(VS_LIBRARY_JANSSON, "JSON", dynamic_names,
                                      sizeof dynamic_names / sizeof *dynamic_names, r->functions, &e))
    return true;
  snprintf(r->trouble, sizeof r->trouble, "%s", r->functions ? e.message : "out of memory");
  return false;
}

void cli_data_close(cli_data_reader *r) {
  free(r->functions);
  r->functions = NULL;
}

static const dynamic_functions *of(const cli_data_reader *r) { return r->functions; }

cli_data cli_data_read(cli_data_reader *r, const char *text, size_t length) {
  json_error_t wrong;
  return of(r)->load(text, length, JSON_DECODE_ANY, &wrong);
}

void cli_data_free(cli_data_reader *r, cli_data value) {
  if (value && value->refcount != (size_t)-1 && --value->refcount == 0) of(r)->discard(value);
}

cli_data cli_data_at(const cli_data_reader *r, cli_data value, const char *path) {
  char name[80];
  while (value && *path) {
    size_t n = strcspn(path, ".");
    snprintf(name, sizeof name, "%.*s", (int)n, path);
    value = json_is_object(value) ? of(r)->get(value, name) : NULL;
    path += n + (path[n] == '.');
  }
  return value;
}

size_t cli_data_count(const cli_data_reader *r, cli_data array) {
  return array && json_is_array(array) ? of(r)->count(array) : 0;
}

cli_data cli_data_nth(const cli_data_reader *r, cli_data array, size_t nth) { return of(r)->nth(array, nth); }

const char *cli_data_text(const cli_data_reader *r, cli_data value, const char *path, size_t *length) {
  value = cli_data_at(r, value, path);
  if (!value || !json_is_string(value)) return NULL;
  if (length) *length = of(r)->length(value);
  return of(r)->text(value);
}

long long cli_data_number(const cli_data_reader *r, cli_data value, const char *path, long long otherwise) {
  value = cli_data_at(r, value, path);
  return value && json_is_integer(value) ? of(r)->number(value) : otherwise;
}

bool cli_data_true(const cli_data_reader *r, cli_data value, const char *path) {
  return json_is_true(cli_data_at(r, value, path));
}

bool cli_data_is_number(const cli_data_reader *r, cli_data value, double *out) {
  if (!value || !json_is_number(value)) return false;
  *out = cli_data_real(r, value, "", 0);
  return true;
}

bool cli_data_is_truth(cli_data value, bool *out) {
  if (!value || !json_is_boolean(value)) return false;
  *out = json_is_true(value);
  return true;
}

void cli_data_echo(const cli_data_reader *r, cli_data value, FILE *to) {
  if (value && json_is_integer(value)) fprintf(to, "%lld", (long long)of(r)->number(value));
  else if (value && json_is_string(value)) know_json_text(to, of(r)->text(value), of(r)->length(value));
  else fputs("null", to);
}

double cli_data_real(const cli_data_reader *r, cli_data value, const char *path, double otherwise) {
  value = cli_data_at(r, value, path);
  if (value && json_is_real(value)) return of(r)->real(value);
  return value && json_is_integer(value) ? (double)of(r)->number(value) : otherwise;
}

bool cli_data_put_datum(const cli_data_reader *r, cli_data value, FILE *to) {
  if (value && json_is_integer(value)) fprintf(to, "%lld", (long long)of(r)->number(value));
  else if (value && json_is_real(value)) cli_json_number(to, of(r)->real(value));
  else if (value && json_is_boolean(value)) fputs(json_is_true(value) ? "#t" : "#f", to);
  else return false;
  return true;
}

bool cli_data_same(const cli_data_reader *r, cli_data a, cli_data b) {
  if (!a || !b) return false;
  if (json_is_integer(a) && json_is_integer(b)) return of(r)->number(a) == of(r)->number(b);
  return json_is_string(a) && json_is_string(b) && !strcmp(of(r)->text(a), of(r)->text(b));
}

cli_data_member cli_data_first(const cli_data_reader *r, cli_data object) {
  return object && json_is_object(object) ? of(r)->first(object) : NULL;
}

cli_data_member cli_data_next(const cli_data_reader *r, cli_data object, cli_data_member m) {
  return of(r)->next(object, m);
}

const char *cli_data_key(const cli_data_reader *r, cli_data_member m) { return of(r)->key(m); }

cli_data cli_data_value(const cli_data_reader *r, cli_data_member m) { return of(r)->value(m); }
