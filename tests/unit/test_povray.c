/* Tests the scenes for POV-Ray: their text, solids that become triangles, the plan of strips and tiles, and pictures that
 * POV-Ray draws. */
#define _XOPEN_SOURCE 700
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "backends/povray/povray_plan.h"
#include "passes/flush.h"
#include "tests/unit/skip.h"
#include "tests/unit/written.h"

static void test_povray_words(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_box(&m, 0, 0, 0, 1, 2, 3));
  test_draw(&m, test_sphere(&m, 1, 2, 3, 4));
  test_draw(&m, test_cylinder(&m, vs_v3(0, 0, 0), vs_v3(0, 0, 2), 0.5));
  test_draw(&m, test_node(&m, 1, VS_CONE, &(struct vs_cone){ .apex = { 0, 0, 1 }, .radius = 2 }, NULL, 0));
  test_draw(&m, test_node(&m, 1, VS_CUT_CONE, &(struct vs_cut_cone){ .base_radius = 1, .top = { 0, 0, 1 }, .top_radius = 1 }, NULL, 0));
  test_draw(&m, test_node(&m, 1, VS_TORUS, &(struct vs_torus){ .center = { 1, 1, 1 }, .radius = 3, .tube_radius = 1 }, NULL, 0));
  test_draw(&m, test_paint(&m, "red", test_pair(&m, VS_DIFFERENCE, test_box(&m, 0, 0, 0, 1, 1, 1), test_sphere(&m, 0, 0, 0, 0.5))));
  char *text = written(&m, "pov");
  assert_holds(text, "box { <0, 0, 0>, <1, 2, 3> }\n");
  assert_holds(text, "sphere { <1, 2, 3>, 4 }\n");
  assert_holds(text, "cylinder { <0, 0, 0>, <0, 0, 2>, 0.5 }\n");
  assert_holds(text, "cone { <0, 0, 0>, 2, <0, 0, 1>, 0 }\n");
  assert_holds(text, "cylinder { <0, 0, 0>, <0, 0, 1>, 1 }\n"); /* POV-Ray refuses a cone with equal radii, so the
                                                                 * writer writes a cylinder */
  assert_holds(text, "torus { 3, 1 rotate 90*x translate <1, 1, 1> }\n");
  assert_holds(text, "object {\n  difference {\n    box { <0, 0, 0>, <1, 1, 1> }\n    sphere { <0, 0, 0>, 0.5 }\n  }\n  material { M1_red }\n}\n");
  free(text);
  test_model_close(&m);
}

/* POV-Ray leaves a thin skin of material where two subtracted solids touch face to face, or where a face of a
 * subtracted solid lies in a face of the object. The writer therefore enlarges the later of two touching solids, or the
 * subtracted solid. It does not enlarge solids side by side, or solids that only share the plane of their bottoms. */
static void test_povray_skins(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  vs_ref cutters[4] = { test_box(&m, -1, -9, -9, 12, 9, 9), test_cylinder(&m, vs_v3(0, 0, 0), vs_v3(5, 0, 0), 1), test_cylinder(&m, vs_v3(5, 0, 0), vs_v3(10, 0, 0), 1),
                        test_cylinder(&m, vs_v3(0, 4, 0), vs_v3(5, 4, 0), 1) };
  test_draw(&m, test_node(&m, 1, VS_DIFFERENCE, &(struct vs_difference){ 0 }, cutters, 4));
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_true(vs_scene_part_flush(&m.scene, &e));
  char *text = written(&m, "pov");
  assert_holds(text, "  cylinder { <0, 0, 0>, <5, 0, 0>, 1 }\n");
  assert_holds(text, "  cylinder { <4.99");
  assert_holds(text, "  cylinder { <0, 4, 0>, <5, 4, 0>, 1 }\n");
  free(text);
  test_model_close(&m);
}

/* Thousands of differences and unions inside each other, as a loop makes them: each cutter is compared with its
 * neighbours, however deep they lie. The first cutter of each pair ends flush with a block and is enlarged; the second
 * ends inside it and stays. */
