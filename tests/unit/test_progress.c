/* Tests the progress reports that a host receives while a mesh is made. The reported fraction must never decrease. If
 * the host's callback interrupts, no file is written. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "visualscheme.h"

typedef struct {
  vs_scheme *s;
  int told, steps;    /* told: number of reports while the mesh is made. steps: number of reports whose fraction is
                       * greater than in the previous report */
  double done, until; /* done: last reported fraction. until: fraction at which the callback interrupts */
  char said[200], wrong[200];
} watch;

static void follow(void *context, const vs_progress *p) {
  watch *w = context;
  if (strcmp(p->phase, "meshing") != 0 || p->fraction < 0) return;
  if (p->fraction < w->done || p->fraction > 1) snprintf(w->wrong, sizeof w->wrong, "%g after %g", p->fraction, w->done);
  w->told++;
  w->steps += p->fraction > w->done;
  w->done = p->fraction;
  if (w->done >= w->until) vs_interrupt(w->s);
}
static void tell(void *context, const vs_diagnostic *d) {
  if (d->severity == VS_SEVERITY_ERROR) snprintf(((watch *)context)->said, sizeof ((watch *)context)->said, "%s", d->message);
}

/* Models for the test. The host receives ten progress reports a second, so each model takes a second or more: all of
 * its triangles intersect others. For .glb vs makes the mesh of each part in turn, for other formats one mesh of all
 * parts. */
static const char single[] =
  "(draw (subtract (make-box (xyz -12 -12 -12) (xyz 12 12 12))"
  "                (unite (map (lambda (i) (do-rotate (make-sphere (xyz 0 0 0) 10 #:segments 90) (xyz 0 0 0) (vxyz 1 2 3) (* i 0.06))) (iota 4)))))";
static const char several[] =
  "(for-each (lambda (k) (draw (subtract (make-box (xyz (- (* 30 k) 12) -12 -12) (xyz (+ (* 30 k) 12) 12 12))"
  "                                      (unite (map (lambda (i) (do-rotate (make-sphere (xyz (* 30 k) 0 0) 10 #:segments 50)"
  "                                                                         (xyz (* 30 k) 0 0) (vxyz 1 2 3) (* i (+ 0.06 (/ k 100))))) (iota 4))))))"
  "          (iota 5))";
static const struct { const char *drawing, *ending; } outputs[] = { { single, "off" }, { several, "off" }, { several, "3mf" }, { several, "glb" }, { several, "x3d" } };

static const char *place(const char *ending) {
  static char path[64];
  snprintf(path, sizeof path, "/tmp/vs-progress-%ld.%s", (long)getpid(), ending);
  return path;
}

static vs_outcome write_it(watch *w, const char *drawing, const char *ending, double until) {
  vs_options o = vs_options_default();
  *w = (watch){ .until = until };
  o.host.context = w, o.host.progress = follow, o.host.diagnose = tell;
  w->s = vs_new(&o);
  assert_non_null(w->s);
  assert_int_equal(vs_eval_text(w->s, "model", 1, drawing, strlen(drawing), 0), VS_OUTCOME_DONE);
  return vs_write_drawing(w->s, place(ending), NULL, NULL);
}

static void test_grows(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i++) {
    watch w;
    assert_int_equal(write_it(&w, outputs[i].drawing, outputs[i].ending, 2), VS_OUTCOME_DONE);
    assert_int_equal(unlink(place(outputs[i].ending)), 0);
    if (w.wrong[0]) fail_msg("%s of %s: %s", outputs[i].ending, outputs[i].drawing, w.wrong);
    if (w.told < 3 || w.steps < 2 || w.done < 0.5) fail_msg("%s: told %d times, %d steps, the last %g", outputs[i].ending, w.told, w.steps, w.done);
    vs_free(w.s);
  }
}

static void test_interrupt(void **state) {
  (void)state;
  static const double until[] = { 0, 0.5 };
  for (size_t i = 0; i < sizeof outputs / sizeof *outputs; i += 3)
    for (size_t k = 0; k < sizeof until / sizeof *until; k++) {
      watch w;
      assert_int_equal(write_it(&w, outputs[i].drawing, outputs[i].ending, until[k]), VS_OUTCOME_INTERRUPTED);
      assert_non_null(strstr(w.said, "interrupted"));
      assert_true(w.done >= until[k]);
      assert_int_equal(access(place(outputs[i].ending), F_OK), -1);
      assert_int_equal(vs_eval_text(w.s, "after", 1, "(+ 1 2)", 7, 0), VS_OUTCOME_DONE);
      vs_free(w.s);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_grows), cmocka_unit_test(test_interrupt) };
  return cmocka_run_group_tests_name("progress", tests, NULL, NULL);
}
