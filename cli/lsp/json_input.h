/* Declares the reading of JSON by the library jansson, which is loaded at its first use. */
#ifndef VS_CLI_LSP_JSON_INPUT_H
#define VS_CLI_LSP_JSON_INPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct json_t;
typedef struct json_t *lsp_json; /* a value of a JSON text, or NULL: there is none */

typedef struct { void *functions; char trouble[600]; } lsp_json_reader;

/* Loads the library. Returns false, with the reason in r->trouble, if it is missing. */
bool lsp_json_open(lsp_json_reader *r);
void lsp_json_close(lsp_json_reader *r);
/* Returns the value of the text, or NULL if it is no JSON. lsp_json_free frees it. */
lsp_json lsp_json_read(lsp_json_reader *r, const char *text, size_t length);
void lsp_json_free(lsp_json_reader *r, lsp_json value);
/* Returns the member at a path of names with dots, such as "position.line", or NULL. */
lsp_json lsp_json_at(const lsp_json_reader *r, lsp_json value, const char *path);
size_t lsp_json_count(const lsp_json_reader *r, lsp_json array); /* returns 0 for NULL */
lsp_json lsp_json_nth(const lsp_json_reader *r, lsp_json array, size_t nth);
/* Returns the text at the path, or NULL. It lives as long as the value. */
const char *lsp_json_text(const lsp_json_reader *r, lsp_json value, const char *path, size_t *length);
/* Returns the whole number at the path, or `otherwise` if there is none. */
long long lsp_json_number(const lsp_json_reader *r, lsp_json value, const char *path, long long otherwise);
bool lsp_json_true(const lsp_json_reader *r, lsp_json value, const char *path); /* returns whether `true` is there */
/* Returns the nth member of an object, in the order of the text, and sets *name; NULL after the last. */
lsp_json lsp_json_member(const lsp_json_reader *r, lsp_json object, size_t nth, const char **name);
/* Returns true, and sets *out, if the value is a number. */
bool lsp_json_is_number(const lsp_json_reader *r, lsp_json value, double *out);
/* Returns true if the value is true or false, and sets *out. */
bool lsp_json_is_truth(lsp_json value, bool *out);
/* Writes the value to the stream if it is a number or a text, as it was read; writes null for any other value. */
void lsp_json_echo(const lsp_json_reader *r, lsp_json value, FILE *to);

#endif
