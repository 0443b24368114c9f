/* Owns VS_ASSERT(condition): a condition that holds for every model, so that only a fault of the program breaks it.
 *
 * VS_DEBUG turns it on; the Makefile's builds for tests have it. Otherwise the condition is compiled and not evaluated.
 * A false condition prints itself and its place, and aborts the process. A mistake that a user, a file or a library may
 * make is not asserted: it is answered with an error. */
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
