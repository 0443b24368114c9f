/* Tests a host's use of a scene. Rays are compared with formulas. Random sequences of calls receive valid and
 * invalid handles. Allocations are refused while a GML program runs, while nodes are made, and while the host
 * receives meshes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "visualscheme.h"

static const char model[] =
    "/gmlcontext node-create !n :n node-begin (0,0,0) (0,0,1) 1 8 circle 5 poly2doubleface\n"
    "[ (0.2,0.5,0) (0.4,1,0) ] extrude node-end node-getroot :n node-addchild\n"
    "[ 1 2 3 ] { dup mul } map pop (3,0,0) (0,0,1) 1 4 circle 3 poly2doubleface (0,1,3) extrude\n";

static uint64_t state;
static uint64_t next(void) {
  state ^= state << 13, state ^= state >> 7, state ^= state << 17;
  return state;
}
static double real(double low, double high) { return low + (high - low) * (double)(next() >> 11) / 9007199254740992.0; }

static bool take_first(void *context, vs_scheme *s, const vs_hit *hit) {
  (void)s;
  *(vs_hit *)context = *hit;
  return false;
}

/* Tests rays that hit a ball in a node that is moved, rotated and scaled. The expected distance is a root of a
 * quadratic equation. */
static void test_rays(void **unused) {
  (void)unused;
  vs_scheme *s = vs_new(NULL);
  static const char text[] =
      "(define ball (make-sphere (xyz 1 0 0) 2 #:segments 400))"
      "(define n (node-create #:name \"ball\" #:parent (node-getroot) #:drawing ball"
      " #:translate (vxyz 3 4 5) #:rotate (vxyz 20 40 60) #:scale 3))";
  assert_int_equal(vs_eval_text(s, "t", 1, text, sizeof text - 1, 0), VS_OUTCOME_DONE);
  vs_handle node = vs_node_find(s, "ball");
  double m[16];
  assert_true(vs_node_matrix(s, node, true, m));
  const double centre[] = { m[0] + m[3], m[4] + m[7], m[8] + m[11] }, radius = 6;
  state = 12345;
  int met = 0;
  for (int i = 0; i < 200; i++) {
    double from[3], way[3], length = 0, along = 0, away = 0;
    for (int k = 0; k < 3; k++) from[k] = centre[k] + real(-20, 20), way[k] = centre[k] + real(-5, 5) - from[k];
    for (int k = 0; k < 3; k++) length += way[k] * way[k];
    length = sqrt(length);
    for (int k = 0; k < 3; k++) way[k] /= length, along += (centre[k] - from[k]) * way[k];
    for (int k = 0; k < 3; k++) away += pow(from[k] + along * way[k] - centre[k], 2);
    double outside = 0;
    for (int k = 0; k < 3; k++) outside += pow(from[k] - centre[k], 2);
    /* skips rays that begin inside the ball, or pass so close to its rim that rounding decides */
    if (sqrt(outside) < radius * 1.01 || fabs(sqrt(away) - radius) < 0.05) continue;
    vs_hit hit = { .distance = -1 };
    assert_int_equal(vs_pick(s, from, way, take_first, &hit), VS_OUTCOME_DONE);
    if (away > radius * radius) { assert_true(hit.distance == -1); continue; }
    met++;
    double want = along - sqrt(radius * radius - away);
    if (fabs(hit.distance - want) > 0.02 * radius) fail_msg("ray %d: met after %g, not %g", i, hit.distance, want);
  }
  assert_true(met > 50);
  vs_free(s);
}

/* Makes random calls with handles that are valid, released, 0, or from another interpreter. Nothing may crash, each
 * call must return an outcome, and the interpreter must work afterwards. */
