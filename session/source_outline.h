/* Owns looking at a source text as it was written, for messages: where its top-level definitions stand, and what
 * forms a call is made of. */
#ifndef VS_SESSION_SOURCE_OUTLINE_H
#define VS_SESSION_SOURCE_OUTLINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
  const char *name;   /* in the text, not ended by a NUL */
  size_t length;
  uint32_t line;      /* of the definition, counted from the text's own first line as 1 */
  bool procedure;     /* (define (name ...) ...) or (define name (lambda ...)) */
} vs_outline_item;

/* Hands every top-level definition of the text (define, define-parameter, define-syntax and the like) to `each`, in
 * order, until it returns false. */
void vs_outline_each(const char *text, size_t length, bool (*each)(void *context, const vs_outline_item *item),
    void *context);

/* Skips blanks and comments from `at`; *line counts newlines that were passed. */
const char *vs_outline_blanks(const char *at, const char *end, uint32_t *line);
/* Skips one datum from `at`, which is not blank. The end where none begins there or it is not closed. */
const char *vs_outline_datum(const char *at, const char *end, uint32_t *line);
/* The length of the word at `at`: up to a blank, a parenthesis, a quote or a comment. */
size_t vs_outline_word(const char *at, const char *end);

#endif
