/* Tests that a host can embed the library: it includes the public header alone and links the installed shared
 * library. */
#define _POSIX_C_SOURCE 200809L
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <visualscheme.h>

typedef struct { char printed[4096], said[4096]; vs_span at; size_t values; vs_scheme *scheme; } host;

static bool print(void *context, const char *text, size_t length) {
  host *h = context;
  strncat(h->printed, text, length);
  return true;
}
static void diagnose(void *context, const vs_diagnostic *d) {
  host *h = context;
  snprintf(h->said, sizeof h->said, "%s", d->message);
  h->at = d->at;
}
static void value(void *context, const char *text, size_t length) {
  host *h = context;
  strncat(h->printed, text, length);
  strcat(h->printed, ";");
  h->values++;
}
static bool poll_interrupt(void *context) { return ((host *)context)->values == 99; }
static bool write_nothing(void *context, const void *bytes, size_t count) {
  (void)bytes;
  *(size_t *)context += count;
  return true;
}
static bool first_name(void *context, const char *name) {
  snprintf(context, 64, "%s", name);
  return false;
}

static int failures;
#define CHECK(condition) ((condition) ? (void)printf("ok embed:%s\n", #condition) : (failures++, (void)printf("not ok embed:%s (line %d)\n", #condition, __LINE__)))

static vs_outcome run(vs_scheme *s, const char *text, unsigned flags) { return vs_eval_text(s, "text", 1, text, strlen(text), flags); }

static void check_told(void *context, const vs_checked *c) {
  host *h = context;
  h->values += c->passed ? 10 : 1;
  snprintf(h->said, sizeof h->said, "%u: %s %s %s %s", (unsigned)c->at.line, c->form, c->expression, c->gives, c->expected);
}

/* Tests the checks that a program declares. With VS_EVAL_CHECK_LATER the library keeps the checks for the host, which
 * runs them one by one; they do not change the drawing. Otherwise a failed check is a warning. */
static void checks(void) {
  static host a;
  vs_options o = vs_options_default();
  o.host = (vs_host){.context = &a, .output = print, .diagnose = diagnose};
  vs_scheme *s = vs_new(&o);
  vs_check_listener listener = {.context = &a, .told = check_told};
  vs_summary summary;
  CHECK(s && run(s, "(check-expect (f) 1)\n(check-expect (begin (draw (make-sphere origin 1)) (f)) 2)(define (f) 1)",
                 VS_EVAL_CHECK_LATER) == VS_OUTCOME_DONE);
  CHECK(a.values == 0 && vs_check_waits(s));
  CHECK(vs_check_next(s, &listener) == VS_OUTCOME_DONE && a.values == 10 && vs_check_waits(s));
  CHECK(vs_check_next(s, &listener) == VS_OUTCOME_DONE && a.values == 11 && !vs_check_waits(s));
  CHECK(strncmp(a.said, "2: check-expect (begin", 22) == 0 && strstr(a.said, " 1 2"));
  CHECK(vs_check_next(s, &listener) == VS_OUTCOME_DONE && a.values == 11);
  CHECK(vs_drawing_summary(s, &summary) == VS_OUTCOME_DONE && summary.objects == 0);
  CHECK(run(s, "(check-expect (f) 3)", 0) == VS_OUTCOME_DONE && strstr(a.said, "check-expect: (f) gives 1, expected 3"));
  CHECK(run(s, "(check-expect 1 2) (car 5)", 0) == VS_OUTCOME_MODEL && !vs_check_waits(s));
  CHECK(!vs_check_redefined(s) && run(s, "(define (check-error . any) 1)", 0) == VS_OUTCOME_DONE);
  CHECK(vs_check_redefined(s) && strcmp(vs_check_redefined(s), "check-error") == 0);
  vs_free(s);
}

/* Runs a host without a diagnose callback: the library writes errors, warnings and the calls that led to them to
 * standard error. */
static void say_on_standard_error(void) {
  char said[2000] = "";
  FILE *kept = tmpfile();
  int was = dup(STDERR_FILENO);
  vs_scheme *s = vs_new(NULL);
  fflush(stderr);
  dup2(fileno(kept), STDERR_FILENO);
  run(s, "(define (f x)\n  (+ 1 (car x)))\n(+ 1 (f 5))", 0);
  run(s, "(sqrt", 0);
  run(s, "(make-sphere origin 1) (draw (make-sphere origin 2))", 0);
  run(s, "(error \"stop\" 7)", 0);
  vs_handle_release(s, 12345);
  vs_write_drawing(s, "/nowhere/at/all.stl", NULL, NULL);
  fflush(stderr);
  dup2(was, STDERR_FILENO);
  close(was);
  rewind(kept);
  said[fread(said, 1, sizeof said - 1, kept)] = 0;
  fclose(kept);
  CHECK(strstr(said, "text:2:8: car: ") && strstr(said, "text:3:6: called from here\n"));
  CHECK(strstr(said, "text:1:1: ") && strstr(said, ": warning: ") && strstr(said, "stop 7\n") && strstr(said, "cannot write /nowhere/at/all.stl: ") && strstr(said, "vs_handle_release: "));
  vs_free(s);
}

