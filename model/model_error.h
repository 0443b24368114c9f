/* Declares the errors that C layers return, and the places in the user's text to which they refer. */
#ifndef VS_MODEL_MODEL_ERROR_H
#define VS_MODEL_MODEL_ERROR_H

#include <stdbool.h>
#include <stdint.h>

/* The place of a call in the user's text, with a pointer to the call that led to it. The store owns these places; equal
 * places have one address. */
typedef struct vs_origin vs_origin;
struct vs_origin {
  const char *file; /* file name, interned in the store */
  uint32_t line, column; /* line and column, both counted from 1 */
  const vs_origin *caller; /* call in the user's text that led to this call, or NULL */
};

/* The kind of an error. */
typedef enum {
  VS_ERROR_NONE,
  VS_ERROR_MODEL /* the user's model is wrong; exit status of vs: 1 */,
  VS_ERROR_FILE /* a file cannot be read or written; exit status 2 */,
  VS_ERROR_WORKER /* an external program failed; exit status 3 */,
  VS_ERROR_MEMORY /* memory is out, by malloc or by the limit on memory; exit status 4 */,
  VS_ERROR_LIMIT /* another limit was reached: triangles or seconds; exit status 4 */,
  VS_ERROR_INTERRUPT /* interrupted by the user or a time limit; exit status 130 */
} vs_error_kind;
typedef struct {
  vs_error_kind kind;
  const vs_origin *origin;
  char message[512]; /* text of the message in UTF-8; a long message is cut between two characters */
} vs_error;
/* Sets e, which may be NULL, to an error. Returns false, so that callers may write `return vs_error_set(...)`. */
bool vs_error_set(vs_error *e, vs_error_kind kind, const vs_origin *origin, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
bool vs_error_memory(vs_error *e, const vs_origin *origin); /* Sets e to the error "out of memory"; returns false. */

#endif
