/* Tests that every pass over a drawing takes linear time and can be interrupted. The drawings are a chain, a comb and a
 * fan of a million nodes (LONG=1; otherwise fewer). Each pass of passes.def runs alone, then all passes run together.
 * The test measures processor time, since the machine may be busy. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <cmocka.h>

#include "geometry/measure/node_measures.h"
#include "model/job.h"
#include "model/store/piece.h"
#include "model/store/store_inside.h"
#include "passes/optimise.h"
#include "passes/passes.h"
#include "vm/values/debug.h"

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

/* ---- trees of n nodes ---- */

static vs_node *leaf(vs_store *s, size_t i) {
  return vs_node_new(s, VS_SPHERE, &(struct vs_sphere){ .center = { (double)(i % 1000) * 3, (double)(i / 1000) * 3, 0 }, .radius = 1 }, NULL, 0);
}

static vs_node *over(vs_store *s, vs_kind kind, const void *data, vs_node *a, vs_node *b) { /* takes over the references to
                                                                                             * the children */
  vs_node *n = vs_node_new(s, kind, data, (vs_ref[]){ { a, NULL }, { b, NULL } }, b ? 2 : 1);
  vs_node_release(a), vs_node_release(b);
  assert_non_null(n);
  return n;
}

static vs_node *moved(vs_store *s, size_t i, vs_node *n) {
  struct vs_transform t = { .matrix = vs_affine_translation(vs_v3((double)(i % 7) - 3, 1, 0)) };
  return over(s, VS_TRANSFORM, &t, n, NULL);
}
static vs_node *turned(vs_store *s, size_t i, vs_node *n) {
  struct vs_transform t = { .matrix = vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(0, 0, 1), (double)i) };
  return over(s, VS_TRANSFORM, &t, n, NULL);
}

static vs_node *chain_of_moves(vs_store *s, size_t n) {
  vs_node *at = leaf(s, 0);
  for (size_t i = 1; i < n; i++) at = moved(s, i, at);
  return at;
}
static vs_node *chain_of_turns(vs_store *s, size_t n) {
  vs_node *at = over(s, VS_UNION, NULL, leaf(s, 0), leaf(s, 1));
  for (size_t i = 1; i < n; i++) at = turned(s, i, at);
  return at;
}
static vs_node *chain_of_sets(vs_store *s, size_t n) {
  vs_node *at = over(s, VS_UNION, NULL, leaf(s, 0), leaf(s, 1));
  for (size_t i = 1; i < n; i++) at = over(s, VS_UNION, NULL, at, NULL);
  return at;
}
static vs_node *comb(vs_store *s, size_t n) {
  vs_node *at = leaf(s, 0);
  for (size_t i = 1; i < n / 2; i++) at = over(s, VS_UNION, NULL, at, leaf(s, i));
  return at;
}
static vs_node *comb_of_kinds(vs_store *s, size_t n) {
  vs_node *at = leaf(s, 0);
  for (size_t i = 1; i < n / 3; i++) at = over(s, i % 2 ? VS_DIFFERENCE : VS_UNION, NULL, turned(s, i, at), leaf(s, i));
  return at;
}
static vs_node *fan(vs_store *s, size_t n, vs_node *(*make)(vs_store *s, size_t i)) {
  vs_ref *refs = malloc(n * sizeof *refs);
  assert_non_null(refs);
  for (size_t i = 0; i < n; i++) refs[i] = (vs_ref){ make(s, i), NULL };
  vs_node *at = vs_node_new(s, VS_UNION, NULL, refs, n);
  for (size_t i = 0; i < n; i++) vs_node_release(refs[i].node);
  free(refs);
  assert_non_null(at);
  return at;
}
static vs_node *fan_of_leaves(vs_store *s, size_t n) { return fan(s, n, leaf); }
static vs_node *trio(vs_store *s, size_t i) {
  return turned(s, i, over(s, VS_UNION, NULL, over(s, VS_DIFFERENCE, NULL, leaf(s, i), leaf(s, i + 1)), leaf(s, 2 * i)));
}
static vs_node *fan_of_trios(vs_store *s, size_t n) { return fan(s, n / 6, trio); }

static const struct { const char *name; vs_node *(*make)(vs_store *s, size_t n); } trees[] = {
  { "chain of moves", chain_of_moves }, { "chain of turns", chain_of_turns }, { "chain of sets", chain_of_sets }, { "comb", comb },
  { "comb of kinds", comb_of_kinds }, { "fan of leaves", fan_of_leaves }, { "fan of trios", fan_of_trios },
};
enum { TREES = sizeof trees / sizeof *trees };

/* ---- running ---- */

/* gap: longest time between two polls for an interrupt, in seconds. until: time in seconds after which the poll reports
 * an interrupt */
typedef struct { double last, gap, until; size_t asked; } listener;

static bool going(void *context, const char *stage, double done) {
  (void)stage, (void)done;
  listener *l = context;
  double at = now();
  if (at - l->last > l->gap) l->gap = at - l->last;
  l->last = at;
  l->asked++;
  return at < l->until;
}

/* Runs the passes over the tree. *seconds: processor time of the passes and of freeing the tree. stop_after: seconds
 * after which a poll reports an interrupt. */
