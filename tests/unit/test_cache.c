/* Tests the cache of computed results. The cache compares whole values, not only their hashes. It removes the least
 * recently used entry first, stays within its limit of bytes, and frees its memory when an allocation is refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "backends/reuse.h"
#include "model/store/cache.h"
#include "visualscheme.h"

/* ---- the cache alone, without an interpreter ---- */

static vs_node *sphere(vs_store *s, double radius) {
  vs_node *n = vs_node_new(s, VS_SPHERE, &(struct vs_sphere){ .radius = radius }, NULL, 0);
  assert_non_null(n);
  return n;
}

static const vs_cached *keep(vs_cache *c, vs_node *n, uint64_t word, size_t bytes) {
  char *data = calloc(1, bytes);
  assert_non_null(data);
  memcpy(data, &word, sizeof word);
  const vs_cached *r = vs_cache_keep(c, &(vs_cache_key){ VS_CACHED_PRIMITIVE, n, &word, 1, 0 }, &(vs_cache_piece){ data, bytes }, 1);
  free(data);
  return r;
}

static bool holds(vs_cache *c, vs_node *n, uint64_t word) {
  const vs_cached *r = vs_cache_find(c, &(vs_cache_key){ VS_CACHED_PRIMITIVE, n, &word, 1, 0 });
  if (r) assert_memory_equal(r->data, &word, sizeof word);
  vs_cache_let_go(c, r);
  return r != NULL;
}

static void test_equality(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_cache *c = vs_cache_new(s, 1 << 20);
  vs_node *a = sphere(s, 1), *b = sphere(s, 1), *other = sphere(s, 2);
  vs_cache_let_go(c, keep(c, a, 7, 100));
  assert_true(holds(c, b, 7)); /* a sphere at another address, equal in value */
  assert_false(holds(c, b, 8));
  assert_false(holds(c, NULL, 7));
  other->hash = a->hash; /* gives two different spheres equal hashes: the cache must distinguish them */
  assert_false(holds(c, other, 7));
  uint64_t words[] = { 7, 0 };
  assert_null(vs_cache_find(c, &(vs_cache_key){ VS_CACHED_PRIMITIVE, b, words, 2, 0 }));
  assert_null(vs_cache_find(c, &(vs_cache_key){ VS_CACHED_CLUSTER, b, words, 1, 0 }));
  const vs_cached *first = keep(c, NULL, 1, 16), *second = keep(c, NULL, 2, 16);
  assert_true(first->serial != second->serial && first->serial && second->serial);
  vs_cache_let_go(c, first);
  vs_cache_let_go(c, second);
  vs_node_release(a), vs_node_release(b), vs_node_release(other);
  assert_int_equal(vs_cache_count(c).hits[VS_CACHED_PRIMITIVE], 1);
  vs_cache_free(c);
  assert_null(vs_store_cache(s));
  assert_int_equal(vs_store_bytes(s), 0);
  vs_store_release(s);
}

