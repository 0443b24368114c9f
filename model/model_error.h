/* Owns the errors that C layers return, and the origins in the user's text to which they refer. */
#ifndef VS_MODEL_MODEL_ERROR_H
#define VS_MODEL_MODEL_ERROR_H

#include <stdbool.h>
#include <stdint.h>

/* A call in a text, and the call that led to it: interned chains, owned by the store. */
typedef struct vs_origin vs_origin;
struct vs_origin {
  const char *file; /* interned in the store */
  uint32_t line, column; /* from 1 */
  const vs_origin *caller; /* the call that led here, or NULL */
};

/* An error: one message, and its place in the user's model (NULL: none). */
typedef enum {
  VS_ERROR_NONE,
  VS_ERROR_MODEL /* exit 1 */,
  VS_ERROR_FILE /* 2 */,
  VS_ERROR_WORKER /* 3 */,
  VS_ERROR_MEMORY /* 4 */,
  VS_ERROR_INTERRUPT /* 130 */
} vs_error_kind;
typedef struct {
  vs_error_kind kind;
  const vs_origin *origin;
  char message[512]; /* UTF-8, cut at a character */
} vs_error;
/* Fills e (may be NULL) and returns false, so that callers may write `return vs_error_set(...)`. */
bool vs_error_set(vs_error *e, vs_error_kind kind, const vs_origin *origin, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool vs_error_memory(vs_error *e, const vs_origin *origin); /* the same, "out of memory" */

#endif