static vs_error_kind run(size_t tree, size_t n, unsigned passes, listener *l, double *seconds, double stop_after) {
  vs_store *s = vs_store_new(NULL, NULL);
  vs_node *root = trees[tree].make(s, n);
  vs_scene scene = { .store = s, .drawn = &(vs_ref){ root, NULL }, .drawn_count = 1 };
  vs_error e = { 0 };
  double began = now();
  *l = (listener){ .last = began, .until = began + stop_after };
  vs_job job = { .going = going, .context = l };
  vs_store_set_job(s, &job);
  bool ok = vs_scene_optimise(&scene, passes, NULL, NULL, &e);
  *seconds = now() - began;
  if (now() - l->last > l->gap) l->gap = now() - l->last;
  vs_store_set_job(s, NULL);
  vs_node_release(scene.drawn[0].node);
  vs_store_release(s);
  return ok ? VS_ERROR_NONE : e.kind;
}

/* Longest processor time allowed between two polls, and from an interrupt until the tree is freed; in seconds. */
#define SILENT 0.3

static void every_pass(void **state) {
  (void)state;
  const char *longer = getenv("LONG");
  size_t n = longer && *longer ? 1000000 : 100000;
  for (unsigned k = 0; k <= VS_PASS_COUNT; k++)
    for (size_t t = 0; t < TREES; t++) {
      unsigned passes = k < VS_PASS_COUNT ? 1u << k : (1u << VS_PASS_COUNT) - 1;
      const char *name = k < VS_PASS_COUNT ? vs_pass_get((vs_pass_kind)k)->name : "all";
      listener l;
      double small, large, stopped;
      assert_int_equal(run(t, n / 4, passes, &l, &small, 1e9), VS_ERROR_NONE);
      assert_int_equal(run(t, n, passes, &l, &large, 1e9), VS_ERROR_NONE);
      if (getenv("SHOW")) print_message("%-8s %-16s %.3f -> %.3f s, silent for %.3f\n", name, trees[t].name, small, large, l.gap);
      /* `large` is the time for four times as many nodes as `small`. Linear time makes it 4 times `small`, quadratic
       * time 16 times; 12 is allowed */
      if (large > 0.1 + 12 * small) fail_msg("%s of a %s: %.3f s, and %.3f s of four times as many nodes", name, trees[t].name, small, large);
      if (l.gap > SILENT) fail_msg("%s of a %s does not ask for %.3f s", name, trees[t].name, l.gap);
      vs_error_kind kind = run(t, n, passes, &l, &stopped, large / 2);
      double late = stopped - large / 2;
      if (kind != VS_ERROR_NONE && kind != VS_ERROR_INTERRUPT) fail_msg("%s of a %s ends with error %d", name, trees[t].name, (int)kind);
      if (kind == VS_ERROR_INTERRUPT && late > SILENT) fail_msg("%s of a %s goes on for %.3f s", name, trees[t].name, late);
    }
}

/* ---- a process that ends after an interrupt ---- */

#if defined __SANITIZE_ADDRESS__ || VS_DEBUG_STRESS
#define PIECES_COUNTED 0 /* there every node is a block of its own, and the leak checker reports nodes that are not freed */
#else
#define PIECES_COUNTED 1
#endif

/* store: the store of the tree; nodes: number of its nodes at the interrupt */
typedef struct { vs_store *store; size_t nodes; } leaving;

static bool leave(void *context, const char *stage, double done) {
  (void)stage, (void)done;
  leaving *l = context;
  if (!l->nodes) l->nodes = l->store->piece_count;
  vs_store_abandon(l->store);
  return false;
}

/* A pass that is interrupted in an abandoned store frees no node, and neither does the release of the tree: both would
 * take as long as making a million nodes. */
static void frees_nothing(void **state) {
  (void)state;
  if (!PIECES_COUNTED) skip();
  unsigned interrupted = 0;
  for (unsigned pass = 0; pass < VS_PASS_COUNT; pass++)
    for (size_t t = 0; t < TREES; t++) {
      vs_store *s = vs_store_new(NULL, NULL);
      vs_node *root = trees[t].make(s, 100000);
      vs_scene scene = { .store = s, .drawn = &(vs_ref){ root, NULL }, .drawn_count = 1 };
      vs_error e = { 0 };
      leaving l = { .store = s };
      vs_job job = { .going = leave, .context = &l };
      vs_store_set_job(s, &job);
      bool ok = vs_scene_optimise(&scene, 1u << pass, NULL, NULL, &e);
      vs_store_set_job(s, NULL);
      assert_int_equal(ok ? VS_ERROR_INTERRUPT : e.kind, VS_ERROR_INTERRUPT);
      interrupted += !ok;
      vs_node_release(scene.drawn[0].node);
      if (!ok && s->piece_count < l.nodes)
        fail_msg("%s of a %s: %zu of %zu nodes are left", vs_pass_get((vs_pass_kind)pass)->name, trees[t].name,
                 s->piece_count, l.nodes);
      vs_store_slabs_free(s);
    }
  assert_true(interrupted * 2 > VS_PASS_COUNT * TREES); /* the others end before their first poll */
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(every_pass), cmocka_unit_test(frees_nothing) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