static void test_bound(void **state) {
  (void)state;
  enum { ONE = 10000, LIMIT = 100000 };
  vs_store *s = vs_store_new(NULL, NULL);
  vs_cache *c = vs_cache_new(s, LIMIT);
  for (uint64_t i = 0; i < 50; i++) { /* requests each value in a separate turn, the time between two calls of
                                       * vs_cache_turn */
    vs_cache_turn(c, true);
    vs_node *n = sphere(s, 1 + (double)i);
    vs_cache_let_go(c, keep(c, n, i, ONE));
    vs_node_release(n);
    assert_true(vs_cache_count(c).bytes <= LIMIT);
    assert_true(vs_store_bytes(s) < LIMIT + 4096); /* the cache's limit includes nodes to which only the cache still
                                                    * refers */
    if (i > 0) {
      vs_node *again = sphere(s, 1);
      assert_true(holds(c, again, 0)); /* every turn requests the value of `again`, so the cache removes other
                                        * entries */
      vs_node_release(again);
    }
  }
  assert_true(vs_cache_count(c).evicted > 35);
  assert_true(vs_cache_count(c).entries >= 8);
  vs_cache_turn(c, true); /* within a turn the cache removes no entry that was requested, and stores no new entry beyond
                           * its limit */
  size_t kept = 0;
  for (uint64_t i = 100; i < 150; i++) {
    const vs_cached *r = keep(c, NULL, i, ONE);
    kept += r != NULL;
    vs_cache_let_go(c, r);
  }
  assert_in_range(kept, 8, 10);
  for (uint64_t i = 100; i < 100 + kept; i++) assert_true(holds(c, NULL, i));
  assert_null(keep(c, NULL, 999, LIMIT));
  const vs_cached *held = vs_cache_find(c, &(vs_cache_key){ VS_CACHED_PRIMITIVE, NULL, (uint64_t[]){ 101 }, 1, 0 });
  assert_true(vs_cache_shrink(c, SIZE_MAX)); /* vs_cache_shrink removes every entry to which no caller refers */
  assert_int_equal(vs_cache_count(c).entries, 1);
  assert_false(vs_cache_shrink(c, SIZE_MAX));
  vs_cache_let_go(c, held);
  vs_cache_turn(c, false); /* in this turn the cache finds entries, but stores no new entries */
  assert_true(holds(c, NULL, 101));
  assert_null(keep(c, NULL, 5000, 16));
  vs_cache_free(c);
  vs_store_release(s);
}

static void test_refused(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_cache *c = vs_cache_new(s, 1 << 20);
  vs_node *leaf = sphere(s, 1), *n = leaf;
  for (int i = 0; i < 200; i++) { /* a node 200 levels deep: the cache must poll for an interrupt while it counts the
                                   * node's bytes */
    vs_ref both[] = { { n, NULL }, { leaf, NULL } };
    vs_node *up = vs_node_new(s, VS_UNION, &(struct vs_union){ 0 }, both, 2);
    if (n != leaf) vs_node_release(n);
    n = up;
  }
  bool kept = false;
  size_t refusals = 0;
  for (size_t at = 1; !kept; at++) {
    vs_store_fail_at(s, at);
    const vs_cached *r = keep(c, n, 3, 64);
    kept = r != NULL;
    refusals += !kept;
    vs_cache_let_go(c, r);
    vs_store_fail_at(s, 0);
    assert_int_equal(vs_cache_count(c).entries, kept);
    assert_int_equal(holds(c, n, 3), kept);
  }
  assert_true(refusals > 3);
  vs_cache_free(c);
  vs_node_release(n);
  vs_node_release(leaf);
  assert_int_equal(vs_store_bytes(s), 0);
  vs_store_release(s);
}

/* ---- through the interpreter: after a change of the model, only changed parts are computed again, and the written
 * bytes equal those of a new process ---- */

typedef struct { char *at; size_t count; } bytes;

static bool collect(void *context, const void *from, size_t count) {
  bytes *b = context;
  char *grown = realloc(b->at, b->count + count + 1);
  if (!grown) return false;
  memcpy(grown + b->count, from, count);
  b->at = grown, b->count += count;
  return true;
}

static double statistic(vs_scheme *s, const char *key) {
  vs_statistic all[256];
  size_t n = vs_statistics(s, all, 256);
  for (size_t i = 0; i < n; i++)
    if (!strcmp(all[i].key, key)) return all[i].value;
  fail_msg("no statistic %s", key);
  return 0;
}

static void say(void *context, const vs_diagnostic *d) {
  (void)context;
  if (d->severity == VS_SEVERITY_ERROR) fprintf(stderr, "%s\n", d->message);
}

static vs_scheme *session(size_t cache) {
  vs_options o = vs_options_default();
  o.host.diagnose = say;
  o.cache = cache;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  return s;
}

static void run(vs_scheme *s, const char *text) { assert_int_equal(vs_eval_text(s, "test", 1, text, strlen(text), 0), VS_OUTCOME_DONE); }

static bytes written(vs_scheme *s, const char *format, bool last) {
  bytes b = { NULL, 0 };
  vs_output_options o = vs_output_options_default();
  o.last = last;
  assert_int_equal(vs_write_drawing_to(s, format, &o, collect, &b), VS_OUTCOME_DONE);
  assert_true(b.count > 0);
  return b;
}

