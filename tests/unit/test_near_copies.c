/* Tests that vs never writes a self-intersecting mesh without a warning. Each sample of the table of shapes, made a
 * solid, is combined with a nearly equal copy of itself. The copy is rotated by 1e-2 to 1e-9 radians, or moved or
 * scaled as slightly. The meshes in .stl (32-bit numbers) and .off must be closed. No triangle crosses or lies on
 * another unless a warning gives the number of such triangles and the first place.
 *
 * Runs a sample of 150 programs, with LONG=1 four thousand, or those of SEEDS=FROM-TO. SHOW=1 prints each program,
 * TELL=1 the counts. */
#include "tests/unit/trials.h"
#include "tests/unit/seeds.h"

#include "tests/oracle/paths.c"

static const char samples_file[] = "tests/cross/shapes.vs";
static size_t written_count, met_count, refused_count;

static double tiny(maker *m) { return pow(10, -2 - any(m, 71) / 10.0); }

/* Writes the program that belongs to the seed. Successive seeds use successive samples of the table of shapes. */
static void make_near(uint64_t seed, char text[MODEL_ROOM]) {
  static const char *const tools[] = { "unite", "subtract", "intersect" }, *const axes[] = { "ux", "uy", "uz",
                                                                                             "(vxyz 1 2 3)" };
  maker m = { .state = seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du, .text = text };
  for (int i = 0; i < 8; i++) any(&m, 2);
  double angle = any(&m, 8) ? tiny(&m) : 0, move = any(&m, 2) ? tiny(&m) : 0, scale = any(&m, 4) ? 0 : tiny(&m);
  double far = any(&m, 2) ? 0 : any(&m, 2) ? 10 : 1000;
  text[0] = 0;
  say(&m, "(let* ([o (thick %s)] [near (do-move (do-rotate (do-scale o %.17g) origin %s %.6g) (vxyz %.6g 0 %.6g))])",
      samples[seed % sample_count].object, 1 + scale, axes[any(&m, 4)], angle, move, move / 3);
  say(&m, " (do-move (do-rotate (%s o near) origin (vxyz 1 1 0) %g) (vxyz %g %g 0)))", tools[any(&m, 3)],
      any(&m, 2) ? 0.3 : 0, far, far / 3);
}

/* Returns true if the written mesh has a fault: it is open, or it intersects itself and vs did not warn. */
static bool silent(trial *t, const char *suffix) {
  written w = { .volume = 0 };
  crossings_found found;
  bool more;
  if (!write_as(t, suffix, 0, &w, &more)) {
    refused_count++;
    return strstr(t->heard.error, "fault of vs") && snprintf(t->why, sizeof t->why, "%s: %s", suffix, t->heard.error);
  }
  if (!crossings_find((const crossings_point *)w.s.points, w.s.point_count, (const crossings_triangle *)w.s.triangles,
                      w.s.count, &found)) abort();
  size_t open = written_open_edges(&w.s), faults = crossings_sum(&found) - found.count[CROSSINGS_TOUCHING];
  bool says = strstr(t->heard.warning, "touch or cross") != NULL;
  written_count++, met_count += faults > 0;
  release(&w);
  if (!open && (!faults || says)) return false;
  int n = snprintf(t->why, sizeof t->why, "%s has %zu open edges", suffix, open);
  for (int k = 0; k < CROSSINGS_KINDS; k++)
    if (found.count[k])
      n += snprintf(t->why + n, sizeof t->why - (size_t)n, ", %zu %s", found.count[k], crossings_names[k]);
  return true;
}

static bool is_silent(void *context, const char *text) {
  trial *t = context;
  const char *before = path_definitions();
  vs_restart(t->vm);
  if (vs_eval_text(t->vm, samples_file, 1, before, strlen(before), 0) != VS_OUTCOME_DONE)
    fail_msg("the samples' definitions: %s", t->heard.error);
  if (run(t, "(draw (parameterize ((current-segments 12)) %s))", text) != VS_OUTCOME_DONE)
    return refused_count++, false;
  return silent(t, ".stl") || silent(t, ".off");
}

static void near_copies_are_never_silent(void **state) {
  (void)state;
  static char text[MODEL_ROOM];
  static trial t;
  seed_range seeds = seeds_asked(150, 4000);
  unsigned long long bad = 0;
  assert_true(path_samples_read(samples_file));
  begin(&t, 0);
  t.file = samples_file;
  for (unsigned long long seed = seeds.from; seed <= seeds.to; seed++) {
    make_near(seed * (seeds.whole ? 1 : 5), text); /* with few seeds, runs every fifth program, so that the sample
                                                    * covers the whole table of shapes */
    if (getenv("SHOW")) fprintf(stderr, "seed %llu: %s\n", seed, text);
    if (!is_silent(&t, text)) continue;
    bad++;
    report_seed("", seed, text, is_silent, &t, t.why);
  }
  vs_free(t.vm);
  if (getenv("TELL") || seeds.asked)
    fprintf(stderr, "%zu meshes, %zu of them meet themselves, %zu refused or empty; %llu silent\n", written_count,
            met_count, refused_count, bad);
  assert_int_equal(bad, 0);
  if (!seeds.asked) assert_true(written_count > 100 && met_count > 0);
}

int main(void) {
  const struct CMUnitTest tests[] = { cmocka_unit_test(near_copies_are_never_silent) };
  cmocka_set_test_filter(getenv("TESTS"));
  return cmocka_run_group_tests_name("solids combined with near copies", tests, NULL, NULL);
}
