/* Tests kerning. For a font that has the tables GPOS and kern, kerning from GPOS must equal FreeType's kerning from
 * kern. With damaged bytes, the reader must not read outside the table. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/text/font.h"
#include "geometry/text/fontfile.h"
#include "geometry/text/kerning.h"

static uint32_t number(const unsigned char *at) { return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3]; }

/* Returns a copy of the table GPOS of a font file, or NULL if the file has no such table. */
static unsigned char *gpos_of(const char *path, size_t *size) {
  FILE *f = fopen(path, "rb");
  static unsigned char bytes[4 << 20];
  size_t n = f ? fread(bytes, 1, sizeof bytes, f) : 0;
  if (f) fclose(f);
  for (unsigned i = 0; n > 12 && i < (unsigned)(bytes[4] << 8 | bytes[5]) && 28 + 16 * (size_t)i <= n; i++) {
    const unsigned char *row = bytes + 12 + 16 * (size_t)i;
    size_t from = number(row + 8);
    *size = number(row + 12);
    if (memcmp(row, "GPOS", 4) != 0 || from + *size > n) continue;
    unsigned char *table = malloc(*size);
    assert_non_null(table);
    memcpy(table, bytes + from, *size);
    return table;
  }
  return NULL;
}

static void kerning(void **state) {
  static const char *const pairs[] = { "AV", "To", "LT", "Ya", "P.", "Wa", "ov", "HH" };
  vs_store *s = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  char path[1024];
  size_t size = 0;
  (void)state;
  vs_font *f = vs_font_get(s, "", &e);
  if (!f || !vs_font_file("", path, sizeof path, &e)) {
    printf("%s\n", e.message);
    fail();
  }
  unsigned char *table = gpos_of(path, &size);
  assert_non_null(table);
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
    uint32_t a = vs_font_index(f, (unsigned char)pairs[i][0]), b = vs_font_index(f, (unsigned char)pairs[i][1]);
    assert_true(vs_font_kerning(f, a, b) == vs_kerning_pair(table, size, a, b));
  }
  assert_true(vs_kerning_pair(table, size, vs_font_index(f, 'T'), vs_font_index(f, 'o')) < 0);
  srand(7);
  for (int k = 0; k < 300; k++) { /* cuts the table short, or changes random bytes, mostly among the offsets: the reader
                                   * must end, and read only within the table */
    size_t kept = k % 3 ? size : (size_t)rand() % size;
    unsigned char *wrong = malloc(kept + 1);
    assert_non_null(wrong);
    memcpy(wrong, table, kept);
    for (int j = 0; j < 40 && kept; j++) wrong[(size_t)rand() % (j % 2 || kept < 400 ? kept : 400)] = (unsigned char)rand();
    for (int j = 0; j < 20; j++) {
      double by = vs_kerning_pair(wrong, kept, (uint32_t)rand() % 6000, (uint32_t)rand() % 6000);
      assert_true(by == by);
    }
    free(wrong);
  }
  free(table);
  vs_store_release(s);
}

static void names(void **state) {
  vs_store *s = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  (void)state;
  assert_true(vs_font_get(s, "DejaVu Sans", &e) != NULL && vs_font_get(s, "dejavusans", &e) != NULL);
  assert_null(vs_font_get(s, "No Such Family", &e));
  assert_non_null(strstr(e.message, "DejaVu Sans"));
  assert_null(vs_font_get(s, "./no-such-file.ttf", &e));
  assert_false(vs_font_add(s, "bytes.ttf", "not a font", 10, &e));
  assert_true(vs_font_is_path("a.TTF") && vs_font_is_path("a/b") && !vs_font_is_path("DejaVu Sans"));
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(kerning), cmocka_unit_test(names) };
  return cmocka_run_group_tests_name("fonts", tests, NULL, NULL);
}
