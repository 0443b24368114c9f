/* Tests that a host can process pictures in linear light and compute sun studies. It uses the public header alone.
 * Without POV-Ray the test reports the parts that it skips. Argument: a folder for the test's files. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <visualscheme.h>

static int failures;
static void check(bool holds, const char *text, int line) {
  failures += !holds;
  printf(holds ? "ok embed:%s\n" : "not ok embed:%s (line %d)\n", text, line);
}
#define CHECK(condition) check(condition, #condition, __LINE__)

static char said[600];
static void diagnose(void *context, const vs_diagnostic *d) { (void)context, snprintf(said, sizeof said, "%s", d->message); }

static const char *in(const char *folder, const char *name) {
  static char paths[4][600];
  static int next;
  next = (next + 1) % 4;
  snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
  return paths[next];
}

int main(int argc, char **argv) {
  const char *folder = argc > 1 ? argv[1] : ".";
  static const char model[] = "(draw (color \"red\" (make-box (xyz 0 0 0) (xyz 2 2 2))))";
  vs_options options = vs_options_default();
  options.host.diagnose = diagnose;
  vs_scheme *s = vs_new(&options);
  double stops = 9, least = 0, most = 0;
  bool layers = false;
  vs_picture_point p;
  vs_picture_difference d;
  vs_sun_summary told;
  CHECK(vs_eval_text(s, "box.vs", 1, model, strlen(model), 0) == VS_OUTCOME_DONE);
  CHECK(vs_picture_tone(s, in(folder, "none.exr"), in(folder, "a.png"), NULL, &stops) == VS_OUTCOME_USAGE && *said);
  vs_output_options o = vs_output_options_default();
  o.width = 32, o.height = 24, o.quality = VS_QUALITY_DRAFT, o.layers = true;
  vs_sun_span day = {.latitude = 40, .year = 2026, .month = 3, .day = 20, .to = 24, .step = 8};
  vs_outcome outcome = vs_sun_study(s, &day, in(folder, "sun"), &o, &told);
  CHECK(outcome == VS_OUTCOME_DONE || outcome == VS_OUTCOME_WORKER);
  CHECK(told.faces == 6 && told.dark == 2);
  day.day = 32;
  CHECK(vs_sun_study(s, &day, in(folder, "sun"), &o, &told) == VS_OUTCOME_USAGE && strstr(said, "2026-03-32"));
  if (outcome == VS_OUTCOME_WORKER) {
    puts("skip embed:pictures: no POV-Ray");
    vs_free(s);
    return failures > 0;
  }
  CHECK(vs_write_drawing(s, in(folder, "a.exr"), NULL, &o) == VS_OUTCOME_DONE);
  CHECK(vs_picture_tone(s, in(folder, "a.exr"), in(folder, "a.png"), NULL, &stops) == VS_OUTCOME_DONE && fabs(stops) < 5);
  CHECK(vs_picture_false_color(s, in(folder, "a.exr"), in(folder, "f.png"), 1, &least, &most) == VS_OUTCOME_DONE);
  CHECK(least > 0 && least < most);
  CHECK(vs_picture_pick(s, in(folder, "a.exr"), 16, 12, &p) == VS_OUTCOME_DONE);
  CHECK(p.id == 1 && !strcmp(p.place, "box.vs:1:20") && p.has_normal && p.depth > 0 && p.color[0] > p.color[2]);
  CHECK(!strcmp(p.material, "red") && p.openness > 0 && p.openness <= 1 && p.illuminance > 0);
  CHECK(vs_picture_illuminance(s, in(folder, "a.exr"), in(folder, "l.png"), 1e4, &least, &most) == VS_OUTCOME_DONE);
  CHECK(least > 1 && least < most);
  CHECK(vs_picture_pick(s, in(folder, "a.exr"), 32, 12, &p) == VS_OUTCOME_USAGE && strstr(said, "0 to 31"));
  CHECK(vs_picture_denoise(s, in(folder, "a.exr"), in(folder, "b.exr"), &layers) == VS_OUTCOME_DONE && layers);
  CHECK(vs_picture_compare(s, in(folder, "a.exr"), in(folder, "b.exr"), NULL, &d) == VS_OUTCOME_DONE);
  CHECK(d.columns == 32 && d.rows == 24 && d.ssim > 0.9 && d.ssim <= 1);
  /* joins four pictures into a sheet of two columns, then pictures of different heights in one row */
  const char *tiles[4];
  char names[4][512];
  for (int i = 0; i < 4; i++) {
    snprintf(names[i], sizeof names[i], "%s/tile%d.exr", folder, i);
    tiles[i] = names[i];
    o.crop[0] = i % 2 ? 20 : 0, o.crop[1] = i / 2 ? 7 : 0, o.crop[2] = i % 2 ? 12 : 20, o.crop[3] = i / 2 ? 17 : 7;
    CHECK(vs_write_drawing(s, tiles[i], NULL, &o) == VS_OUTCOME_DONE);
  }
  CHECK(vs_picture_join(s, tiles, 2, 2, in(folder, "joined.exr")) == VS_OUTCOME_DONE);
  CHECK(vs_picture_compare(s, in(folder, "a.exr"), in(folder, "joined.exr"), NULL, &d) == VS_OUTCOME_DONE && d.most == 0);
  tiles[1] = names[3];
  CHECK(vs_picture_tile_top(640, 480, 4, 0) == 0 && vs_picture_tile_top(640, 480, 4, 1) == 120);
  CHECK(vs_picture_tile_top(640, 480, 4, 4) == 480 && vs_picture_tile_top(640, 480, 481, 1) == 0);
  CHECK(vs_picture_join(s, tiles, 2, 1, in(folder, "joined.exr")) == VS_OUTCOME_USAGE && strstr(said, "does not fit"));
  vs_free(s);
  return failures > 0;
}
