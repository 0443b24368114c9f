/* Determines the range of seeds for a test of random inputs. */
#ifndef VS_TESTS_SEEDS_H
#define VS_TESTS_SEEDS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* from, to: first and last seed. whole: true if the environment variable LONG or SEEDS requests more than the usual
 * sample. asked: true if SEEDS is set. A variable that is set but empty counts as not set. */
typedef struct { unsigned long long from, to; bool whole, asked; } seed_range;

/* Returns the seeds FROM to TO of the environment variable SEEDS=FROM-TO. Without SEEDS, returns 1 to `most` with
 * LONG=1, otherwise 1 to `usual`. */
static inline seed_range seeds_asked(unsigned long long usual, unsigned long long most) {
  const char *longer = getenv("LONG"), *asked = getenv("SEEDS");
  seed_range r = { 1, longer && *longer ? most : usual, (longer && *longer) || (asked && *asked), asked && *asked };
  if (r.asked && (sscanf(asked, "%llu-%llu", &r.from, &r.to) != 2 || r.from > r.to))
    fail_msg("SEEDS must be FROM-TO, got %s", asked);
  return r;
}

#endif
