/* Tests that every pass keeps the meaning of a random drawing: the set of its points, the placement of each part, its
 * paint, and its origin in the program. Runs each pass alone, each set of passes, and all passes. Tests a sample of
 * drawings, or with LONG=1 five thousand. The test shrinks a failing drawing as long as it fails, and prints it. SEED=n
 * tests drawing n alone. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "passes/optimise.h"
#include "solids/solid_meshes.h"
#include "tests/oracle/drawings.h"
#include "tests/oracle/drawings_look.c"
#include "tests/oracle/drawings_make.c"

enum { SETS = 1 << VS_PASS_COUNT, POINTS = 40 };

typedef struct { size_t drawings, looked, points, inside, close, changed[VS_PASS_COUNT], volumes; char why[400]; unsigned passes; uint64_t points_seed; bool volume; } trial;

static drawing optimised(const drawing *d, unsigned passes, vs_pass_stats *stats) {
  vs_scene scene;
  vs_error e = { 0 };
  drawing after = { .count = d->count };
  vs_scene_init(&scene, d->at[0].node->store);
  for (size_t i = 0; i < d->count; i++) assert_true(vs_scene_draw(&scene, d->at[i]));
  if (!vs_scene_optimise(&scene, passes, stats, NULL, &e)) fail_msg("%s", e.message);
  for (size_t i = 0; i < d->count; i++) after.at[i] = (vs_ref){ vs_node_retain(scene.drawn[i].node), scene.drawn[i].origin };
  vs_scene_free(&scene);
  return after;
}

static double fraction(uint64_t *state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) / 9007199254740992.0;
}

static bool mesh_volume(const drawing *d, double *volume, double *area) {
  static const vs_fineness facets = { 0.02, 0 };
  vs_solid m;
  vs_error e = { 0 };
  vs_kernel_options options = { .max_triangles = 2000000 };
  if (!vs_solid_evaluate(d->at, d->count, &facets, &options, &m, &e)) return false;
  *volume = vs_mesh_volume(&m.mesh);
  *area = vs_mesh_area(&m.mesh);
  vs_solid_free(&m);
  return true;
}

/* Returns true if the passes t->passes change the meaning of the drawing d; writes the reason to t->why. Counts the
 * comparisons. */
static bool differs(void *context, const drawing *d) {
  trial *t = context;
  bool bad = true, less = t->passes >> VS_PASS_PRUNE & 1;
  vs_pass_stats stats, stats_again;
  drawing after = optimised(d, t->passes, &stats), again = optimised(d, t->passes, &stats_again);
  drawing_memo *memo = drawing_memo_new();
  drawing_look *was = drawing_look_new(d, memo), *is = was ? drawing_look_new(&after, memo) : NULL;
  t->why[0] = 0;
  if (!was) {
    bad = false;
    goto done;
  }
  for (int k = 0; k < VS_PASS_COUNT; k++) t->changed[k] += stats.changed[k];
  t->looked++;
  if (!is) {
    snprintf(t->why, sizeof t->why, "it has many more parts than it had");
    goto done;
  }
  for (size_t i = 0; i < d->count; i++)
    if (!vs_node_equal(after.at[i].node, again.at[i].node, NULL)) {
      snprintf(t->why, sizeof t->why, "the same drawing became another the second time");
      goto done;
    }
  if (stats.commands_after > stats.commands_before) {
    snprintf(t->why, sizeof t->why, "%g commands became %g", stats.commands_before, stats.commands_after);
    goto done;
  }
  if (!drawing_same_parts(was, is, less, t->passes >> VS_PASS_SHARE & 1, t->why, sizeof t->why)) goto done;
  if (!less && !drawing_same_sets(was, is, t->points_seed, t->why, sizeof t->why)) goto done;
  uint64_t state = t->points_seed;
  for (int i = 0; i < POINTS; i++) {
    double r[4] = { fraction(&state), fraction(&state), fraction(&state), fraction(&state) };
    vs_vec3 p = drawing_look_point(was, r[0], r[1], r[2], r[3]);
    bool inside, close;
    if (!drawing_same_at(was, is, p, &inside, &close, t->why, sizeof t->why)) goto done;
    t->points++;
    t->inside += inside;
    t->close += close;
  }
  double v[2], area[2];
  if (t->volume && mesh_volume(d, &v[0], &area[0])) { /* a drawing that cannot be meshed before the passes, such as an
                                                       * endless line, cannot be meshed after them either */
    t->volumes++;
    if (!mesh_volume(&after, &v[1], &area[1])) {
      snprintf(t->why, sizeof t->why, "it has no mesh any more");
      goto done;
    }
    /* the passes may rotate the facets of round parts: the volume may change by the chord height (distance of facet and
     * arc) times the area */
    if (fabs(v[0] - v[1]) > 1e-9 * v[0] + 0.02 * (area[0] + area[1])) {
      snprintf(t->why, sizeof t->why, "the mesh had a volume of %.9g, and has %.9g", v[0], v[1]);
      goto done;
    }
  }
  bad = false;
done:
  drawing_look_free(was);
  drawing_look_free(is);
  drawing_memo_free(memo);
  drawing_release(&after);
  drawing_release(&again);
  return bad;
}

