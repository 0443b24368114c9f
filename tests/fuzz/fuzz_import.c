/* Fuzzes the importers: the first byte selects the importer, which reads the other bytes as a file. */
#include "tests/fuzz/fuzz.h"

static const char begin[] = "(define (stl) (load-mesh \"a.stl\")) (define (obj) (load-mesh \"a.obj\")) (define (off) "
                            "(load-mesh \"a.off\")) (define (ply) (load-mesh \"a.ply\"))"
                            "(define (stl-repaired) (load-mesh \"a.stl\" #:repair #t)) (define (ply-repaired) "
                            "(load-mesh \"a.ply\" #:repair #t))"
                            "(define (png) (make-height-field \"a.png\" (xyz 0 0 0) (xyz 1 1 0) #:low -1)) (define "
                            "(exr) (make-height-field \"a.exr\" (xyz 0 0 0) (xyz 1 1 0) #:low -1))"
                            "(define (hdr) (sky #:image \"a.hdr\")) (define (vs) (load \"a.vs\")) (define (json) "
                            "(load-json \"a.json\")) (define (csv) (load-csv \"a.csv\")) (define (photo) (make-material "
                            "#:image \"a.jpg\")) (define (ies) (lamp (xyz 0 0 9) #:ies \"a.ies\"))"
                            "(define (mtl) (load-mtl \"a.mtl\"))";

enum { TTF = 8, OTF = 13 };

/* Returns a font file. A whole font is too large for an input. Therefore each four bytes of the input change a byte in
 * a table of the system's font. Without a system font, the input itself is the file. */
static fuzz_file patched_font(const uint8_t *data, size_t size) {
  enum { MOST = 1 << 20 };
  static uint8_t whole[MOST], changed[MOST];
  static size_t count;
  static bool asked;
  if (!asked) {
    FILE *f = fopen("/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "rb");
    count = f ? fread(whole, 1, sizeof whole, f) : 0;
    if (f) fclose(f);
    asked = true;
  }
  if (count < 400 || whole[4] || !whole[5]) return (fuzz_file){ data, size };
  memcpy(changed, whole, count);
  for (size_t i = 0; i + 4 <= size; i += 4) {
    const uint8_t *record = whole + 12 + 16 * (data[i] % (whole[5] + 1));
    const size_t table = (size_t)record[8] << 24 | (size_t)record[9] << 16 | (size_t)record[10] << 8 | record[11];
    const size_t at = (data[i] % (whole[5] + 1) == whole[5] ? 0 : table) + ((size_t)data[i + 1] << 8 | data[i + 2]);
    if (at < count) changed[at] = data[i + 3];
  }
  return (fuzz_file){ changed, count };
}

/* Returns the interpreter for fonts. An interpreter keeps each font that it has read until it is freed. Therefore each
 * font gets a new name, and a new interpreter is made after FONTS fonts. */
static vs_scheme *fonts_interpreter(fuzz_file *file, char text[static 100], const char *letters) {
  enum { FONTS = 40 };
  static vs_scheme *s;
  static unsigned fonts;
  if (s && fonts % FONTS == 0) vs_free(s), s = NULL;
  if (!s && !(s = fuzz_open(file))) abort();
  snprintf(text, 100, "(make-text (xyz 0 0 0) 1 \"%s\" #:font \"%u.ttf\")", letters, ++fonts);
  return s;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const readers[] = { "(stl)",          "(obj)",  "(off)", "(ply)", "(stl-repaired)",
                                         "(ply-repaired)", "(png)",  "(exr)", "aV",    "(hdr)",
                                         "(vs)",           "(json)", "(csv)", "fi",
                                         "(photo)",       "(ies)",  "(mtl)" };
  enum { READERS = sizeof readers / sizeof *readers };
  static fuzz_file file;
  char text[100];
  if (size < 1) return 0;
  vs_scheme *s = fuzz_interpreter(&file, data, size, 500, begin);
  const unsigned which = data[0] % READERS;
  const bool font = which == TTF || which == OTF;
  file = font && size < 200 ? patched_font(data + 1, size - 1) : (fuzz_file){ data + 1, size - 1 };
  if (font) s = fonts_interpreter(&file, text, readers[which]);
  else snprintf(text, sizeof text, "%s", readers[which]);
  vs_eval_text(s, "fuzz", 1, text, strlen(text), 0);
  file = (fuzz_file){ NULL, 0 };
  return 0;
}
