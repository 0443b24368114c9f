/* Owns the fuzzing of the reader: any bytes as source text, and as the text of a number. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static vs_scheme *s;
  static unsigned turn;
  static fuzz_file none;
  if (!s || ++turn % 100000 == 0) s = fuzz_interpreter(&none);
  vs_read_status status = vs_read_check(s, (const char *)data, size);
  if (status.state == VS_READ_BAD && !status.message) abort();
  return 0;
}