/* The model has forty parts, each a cluster (a group of touching solids) of three. No part is a copy of another part.
 * `changed` is another radius for part k. */
enum { PARTS = 40 };
static const char *const parts =
    "(define (part i r) (subtract (unite (make-box (xyz (* 10 i) 0 0) (xyz (+ (* 10 i) 5 (* i 0.01)) 5 5)) (make-sphere (xyz (* 10 i) 0 0) r)) (make-cylinder (xyz (+ (* 10 i) 2) 2 -1) 7 1)))"
    "(define (model k r) (erase-all) (for ([i (in-range 40)]) (draw (part i (if (= i k) r 2)))))";

static void test_incremental(void **state) {
  (void)state;
  static const char *const formats[] = { "stl", "glb", "3mf", "obj", "x3d", "povray", "openscad" };
  for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
    vs_scheme *s = session(0);
    run(s, parts);
    run(s, "(model 7 2)");
    bytes first = written(s, formats[f], false);
    double combined = statistic(s, "cache.clusters.misses"), meshed = statistic(s, "cache.primitives.misses");
    run(s, "(model 7 3)");
    bytes second = written(s, formats[f], false);
    if (!strcmp(formats[f], "stl")) {
      assert_true(combined == PARTS);
      assert_true(statistic(s, "cache.clusters.misses") == PARTS + 1); /* after a change, only the changed part is
                                                                        * computed again */
    }
    if (combined > 0) {
      assert_true(combined >= PARTS);
      assert_true(statistic(s, "cache.clusters.misses") - combined <= 1);
      assert_true(statistic(s, "cache.primitives.misses") - meshed <= 1);
    }
    run(s, "(model 7 2)"); /* changes the part back: nothing is computed again */
    double before = statistic(s, "cache.clusters.misses"), was = statistic(s, "cache.primitives.misses");
    bytes third = written(s, formats[f], false);
    assert_true(statistic(s, "cache.clusters.misses") == before && statistic(s, "cache.primitives.misses") == was);
    assert_int_equal(third.count, first.count);
    assert_memory_equal(third.at, first.at, first.count);
    vs_free(s);
    vs_scheme *fresh = session(SIZE_MAX); /* an interpreter whose cache stores nothing */
    run(fresh, parts);
    run(fresh, "(model 7 3)");
    bytes other = written(fresh, formats[f], true);
    assert_true(statistic(fresh, "cache.bytes") == 0);
    assert_int_equal(other.count, second.count);
    assert_memory_equal(other.at, second.at, other.count);
    vs_free(fresh);
    free(first.at), free(second.at), free(third.at), free(other.at);
  }
}

/* The cache stores the results of measures and checks, and returns a result only for an object equal to the measured
 * object. */
static void test_measures(void **state) {
  (void)state;
  static const char define[] =
      "(define (o r) (subtract (make-box (xyz 0 0 0) (xyz 5 5 5)) (make-sphere (xyz 0 0 0) r)))"
      "(define (ask r) (list (volume (o r)) (area (o r)) (centroid (o r)) (bounding-box (do-rotate (o r) 'z 0.3))))"
      "(define (l z) (make-polyface-mesh (list (xyz 0 0 0) (xyz 2 0 0) (xyz 2 1 0) (xyz 1 1 0) (xyz 1 2 0) (xyz 0 2 0) (xyz 0 0 z) (xyz 2 0 z) (xyz 2 1 z) (xyz 1 1 z) (xyz 1 2 z) (xyz 0 2 z))"
      " '((6 5 4 3 2 1) (7 8 9 10 11 12) (1 2 8 7) (2 3 9 8) (3 4 10 9) (4 5 11 10) (5 6 12 11) (6 1 7 12))))"
      "(define first (ask 3)) (define other (ask 2))";
  vs_scheme *s = session(0);
  run(s, define);
  double asked = statistic(s, "cache.measures.misses"), found = statistic(s, "cache.measures.hits");
  assert_true(asked >= 4);
  run(s, "(if (not (equal? first (ask 3))) (error \"other\")) (if (equal? first other) (error \"the same\"))");
  assert_true(statistic(s, "cache.measures.misses") == asked);
  assert_true(statistic(s, "cache.measures.hits") >= found + 3);
  run(s, "(l 1) (l 2) (l 1)");
  assert_true(statistic(s, "cache.checks.misses") == 2 && statistic(s, "cache.checks.hits") == 1);
  vs_free(s);
}

