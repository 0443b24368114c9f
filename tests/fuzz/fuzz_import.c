/* Owns the fuzzing of the importers: the first byte says what reads the rest as a file. */
#include "tests/fuzz/fuzz.h"

static const char begin[] = "(define (stl) (load-mesh \"a.stl\")) (define (obj) (load-mesh \"a.obj\")) (define (off) "
                            "(load-mesh \"a.off\")) (define (ply) (load-mesh \"a.ply\"))"
                            "(define (stl-repaired) (load-mesh \"a.stl\" #:repair #t)) (define (ply-repaired) "
                            "(load-mesh \"a.ply\" #:repair #t))"
                            "(define (png) (make-height-field \"a.png\" (xyz 0 0 0) (xyz 1 1 0) #:low -1)) (define "
                            "(exr) (make-height-field \"a.exr\" (xyz 0 0 0) (xyz 1 1 0) #:low -1))"
                            "(define (ttf) (make-text (xyz 0 0 0) 1 \"aV\" #:font \"a.ttf\")) (define (otf) (make-text "
                            "(xyz 0 0 0) 1 \"fi\" #:font \"a.otf\"))"
                            "(define (hdr) (sky #:image \"a.hdr\")) (define (vs) (load \"a.vs\")) (define (json) "
                            "(load-json \"a.json\")) (define (csv) (load-csv \"a.csv\"))";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const readers[] = { "(stl)",          "(obj)",  "(off)", "(ply)", "(stl-repaired)",
                                         "(ply-repaired)", "(png)",  "(exr)", "(ttf)", "(hdr)",
                                         "(vs)",           "(json)", "(csv)", "(otf)" };
  enum { READERS = sizeof readers / sizeof *readers };
  static fuzz_file file;
  if (size < 1) return 0;
  const char *program = readers[data[0] % READERS];
  vs_scheme *s = fuzz_interpreter(&file, data, size, 500, begin);
  file = (fuzz_file){ data + 1, size - 1 };
  vs_eval_text(s, "fuzz", 1, program, strlen(program), 0);
  file = (fuzz_file){ NULL, 0 };
  return 0;
}