static void test_povray_nested_skins(void **state) {
  (void)state;
  enum { PAIRS = 1000 };
  test_model m;
  test_model_open(&m);
  vs_ref all = test_box(&m, 0, 0, 0, 2, 2, 2);
  for (int i = 1; i < PAIRS; i++) {
    int x = 5 * i;
    vs_ref block[2] = { all, test_box(&m, x, 0, 0, x + 2, 2, 2) };
    all = test_node(&m, 1, VS_UNION, &(struct vs_union){ 0 }, block, 2);
    vs_ref flush[2] = { all, test_box(&m, x, .5, .5, x + 1, 1, 1) };
    all = test_node(&m, 1, VS_DIFFERENCE, &(struct vs_difference){ 0 }, flush, 2);
    vs_ref far[2] = { test_node(&m, 1, VS_UNION, &(struct vs_union){ 0 }, (vs_ref[2]){ all, test_box(&m, x, 8, 0, x + 2, 9, 2) }, 2),
                      test_box(&m, x + .5, 8.25, .5, x + 1.5, 8.75, 1.5) };
    all = test_node(&m, 1, VS_DIFFERENCE, &(struct vs_difference){ 0 }, far, 2);
  }
  test_draw(&m, all);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_true(vs_scene_part_flush(&m.scene, &e));
  char *text = written(&m, "pov");
  for (int i = 1; i < PAIRS; i += 97) {
    char stays[99], grows[99];
    snprintf(stays, sizeof stays, "box { <%g, 8.25, 0.5>, <%g, 8.75, 1.5> }", 5 * i + .5, 5 * i + 1.5);
    snprintf(grows, sizeof grows, "box { <%d, 0.5, 0.5>, <%d, 1, 1> }", 5 * i, 5 * i + 1);
    assert_holds(text, stays);
    if (strstr(text, grows)) fail_msg("not enlarged: %s", grows);
  }
  free(text);
  test_model_close(&m);
}

/* ---- solids that POV-Ray receives as triangles ---- */

static memory scene_text;
static bool keep_scene(vs_emitter *e, const char *scene, const char *output) {
  (void)e, (void)output;
  char part[4096];
  size_t count;
  FILE *f = fopen(scene, "r");
  scene_text.used = 0;
  while ((count = fread(part, 1, sizeof part, f)) > 0) memory_sink(&scene_text, part, count);
  return fclose(f) == 0;
}

/* Returns the scene that POV-Ray would receive for a picture. The text is valid until the next call of this
 * function. */
static const char *pictured(test_model *m) {
  vs_backend instead = vs_backend_povray_png;
  instead.render = keep_scene;
  vs_format format = *vs_export_format_find("png");
  format.backend = &instead;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  memory out = { NULL, 0, 0 };
  if (!vs_export_to(&m->scene, &format, memory_sink, &out, NULL, &e)) fail_msg("%s", e.message);
  free(out.text);
  return scene_text.text;
}

/* Returns a wall with `holes` round openings, in the colour `paint` if this is not NULL. */
static vs_ref wall_of(test_model *m, int holes, const char *paint) {
  vs_ref parts[9] = { test_box(m, 0, 0, 0, 10, 3, 1) };
  if (paint) parts[0] = test_paint(m, paint, parts[0]);
  for (int i = 1; i <= holes; i++) parts[i] = test_cylinder(m, vs_v3(i, 1.5, -1), vs_v3(i, 1.5, 2), 0.4);
  return test_node(m, 1, VS_DIFFERENCE, &(struct vs_difference){ 0 }, parts, (size_t)holes + 1);
}

static size_t times_in(const char *text, const char *part) {
  size_t count = 0;
  for (const char *at = text; (at = strstr(at, part)) != NULL; at++) count++;
  return count;
}

/* A boolean operation that POV-Ray would draw slowly becomes one mesh in a picture, with smooth shading at the
 * openings. In a .pov file it remains an operation. */
static void test_povray_solids(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  test_draw(&m, wall_of(&m, 6, NULL));
  assert_lacks(pictured(&m), "difference");
  assert_int_equal(times_in(scene_text.text, "mesh2"), 1);
  assert_holds(scene_text.text, "normal_vectors");
  char *text = written(&m, "pov");
  assert_holds(text, "difference");
  assert_lacks(text, "mesh2");
  free(text);
  test_model_close(&m);
  /* parts with different paints become one mesh for each paint */
  test_model_open(&m);
  test_draw(&m, test_paint(&m, "blue", test_pair(&m, VS_INTERSECTION, test_box(&m, 0, 0, 0, 9, 9, 9), wall_of(&m, 6, "red"))));
  assert_lacks(pictured(&m), "intersection");
  assert_int_equal(times_in(scene_text.text, "mesh2"), 2);
  test_model_close(&m);
}