/* Parts in another order, of other colours or on other layers use the cached results, because order, colour and layer
 * are not in the key by which the cache finds a result. */
static void test_tags(void **state) {
  (void)state;
  static const char *const programs[] = {
    "(define (p i) (unite (make-box (xyz (* 10 i) 0 0) (xyz (+ (* 10 i) 5) 5 5)) (make-sphere (xyz (* 10 i) 0 0) 3)))"
    "(define (go a b c) (erase-all) (draw (color a (p 0)) (color b (p 1.5)) (layer c (p 3.25))))",
    "(go \"red\" \"blue\" \"x\")", "(go \"blue\" \"red\" \"y\")", "(erase-all) (draw (p 3.25) (color \"green\" (p 1.5)) (p 0))",
    "(erase-all) (draw (unite (color \"red\" (make-box (xyz 0 0 0) (xyz 5 5 5))) (color \"blue\" (make-sphere (xyz 0 0 0) 3))))",
    "(erase-all) (draw (unite (make-box (xyz 0 0 0) (xyz 5 5 5)) (make-sphere (xyz 0 0 0) 3)))",
  };
  static const char *const formats[] = { "obj", "ply", "3mf" };
  for (size_t f = 0; f < 3; f++) {
    vs_scheme *s = session(0);
    run(s, programs[0]);
    for (size_t i = 1; i < sizeof programs / sizeof *programs; i++) {
      run(s, programs[i]);
      bytes kept = written(s, formats[f], false), again = written(s, formats[f], false);
      vs_scheme *fresh = session(SIZE_MAX);
      run(fresh, programs[0]);
      run(fresh, programs[i]);
      bytes alone = written(fresh, formats[f], true);
      assert_int_equal(kept.count, alone.count);
      assert_memory_equal(kept.at, alone.at, alone.count);
      assert_int_equal(again.count, alone.count);
      assert_memory_equal(again.at, alone.at, alone.count);
      vs_free(fresh);
      free(kept.at), free(again.at), free(alone.at);
    }
    assert_true(statistic(s, "cache.clusters.hits") > 0);
    vs_free(s);
  }
}

/* Tests that after a restart an interpreter keeps parameters and meshes, and loses everything else. */
static void test_restart(void **state) {
  (void)state;
  static const char model[] =
      "(define-parameter k 3) (define-primitive (knob [r number?]) (make-sphere (xyz 0 0 0) r)) (camera (xyz 9 9 9) (xyz 0 0 0)) (view-from 'top)"
      "(register-drawing-function knob? (lambda (o) (do-move (make-box (xyz 0 0 0) (xyz 1 1 1)) (vxyz 0 0 (random 5)))))"
      "(for ([i (in-range 12)]) (draw (subtract (make-box (xyz (* 9 i) 0 0) (xyz (+ (* 9 i) 5 (random 1.0)) 5 5)) (make-sphere (xyz (* 9 i) 0 0) (if (= i k) 3 2)))))"
      "(draw (knob 1)) (define mine 5)";
  vs_scheme *s = session(0), *fresh = session(SIZE_MAX);
  run(s, model);
  bytes a = written(s, "stl", false);
  double clusters = statistic(s, "cache.clusters.misses");
  assert_true(vs_parameter_set(s, "k", "4"));
  for (int i = 0; i < 3; i++) {
    assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
    assert_int_equal(vs_parameter_count(s), 0);
    vs_summary sum;
    assert_int_equal(vs_drawing_summary(s, &sum), VS_OUTCOME_DONE);
    assert_int_equal(sum.objects, 0);
    assert_int_not_equal(vs_eval_text(s, "test", 1, "mine", 4, 0), VS_OUTCOME_DONE);
    run(s, model);
  }
  bytes b = written(s, "stl", false);
  assert_true(statistic(s, "cache.clusters.misses") - clusters <= 2); /* only the two changed clusters of thirteen
                                                                       * are computed again */
  bytes pov = written(s, "povray", false); /* POV-Ray's camera needs the bounds of each part, so each part's mesh is
                                            * computed separately */
  assert_true(vs_parameter_set(fresh, "k", "4"));
  run(fresh, model);
  bytes c = written(fresh, "stl", true), pov_too = written(fresh, "povray", true);
  assert_int_equal(b.count, c.count);
  assert_memory_equal(b.at, c.at, b.count);
  assert_int_equal(pov.count, pov_too.count);
  assert_memory_equal(pov.at, pov_too.at, pov.count);
  assert_int_equal(a.count, b.count); /* the mesh has as many triangles as before, at other places */
  free(a.at), free(b.at), free(c.at), free(pov.at), free(pov_too.at);
  vs_free(s);
  vs_free(fresh);
}

