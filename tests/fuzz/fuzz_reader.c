/* Fuzzes the reader: any bytes are source text. A quarter of the inputs that can be read are written as text, read
 * again and written again; both written texts must be equal. */
#include "tests/fuzz/fuzz.h"

#include "vm/front/reader.h"
#include "vm/values/printer.h"

static bool written(vs_scheme *s, vs_value v, vs_text *t) {
  vs_text_open(s, t, 0);
  return vs_print(s, v, VS_PRINT_WRITE, t);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static fuzz_file none;
  const char *text = (const char *)data;
  vs_scheme *s = fuzz_interpreter(&none, data, size, 2000, NULL);
  s->steps = 0, s->fuel = 1 << 20; /* this work is outside of any evaluation, so it gets a new budget of steps */
  vs_read_status status = vs_read_check(s, text, size);
  if (status.state == VS_READ_BAD && !status.message) abort();
  VS_ROOTS(s, r, 2);
  vs_text once, again;
  size_t used;
  if (!vs_check_utf8(s, text, size, 0, 1)) return 0; /* the functions called below accept only valid UTF-8 */
  vs_read_all(s, &(vs_passage){ text, size, 1 }, 0, size % 2, &r[0]);
  if (!vs_read_datum(s, text, size, &r[0], &used)) return 0;
  if (used > size) abort();
  if (r[0] == VS_EOF || data[size / 2] % 4 || !written(s, r[0], &once)) return 0;
  if (!vs_read_datum(s, once.at, once.count, &r[1], &used) || used != once.count) abort();
  if (!written(s, r[1], &again) || again.count != once.count || memcmp(once.at, again.at, again.count)) abort();
  vs_text_close(&again);
  vs_text_close(&once);
  return 0;
}
