/* Tests the C procedures that make geometry, called one by one without the reader: values, messages, and degenerate
 * objects. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "bind/procedures.h"
#include "bind/records.h"
#include "bind/state.h"
#include "vm/values/printer.h"
#include "vm/machine/open_vm.h"
#include "vm/machine/run.h"

enum { NAMES = 512 };
typedef struct {
  vs_scheme *vm;
  vs_bind bind;
  vs_store *store;
  vs_value names[NAMES], procedures[NAMES];
  struct vs_roots kept[2]; /* two blocks of values that the garbage collector keeps */
  size_t count;
  char text[512]; /* text of the last result or error */
  char warning[512];
  int warnings;
} world;

static bool define(vs_scheme *vm, void *context, vs_value symbol, vs_value procedure) {
  (void)vm;
  world *w = context;
  w->names[w->count] = symbol, w->procedures[w->count++] = procedure;
  return w->count < NAMES;
}
static void warn(void *context, const vs_origin *origin, const char *message) {
  world *w = (world *)(void *)((char *)context - offsetof(world, bind)); /* a world's member `bind` is passed as
                                                                          * context, so the world is found by the
                                                                          * member's offset */
  (void)origin;
  w->warnings++;
  snprintf(w->warning, sizeof w->warning, "%s", message);
}

static int setup(void **state) {
  world *w = test_calloc(1, sizeof *w);
  vs_flat_rules rules;
  w->vm = vs_open_vm(&(vs_config){ 0 });
  w->store = vs_store_new(NULL, NULL);
  vs_bind_flat_rules(&rules);
  assert_true(w->vm && w->store && vs_flat_register(w->vm, &rules) && vs_bind_open(&w->bind, w->vm, w->store));
  w->bind.job.warn = warn;
  w->kept[0] = (struct vs_roots){ NULL, w->vm, w->names, NAMES };
  w->kept[1] = (struct vs_roots){ NULL, w->vm, w->procedures, NAMES };
  vs_gc_link(&w->kept[0]);
  vs_gc_link(&w->kept[1]);
  assert_true(vs_native_define(w->vm, &vs_bind_table, define, w));
  *state = w;
  return 0;
}
static int teardown(void **state) {
  world *w = *state;
  vs_close_vm(w->vm);
  vs_bind_close(&w->bind);
  vs_store_release(w->store);
  test_free(w);
  return 0;
}

static void call(world *w, const char *name, size_t n, const vs_value *argv, vs_value *out) {
  size_t i = 0;
  vs_text t;
  while (i < w->count && strcmp(vs_as_symbol(w->names[i])->name, name)) i++;
  assert_true(i < w->count);
  bool ok = vs_run(w->vm, w->procedures[i], n, argv, out);
  vs_text_open(w->vm, &t, 0);
  assert_true(ok ? vs_print(w->vm, *out, VS_PRINT_WRITE, &t) : vs_print_condition(w->vm, w->vm->condition, &t));
  assert_true(vs_text_end(&t));
  snprintf(w->text, sizeof w->text, "%s", t.at);
  vs_text_close(&t);
}

/* Checks that (NAME ARGUMENTS) prints as EXPECTED; the value stays in r[0] */
#define CHECK(expected, name, ...)                                                                            \
  do {                                                                                                        \
    call(w, name, sizeof((vs_value[]){ __VA_ARGS__ }) / sizeof(vs_value), (vs_value[]){ __VA_ARGS__ }, &r[0]); \
    assert_string_equal(w->text, expected);                                                                   \
  } while (0)
#define I(n) vs_fix(n)
#define D(d) vs_flonum(d)

