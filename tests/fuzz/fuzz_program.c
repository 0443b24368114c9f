/* Fuzzes expander, compiler and evaluator: any bytes are a program under limits. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static fuzz_file none;
  vs_scheme *s = fuzz_interpreter(&none, data, size, 500, NULL);
  vs_eval_text(s, "fuzz", 1, (const char *)data, size, VS_EVAL_PRINT);
  return 0;
}