static int64_t integer_of(vs_scheme *s, const char *text) {
  vs_handle h;
  int64_t n = -1;
  CHECK(vs_eval_value(s, "text", 1, text, strlen(text), 0, &h) == VS_OUTCOME_DONE && vs_handle_get_integer(s, h, &n));
  vs_handle_release(s, h);
  return n;
}

/* Gets values of texts, and integers of 64 bits in both directions. */
static void values_and_integers(void) {
  static const int64_t numbers[] = {0, 1, -1, (INT64_C(1) << 47) - 1, INT64_C(1) << 47, -(INT64_C(1) << 47) - 1, INT64_MAX, INT64_MIN};
  static const char *const others[] = {"1.0", "1/2", "9223372036854775808", "-9223372036854775809", "(expt 10 100)", "\"1\"", "'a"};
  static host a;
  vs_options o = vs_options_default();
  o.host = (vs_host){.context = &a, .output = print, .diagnose = diagnose};
  vs_scheme *s = vs_new(&o);
  vs_handle h;
  int64_t n;
  CHECK(integer_of(s, "(define x 20) (display x) (+ x 1)") == 21 && strcmp(a.printed, "20") == 0);
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    char text[40];
    snprintf(text, sizeof text, "%lld", (long long)numbers[i]);
    CHECK(integer_of(s, text) == numbers[i]);
    h = vs_handle_integer(s, numbers[i]);
    CHECK(vs_handle_get_integer(s, h, &n) && n == numbers[i] && strcmp(vs_handle_get_text(s, h), text) == 0);
    vs_handle_release(s, h);
  }
  for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
    CHECK(vs_eval_value(s, "text", 1, others[i], strlen(others[i]), 0, &h) == VS_OUTCOME_DONE && !vs_handle_get_integer(s, h, &n));
    vs_handle_release(s, h);
  }
  h = 5;
  CHECK(vs_eval_value(s, "text", 3, "1 (car 5)", 9, 0, &h) == VS_OUTCOME_MODEL && h == 0 && a.at.line == 3 && a.at.column == 3);
  CHECK(vs_eval_value(s, "text", 1, "(list 1 2)", 10, 0, &h) == VS_OUTCOME_DONE && vs_handle_count(s, h) == 2);
  vs_free(s);
}

/* A host of an earlier version has shorter structs of options: the library reads no byte behind them, and writes none.
 * A host of a later version has longer ones. */
static void options_of_other_versions(void) {
  struct { vs_options o; unsigned char behind[64]; } later;
  memset(&later, 0x55, sizeof later);
  vs_options_init(&later.o, sizeof later);
  CHECK(later.o.size == sizeof later && later.behind[0] == 0 && later.behind[63] == 0 && later.o.limit_steps == 0);
  later.o.limit_steps = 1000;
  vs_scheme *s = vs_new(&later.o);
  CHECK(s && run(s, "(let loop () (loop))", 0) == VS_OUTCOME_MACHINE);
  vs_free(s);

  size_t known = offsetof(vs_options, limit_steps); /* the host knows no members from limit_steps on */
  _Alignas(16) unsigned char earlier[sizeof(vs_options)];
  vs_options_init((vs_options *)(void *)memset(earlier, 0x55, sizeof earlier), known);
  bool untouched = true;
  for (size_t i = known; i < sizeof earlier; i++) untouched = untouched && earlier[i] == 0x55;
  CHECK(untouched);
  s = vs_new((vs_options *)(void *)earlier); /* the bytes behind would be a limit of steps, and addresses */
  CHECK(s && run(s, "(do ((i 0 (+ i 1))) ((= i 100000)))", 0) == VS_OUTCOME_DONE);
  vs_free(s);

  vs_output_options out = vs_output_options_default();
  vs_fit_options fit = vs_fit_options_default();
  CHECK(out.size == sizeof out && out.passes == VS_PASSES_ALL && fit.size == sizeof fit && fit.points == 20000);
  s = vs_new(&(vs_options){.limit_steps = 1000}); /* a size of 0 */
  CHECK(s && run(s, "(let loop () (loop))", 0) == VS_OUTCOME_MACHINE);
  vs_free(s);
}

