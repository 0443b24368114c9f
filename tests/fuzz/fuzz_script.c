/* Fuzzes the readers of other languages: the first byte selects JavaScript or GML for the other bytes. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static fuzz_file none;
  if (size < 1) return 0;
  vs_scheme *s = fuzz_interpreter(&none, data, size, 20, NULL);
  vs_eval_text(s, *data % 2 ? "fuzz.gml" : "fuzz.js", 1, (const char *)data + 1, size - 1, VS_EVAL_PRINT);
  return 0;
}