enum { HELD = 24 };
static bool called(void *context, vs_scheme *s, const vs_handle *a, size_t n, vs_handle *result) {
  (void)context;
  *result = n ? vs_handle_retain(s, a[0]) : 0;
  return next() % 8 != 0;
}
static bool see_gizmo(void *context, vs_scheme *s, const vs_gizmo *g) {
  (void)context;
  assert_true(g->handle_count <= 3 && vs_handle_kind_of(s, g->node) == VS_HANDLE_NODE);
  return next() % 4 != 0;
}
static void test_random_calls(void **unused) {
  (void)unused;
  vs_scheme *s = vs_new(NULL), *other = vs_new(NULL);
  vs_handle held[HELD] = { 0 }, foreign = vs_handle_number(other, 1);
  state = 987654321;
  static const char rig[] = "(make-slider (xyz -9 0 0) (xyz 9 0 0) 0 1 #:size 9 #:parent (node-getroot))"
                            "(make-tripod (xyz 0 0 0) (vxyz 1 2 3) #:size 4 #:parent (node-getroot))";
  assert_int_equal(vs_eval_text(s, "t", 1, rig, sizeof rig - 1, 0), VS_OUTCOME_DONE);
  for (int i = 0; i < 20000; i++) {
    vs_handle *to = &held[next() % HELD], a = held[next() % HELD], b = held[next() % HELD], made = 0;
    if (next() % 50 == 0) a = foreign;
    if (next() % 50 == 0) b = next();
    double v[16];
    const double three[] = { real(-9, 9), real(-9, 9), real(-9, 9) };
    vs_hit hit;
    switch (next() % 34) {
    case 0: made = vs_handle_number(s, three[0]); break;
    case 1: made = vs_handle_integer(s, (int64_t)next()); break;
    case 2: made = vs_handle_text(s, "width"); break;
    case 3: made = vs_handle_symbol(s, "name"); break;
    case 4: made = vs_handle_point(s, three[0], three[1], three[2]); break;
    case 5: made = vs_handle_list(s, (vs_handle[]){ a, b }, 2); break;
    case 6: made = vs_node_create(s, next() % 9 ? NULL : "chair", "n", next() % 2 ? a : 0); break;
    case 7: made = vs_node_root(s); break;
    case 8: made = vs_node_find(s, "n"); break;
    case 9: made = vs_node_parent(s, a); break;
    case 10: made = vs_node_children(s, a); break;
    case 11: made = vs_handle_item(s, a, next() % 3); break;
    case 12: made = vs_lookup(s, next() % 2 ? "list" : "none"); break;
    case 13: vs_apply(s, a, (vs_handle[]){ b }, 1, &made); break;
    case 14: made = vs_host_procedure(s, "called", called, NULL); break;
    case 15: vs_node_add_child(s, a, b); break;
    case 16: vs_node_remove_child(s, a, b); break;
    case 17: vs_node_place(s, a, three, next() % 2 ? three : NULL, NULL); break;
    case 18: vs_node_matrix(s, a, next() % 2, v); break;
    case 19: vs_node_set_drawing(s, a, b); break;
    case 20: if (next() % 2) vs_node_begin(s, a); else vs_node_end(s); break;
    case 21: vs_property_put(s, a, "width", b); break;
    case 22: vs_property_get(s, a, "width", &made); break;
    case 23: made = vs_property_of(s, a, "width"); break;
    case 24: vs_property_subscribe(s, a, called, NULL); break;
    case 25: vs_property_unsubscribe(s, a, next() % 9); break;
    case 26: vs_post(s, a, b); break;
    case 27: vs_update(s); break;
    case 28: vs_pick(s, three, (double[]){ 0, 0, -1 }, take_first, &hit); break;
    case 29: vs_handle_get_numbers(s, a, v, 16), vs_handle_get_text(s, a), vs_handle_count(s, a), vs_handle_same(s, a,
        b); break;
    case 30: vs_scene_frame(s, three[0]), vs_action_apply(s, "turn", a); break;
    case 31: vs_gizmos(s, see_gizmo, NULL); break;
    case 32:
      vs_input(s, (vs_input_kind)(next() % 6), (vs_input_button)(next() % 5), next() % 4 ? three : NULL,
               next() % 4 ? (double[]){ 0, 0, -1 } : NULL, next() % 4 ? NULL : "k", next() % 2 ? &made : NULL);
      break;
    default: vs_handle_release(s, *to), *to = 0; break;
    }
    if (made) vs_handle_release(s, *to), *to = made;
    if (i % 5000 == 4999) {
      static const char text[] = "(make-box (xyz 0 0 0) (xyz 1 1 1))";
      assert_int_equal(vs_eval_text(s, "t", 1, text, sizeof text - 1, 0), VS_OUTCOME_DONE);
    }
  }
  assert_int_equal(vs_restart(s), VS_OUTCOME_DONE);
  assert_int_equal(vs_handle_kind_of(s, held[0] ? held[0] : next()), VS_HANDLE_NONE);
  vs_free(other);
  vs_free(s);
}