/* left: number of allocations until one is refused. on: true while allocations are counted. */
typedef struct { long left; bool on; } refusal;

static void *refusing(void *context, void *old, size_t old_size, size_t new_size) {
  refusal *r = context;
  (void)old_size;
  if (!new_size) return free(old), NULL;
  if (r->on && new_size > old_size && r->left-- <= 0) return NULL;
  return realloc(old, new_size);
}

static void test_restart_refused(void **state) {
  (void)state;
  refusal r = { 0, false };
  vs_options o = vs_options_default();
  o.alloc = refusing, o.alloc_context = &r;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  run(s, parts);
  run(s, "(define mine 5) (model 3 1)");
  long refusals = 0;
  for (vs_outcome outcome = VS_OUTCOME_MACHINE; outcome != VS_OUTCOME_DONE; refusals++) {
    r = (refusal){ refusals, true };
    outcome = vs_restart(s);
    r.on = false;
    if (outcome == VS_OUTCOME_DONE) break;
    assert_int_equal(outcome, VS_OUTCOME_MACHINE);
    if (refusals % 7 == 0) run(s, "(if (not (= mine 5)) (error \"lost\"))");
    vs_summary sum;
    assert_int_equal(vs_drawing_summary(s, &sum), VS_OUTCOME_DONE);
    assert_int_equal(sum.objects, PARTS);
  }
  assert_true(refusals > 5);
  run(s, parts);
  run(s, "(model 3 1)");
  vs_free(s);
}

/* The user's memory limit is for the program alone: the cache removes results to make room. */
static void test_limit(void **state) {
  (void)state;
  vs_options o = vs_options_default();
  o.limit_memory = (size_t)24 << 20;
  o.host.diagnose = say;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  run(s, parts);
  run(s, "(model 7 2)");
  bytes b = written(s, "stl", false);
  free(b.at);
  assert_true(statistic(s, "cache.bytes") > 100000);
  double room = (double)o.limit_memory - statistic(s, "memory.now") + statistic(s, "cache.bytes") / 2;
  char text[200];
  snprintf(text, sizeof text, "(define kept (make-bytevector %.0f 0))", room);
  run(s, text);
  assert_true(statistic(s, "cache.evicted") > 0);
  run(s, "(set! kept #f)");
  b = written(s, "stl", false);
  free(b.at);
  vs_free(s);
}

/* ---- cached text of the written formats ---- */

typedef struct { char text[4096]; size_t count; } heard;

static void hear(void *context, const vs_diagnostic *d) {
  heard *h = context;
  h->count += (size_t)snprintf(h->text + h->count, sizeof h->text - h->count, "%u:%u %s|", (unsigned)d->at.line, (unsigned)d->at.column, d->message);
  assert_true(h->count < sizeof h->text);
}

static vs_scheme *hearing(heard *h, size_t cache) {
  vs_options o = vs_options_default();
  o.host.diagnose = hear, o.host.context = h;
  o.cache = cache;
  vs_scheme *s = vs_new(&o);
  assert_non_null(s);
  return s;
}

