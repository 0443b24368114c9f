/* Owns the interface of source_outline.c: for messages, the places of a text's top-level definitions, and the forms of
 * a call. */
#ifndef VS_SESSION_SOURCE_OUTLINE_H
#define VS_SESSION_SOURCE_OUTLINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
  const char *name;   /* in the text, without a NUL */
  size_t length;
  uint32_t line;      /* the line of the definition, with the text's own first line as 1 */
  bool procedure;     /* (define (name ...) ...) or (define name (lambda ...)) */
} vs_outline_item;

/* Passes every top-level definition of the text (define, define-parameter, define-syntax and the like) to `each`, in
 * order, until it returns false. */
void vs_outline_each(const char *text, size_t length, bool (*each)(void *context, const vs_outline_item *item),
    void *context);

/* Skips blanks and comments from `at`; adds the passed newlines to *line. */
const char *vs_outline_blanks(const char *at, const char *end, uint32_t *line);
/* Skips one datum from `at`, which is not blank. Returns the end if no datum begins there or it is not closed. */
const char *vs_outline_datum(const char *at, const char *end, uint32_t *line);
/* Returns the length of the word at `at`: up to a blank, a parenthesis, a quote or a comment. */
size_t vs_outline_word(const char *at, const char *end);

#endif