/* ---- refused memory ---- */

typedef struct {
  long left; /* number of allocations until one is refused; negative if none is to be refused */
  size_t blocks, bytes;
} budget;
static void *take(void *context, void *old, size_t old_size, size_t new_size) {
  budget *b = context;
  if (new_size > old_size && b->left >= 0 && b->left-- == 0) return NULL;
  if (old) b->bytes -= old_size;
  b->bytes += new_size;
  if (new_size == 0) {
    if (old) b->blocks--;
    free(old);
    return NULL;
  }
  void *p = realloc(old, new_size);
  assert_non_null(p);
  if (!old) b->blocks++;
  return p;
}

static uint64_t no_material(void *context, const char *name) { return (void)context, (uint64_t)strlen(name); }

/* runs a session with a scene; returns true if all calls succeeded */
static bool session(budget *b) {
  vs_options o = vs_options_default();
  o.alloc = take, o.alloc_context = b;
  vs_scheme *s = vs_new(&o);
  bool ok = s != NULL;
  if (ok) vs_material_handler(s, no_material, NULL);
  ok = ok && vs_eval_text(s, "m.gml", 1, model, sizeof model - 1, VS_EVAL_PROGRAM) == VS_OUTCOME_DONE;
  vs_handle root = ok ? vs_node_root(s) : 0, node = root ? vs_node_create(s, NULL, "n", root) : 0;
  ok = ok && node && vs_node_place(s, node, (double[]){ 1, 2, 3 }, NULL, NULL) == VS_OUTCOME_DONE;
  vs_hit hit;
  ok = ok && vs_pick(s, (double[]){ 0, 0, 9 }, (double[]){ 0, 0, -1 }, take_first, &hit) == VS_OUTCOME_DONE;
  vs_mesh_info m;
  for (int i = 0; i < 2; i++) {
    size_t count = 0;
    ok = ok && vs_meshes_begin(s, NULL) == VS_OUTCOME_DONE;
    while (ok && vs_mesh_next(s, &m)) count++;
    if (ok) assert_int_equal(count, i == 0 ? 2 : 0);
  }
  vs_free(s);
  return ok;
}

/* Refuses a sample of some hundred allocations of a session with a scene. test_embedding.c tests the allocations at the
 * beginning, which all sessions have in common. */
static void test_refused_memory(void **unused) {
  (void)unused;
  budget whole = { .left = 1000000 };
  assert_true(session(&whole));
  long count = 1000000 - whole.left, step = count / 150 + 1;
  for (long n = 0; n < count; n += step) {
    budget b = { .left = n };
    session(&b); /* does not check the result: if the refused allocation was for a cache, the session succeeds without
                  * the cache */
    assert_int_equal(b.blocks, 0);
  }
}

/* Tests that all arrays of a mesh, including normals, come from the host's allocator, so they count towards the memory
 * limit. The next call of the library frees these arrays. */
static void test_counted_meshes(void **unused) {
  (void)unused;
  budget b = { .left = -1 };
  vs_options o = vs_options_default();
  o.alloc = take, o.alloc_context = &b;
  vs_scheme *s = vs_new(&o);
  static const char text[] = "(draw (make-sphere (xyz 0 0 0) 1 #:segments 200))";
  assert_int_equal(vs_eval_text(s, "t", 1, text, sizeof text - 1, 0), VS_OUTCOME_DONE);
  assert_int_equal(vs_meshes_begin(s, NULL), VS_OUTCOME_DONE);
  vs_mesh_info m;
  assert_true(vs_mesh_next(s, &m));
  size_t held = b.bytes, arrays = m.point_count * sizeof *m.points + m.triangle_count * sizeof *m.corners +
                                  m.normal_count * sizeof *m.normals + m.triangle_count * sizeof *m.normal_corners;
  assert_true(arrays > 1000000);
  assert_false(vs_mesh_next(s, &m));
  assert_true(held - b.bytes >= arrays && held - b.bytes < arrays + arrays / 4);
  vs_free(s);
  assert_int_equal(b.blocks, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(test_rays), cmocka_unit_test(test_random_calls),
                                      cmocka_unit_test(test_refused_memory), cmocka_unit_test(test_counted_meshes) };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
