/* Fuzzes texts: numbers in every radix, which it writes and reads again; bytes as UTF-8; and ports that read bytes. The
 * first byte of an input selects one of these three tests. */
#include <math.h>

#include "tests/fuzz/fuzz.h"

#include "vm/numbers/number.h"
#include "vm/numbers/number_text.h"
#include "vm/values/text.h"

static const char begin[] =
    "(define (all next) (lambda () (call-with-input-file \"a\" (lambda (p) (let loop ((c (next p))) (if (eof-object? "
    "c) 0 (loop (next p))))))))"
    "(define (mixed) (call-with-input-file \"a\" (lambda (p) (let loop ((c (peek-char p))) (if (eof-object? c) 0 (begin"
    "  (case c ((#\\l) (read-line p)) ((#\\s) (read-string 3 p)) ((#\\d) (read p)) (else (read-char p))) (loop "
    "(peek-char p))))))))"
    "(define (bytes) (let* ((s (file->string \"a\")) (b (string->utf8 s))) (if (not (string=? (utf8->string b) s)) "
    "(exit 9))"
    "  (if (not (string=? (list->string (string->list s)) s)) (exit 9)) (string-upcase s) (string-downcase s) "
    "(string-foldcase s) (string->symbol s) (string<? s s)"
    "  (string-length s) (if (not (string=? (call-with-output-string (lambda (p) (display s p))) s)) (exit 9))))"
    "(define lines (all read-line)) (define chars (all read-char)) (define strings (all (lambda (p) (read-string 2 "
    "p)))) (define data (all read))"
    "(define (number) (string->number (file->string \"a\")))";

static void number(vs_scheme *s, const char *text, size_t size, int radix) {
  VS_ROOTS(s, r, 2);
  vs_text t;
  if (size > 300 || !vs_number_parse(s, text, size, radix, &r[0]) || r[0] == VS_FALSE) return;
  vs_text_open(s, &t, 0);
  if (!vs_number_print(s, r[0], radix, &t)) return;
  if (!vs_number_parse(s, t.at, t.count, radix, &r[1]) || r[1] == VS_FALSE || !vs_number_eqv(r[0], r[1])) abort();
  vs_text_close(&t);
}

static void of_double(const uint8_t *data) {
  double d;
  char text[VS_DOUBLE_TEXT];
  memcpy(&d, data, sizeof d);
  if (!isfinite(d)) return;
  size_t n = vs_double_text(d, text);
  if (n >= sizeof text || text[n] || strtod(text, NULL) != d) abort();
}

static void decoded(const char *text, size_t size) {
  for (size_t i = 0, n; i < size; i += n) {
    uint32_t c;
    char out[4];
    n = vs_utf8_decode(text + i, size - i, &c);
    if (n > size - i || (n && (vs_utf8_encode(c, out) != n || memcmp(out, text + i, n)))) abort();
    if (!n) n = 1;
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const readers[] = {
    "(lines)", "(chars)", "(strings)", "(data)", "(mixed)", "(bytes)", "(number)"
  };
  enum { READERS = sizeof readers / sizeof *readers };
  static fuzz_file file;
  if (size < 1) return 0;
  const uint8_t way = *data++;
  size--;
  vs_scheme *s = fuzz_interpreter(&file, data - 1, size + 1, 2000, begin);
  s->steps = 0, s->fuel = 1 << 20;
  if (way < 64)
    number(s, (const char *)data, size, 2 + way % 35);
  else if (way < 96) {
    if (size >= sizeof(double)) of_double(data);
  } else if (way < 128)
    decoded((const char *)data, size);
  else {
    int code;
    const char *program = readers[way % READERS];
    file = (fuzz_file){ data, size };
    vs_eval_text(s, "fuzz", 1, program, strlen(program), 0);
    if (vs_exit_requested(s, &code) && code == 9) abort(); /* the program exits with code 9 if writing and reading
                                                            * changed a text */
    file = (fuzz_file){ NULL, 0 };
  }
  return 0;
}
