/* Owns the run of the kernel's random trees (tests/oracle/fuzz.c): a sample, or with LONG=1 some thousands. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define FUZZ_AS_A_TEST
#include "tests/oracle/fuzz.c"
#include "tests/oracle/sx.c"

static void test_random_trees(void **unused) {
  (void)unused;
  const char *longer = getenv("LONG");
  uint64_t count = longer && *longer ? 3000 : 40, bad = 0;
  for (uint64_t seed = 1; seed <= count; seed++) {
    failed = false;
    one(seed);
    bad += failed;
  }
  assert_int_equal(bad, 0);
  assert_true(results > 7 * count && said * FEW <= results);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_random_trees) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
