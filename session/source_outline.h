/* Declares functions that find top-level definitions and the parts of calls in a source text, for messages. Implemented
 * in source_outline.c. */
#ifndef VS_SESSION_SOURCE_OUTLINE_H
#define VS_SESSION_SOURCE_OUTLINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
  const char *name;   /* name in the source text, not terminated by NUL */
  size_t length;
  uint32_t line;      /* line of the definition; the first line of the text is 1 */
  bool procedure;     /* whether the definition is that of a procedure: (define (name ...) ...) or (define name (lambda
                       * ...)) */
} vs_outline_item;

/* Calls `each` for every top-level definition of the text, in order, until it returns false. Definitions are define,
 * define-parameter, define-syntax and the like. */
void vs_outline_each(const char *text, size_t length, bool (*each)(void *context, const vs_outline_item *item),
    void *context);

/* Returns the first place from `at` that is neither blank nor in a comment. Adds the number of line ends before that
 * place to *line. */
const char *vs_outline_blanks(const char *at, const char *end, uint32_t *line);
/* Returns the end of the datum that begins at `at`. Returns `end` if no datum begins there, or the datum is not
 * closed. */
const char *vs_outline_datum(const char *at, const char *end, uint32_t *line);
/* Returns the length of the word at `at`, which ends before a blank, parenthesis, quote or comment. */
size_t vs_outline_word(const char *at, const char *end);

#endif
