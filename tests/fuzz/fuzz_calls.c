/* Owns the fuzzing of visualscheme.h: the bytes are a sequence of calls, on an interpreter of its own. */
#include "tests/fuzz/fuzz.h"

static bool each_name(void *context, const char *name) { return (void)context, *name != 0; }

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const char *const texts[] = { "(define-parameter n 3 #:min 1 #:max 9)", "(draw (make-box (xyz 0 0 0) (xyz 1 1 1)))", "(make-sphere (xyz 0 0 0) 1)", "(car 5)", "(exit 3)", "(define x", "(let loop () (loop))",
                                       "(erase-all)", "(define (f x) (* x x)) (f 4)", "\"abc", "(draw (subtract (make-sphere (xyz 0 0 0) 1) (make-box (xyz 0 0 0) (xyz 1 1 1))))", "(gc)", "(call/cc (lambda (c) (set! k c)))", "(k 1)",
                                       "(define k #f)", "(sky #:color 'white)" };
  vs_options o = vs_options_default();
  o.untrusted = true, o.limit_steps = 2000, o.limit_memory = 32 << 20, o.limit_time = 5;
  fuzz_file none = { NULL, 0 };
  o.host = (vs_host){ .context = &none, .output = fuzz_drop, .diagnose = fuzz_told, .value = fuzz_value, .read_file = fuzz_read };
  vs_scheme *s = vs_new(&o);
  if (!s) abort();
  vs_output_options how = vs_output_options_default();
  how.segments = 6;
  for (size_t i = 0; i + 1 < size && i < 60; i += 2) {
    const char *text = texts[data[i + 1] % (sizeof texts / sizeof *texts)];
    size_t formats, count;
    const vs_format_info *format = &vs_format_list(&formats)[0];
    vs_summary summary;
    vs_parameter_info p;
    vs_statistic all[80];
    vs_output_info info;
    int code;
    switch (data[i] % 16) {
    case 0: case 1: case 2: vs_eval_text(s, "fuzz", data[i + 1], text, strlen(text), data[i + 1] % 4); break;
    case 3: vs_eval_file(s, text, 0); break;
    case 4: vs_restart(s); break;
    case 5: vs_interrupt(s); break;
    case 6: vs_interrupt_clear(s); break;
    case 7: vs_read_check(s, text, strlen(text)); break;
    case 8: vs_complete(s, data[i + 1] % 2 ? "make-" : "", each_name, NULL); break;
    case 9: vs_parameter_set(s, data[i + 1] % 3 ? "n" : "a b", text); break;
    case 10:
      for (size_t k = 0; k <= vs_parameter_count(s); k++) vs_parameter_get(s, k, &p);
      vs_parameter_unused(s, data[i + 1]);
      break;
    case 11: vs_drawing_summary(s, &summary); break;
    case 12: vs_drawing_clear(s); break;
    case 13: case 14:
      format += data[i + 1] % formats;
      if (!format->worker) vs_write_drawing_to(s, format->name, &how, fuzz_drop_bytes, NULL);
      break;
    default:
      vs_exit_requested(s, &code);
      vs_statistics(s, all, data[i + 1] % 80);
      vs_output_statistics(s, data[i + 1] % 4, &info, all, 80, &count);
    }
  }
  vs_free(s);
  return 0;
}