static void print_passes(unsigned passes) {
  for (int k = 0; k < VS_PASS_COUNT; k++)
    if (passes >> k & 1) fprintf(stderr, " %s", vs_pass_get((vs_pass_kind)k)->name);
}

/* Tests the drawing of the seed. Returns false if a pass changes its meaning, and prints the reason. */
static bool holds(trial *t, uint64_t seed, bool every) {
  vs_store *s = vs_store_new(NULL, NULL);
  drawing d = drawing_make(s, seed);
  bool good = true;
  t->drawings++;
  for (unsigned passes = 1; good && passes < SETS; passes++) {
    bool few = passes == SETS - 1 || !(passes & (passes - 1)) || passes == seed % SETS;
    if (!every && !few) continue;
    t->passes = passes;
    t->points_seed = seed;
    t->volume = seed % 16 == 0 && passes == SETS - 1;
    good = !differs(t, &d);
    if (good) continue;
    fprintf(stderr, "seed %llu,", (unsigned long long)seed);
    print_passes(passes);
    fprintf(stderr, ": %s\n", t->why);
    drawing_shrink(&d, differs, t);
    differs(t, &d);
    fprintf(stderr, "smaller: %s\n", t->why);
    drawing_print(&d, stderr);
    drawing after = optimised(&d, passes, NULL);
    fprintf(stderr, "became\n");
    drawing_print(&after, stderr);
    drawing_release(&after);
  }
  drawing_release(&d);
  vs_store_release(s);
  return good;
}

static void passes_keep_what_is_drawn(void **state) {
  (void)state;
  static trial t;
  const char *longer = getenv("LONG"), *only = getenv("SEED");
  bool all = longer && *longer;
  uint64_t first = only && *only ? strtoull(only, NULL, 10) : 1, count = only && *only ? 1 : all ? 5000 : 300;
  size_t bad = 0;
  for (uint64_t seed = first; seed < first + count && bad < 3; seed++) bad += !holds(&t, seed, all || count == 1);
  if (getenv("TELL"))
    fprintf(stderr, "%zu drawings, %zu looks, %zu points, %zu inside, %zu too close to tell, %zu volumes; changed %zu %zu %zu %zu\n", t.drawings, t.looked, t.points, t.inside, t.close, t.volumes,
            t.changed[0], t.changed[1], t.changed[2], t.changed[3]);
  assert_int_equal(bad, 0);
  if (count == 1) return;
  /* checks that the run has made enough comparisons */
  assert_true(t.looked > 5 * t.drawings && t.inside * 10 > t.points && t.close * 2000 < t.points && t.volumes * 40 > t.drawings);
  for (int k = 0; k < VS_PASS_COUNT; k++) assert_true(t.changed[k] > count / 2);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(passes_keep_what_is_drawn) };
  return cmocka_run_group_tests_name("passes on random drawings", tests, NULL, NULL);
}
