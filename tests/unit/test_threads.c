/* Tests threads. Interpreters share nothing: several threads, each with an interpreter, must write the bytes that a
 * single thread writes, while another thread interrupts one of the interpreters. No thread that the library starts
 * receives a signal of the host. `make tsan` runs this test under the thread sanitizer. */
#define _GNU_SOURCE /* for gettid, pthread_tryjoin_np */
#include <dirent.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <cmocka.h>

#include "visualscheme.h"

enum { THREADS = 3, TURNS = 2 };

typedef struct {
  uint64_t sum;
  size_t bytes;
} print;
typedef struct {
  print of[32];
  vs_outcome outcome;
  size_t formats;
  size_t hits, meshes, gizmos, changes; /* hits, meshes, gizmos, changes: numbers of events of each kind that the host
                                         * has received */
  double distance, width;
} result;

static const char model[] =
    "(define-parameter n 3 #:min 1 #:max 9)"
    "(define-syntax twice (syntax-rules () ((_ e) (begin e e))))"
    "(define h (make-hash)) (hash-set! h 'a (string->symbol (number->string n)))"
    "(define (tower i) (do-move (subtract (make-sphere (xyz 0 0 0) 1) (make-box (xyz 0 0 0) (xyz 1 1 1))"
    "  (make-cylinder (xyz 0 0 -2) 4 1/4)) (vxyz (* 3 i) 0 0)))"
    "(draw (unite (map tower (iota n))))"
    "(draw (with-material 'copper (make-torus (xyz 0 9 0) 2 1/2)))"
    "(draw (make-text (xyz 0 20 0) 1 \"aV\")) (draw (hull (make-sphere (xyz 0 30 0) 1) (make-box (xyz 3 30 0) 1 1 1)))"
    "(define-function (ball x y z) (- (+ (* x x) (* y y) (* z z)) 1))"
    "(draw (make-isosurface ball (xyz -2 -2 -2) (xyz 2 2 2)))"
    "(twice (display (volume (tower 0)))) (guard (e (#t (display e))) (car 5))";

static bool add(void *context, const void *bytes, size_t count) { /* adds the bytes to the hash FNV-1a of the output */
  print *p = context;
  const unsigned char *b = bytes;
  for (size_t i = 0; i < count; i++) p->sum = (p->sum ^ b[i]) * 1099511628211u;
  p->bytes += count;
  return true;
}

static const char scene[] =
    "(define rig (node-create #:name \"rig\" #:parent (node-getroot) #:translate (vxyz 0 0 60)))"
    "(for ([i (in-range 3)]) (node-create #:parent rig #:drawing (tower 0) #:translate (vxyz (* 5 i) 0 0)))"
    "(define width (make-slider (xyz 0 9 0) (xyz 10 9 0) 0 10 #:value 4 #:size 1 #:name \"width\" #:parent rig))"
    "(property-subscribe (property-ref width 'value) (lambda (v) (node-scale (node-getchild rig 0) (+ 1 v))))"
    "(every-frame (lambda (seconds) (node-rotate rig (v+v (node-getrotate rig) (vxyz 0 0 0)))))";

static bool take_hit(void *context, vs_scheme *s, const vs_hit *hit) {
  result *r = context;
  (void)s;
  if (r->hits++ == 0) r->distance = hit->distance;
  return true;
}
static bool take_gizmo(void *context, vs_scheme *s, const vs_gizmo *gizmo) {
  (void)s;
  ((result *)context)->width = gizmo->value[0];
  return ++((result *)context)->gizmos != 0;
}
static bool changed(void *context, vs_scheme *s, const vs_handle *arguments, size_t count, vs_handle *value) {
  (void)s, (void)arguments, (void)count, (void)value;
  return ++((result *)context)->changes != 0;
}

/* Uses a scene as a host does: moves a node, follows a property, drags, runs frames, picks objects, reads meshes. */
static void hold_scene(vs_scheme *s, result *r) {
  const double down[] = { 0, 0, -1 };
  vs_mesh_info m;
  if (vs_eval_text(s, "scene", 1, scene, sizeof scene - 1, 0) != VS_OUTCOME_DONE) return;
  vs_handle node = vs_node_create(s, NULL, "more", vs_node_root(s)), rig = vs_node_find(s, "rig");
  vs_node_set_drawing(s, node, vs_lookup(s, "rig") ? vs_node_object(s, vs_node_find(s, "rig")) : 0);
  vs_node_place(s, node, (double[]){ 0, 40, 0 }, (double[]){ 0, 0, 90 }, NULL);
  vs_handle width = vs_node_find(s, "width"), property = vs_property_of(s, width, "value");
  vs_property_subscribe(s, property, changed, r);
  vs_input(s, VS_INPUT_PRESS, VS_BUTTON_LEFT, (double[]){ 4, 9, 90 }, down, NULL, NULL);
  for (int i = 0; i < 20; i++)
    vs_input(s, VS_INPUT_DRAG, VS_BUTTON_LEFT, (double[]){ 4 + 0.25 * i, 9, 90 }, down, NULL, NULL);
  vs_input(s, VS_INPUT_RELEASE, VS_BUTTON_LEFT, (double[]){ 9, 9, 90 }, down, NULL, NULL);
  vs_handle one = vs_handle_number(s, 1);
  vs_post(s, property, one);
  vs_update(s);
  vs_scene_frame(s, 0.1);
  vs_gizmos(s, take_gizmo, r);
  vs_pick(s, (double[]){ -30, 0.3, 60.4 }, (double[]){ 1, 0, 0 }, take_hit, r);
  vs_handle_release(s, rig);
  vs_meshes_forget(s); /* removes the meshes of the previous run, so that the library returns all of them again */
  if (vs_meshes_begin(s, NULL) != VS_OUTCOME_DONE) return;
  while (vs_mesh_next(s, &m)) r->meshes++;
}

