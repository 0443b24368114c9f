/* Tests the pass fold, which replaces a placed node by a node whose own fields contain the placement. Every distinct
 * node of the table of shapes (tests/cross/shapes.vs) is placed by every transformation in `maps`. The table must have
 * a sample of each kind, so a new kind is tested too. The test compares each placed node before and after the pass:
 * inside or outside at random points, bounds, volume, area, length, and the corners of the mesh for a given number of
 * facets. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>

#include <cmocka.h>

#include "bind/state.h"
#include "geometry/measure/bounds.h"
#include "geometry/measure/inside.h"
#include "geometry/measure/node_measures.h"
#include "geometry/primitives/shape.h"
#include "geometry/tessellate.h"
#include "model/job.h"
#include "model/walk.h"
#include "passes/passes.h"
#include "visualscheme.h"
#include "vm/machine/open_vm.h"

static const char shapes[] = "(define-syntax shape (syntax-rules () ((_ name object . options) (draw object))))"
                             "(load \"tests/cross/shapes.vs\")";

/* The transformations that place nodes, as rows of their matrices. */
static const struct { const char *name; double m[3][4]; } maps[] = {
  { "translation", { { 1, 0, 0, 3 }, { 0, 1, 0, -2 }, { 0, 0, 1, 5 } } },
  { "quarter turn about z", { { 0, -1, 0, 1 }, { 1, 0, 0, 0 }, { 0, 0, 1, 2 } } },
  { "quarter turn about x", { { 1, 0, 0, 0 }, { 0, 0, -1, 1 }, { 0, 1, 0, 0 } } },
  { "half turn about y", { { -1, 0, 0, 0 }, { 0, 1, 0, 2 }, { 0, 0, -1, 0 } } },
  { "rotation about z", { { 0.8, -0.6, 0, 1 }, { 0.6, 0.8, 0, 0 }, { 0, 0, 1, 0 } } },
  { "rotation about x", { { 1, 0, 0, 0 }, { 0, 0.8, -0.6, 0 }, { 0, 0.6, 0.8, 1 } } },
  { "rotation about an oblique axis",
    { { 2.0 / 3, -1.0 / 3, 2.0 / 3, 0 }, { 2.0 / 3, 2.0 / 3, -1.0 / 3, 0 }, { -1.0 / 3, 2.0 / 3, 2.0 / 3, 1 } } },
  { "equal scale", { { 2.5, 0, 0, 1 }, { 0, 2.5, 0, 0 }, { 0, 0, 2.5, 0 } } },
  { "equal scale about the origin", { { 2, 0, 0, 0 }, { 0, 2, 0, 0 }, { 0, 0, 2, 0 } } },
  { "equal scale, rotated", { { 0, -0.5, 0, 0 }, { 0.5, 0, 0, 0 }, { 0, 0, 0.5, 0 } } },
  { "unequal scale", { { 1.5, 0, 0, 0 }, { 0, 0.75, 0, 1 }, { 0, 0, 1.25, 0 } } },
  { "unequal scale along z", { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 3, 0 } } },
  { "unequal scale along x", { { 3, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },
  { "unequal scale, axes exchanged", { { 0, 2, 0, 0 }, { 0, 0, 0.5, 0 }, { 1.5, 0, 0, 0 } } },
  { "shear of x by z", { { 1, 0, 0.5, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },
  { "shear of z by x", { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0.5, 0, 1, 0 } } },
  { "mirror at yz", { { -1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } },
  { "mirror at xy", { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, -1, 1 } } },
  { "mirror at an oblique plane",
    { { 1.0 / 3, -2.0 / 3, -2.0 / 3, 0 }, { -2.0 / 3, 1.0 / 3, -2.0 / 3, 0 }, { -2.0 / 3, -2.0 / 3, 1.0 / 3, 0 } } },
  { "point reflection, scaled unequally", { { -1, 0, 0, 0 }, { 0, -2, 0, 0 }, { 0, 0, -1.5, 0 } } },
};
enum { MAPS = sizeof maps / sizeof *maps, POINTS = 60, KINDS = 64, NODES = 1 << 14 };

static size_t tried[KINDS], folded[KINDS]; /* tried[k]: number of tests of a node of kind k with a transformation.
                                            * folded[k]: number of these tests in which the pass changed the node */
static size_t compared_points, compared_meshes, wrong_count;
static uint64_t chance;

static double between(double low, double high) {
  chance ^= chance << 13, chance ^= chance >> 7, chance ^= chance << 17;
  return low + (high - low) * (double)(chance >> 11) / 0x1p53;
}

static bool bounds_of(void *context, const vs_node *n, vs_bounds *out, vs_error *e) {
  return vs_bounds_memo_get(context, n, out, e);
}

/* Returns the placed node t as the pass fold rewrites it. */
static vs_node *fold(vs_store *s, vs_node *t) {
  vs_bounds_memo memo = { .places = { .store = s } };
  vs_pass_options o = { 1 << VS_PASS_FOLD, bounds_of, &memo, NULL };
  vs_pass_stats stats;
  vs_error e = { 0 };
  vs_ref ref = { t, NULL };
  vs_node_retain(t);
  if (!vs_passes_run(s, &ref, 1, &o, &stats, &e)) fail_msg("%s", e.message);
  vs_bounds_memo_free(&memo);
  return ref.node;
}

static void wrong(const vs_node *n, size_t map, const char *format, ...) {
  char why[300];
  va_list rest;
  va_start(rest, format);
  vsnprintf(why, sizeof why, format, rest);
  va_end(rest);
  if (wrong_count++ < 40) fprintf(stderr, "%s, %s: %s\n", vs_kind_get((vs_kind)n->kind)->name, maps[map].name, why);
}

static bool differ(double a, double b, double slack) { return !(fabs(a - b) <= slack); }

/* Compares whether random points are inside the object before and after the pass. Points closer than `slack` to the
 * object's surface do not count. */
static void compare_points(const vs_node *n, const vs_node *t, const vs_node *r, size_t map, const vs_bounds *b,
                           double slack) {
  vs_error e = { 0 };
  vs_inside *without = vs_inside_new(t, &e), *with = without ? vs_inside_new(r, &e) : NULL;
  for (int i = 0; with && i < POINTS; i++) {
    vs_vec3 p = vs_v3(between(b->min.x, b->max.x), between(b->min.y, b->max.y), between(b->min.z, b->max.z));
    bool inside = vs_inside_test(without, p), near = false;
    for (int k = 0; k < 6; k++) {
      vs_vec3 q = p;
      double step = k & 1 ? slack : -slack;
      if (k / 2 == 0) q.x += step;
      else if (k / 2 == 1) q.y += step;
      else q.z += step;
      near = near || vs_inside_test(without, q) != inside;
    }
    compared_points += !near;
    if (near || vs_inside_test(with, p) == inside) continue;
    wrong(n, map, "%s at %.9g %.9g %.9g, folded %s", inside ? "inside" : "outside", p.x, p.y, p.z,
          inside ? "outside" : "inside");
    break;
  }
  vs_inside_free(without), vs_inside_free(with);
}

/* Compares the corners of the meshes of a leaf before and after the pass. The leaf's number of facets does not depend
 * on the tolerance of the drawing. */
static void compare_corners(const vs_node *n, const vs_node *t, const vs_node *r, size_t map, double slack) {
  vs_error e = { 0 };
  vs_mesh a = { 0 }, b = { 0 };
  vs_fineness f = { .tolerance = 1, .segments = 0 };
  if (vs_tessellate(t, &f, &a, &e) && vs_tessellate(r, &f, &b, &e)) {
    compared_meshes++;
    if (a.vertex_count != b.vertex_count) wrong(n, map, "%zu corners, folded %zu", a.vertex_count, b.vertex_count);
    for (size_t i = 0; i < a.vertex_count && a.vertex_count == b.vertex_count; i++) {
      double nearest = INFINITY;
      for (size_t k = 0; k < b.vertex_count; k++)
        nearest = fmin(nearest, vs_v3_length(vs_v3_sub(a.vertices[i], b.vertices[k])));
      if (nearest <= slack) continue;
      wrong(n, map, "the folded mesh has no corner at %.9g %.9g %.9g", a.vertices[i].x, a.vertices[i].y,
            a.vertices[i].z);
      break;
    }
  }
  vs_mesh_free(&a), vs_mesh_free(&b);
}

static void compare_measures(const vs_node *n, const vs_node *t, const vs_node *r, size_t map, double size) {
  vs_error e = { 0 };
  vs_measure a = { 0 }, b = { 0 };
  if (!vs_node_measure(t, &a, &e) || !vs_node_measure(r, &b, &e) || !a.known || !b.known) return;
  double within = 1e-6;
  if (differ(a.volume, b.volume, within * size * size * size))
    wrong(n, map, "volume %.12g, folded %.12g", a.volume, b.volume);
  if ((a.area_known && b.area_known) && differ(a.area, b.area, within * size * size))
    wrong(n, map, "area %.12g, folded %.12g", a.area, b.area);
  if (differ(a.length, b.length, within * size)) wrong(n, map, "length %.12g, folded %.12g", a.length, b.length);
}

static bool is_empty(const vs_bounds *b) { return !(b->min.x <= b->max.x); }

static void compare_bounds(const vs_node *n, size_t map, const vs_bounds *a, const vs_bounds *b, double slack) {
  bool same = !differ(a->min.x, b->min.x, slack) && !differ(a->min.y, b->min.y, slack) &&
              !differ(a->min.z, b->min.z, slack) && !differ(a->max.x, b->max.x, slack) &&
              !differ(a->max.y, b->max.y, slack) && !differ(a->max.z, b->max.z, slack);
  if (is_empty(a) != is_empty(b) || (!is_empty(a) && !same))
    wrong(n, map, "bounds %.9g %.9g %.9g to %.9g %.9g %.9g, folded %.9g %.9g %.9g to %.9g %.9g %.9g", a->min.x,
          a->min.y, a->min.z, a->max.x, a->max.y, a->max.z, b->min.x, b->min.y, b->min.z, b->max.x, b->max.y, b->max.z);
}

/* Returns the number of facets that the node itself requires; 0 if the tolerance decides the number; -1 if the node has
 * no field for it. */
static int64_t segments_of(const vs_node *n) {
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  for (size_t i = 0; i < info->field_count; i++)
    if (!strcmp(info->fields[i].name, "segments"))
      return *(const int64_t *)(const void *)((const char *)vs_node_data(n) + info->fields[i].offset);
  return -1;
}

/* Returns a new node like n that requires 12 facets in a full turn, or NULL if n's kind has no field for the number of
 * facets. */
static vs_node *with_segments(vs_store *s, const vs_node *n) {
  const vs_kind_info *info = vs_kind_get((vs_kind)n->kind);
  _Alignas(max_align_t) char data[512];
  if (segments_of(n) != 0 || info->size > sizeof data) return NULL;
  memcpy(data, vs_node_data(n), info->size);
  for (size_t i = 0; i < info->field_count; i++)
    if (!strcmp(info->fields[i].name, "segments")) *(int64_t *)(void *)(data + info->fields[i].offset) = 12;
  return vs_node_new(s, (vs_kind)n->kind, data, n->children, n->child_count);
}

static void compare(vs_store *s, vs_node *n, size_t map) {
  struct vs_transform place = { .matrix = { { { 0 } } } };
  memcpy(place.matrix.m, maps[map].m, sizeof place.matrix.m);
  vs_node *t = vs_node_new(s, VS_TRANSFORM, &place, &(vs_ref){ n, NULL }, 1), *r = t ? fold(s, t) : NULL;
  vs_error e = { 0 };
  vs_bounds a, b;
  assert_true(t && r);
  tried[n->kind]++, folded[n->kind] += r != t;
  bool flat = vs_kind_get((vs_kind)n->kind)->level == VS_LEVEL_FLAT && vs_node_role(n) != VS_ROLE_MADE;
  if (r != t && vs_node_bounds(t, &a, &e) && vs_node_bounds(r, &b, &e)) {
    double size = is_empty(&a) ? 0 : vs_bounds_diagonal(&a);
    bool finite = size > 0 && isfinite(size) && size < 1e6;
    /* allowed relative difference of bounds: a spline's bounds come from fine samples of the curve, other bounds are
     * exact */
    double sampled = n->class_ == VS_CURVE && !flat && !vs_node_has(n, VS_IS_SHORT) ? 1e-3 : 1e-9;
    if (finite && !vs_node_has(n, VS_IS_SAMPLED) && vs_node_role(n) != VS_ROLE_SET)
      compare_bounds(n, map, &a, &b, sampled * size);
    if (!finite) a = (vs_bounds){ { -8, -8, -8 }, { 8, 8, 8 } };
    if (n->class_ == VS_SOLID) compare_points(n, t, r, map, &a, 1e-6 * (finite ? size : 10));
    if (finite) compare_measures(n, t, r, map, size);
    if (finite && n->class_ != VS_CURVE && n->class_ != VS_REGION_CLASS && (flat || segments_of(n) > 0) &&
        r->kind == n->kind)
      compare_corners(n, t, r, map, 1e-9 * size);
  }
  vs_node_release(r), vs_node_release(t);
}

static void hear(void *context, const vs_diagnostic *d) {
  (void)context;
  if (d->severity == VS_SEVERITY_ERROR) fprintf(stderr, "%s\n", d->message);
}

/* Collects the distinct nodes of the drawing. For a node with a field for the number of facets, also adds a copy that
 * requires 12 facets. Returns the number of nodes. */
static size_t gather(vs_bind *bind, vs_node *all[NODES]) {
  size_t count = 0, depth;
  vs_ref ref;
  for (size_t i = 0; i < bind->scene.drawn_count; i++) {
    vs_walk *w = vs_walk_new(bind->store, bind->scene.drawn[i]);
    assert_non_null(w);
    for (vs_walk_event event; (event = vs_walk_next(w, &ref, &depth)) != VS_WALK_DONE;) {
      assert_true(event != VS_WALK_FAILED && count + 2 < NODES);
      if (event != VS_WALK_ENTER) continue;
      size_t k = 0;
      while (k < count && all[k] != ref.node) k++;
      if (k < count) {
        vs_walk_skip(w);
        continue;
      }
      all[count++] = ref.node;
      vs_node_retain(ref.node);
      if ((all[count] = with_segments(bind->store, ref.node)) != NULL) count++;
    }
    vs_walk_free(w);
  }
  return count;
}

static void placed_objects_agree(void **state) {
  (void)state;
  static vs_node *all[NODES];
  vs_options o = vs_options_default();
  o.host = (vs_host){ .diagnose = hear };
  vs_scheme *vm = vs_new(&o);
  assert_non_null(vm);
  assert_int_equal(vs_eval_text(vm, "moved", 1, shapes, strlen(shapes), 0), VS_OUTCOME_DONE);
  vs_bind *bind = vs_bind_of(vm);
  size_t count = gather(bind, all);
  chance = 88172645463325252u;
  for (size_t i = 0; i < count; i++) {
    for (size_t map = 0; map < MAPS; map++) compare(bind->store, all[i], map);
    vs_node_release(all[i]);
  }
  if (getenv("TELL")) fprintf(stderr, "%zu nodes, %zu points, %zu meshes\n", count, compared_points, compared_meshes);
  for (int kind = 0; kind < VS_KIND_OF_END; kind++) {
    if (getenv("TELL"))
      fprintf(stderr, "%s: %zu of %zu are folded\n", vs_kind_get((vs_kind)kind)->name, folded[kind], tried[kind]);
    if (vs_kind_roles[kind] == VS_ROLE_SHAPE && !folded[kind])
      fail_msg("no %s is folded", vs_kind_get((vs_kind)kind)->name);
  }
  vs_free(vm);
  assert_true(compared_points > 10000 && compared_meshes > 100);
  assert_int_equal(wrong_count, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(placed_objects_agree) };
  cmocka_set_test_filter(getenv("TESTS"));
  return cmocka_run_group_tests_name("placements folded and not", tests, NULL, NULL);
}