/* Tests boolean operations that no mesh replaces: with few parts, with glass around or inside, with a pattern that was
 * moved with its part, or as operand of another operation. */
static void test_povray_solids_left(void **state) {
  (void)state;
  test_model m;
  for (int i = 0; i < 5; i++) {
    test_model_open(&m);
    vs_ref moved = test_move(&m, 1, 0, 0, test_paint(&m, "brick", test_box(&m, 0, 0, 0, 1, 2, 3)));
    vs_ref wall = wall_of(&m, i == 0 ? 2 : 6, i == 1 ? "glass" : NULL);
    if (i == 2) wall = test_paint(&m, "glass", wall);
    if (i == 3) wall = test_pair(&m, VS_DIFFERENCE, wall, moved);
    else vs_node_release(moved.node);
    if (i == 4) { /* draws the solid alone, or subtracts it from a larger glass sphere */
      vs_node_retain(wall.node);
      test_draw(&m, test_paint(&m, "glass", test_pair(&m, VS_DIFFERENCE, test_sphere(&m, 0, 0, 0, 20), wall)));
    }
    test_draw(&m, wall);
    assert_lacks(pictured(&m), "mesh2");
    assert_holds(scene_text.text, "difference");
    test_model_close(&m);
  }
}

/* ---- pictures ---- */

static bool stop_rendering(void *context, const char *stage, double fraction) {
  (void)context, (void)fraction;
  return strcmp(stage, "rendering") != 0;
}

static void test_povray_missing(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_box(&m, 0, 0, 0, 1, 1, 1));
  place p;
  place_open(&p, "out.png");
  char *path = strdup(getenv("PATH"));
  setenv("PATH", "/nowhere", 1);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  bool ok = vs_export(&m.scene, NULL, p.path, NULL, &e);
  setenv("PATH", path, 1);
  free(path);
  assert_false(ok);
  assert_int_equal(e.kind, VS_ERROR_WORKER);
  assert_holds(e.message, "povray");
  assert_int_equal(place_files(&p), 0);
  place_close(&p);
  test_model_close(&m);
}

static void test_povray_complains(void **state) {
  (void)state;
  if (!installed("povray")) SKIP_TEST("no povray (package povray)");
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_box(&m, 0, 0, 0, 1, 1, 1));
  /* a cylinder whose radius or height is too small for POV-Ray */
  vs_ref thin = test_node(&m, 123, VS_CYLINDER, &(struct vs_cylinder){ .top = { 0, 0, 1e-13 }, .radius = 1 }, NULL, 0);
  test_draw(&m, test_pair(&m, VS_UNION, test_sphere(&m, 0, 0, 0, 1), thin));
  place p;
  place_open(&p, "out.png");
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_false(vs_export(&m.scene, NULL, p.path, NULL, &e));
  assert_int_equal(e.kind, VS_ERROR_WORKER);
  assert_non_null(e.origin);
  assert_int_equal(e.origin->line, 123);
  assert_holds(e.message, "POV-Ray: Degenerate cylinder");
  assert_int_equal(place_files(&p), 0);
  place_close(&p);
  test_model_close(&m);
}

static void test_povray_stops(void **state) {
  (void)state;
  if (!installed("povray")) SKIP_TEST("no povray (package povray)");
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_sphere(&m, 0, 0, 0, 1));
  place p;
  place_open(&p, "out.png");
  vs_export_options options;
  vs_export_options_init(&options);
  vs_job job = { .going = stop_rendering };
  options.job = &job;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_false(vs_export(&m.scene, NULL, p.path, &options, &e));
  assert_int_equal(e.kind, VS_ERROR_INTERRUPT);
  assert_int_equal(place_files(&p), 0);
  job.going = NULL;
  job.limits.worker_seconds = 1e-6;
  options.width = options.height = 2000;
  assert_false(vs_export(&m.scene, NULL, p.path, &options, &e));
  assert_int_equal(e.kind, VS_ERROR_WORKER);
  assert_int_equal(place_files(&p), 0);
  place_close(&p);
  test_model_close(&m);
}

/* Several POV-Ray processes draw one picture; each draws a horizontal strip. The number of strips depends on the
 * picture's size and triangles, not on the number of processors. For a part of a picture, POV-Ray draws those strips of
 * the whole picture that contain the part. */