/* A drawing with shapes alone and in a difference, painted and unpainted, templates, thin parts, a half-space and a
 * mesh. Parameter a changes a shape in the middle; b an object before all others, with its own paint and template; c
 * the drawing's size, and with it the tolerance and the thickness of lines; d the paint of the first row. */
static const char model[] =
    "(define (bolt h) (unite (make-cylinder (xyz 0 0 0) h 0.3) (make-box (xyz -1 -1 h) (xyz 1 1 (+ h 0.4))) (make-regular-polygon (xyz 0 0 0) 1 6)))\n"
    "(define (nut h) (subtract (make-box (xyz -1 -1 0) (xyz 1 1 h)) (make-cylinder (xyz 0 0 -1) 9 0.5) (make-torus (xyz 0 0 0) 1 0.2)))\n"
    "(define (model a b c d) (erase-all)\n"
    " (when b (draw (color \"orange\" (make-sphere (xyz 30 30 3) 1)) (do-move (nut 3.5) (vxyz 5 40 0)) (do-rotate (do-move (nut 3.5) (vxyz 5 40 0)) 'z 0.3)))\n"
    " (for ([i (in-range 300)]) (draw (color (if (even? i) d \"blue\") (make-cylinder (xyz (* 3 i) 0 0) (+ 1 (* i 0.001)) (if (= i 150) a 0.5)))))\n"
    " (for ([i (in-range 400)]) (draw (do-rotate (do-move (if (even? i) (bolt 2.25) (nut 1.75)) (vxyz (* 4 i) 20 0)) 'z (* i 0.001))))\n"
    " (draw (make-line (xyz 0 0 5) (xyz 1 1 6) (xyz c 3 5)) (make-circle (xyz 3 3 3) 2))\n"
    " (draw (subtract (make-box (xyz 0 0 0) (xyz 900 9 9)) (for/list ([i (in-range 200)]) (make-sphere (xyz (* 4 i) 0 (if (= i 77) a 0)) 1.25)) (do-move (nut 1.75) (vxyz 3 3 3))))\n"
    " (draw (intersect (make-half-space (make-plane (xyz 0 0 2) (vxyz 0 0 1))) (unite (for/list ([i (in-range 80)]) (make-sphere (xyz (* 4 i) 99 0) 5)))))\n"
    " (draw (do-scale (unite (for/list ([i (in-range 60)]) (do-sweep (make-circle (xyz 0 0 0) 0.2) (make-line (xyz i 0 0) (xyz i 2 2) (xyz i 2 5))))) c)))\n";

static void test_texts(void **state) {
  (void)state;
  static const char *const formats[] = { "povray", "openscad", "tree", "x3d" };
  static const struct { const char *text; bool most; } steps[] = {
    { "(model 0.5 #f 2 \"red\")", false }, { "(model 0.5 #f 2 \"red\")", true }, { "(model 0.4 #f 2 \"red\")", true }, { "(model 0.4 #t 2 \"red\")", true },
    { "(model 0.4 #t 2 \"gold\")", true }, { "(model 0.4 #f 900 \"red\")", false }, { "(model 0.5 #f 2 \"red\")", true } };
  for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
    heard one = { "", 0 };
    vs_scheme *s = hearing(&one, 0);
    run(s, model);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
      heard other = { "", 0 };
      vs_scheme *fresh = hearing(&other, SIZE_MAX);
      run(fresh, model);
      run(fresh, steps[i].text);
      run(s, steps[i].text);
      one.count = 0;
      double texts = statistic(s, "texts"), emitted = statistic(s, "texts.emitted");
      bytes b = written(s, formats[f], false), c = written(fresh, formats[f], true);
      texts = statistic(s, "texts") - texts, emitted = statistic(s, "texts.emitted") - emitted;
      assert_int_equal(b.count, c.count);
      assert_memory_equal(b.at, c.at, b.count);
      assert_string_equal(one.count ? one.text : "", other.count ? other.text : "");
      assert_true(statistic(fresh, "texts") == 0 && statistic(fresh, "cache.bytes") == 0);
      if (strcmp(formats[f], "x3d") != 0) {
        assert_true(texts >= 5);
        if (i == 0) assert_true(emitted == texts);
        if (steps[i].most) assert_true(2 * emitted <= texts + 1); /* after a change, at most half of the cached texts
                                                                   * are written anew */
      }
      free(b.at), free(c.at);
      vs_free(fresh);
    }
    vs_free(s);
  }
}