static void *make(void *context) {
  result *r = context;
  vs_scheme *s = vs_new(NULL);
  size_t count;
  const vs_format_info *formats = vs_format_list(&count);
  for (int turn = 0; s && turn < TURNS; turn++) {
    if (turn) vs_restart(s);
    memset(r->of, 0, sizeof r->of);
    r->outcome = vs_eval_text(s, "model", 1, model, sizeof model - 1, 0);
    r->formats = 0;
    for (size_t i = 0; i < count; i++)
      if (!formats[i].worker && vs_write_drawing_to(s, formats[i].name, NULL, add, &r->of[i]) == VS_OUTCOME_DONE)
        r->formats++;
    r->hits = r->meshes = r->gizmos = r->changes = 0;
    hold_scene(s, r);
  }
  vs_free(s);
  return NULL;
}

static void test_apart(void **state) {
  (void)state;
  pthread_t threads[THREADS];
  static result alone, together[THREADS];
  make(&alone);
  assert_int_equal(alone.outcome, VS_OUTCOME_DONE);
  assert_in_range(alone.formats, 8, 32);
  assert_int_equal(alone.hits, 3);
  assert_int_equal(alone.gizmos, 1);
  assert_int_equal(alone.changes, 21); /* the value changes from 4 to 4.0 in steps of a quarter, and by the changes that
                                        * the host posted: 21 in all */
  assert_true(alone.width == 1 && alone.meshes == 6);
  for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_create(&threads[i], NULL, make, &together[i]), 0);
  for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_join(threads[i], NULL), 0);
  for (int i = 0; i < THREADS; i++) assert_memory_equal(&together[i], &alone, sizeof alone);
}

static void *interrupt(void *s) {
  for (int i = 0; i < 1000; i++) vs_interrupt(s);
  return NULL;
}

static void test_interrupted(void **state) {
  (void)state;
  static const char endless[] = "(let loop () (loop))";
  pthread_t thread;
  vs_scheme *s = vs_new(NULL);
  assert_non_null(s);
  for (int i = 0; i < 5; i++) {
    assert_int_equal(pthread_create(&thread, NULL, interrupt, s), 0);
    assert_int_equal(vs_eval_text(s, "endless", 1, endless, sizeof endless - 1, 0), VS_OUTCOME_INTERRUPTED);
    assert_int_equal(pthread_join(thread, NULL), 0);
    vs_interrupt_clear(s);
  }
  vs_free(s);
}

static atomic_int host; /* thread id of the thread that evaluates the program */

static void *evaluate(void *s) {
  static const char solids[] =
      "(volume (unite (map (lambda (i) (unite (make-sphere (xyz (* 9 i) 0 0) (+ 1 (/ i 999)))"
      "  (make-sphere (xyz (+ (* 9 i) 1) 0 0) 1))) (iota 200))))";
  atomic_store(&host, gettid());
  return vs_eval_text(s, "solids", 1, solids, sizeof solids - 1, 0) == VS_OUTCOME_DONE ? s : NULL;
}

/* Returns true if this thread of the process does not block the signal. For a thread that has ended returns false. */
static bool hears(const char *thread, int signal_number) {
  char path[300], line[200];
  unsigned long long held = ~0ull;
  int threads = 0; /* number of threads in the process's status file; 0 if the thread has just ended */
  snprintf(path, sizeof path, "/proc/self/task/%s/status", thread);
  FILE *f = fopen(path, "r");
  while (f && fgets(line, sizeof line, f)) sscanf(line, "Threads: %d", &threads), sscanf(line, "SigBlk: %llx", &held);
  if (f) fclose(f);
  return threads > 0 && !(held >> (signal_number - 1) & 1);
}

/* Tests that signals reach only the host's threads, not the threads that the library has started. */
static void test_signals(void **state) {
  (void)state;
  pthread_t thread;
  void *done = NULL;
  vs_scheme *s = vs_new(NULL);
  assert_non_null(s);
  assert_int_equal(pthread_create(&thread, NULL, evaluate, s), 0);
  while (pthread_tryjoin_np(thread, &done) != 0) {
    DIR *threads = opendir("/proc/self/task");
    assert_non_null(threads);
    for (struct dirent *e; (e = readdir(threads));)
      if (atoi(e->d_name) > 0 && atoi(e->d_name) != getpid() && atomic_load(&host) && atoi(e->d_name) != host)
        if (hears(e->d_name, SIGINT) || hears(e->d_name, SIGTERM)) fail_msg("thread %s hears signals", e->d_name);
    closedir(threads);
  }
  assert_ptr_equal(done, s);
  vs_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_apart), cmocka_unit_test(test_interrupted),
                                      cmocka_unit_test(test_signals) };
  return cmocka_run_group_tests_name("threads", tests, NULL, NULL);
}