static void test_povray_plan(void **state) {
  (void)state;
  static const int sizes[][2] = { { 1, 1 }, { 64, 48 }, { 3, 4000 }, { 4000, 3 }, { 640, 480 }, { 1024, 768 }, { 1023, 997 }, { 4800, 3600 }, { 32768, 32768 } };
  static const uint64_t triangles[] = { 0, 100000, 10000000 };
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes * 3; i++)
    for (int quality = 0; quality <= VS_RENDER_FINAL; quality++) {
      vs_export_options o;
      vs_export_options_init(&o);
      size_t t = i % 3;
      o.width = sizes[i / 3][0], o.height = sizes[i / 3][1], o.quality = (vs_render_quality)quality, o.threads = 1;
      vs_povray_plan whole = vs_povray_plan_of(&o, triangles[t], true, false);
      assert_true(whole.count > whole.pass_count);
      uint64_t area[2] = { 0, 0 };
      for (size_t k = 0; k < whole.count; k++) {
        const vs_povray_job *j = &whole.jobs[k];
        bool pass = k < whole.pass_count;
        area[pass] += (uint64_t)j->part.columns * j->part.rows;
        assert_true(j->part.left + j->part.columns <= j->columns && j->part.top + j->part.rows <= j->rows);
        for (size_t m = pass ? 0 : whole.pass_count; m < k; m++) {
          const vs_exr_part *a = &j->part, *b = &whole.jobs[m].part;
          assert_true(a->left + a->columns <= b->left || b->left + b->columns <= a->left || a->top + a->rows <= b->top || b->top + b->rows <= a->top);
        }
      }
      assert_true(area[0] == (uint64_t)whole.columns * whole.rows);
      assert_true(!whole.pass_count || area[1] == (uint64_t)whole.jobs[0].columns * whole.jobs[0].rows);
      o.threads = 7;
      o.crop[0] = o.width / 3, o.crop[1] = o.height / 3, o.crop[2] = (o.width + 2) / 3, o.crop[3] = (o.height + 2) / 3;
      vs_povray_plan part = vs_povray_plan_of(&o, triangles[t], true, false);
      assert_int_equal(part.pass_count, whole.pass_count);
      for (size_t k = 0; k < part.count; k++) {
        size_t same = 0;
        for (size_t m = 0; m < whole.count; m++) same += memcmp(&part.jobs[k], &whole.jobs[m], sizeof *whole.jobs) == 0;
        assert_int_equal(same, 1);
      }
    }
}

/* Tiles have at least a row each, one above the other, and fill the picture. If a picture has more than two strips, no
 * strip is rendered for two tiles, unless there are more tiles than strips: a tile then lies in one strip. */
static void test_povray_tiles(void **state) {
  (void)state;
  static const uint32_t columns[] = { 1, 200, 3840 }, rows[] = { 1, 7, 240, 361, 481, 482, 1080, 2160, 7016, 32768 };
  static const uint32_t tiles[] = { 1, 2, 3, 7, 16, 17, 18, 19, 64, 479 };
  for (size_t i = 0; i < sizeof columns / sizeof *columns * (sizeof rows / sizeof *rows); i++)
    for (size_t t = 0; t < sizeof tiles / sizeof *tiles && tiles[t] <= rows[i / 3]; t++) {
      vs_export_options o;
      vs_export_options_init(&o);
      o.width = (int)columns[i % 3], o.height = (int)rows[i / 3], o.quality = VS_RENDER_GOOD;
      vs_povray_plan whole = vs_povray_plan_of(&o, 0, true, false);
      size_t strips = whole.count - whole.pass_count, rendered = 0;
      uint32_t top = vs_povray_tile_top(columns[i % 3], rows[i / 3], tiles[t], 0);
      assert_int_equal(top, 0);
      for (uint32_t k = 1; k <= tiles[t]; k++) {
        uint32_t end = vs_povray_tile_top(columns[i % 3], rows[i / 3], tiles[t], k);
        assert_true(end > top);
        o.crop[1] = (int)top, o.crop[2] = o.width, o.crop[3] = (int)(end - top);
        vs_povray_plan part = vs_povray_plan_of(&o, 0, true, false);
        rendered += part.count - part.pass_count;
        top = end;
      }
      assert_int_equal(top, rows[i / 3]);
      if (strips > 2 && tiles[t] <= rows[i / 3] / 2)
        assert_int_equal(rendered, tiles[t] > strips ? tiles[t] : strips);
    }
}