static void test_points(void **state) {
  world *w = *state;
  VS_ROOTS(w->vm, r, 8);
  CHECK("(xyz 1 2 3.5)", "xyz", I(1), I(2), D(3.5));
  r[4] = r[0];
  CHECK("(xyz 11 2.5 3.5)", "+xy", r[4], I(10), D(.5));
  CHECK("(xyz 0 2 0)", "pol", I(2), D(1.5707963267948966));
  CHECK("(xyz 0 0 -3)", "sph", I(3), I(0), D(3.141592653589793));
  CHECK("2.0", "cy", r[4]);
  CHECK("(vxyz 0 0 0)", "p->q", r[4], r[4]);
  r[5] = r[0];
  CHECK("make-axis: direction must be longer than 0, got (vxyz 0 0 0)", "make-axis", r[4], r[5]);
  CHECK("(vxyz 0 0 1)", "vxyz", I(0), I(0), I(1));
  r[5] = r[0];
  CHECK("(make-axis (xyz 1 2 3.5) (vxyz 0 0 1))", "make-axis", r[4], r[5]);
  CHECK("p+v: v must be a gvector ((vxyz 1 2 3.5)?), got (xyz 1 2 3.5)", "p+v", r[4], r[4]);
}

static void test_sequences(void **state) {
  world *w = *state;
  VS_ROOTS(w->vm, r, 8);
  CHECK("(0 1 2 3)", "enumerate", I(0), I(4), I(4));
  CHECK("()", "enumerate", I(0), I(4), I(0));
  CHECK("(0 1/2 1)", "division", I(0), I(1), I(2));
  CHECK("(0.0 0.5)", "division", D(0), I(1), I(2), VS_FALSE);
  CHECK("(xyz 0 0 0)", "xyz", I(0), I(0), I(0));
  r[1] = r[0];
  CHECK("(xyz 2 0 0)", "xyz", I(2), I(0), I(0));
  r[2] = r[0];
  CHECK("((xyz 0 0 0) (xyz 1 0 0) (xyz 2 0 0))", "line-sequence", r[1], r[2], I(3));
  CHECK("((xyz 0 0 2) (xyz 2 0 0))", "arc-sequence", r[1], I(2), I(0), I(0), D(1.5707963267948966), I(2));
  CHECK("((xyz 0 0 5) (xyz 2.5 0 4.330127018922193) (xyz 5 0 0))", "linear-h-arc-sequence", r[1], I(5), I(0), I(0), D(1.5707963267948966), I(3));
  CHECK("10.0", "arc-height", I(10), I(0), D(1.5707963267948966));
}

static void test_solids(void **state) {
  world *w = *state;
  VS_ROOTS(w->vm, r, 8);
  CHECK("(xyz 0 0 0)", "xyz", I(0), I(0), I(0));
  r[1] = r[0];
  CHECK("(xyz 1 2 3)", "xyz", I(1), I(2), I(3));
  r[2] = r[0];
  CHECK("(make-box (xyz 0 0 0) (xyz 1 2 3))", "make-box", r[2], r[1]);
  r[3] = r[0];
  CHECK("(make-box (xyz -1 -2 -3) (xyz 1 2 3))", "make-box", r[1], I(2), I(4), I(6));
  CHECK("make-box: takes (make-box p q) or (make-box c dx dy dz); perhaps (make-box (xyz 0 0 0) (xyz 1 2 3))", "make-box", I(1), I(2), I(3));
  CHECK("make-box: q must be a point, got 5", "make-box", r[1], I(5));
  CHECK("(unite (make-box (xyz 0 0 0) (xyz 1 2 3)) (make-box (xyz 0 0 0) (xyz 1 2 3)))", "unite", r[3], r[3]);
  CHECK("unite: objects must hold only objects, but one expression gave no value", "unite", r[3], VS_UNSPECIFIC);
  CHECK("(make-line (list (xyz 0 0 0) (xyz 1 2 3)))", "make-line", r[1], r[1], r[2]);
  CHECK("make-region: curves must be a curve or a list of curves, got (make-box (xyz 0 0 0) (xyz 1 2 3))", "make-region", r[3]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test_setup_teardown(test_points, setup, teardown),
    cmocka_unit_test_setup_teardown(test_sequences, setup, teardown),
    cmocka_unit_test_setup_teardown(test_solids, setup, teardown),
  };
  return cmocka_run_group_tests_name("bind", tests, NULL, NULL);
}
