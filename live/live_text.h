/* Declares text that grows, and the JSON form of strings. */
#ifndef VS_LIVE_LIVE_TEXT_H
#define VS_LIVE_LIVE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A text that grows. {0} is an empty text. `at` is NULL or ends in NUL. room: allocated bytes. */
typedef struct { char *at; size_t length, room; bool failed; } live_text;

void live_add(live_text *t, const void *bytes, size_t length); /* appends bytes; if memory is out, sets t->failed, and
                                                                * ignores all later additions */
void live_puts(live_text *t, const char *text);
void live_putf(live_text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
void live_json(live_text *t, const char *text); /* appends a string, quoted and escaped; NULL becomes null */
void live_json_bytes(live_text *t, const char *text, size_t length);
void live_number(live_text *t, double x); /* appends a number; an infinity, which JSON does not have, becomes null */
void live_text_free(live_text *t);

#endif