/* Tests the picture of a red sphere in front of a pale sky: red in the middle, not red in the corner. A POV-Ray scene
 * reads the picture and prints its colours. */
static void test_povray_picture(void **state) {
  (void)state;
  if (!installed("povray")) SKIP_TEST("no povray (package povray)");
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_paint(&m, "#ff0000", test_sphere(&m, 10, 20, 30, 2)));
  place p, q;
  place_open(&p, "out.png");
  vs_export_options options;
  vs_export_options_init(&options);
  options.width = 80, options.height = 60;
  options.quality = VS_RENDER_DRAFT;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  if (!vs_export(&m.scene, NULL, p.path, &options, &e)) fail_msg("%s", e.message);
  place_open(&q, "probe.pov");
  FILE *f = fopen(q.path, "w");
  assert_non_null(f);
  fprintf(f,
    "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n#declare F = function { pigment { image_map { png \"%s\" } } };\n"
    "#declare A = F(0.5, 0.5, 0);\n#declare B = F(0.02, 0.02, 0);\n"
    "#debug concat(\"\\nprobe \", str(A.red, 0, 3), \" \", str(A.green, 0, 3), \" \", str(B.red, 0, 3), \" \", str(B.green, 0, 3), \"\\n\")\n",
    p.path);
  fclose(f);
  char command[512], line[512];
  snprintf(command, sizeof command, "HOME=%s povray %s +L/usr/share/povray-3.7/include +W1 +H1 -D -F 2>&1", q.folder, q.path);
  double a_red = -1, a_green = -1, b_red = -1, b_green = -1;
  FILE *said = popen(command, "r");
  while (said != NULL && fgets(line, sizeof line, said) != NULL) sscanf(line, "probe %lf %lf %lf %lf", &a_red, &a_green, &b_red, &b_green);
  pclose(said);
  assert_true(a_red > 0.3 && a_green < 0.1);
  assert_true(b_red > 0.3 && b_green > 0.3);
  place_close(&p);
  place_close(&q);
  test_model_close(&m);
}

/* Tests that POV-Ray parses and draws every kind of node without a message: alone, and inside a subtraction, rotated
 * and scaled unequally. */
static void test_povray_takes_all(void **state) {
  (void)state;
  if (!installed("povray")) SKIP_TEST("no povray (package povray)");
  test_model m;
  test_model_open(&m);
  static const vs_kind kinds[] = { VS_BOX, VS_WEDGE, VS_SPHERE, VS_CYLINDER, VS_CONE, VS_CUT_CONE, VS_PYRAMID, VS_TORUS, VS_POLYFACE_MESH };
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
    for (int form = 0; form < 3; form++) {
      vs_ref r = test_any(&m, kinds[i]);
      if (form > 0) r = test_pair(&m, form == 1 ? VS_DIFFERENCE : VS_INTERSECTION, r, test_sphere(&m, 0, 0, 0, 2));
      vs_affine turn = vs_affine_rotation(vs_v3(0, 0, 0), vs_v3(1, 2, 3), 1), squeeze = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(1, -2, 0.5));
      vs_affine both = vs_affine_multiply(&turn, &squeeze);
      r = test_node(&m, 10, VS_TRANSFORM, &(struct vs_transform){ .matrix = both }, &r, 1);
      test_draw(&m, test_paint(&m, form == 2 ? "glass" : "brick", r));
    }
  place p;
  place_open(&p, "out.exr");
  vs_export_options options;
  vs_export_options_init(&options);
  options.width = 40, options.height = 30;
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  if (!vs_export(&m.scene, NULL, p.path, &options, &e)) fail_msg("%s", e.message);
  struct stat info;
  assert_int_equal(stat(p.path, &info), 0);
  assert_true(info.st_size > 1000);
  place_close(&p);
  test_model_close(&m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_povray_plan), cmocka_unit_test(test_povray_tiles), cmocka_unit_test(test_povray_words),
    cmocka_unit_test(test_povray_skins), cmocka_unit_test(test_povray_nested_skins),
    cmocka_unit_test(test_povray_solids), cmocka_unit_test(test_povray_solids_left),
    cmocka_unit_test(test_povray_missing), cmocka_unit_test(test_povray_complains),
    cmocka_unit_test(test_povray_stops), cmocka_unit_test(test_povray_picture),
    cmocka_unit_test(test_povray_takes_all),
  };
  return cmocka_run_group_tests_name("povray", tests, NULL, NULL);
}
