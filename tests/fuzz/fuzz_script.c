/* Fuzzes the readers of other languages: the first byte selects JavaScript, GML, AutoLISP or OpenSCAD for the other bytes. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static fuzz_file none;
  if (size < 1) return 0;
  vs_scheme *s = fuzz_interpreter(&none, data, size, 20, NULL);
  static const char *const names[] = { "fuzz.js", "fuzz.gml", "fuzz.lsp", "fuzz.scad" };
  vs_eval_text(s, names[*data % 4], 1, (const char *)data + 1, size - 1, VS_EVAL_PRINT);
  return 0;
}
