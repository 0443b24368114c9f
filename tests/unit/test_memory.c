/* Tests the large blocks of memory that the command vs allocates. Their contents must survive growing, shrinking, and
 * moving from the C library's blocks to mapped blocks and back. */
#include "cli/large_blocks.c"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { BLOCKS = 12, TURNS = 3000 };
typedef struct { unsigned char *at; size_t size; unsigned char mark; } block;

/* Returns the distance in bytes between the bytes that the test marks in a block of this size. The first and last bytes
 * are marked too. */
static size_t step_of(size_t size) { return size / 61 + 1; }
static void mark(block *b) {
  for (size_t i = 0; i < b->size; i += step_of(b->size)) b->at[i] = b->mark;
  if (b->size) b->at[b->size - 1] = b->mark;
}

static void resize(block *b, size_t size) {
  unsigned char *p = cli_memory(NULL, b->at, b->size, size);
  assert_true(!size || p != NULL);
  for (size_t i = 0; p && i < b->size && i < size; i += step_of(b->size)) assert_int_equal(p[i], b->mark);
  if (p && size >= HUGE_PAGE) assert_int_equal((uintptr_t)p % HUGE_PAGE, 0);
  *b = (block){ p, size, (unsigned char)(b->mark + 7) };
  mark(b);
}

static void test_blocks(void **state) {
  (void)state;
  block at[BLOCKS] = { { NULL, 0, 0 } };
  uint32_t random = 1;
  for (int i = 0; i < TURNS; i++) {
    random = random * 1664525 + 1013904223;
    block *b = &at[(random >> 16) % BLOCKS];
    random = random * 1664525 + 1013904223;
    static const size_t most[] = { 100, 1 << 16, HUGE_PAGE + 100, 9 << 20 };
    /* resizes the block to a random size, or by up to 4999 more bytes */
    resize(b, random >> 30 ? (random >> 4) % most[random >> 30] : b->size + (random >> 16) % 5000);
  }
  for (int i = 0; i < BLOCKS; i++) resize(&at[i], 0);
}

static void test_refused(void **state) {
  (void)state;
  assert_null(cli_memory(NULL, NULL, 0, SIZE_MAX));
  assert_null(cli_memory(NULL, NULL, 0, (size_t)1 << 62));
  unsigned char *p = cli_memory(NULL, NULL, 0, HUGE_PAGE);
  assert_non_null(p);
  p[HUGE_PAGE - 1] = 5;
  assert_null(cli_memory(NULL, p, HUGE_PAGE, (size_t)1 << 62));
  assert_null(cli_memory(NULL, p, HUGE_PAGE, SIZE_MAX));
  assert_int_equal(p[HUGE_PAGE - 1], 5); /* the refused allocation has not changed the block's contents */
  assert_null(cli_memory(NULL, p, HUGE_PAGE, 0));
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_blocks), cmocka_unit_test(test_refused) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