int main(void) {
  say_on_standard_error();
  values_and_integers();
  options_of_other_versions();
  static host a, b;
  vs_options o = vs_options_default();
  o.host = (vs_host){.context = &a, .output = print, .diagnose = diagnose, .value = value, .poll = poll_interrupt};
  vs_scheme *s = vs_new(&o);
  o.host.context = &b;
  vs_scheme *t = vs_new(&o);
  if (!s || !t) {
    printf("not ok embed: no interpreter\n");
    return 1;
  }
  CHECK(strcmp(vs_version(), VS_VERSION) == 0);
  CHECK(run(s, "(define x 20) (display (+ x 1))", 0) == VS_OUTCOME_DONE);
  CHECK(strcmp(a.printed, "21") == 0);
  CHECK(run(t, "x", 0) == VS_OUTCOME_MODEL); /* a second interpreter does not know the definition of x */
  CHECK(b.at.line == 1 && b.at.column == 1 && b.at.file && strcmp(b.at.file, "text") == 0);
  CHECK(run(t, "(* 6 7) \"a\"", VS_EVAL_PRINT) == VS_OUTCOME_DONE && strcmp(b.printed, "42;\"a\";") == 0);
  CHECK(run(s, "(define (f) (f)) 1 (car 5)", 0) == VS_OUTCOME_MODEL && strstr(a.said, "car"));
  b.values = 99;
  CHECK(run(t, "(let loop () (loop))", 0) == VS_OUTCOME_INTERRUPTED);
  b.values = 0;
  vs_interrupt(t);
  CHECK(run(t, "1", 0) == VS_OUTCOME_INTERRUPTED);
  CHECK(run(t, "1", 0) == VS_OUTCOME_DONE);
  CHECK(vs_read_check(s, "(a (b", 5).state == VS_READ_INCOMPLETE && vs_read_check(s, "(a (b", 5).depth == 2);
  CHECK(vs_read_check(s, "(a)", 3).state == VS_READ_COMPLETE);
  CHECK(vs_read_check(s, " ; nothing", 10).state == VS_READ_EMPTY);
  CHECK(vs_read_check(s, "(a ]", 4).state == VS_READ_BAD && vs_read_check(s, "(a ]", 4).column == 4);
  char name[64] = "";
  CHECK(vs_complete(s, "make-cyl", first_name, name) == 1 && strcmp(name, "make-cylinder") == 0);
  CHECK(vs_parameter_set(s, "height", "7"));
  CHECK(vs_parameter_unused(s, 0) && strcmp(vs_parameter_unused(s, 0), "height") == 0);
  CHECK(run(s, "(define-parameter height 3 #:min 1 #:max 9) (draw (make-box (xyz 0 0 0) (xyz 1 2 height)))", 0) == VS_OUTCOME_DONE);
  CHECK(vs_parameter_unused(s, 0) == NULL);
  vs_parameter_info p;
  CHECK(vs_parameter_count(s) == 1 && vs_parameter_get(s, 0, &p) && strcmp(p.value, "7") == 0 && p.max == 9 && p.type == VS_PARAMETER_INTEGER);
  vs_scheme *other = vs_new(NULL);
  vs_parameter_info forgotten;
  CHECK(other && vs_parameter_set(other, "height", "7"));
  vs_parameter_unset(other, "height");
  vs_parameter_unset(other, "nobody");
  CHECK(run(other, "(define-parameter height 3)", 0) == VS_OUTCOME_DONE);
  CHECK(vs_parameter_get(other, 0, &forgotten) && strcmp(forgotten.value, "3") == 0);
  vs_free(other);
  vs_summary summary;
  CHECK(vs_drawing_summary(s, &summary) == VS_OUTCOME_DONE && summary.solids == 1 && summary.max[2] == 7);
  size_t bytes = 0;
  CHECK(vs_write_drawing_to(s, "stl", NULL, write_nothing, &bytes) == VS_OUTCOME_DONE && bytes == 84 + 50 * 12);
  CHECK(vs_write_drawing(s, "/nowhere/at/all.stl", NULL, NULL) == VS_OUTCOME_USAGE);
  vs_drawing_clear(s);
  CHECK(vs_drawing_summary(s, &summary) == VS_OUTCOME_DONE && summary.objects == 0);
  size_t count;
  CHECK(vs_format_list(&count) && count >= 8 && vs_format_find("out/a.stl") && !vs_format_find("out/a.slt"));
  int code = -1;
  CHECK(run(t, "(exit 4) (car 5)", 0) == VS_OUTCOME_DONE && vs_exit_requested(t, &code) && code == 4);
  vs_free(t);
  vs_free(s);
  checks();
  return failures != 0;
}
