/* Defines VS_ASSERT(condition). The condition must be true for every model; it is false only if the program itself has
 * a fault.
 *
 * VS_DEBUG enables the check; the Makefile's builds for tests define it. Otherwise the condition is compiled and not
 * evaluated. A false condition prints itself with its file and line, and aborts the process. A mistake of a user, a
 * file or a library is not asserted: it leads to an error message. */
#ifndef VS_MODEL_ASSERT_H
#define VS_MODEL_ASSERT_H

#ifdef VS_DEBUG
#include <stdio.h>
#include <stdlib.h>

static inline void vs_assert_fail(const char *condition, const char *file, int line) {
  fprintf(stderr, "%s:%d: this should hold: %s\n", file, line, condition);
  abort();
}
#define VS_ASSERT(condition) ((condition) ? (void)0 : vs_assert_fail(#condition, __FILE__, __LINE__))
#else
#define VS_ASSERT(condition) ((void)sizeof(!(condition)))
#endif

#endif