/* When an allocation is refused, the cached text or the whole output may be lost. An output that is reported as
 * complete has every byte. */
static void test_texts_refused(void **state) {
  (void)state;
  static const char drawn[] = "(define (bolt i) (unite (make-box (xyz i 0 0) (xyz (+ i 1) 1 2)) (make-sphere (xyz i 0 0) 0.7) (make-cylinder (xyz i 0 0) 5 0.2)))"
                              "(for ([i (in-range 60)]) (draw (color (if (even? i) \"red\" \"blue\") (make-sphere (xyz i 9 0) (+ 1 (* i 0.01)))) (do-rotate (bolt 3) 'z i)))";
  refusal r = { 0, false };
  vs_options o = vs_options_default();
  o.alloc = refusing, o.alloc_context = &r;
  vs_scheme *plain = session(SIZE_MAX);
  run(plain, drawn);
  bytes want = written(plain, "povray", true);
  vs_free(plain);
  size_t done = 0, failed = 0;
  const char *longer = getenv("LONG");
  long early = longer && *longer ? 1 : 11, late = 97; /* steps between the numbers of refused allocations: the
                                                       * first 300 take `early`, later ones, mostly of meshes, `late` */
  for (long left = 0; left < 6000 && done < 40; left += left < 300 ? early : late) {
    vs_scheme *s = vs_new(&o);
    assert_non_null(s);
    run(s, drawn);
    vs_output_options w = vs_output_options_default();
    for (int again = 0; again < 2; again++) { /* the first output stores text in the cache, the second output uses this
                                               * text */
      bytes b = { NULL, 0 };
      r = (refusal){ left, again == 0 };
      vs_outcome outcome = vs_write_drawing_to(s, "povray", &w, collect, &b);
      r.on = false;
      assert_true(outcome == VS_OUTCOME_DONE || outcome == VS_OUTCOME_MACHINE);
      *(outcome == VS_OUTCOME_DONE ? &done : &failed) += again == 0;
      if (outcome == VS_OUTCOME_DONE) assert_int_equal(b.count, want.count);
      if (outcome == VS_OUTCOME_DONE) assert_memory_equal(b.at, want.at, want.count);
      if (again) assert_int_equal(outcome, VS_OUTCOME_DONE);
      free(b.at);
    }
    vs_free(s);
  }
  assert_true(failed > 5 && done > 5);
  free(want.at);
}

/* The cache's key of a spline contains the spline's points first, then its tangents and other fields. Tests that a list
 * of points of any length leaves enough room in the key for these fields. */
static void test_payload_room(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  static vs_vec3 at[400];
  for (uint32_t count = 2; count <= 400; count++) {
    vs_reuse r = { .store = s };
    struct vs_spline spline = { .points = vs_points_new(s, at, count) };
    assert_non_null(spline.points);
    vs_reuse_start(&r);
    for (int i = 0; i < 3; i++) {
      vs_reuse_put_payload(&r, vs_kind_get(VS_SPLINE), &spline);
      assert_true(r.count <= r.room);
      /* numbers in the key of a spline: 1 for the count of points, 3 for each point, 1 for `closed`, 6 for tangents, 1
       * for segments */
      assert_int_equal(r.count, (size_t)(i + 1) * (1 + 3 * (size_t)count + 1 + 6 + 1));
    }
    assert_false(r.unfit);
    vs_reuse_free(&r);
    vs_points_release(s, spline.points);
  }
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_equality), cmocka_unit_test(test_bound), cmocka_unit_test(test_refused),
                                      cmocka_unit_test(test_incremental), cmocka_unit_test(test_measures), cmocka_unit_test(test_tags), cmocka_unit_test(test_restart),
                                      cmocka_unit_test(test_restart_refused), cmocka_unit_test(test_limit), cmocka_unit_test(test_texts), cmocka_unit_test(test_texts_refused),
                                      cmocka_unit_test(test_payload_room) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
