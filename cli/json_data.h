/* Declares the reading of JSON by the library jansson, which is loaded at its first use. */
#ifndef VS_CLI_JSON_DATA_H
#define VS_CLI_JSON_DATA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

struct json_t;
typedef struct json_t *cli_data; /* a value of a JSON text, or NULL: there is none */

typedef struct { void *functions; char trouble[600]; } cli_data_reader;

/* Loads the library. Returns false, with the reason in r->trouble, if it is missing. */
bool cli_data_open(cli_data_reader *r);
void cli_data_close(cli_data_reader *r);
/* Returns the value of the text, or NULL if it is no JSON. cli_data_free frees it. */
cli_data cli_data_read(cli_data_reader *r, const char *text, size_t length);
void cli_data_free(cli_data_reader *r, cli_data value);
/* Returns the member at a path of names with dots, such as "position.line", or NULL. */
cli_data cli_data_at(const cli_data_reader *r, cli_data value, const char *path);
size_t cli_data_count(const cli_data_reader *r, cli_data array); /* returns 0 for NULL */
cli_data cli_data_nth(const cli_data_reader *r, cli_data array, size_t nth);
/* Returns the text at the path, or NULL. It lives as long as the value. */
const char *cli_data_text(const cli_data_reader *r, cli_data value, const char *path, size_t *length);
/* Returns the whole number at the path, or `otherwise`. */
long long cli_data_number(const cli_data_reader *r, cli_data value, const char *path, long long otherwise);
double cli_data_real(const cli_data_reader *r, cli_data value, const char *path, double otherwise); /* returns the
                                                                                                     * number at the
                                                                                                     * path, which need
                                                                                                     * not be whole */
bool cli_data_true(const cli_data_reader *r, cli_data value, const char *path); /* returns whether the value at the path
                                                                                 * is `true` */
/* Returns true, and sets *out, if the value is a number. */
bool cli_data_is_number(const cli_data_reader *r, cli_data value, double *out);
/* Returns true if the value is true or false, and sets *out. */
bool cli_data_is_truth(cli_data value, bool *out);
/* Writes a number or a text as it was read, and null for any other value. */
void cli_data_echo(const cli_data_reader *r, cli_data value, FILE *to);
/* Writes a number, true or false as a datum of the language. Returns false for any other value. */
bool cli_data_put_datum(const cli_data_reader *r, cli_data value, FILE *to);
bool cli_data_same(const cli_data_reader *r, cli_data a, cli_data b); /* compares numbers and texts */

/* A member of a JSON object. cli_data_first returns the first. */
typedef void *cli_data_member;
cli_data_member cli_data_first(const cli_data_reader *r, cli_data object); /* returns NULL if the object is empty */
cli_data_member cli_data_next(const cli_data_reader *r, cli_data object, cli_data_member m);
const char *cli_data_key(const cli_data_reader *r, cli_data_member m);
cli_data cli_data_value(const cli_data_reader *r, cli_data_member m);

#endif
