/* Reads JSON by the library jansson. Inline functions of its header that need the library are not used: they would
 * require the library when the program is linked. */
#include "cli/lsp/json_input.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

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
  F(real, json_number_value, double, (const json_t *))                               \
  F(iterate, json_object_iter, void *, (json_t *))                                   \
  F(next, json_object_iter_next, void *, (json_t *, void *))                         \
  F(key, json_object_iter_key, const char *, (void *))                               \
  F(value, json_object_iter_value, json_t *, (void *))
VS_DYNAMIC_FUNCTIONS(FUNCTIONS);

bool lsp_json_open(lsp_json_reader *r) {
  vs_error e = { 0 };
  *r = (lsp_json_reader){ .functions = vs_zeros(1, sizeof(dynamic_functions)) };
  if (r->functions && vs_dynamic_load(&vs_json_library, dynamic_names, sizeof dynamic_names / sizeof *dynamic_names,
                                      r->functions, &e)) return true;
  snprintf(r->trouble, sizeof r->trouble, "%s", r->functions ? e.message : "out of memory");
  return false;
}

void lsp_json_close(lsp_json_reader *r) {
  free(r->functions);
  r->functions = NULL;
}

static const dynamic_functions *of(const lsp_json_reader *r) { return r->functions; }

lsp_json lsp_json_read(lsp_json_reader *r, const char *text, size_t length) {
  json_error_t wrong;
  return of(r)->load(text, length, JSON_DECODE_ANY, &wrong);
}

void lsp_json_free(lsp_json_reader *r, lsp_json value) {
  if (value && value->refcount != (size_t)-1 && --value->refcount == 0) of(r)->discard(value);
}

lsp_json lsp_json_at(const lsp_json_reader *r, lsp_json value, const char *path) {
  char name[80];
  while (value && *path) {
    size_t n = strcspn(path, ".");
    snprintf(name, sizeof name, "%.*s", (int)n, path);
    value = json_is_object(value) ? of(r)->get(value, name) : NULL;
    path += n + (path[n] == '.');
  }
  return value;
}

size_t lsp_json_count(const lsp_json_reader *r, lsp_json array) {
  return array && json_is_array(array) ? of(r)->count(array) : 0;
}

lsp_json lsp_json_nth(const lsp_json_reader *r, lsp_json array, size_t nth) { return of(r)->nth(array, nth); }

const char *lsp_json_text(const lsp_json_reader *r, lsp_json value, const char *path, size_t *length) {
  value = lsp_json_at(r, value, path);
  if (!value || !json_is_string(value)) return NULL;
  if (length) *length = of(r)->length(value);
  return of(r)->text(value);
}

long long lsp_json_number(const lsp_json_reader *r, lsp_json value, const char *path, long long otherwise) {
  value = lsp_json_at(r, value, path);
  return value && json_is_integer(value) ? of(r)->number(value) : otherwise;
}

lsp_json lsp_json_member(const lsp_json_reader *r, lsp_json object, size_t nth, const char **name) {
  void *at = object && json_is_object(object) ? of(r)->iterate(object) : NULL;
  for (; at && nth > 0; nth--) at = of(r)->next(object, at);
  if (!at) return NULL;
  *name = of(r)->key(at);
  return of(r)->value(at);
}

bool lsp_json_is_number(const lsp_json_reader *r, lsp_json value, double *out) {
  if (!value || !json_is_number(value)) return false;
  *out = of(r)->real(value);
  return true;
}

bool lsp_json_is_truth(lsp_json value, bool *out) {
  if (!value || !json_is_boolean(value)) return false;
  *out = json_is_true(value);
  return true;
}

bool lsp_json_true(const lsp_json_reader *r, lsp_json value, const char *path) {
  return json_is_true(lsp_json_at(r, value, path));
}

void lsp_json_echo(const lsp_json_reader *r, lsp_json value, FILE *to) {
  if (value && json_is_integer(value)) fprintf(to, "%lld", (long long)of(r)->number(value));
  else if (value && json_is_string(value)) know_json_text(to, of(r)->text(value), of(r)->length(value));
  else fputs("null", to);
}
