/* Runs the random set operations of tests/oracle/fuzz.c in the kernel: a sample of seeds, with LONG=1 a few thousand,
 * or those of SEEDS=FROM-TO. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define FUZZ_AS_A_TEST
#include "tests/oracle/fuzz.c"
#include "tests/oracle/sx.c"
#include "tests/unit/seeds.h"

static void test_random_trees(void **unused) {
  (void)unused;
  seed_range seeds = seeds_asked(40, 3000);
  unsigned long long bad = 0;
  for (uint64_t seed = seeds.from; seed <= seeds.to; seed++) {
    failed = false;
    one(seed);
    bad += failed;
    if (failed) print_message("seed %llu failed\n", (unsigned long long)seed);
  }
  if (seeds.asked) print_message("seeds %llu to %llu: %llu failed; %llu times one of %llu results meets itself in a format's numbers, and says so\n", seeds.from, seeds.to, bad, (unsigned long long)said, (unsigned long long)results);
  assert_int_equal(bad, 0);
  assert_true(results > 7 * (seeds.to - seeds.from + 1) && (said == 0 || said * FEW <= results));
}

/* Rounding makes triangles of these results intersect that are far apart along the surface. In the result of the last
 * seed, triangles touch because the kernel repaired a triangle. The kernel must report these contacts. */
static void test_far_apart(void **unused) {
  (void)unused;
  static const uint64_t seeds[] = { 5374, 5871, 200547, 300336, 300545, 405310, 501912, 722672 };
  for (size_t i = 0; i < sizeof seeds / sizeof *seeds; i++) {
    failed = false;
    one(seeds[i]);
    if (failed) fail_msg("seed %llu failed", (unsigned long long)seeds[i]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_random_trees), cmocka_unit_test(test_far_apart) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
