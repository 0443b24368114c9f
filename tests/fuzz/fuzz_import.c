/* Owns the fuzzing of the importers: the first byte says what reads the rest as a file. */
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const readers[] = {
    "(load-mesh \"a.stl\")", "(load-mesh \"a.obj\")", "(load-mesh \"a.off\")", "(load-mesh \"a.ply\")", "(load-mesh \"a.stl\" #:repair #t)", "(load-mesh \"a.ply\" #:repair #t)",
    "(make-height-field \"a.png\" (xyz 0 0 0) (xyz 1 1 0) #:low -1)", "(make-height-field \"a.exr\" (xyz 0 0 0) (xyz 1 1 0) #:low -1)", "(make-text (xyz 0 0 0) 1 \"aV\" #:font \"a.ttf\")",
    "(sky #:image \"a.hdr\")", "(load \"a.vs\")", "(call-with-input-file \"a\" (lambda (p) (let loop ((d (read p))) (if (eof-object? d) 0 (loop (read p))))))",
    "(call-with-input-file \"a\" (lambda (p) (let loop ((d (read-char p))) (if (eof-object? d) 0 (loop (read-char p))))))",
  };
  enum { READERS = sizeof readers / sizeof *readers };
  static fuzz_file file;
  if (size < 1) return 0;
  const char *program = readers[data[0] % READERS];
  file = (fuzz_file){ data + 1, size - 1 };
  vs_scheme *s = fuzz_interpreter(&file);
  vs_eval_text(s, "fuzz", 1, program, strlen(program), 0);
  file = (fuzz_file){ NULL, 0 };
  return 0;
}
