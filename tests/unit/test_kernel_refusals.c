/* Tests that memory may run out anywhere in the kernel, in any of its threads. Each request for memory is refused in
 * turn: once, or with all later requests. Each run must succeed or return a named error, must not hang, and must free
 * all memory. Tests a sample of the requests; LONG=1: every request of four threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel/round/rounding.h"
#include "tests/oracle/sx.c"
#include "tests/unit/allocator.h"
#include "tests/unit/skip.h"

static _Atomic long left = -1, live; /* left: number of allocations until one is refused; negative if none is to be
                                      * refused. live: number of allocated blocks */
static _Atomic bool refused, for_good;

#if REPLACED
static bool refuse(void) {
  if (refused && for_good) return true;
  if (left < 0 || atomic_fetch_sub(&left, 1) != 0) return false;
  return refused = true;
}
static void *held(void *p) {
  live += p != NULL;
  return p;
}
void *malloc(size_t n) { return refuse() ? NULL : held(__libc_malloc(n)); }
void *calloc(size_t n, size_t size) { return refuse() ? NULL : held(__libc_calloc(n, size)); }
void *realloc(void *p, size_t n) {
  if (n && refuse()) return NULL;
  void *new = __libc_realloc(p, n);
  live += (new != NULL) - (p != NULL);
  return new;
}
void free(void *p) {
  live -= p != NULL;
  __libc_free(p);
}
#endif

static bool again(void *context, const char *stage, double done) { return (void)context, (void)stage, done <= 1; }

/* runs the kernel; returns true if it succeeded, and sets *why to its status */
static bool perform(const sx_problem *p, uint32_t threads, vs_kernel_status *why) {
  vs_kernel_options options = { .threads = threads, .job = &(vs_job){ .going = again } };
  vs_kernel_error e = { VS_KERNEL_FINE, 0, "" };
  vs_mesh m = { 0 };
  vs_rounded settled;
  bool ok = vs_kernel_evaluate(&p->problem, &options, &m, &e) && vs_mesh_round(&m, VS_NUMBERS_LOOSE, &options, &settled, &e);
  *why = e.status;
  vs_mesh_free(&m);
  return ok;
}

static void test_refused(void **state) {
  (void)state;
  if (!REPLACED) SKIP_TEST("a sanitizer has replaced the allocator");
  const char *longer = getenv("LONG");
  bool all = longer && *longer;
  sx_problem p;
  vs_kernel_status why;
  assert_true(sx_parse("(difference (union (sphere 3 64) (translate 1 2 .5 (sphere 3 64)) (translate 9 0 0 (box 1 1 1))) (translate 2 0 0 (torus 3 1 48 24)) (translate 0 0 -9 (cyl 30 1 2 48)))", &p));
  for (uint32_t threads = 1; threads <= 4; threads += 3)
    for (int good = 0; good < 2; good++) {
      long n = 0;
      assert_true(perform(&p, threads, &why)); /* runs the kernel without refusals first: later runs reuse blocks of
                                                * memory that its threads freed */
      for (;; n += (all && threads > 1) || n < 150 ? 1 : 1 + n / 8) {
        long before = live;
        refused = false;
        for_good = good;
        left = n;
        bool ok = perform(&p, threads, &why), was = refused;
        left = -1;
        refused = false;
        if (!ok && why != VS_KERNEL_OUT_OF_MEMORY) fail_msg("%u threads, request %ld: status %d", threads, n, (int)why);
        if (!ok && !was) fail_msg("%u threads, request %ld: failed, but nothing was refused", threads, n);
        if (live != before) fail_msg("%u threads, request %ld: %ld blocks were not given back", threads, n, live - before);
        if (!was) break;
      }
      assert_true(n > 100);
    }
  sx_free(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_refused) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
