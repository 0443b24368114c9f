/* Tests the files of backends/ that need no interpreter: numbers, the tree dump and its reader, the text of each
 * format. An output file appears complete or not at all. OpenSCAD reads the written programs. */
#define _XOPEN_SOURCE 700
#include <locale.h>
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
#include <zlib.h>

#include "backends/number_spelling.h"
#include "backends/backend.h"
#include "backends/export.h"
#include "backends/tree/tree_reader.h"
#include "backends/x3d/deflate.h"
#include "tests/unit/skip.h"
#include "tests/unit/written.h"

/* ---- numbers ---- */

/* Checks that vs prints the number as printf's %.12g does, but without the exponent's plus sign and leading zeros, and
 * never as -0. */
static void assert_as_printed(double x) {
  char text[VS_NUMBER_ROOM], wide[64];
  size_t length = vs_number_text(x, text);
  snprintf(wide, sizeof wide, "%.12g", isfinite(x) ? x + 0.0 : 0);
  char *e = strchr(wide, 'e');
  if (e != NULL) {
    char *from = e + 1 + (e[1] == '-' || e[1] == '+'), *to = e + 1 + (e[1] == '-');
    while (*from == '0') from++;
    memmove(to, from, strlen(from) + 1);
  }
  if (length != strlen(text) || strcmp(text, wide) != 0) fail_msg("%a: %s is not %s", x, text, wide);
}

static void test_numbers(void **state) {
  (void)state;
  static const struct { double x; const char *text; } cases[] = {
    { 0, "0" }, { -0.0, "0" }, { 1, "1" }, { -1, "-1" }, { 0.1, "0.1" }, { -0.5, "-0.5" }, { 1.0 / 3, "0.333333333333" }, { 2.0 / 3, "0.666666666667" },
    { 123456.789, "123456.789" }, { 1e21, "1e21" }, { 1e-5, "1e-5" }, { 1.5e-7, "1.5e-7" }, { 6.123233995736766e-17, "6.12323399574e-17" },
    { 123456789012345.0, "1.23456789012e14" }, { 999999.9999999, "1000000" }, { 1e5, "100000" }, { 1e-320, "9.99988867183e-321" }, { 0.3, "0.3" },
    { 0.1 + 0.2, "0.3" }, { 4503599627370497.5, "4.50359962737e15" }, { 1e308 * 10, "0" },
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[VS_NUMBER_ROOM];
    size_t length = vs_number_text(cases[i].x, text);
    assert_int_equal(length, strlen(text));
    assert_string_equal(text, cases[i].text);
  }
  /* For every number, vs writes the twelve digits that printf writes: for random bits, and for numbers that are usual
   * in models. */
  uint64_t seed = 12345;
  const char *longer = getenv("LONG");
  for (int i = 0, most = longer && *longer ? 1500000 : 300000; i < most; i++) {
    seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407;
    uint64_t bits = seed ^ seed >> 29;
    double x;
    memcpy(&x, &bits, sizeof x);
    /* coordinates of many sizes, as in models */
    if (i % 8 > 0) x = (double)(int64_t)seed / (double)(UINT64_C(1) << (20 + i % 44));
    if (i % 8 == 2) x = round(x * 1000) / 1000;
    if (i % 8 == 3) x *= 1e-12;
    if (i % 8 == 4) x = ldexp((double)(seed >> 40), -(i % 40)); /* numbers half-way between two adjacent results of
                                                                 * rounding */
    /* numbers near a power of ten; rounding up gives some of them one digit more */
    if (i % 8 == 5) x = (999999999999.0 + (double)(seed >> 54) / 512) / pow(10, i % 23);
    if (i % 8 == 6) x = nextafter(pow(10, i % 33 - 16), i % 3 - 1);
    assert_as_printed(x);
  }
}

static void test_numbers_locale(void **state) {
  (void)state;
  if (setlocale(LC_NUMERIC, "de_DE.UTF-8") == NULL && setlocale(LC_NUMERIC, "fr_FR.UTF-8") == NULL)
    SKIP_TEST("no locale with a decimal comma (package locales-all)");
  char text[VS_NUMBER_ROOM];
  vs_number_text(1.0 / 3, text);
  setlocale(LC_NUMERIC, "C");
  assert_string_equal(text, "0.333333333333");
}

/* ---- the tree ---- */

static void test_tree_reads_back(void **state) {
  (void)state;
  for (int kind = 0; kind < VS_KIND_COUNT; kind++) {
    test_model m, back;
    test_model_open(&m);
    vs_ref one = test_any(&m, (vs_kind)kind);
    vs_node_retain(one.node);
    vs_ref other = one;
    test_draw(&m, one);
    test_draw(&m, other);
    char *text = written(&m, "tree");
    assert_holds(text, vs_kind_get((vs_kind)kind)->name);
    test_model_open(&back);
    vs_error e = { VS_ERROR_NONE, NULL, "" };
    if (!vs_tree_read(&back.scene, text, strlen(text), &e)) fail_msg("%s\n%s", e.message, text);
    char *again = written(&back, "tree");
    assert_string_equal(again, text);
    assert_int_equal(back.scene.drawn_count, 2);
    free(again);
    free(text);
    test_model_close(&back);
    test_model_close(&m);
  }
}

static void test_tree_golden(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  vs_ref shared = test_pair(&m, VS_UNION, test_box(&m, 0, 0, 0, 1, 2, 3), test_paint(&m, "#ff8000", test_sphere(&m, 0, 0, 4, 0.5)));
  vs_node_retain(shared.node);
  test_draw(&m, shared);
  test_draw(&m, test_move(&m, 5, 0, 0, shared));
  char *text = written(&m, "tree");
  assert_holds(text,
    "(tree 1 \"model\"\n"
    "  (define t1\n"
    "    (unite\n"
    "      (box (p 0 0 0) (q 1 2 3))\n"
    "      (with-material (material ");
  assert_holds(text, "        (sphere (c 0 0 4) (r 0.5) (segments 0)))))\n  (draw t1)\n  (draw (transform (matrix 1 0 0 5 0 1 0 0 0 0 1 0)\n    t1)))\n");
  free(text);
  test_model_close(&m);
}

static void test_tree_refuses(void **state) {
  (void)state;
  static const char *const bad[] = {
    "", "(", "(tree", "(tree 2 \"x\")", "(tree 1 \"x", "(tree 1 \"x\" (draw))", "(tree 1 \"x\" (draw (box)))", "(tree 1 \"x\" (draw (ball (r 1))))",
    "(tree 1 \"x\" (draw (sphere (c 0 0) (r 1) (segments 0))))", "(tree 1 \"x\" (draw t1))", "(tree 1 \"x\" (define t2 (empty-object)))",
    "(tree 1 \"x\" (draw (sphere (c 0 0 0) (r one) (segments 0))))", "(tree 1 \"x\" (draw (unite (box (p 0 0 0) (q 1 1 1))))",
    "(tree 1 \"x\" (draw (line (points (0 0 0) (1 1)) (closed #f))))", "(tree 1 \"x\" (draw (line (points) (closed maybe))))",
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    test_model m;
    test_model_open(&m);
    vs_error e = { VS_ERROR_NONE, NULL, "" };
    if (vs_tree_read(&m.scene, bad[i], strlen(bad[i]), &e)) fail_msg("this was read: %s", bad[i]);
    assert_int_equal(e.kind, VS_ERROR_MODEL);
    assert_true(e.message[0] != '\0');
    test_model_close(&m);
  }
}

/* ---- the text of each format ---- */

/* ---- deflating ---- */

/* Deflates bytes in pieces of `step`, and checks that zlib's inflate restores them. Returns the deflated size. */
static size_t deflate_and_back(vs_store *store, const unsigned char *bytes, size_t count, size_t step) {
  memory to = { 0 };
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_writer *w = malloc(sizeof *w);
  unsigned char *back = malloc(count + 1);
  assert_true(w && back);
  vs_writer_init(w, memory_sink, &to);
  vs_deflate *d = vs_deflate_begin(store, w, &e);
  if (!d) fail_msg("%s", e.message);
  for (size_t i = 0; i < count; i += step) assert_true(vs_deflate_put(d, bytes + i, count - i < step ? count - i : step));
  assert_true(vs_deflate_finish(d) && vs_writer_flush(w));
  vs_deflate_end(d);
  uLongf n = count + 1;
  assert_int_equal(uncompress(back, &n, (const Bytef *)to.text, to.used), Z_OK);
  assert_int_equal(n, count);
  assert_true(count == 0 || memcmp(bytes, back, count) == 0);
  size_t size = to.used;
  free(to.text), free(back), free(w);
  return size;
}

static void test_deflate(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  size_t room = 1 << 20;
  unsigned char *bytes = malloc(room);
  assert_non_null(bytes);
  uint32_t seed = 1;
  for (size_t i = 0; i < room; i++) bytes[i] = (unsigned char)((seed = seed * 1664525u + 1013904223u) >> 24);
  for (size_t n = 0; n < 40; n++) deflate_and_back(m.store, bytes, n, 3);
  /* the deflated form of noise, which cannot be compressed, is not much longer than the noise */
  assert_true(deflate_and_back(m.store, bytes, room, 70000) < room + room / 100);
  for (size_t i = 1000; i < room; i++) bytes[i] = bytes[i - 1000];
  assert_true(deflate_and_back(m.store, bytes, room, 4097) < room / 50);
  free(bytes);
  test_model_close(&m);
}

static void test_openscad_words(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_box(&m, 1, 0, 0, 2, 2, 3));
  test_draw(&m, test_node(&m, 1, VS_PYRAMID, &(struct vs_pyramid){ .base_radius = 2, .sides = 5, .top = { 0, 0, 1 } }, NULL, 0));
  test_draw(&m, test_node(&m, 1, VS_WEDGE, &(struct vs_wedge){ .q = { 1, 1, 1 } }, NULL, 0));
  test_draw(&m, test_paint(&m, "#ff0000", test_pair(&m, VS_DIFFERENCE, test_box(&m, 0, 0, 0, 1, 1, 1), test_paint(&m, "#00ff00", test_sphere(&m, 0, 0, 0, 0.5)))));
  char *text = written(&m, "scad");
  assert_holds(text, "translate([1, 0, 0]) cube([1, 2, 3]);\n");
  assert_holds(text, "cylinder(h = 1, r1 = 2, r2 = 0, $fn = 5);\n");
  assert_holds(text, "polyhedron(points = [");
  assert_holds(text, "difference() {\n  color([1, 0, 0]) cube([1, 1, 1]);\n  color([0, 1, 0]) sphere(r = 0.5, $fn = ");
  free(text);
  test_model_close(&m);
}

static void test_x3d_words(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  m.scene.title = vs_store_text(m.store, "<a&'b'>", 7);
  test_draw(&m, test_paint(&m, "#ff0000", test_box(&m, 0, 0, 0, 1, 2, 3)));
  test_draw(&m, test_paint(&m, "#ff0000", test_sphere(&m, 5, 0, 0, 2)));
  char *text = written(&m, "x3d");
  assert_holds(text, "content='&lt;a&amp;&#39;b&#39;&gt;'");
  assert_holds(text, "<Transform translation='0.5 1 1.5'>");
  assert_holds(text, "<Box size='1 2 3'/>");
  assert_holds(text, "<Sphere radius='2'/>");
  assert_holds(text, "<Appearance USE='M1'></Appearance>");
  free(text);
  text = written(&m, "x3dv");
  assert_holds(text, "geometry Box {\n");
  assert_holds(text, "appearance USE M1\n");
  free(text);
  test_model_close(&m);
}

/* adds a single triangle, which encloses no volume */
/* The text and the binary notation of STL contain the same numbers. */
static void test_stl_words(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_box(&m, 0.1, 0.7, 0.3, 1, 2, 3));
  char *text = written(&m, "stl-ascii");
  assert_holds(text, "vertex 0.10000000149 0.699999988079 0.300000011921\n");
  free(text);
  test_model_close(&m);
}

static vs_ref open_surface(test_model *m) {
  const vs_vec3 at[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  struct vs_polyface_mesh data = { .points = vs_points_new(m->scene.store, at, 3),
                                   .faces = vs_faces_new(m->scene.store, (const uint32_t[]){ 0, 3 }, 1, (const uint32_t[]){ 0, 1, 2 }, 3) };
  vs_ref ref = test_node(m, 1, VS_POLYFACE_MESH, &data, NULL, 0);
  vs_points_release(m->scene.store, data.points);
  vs_faces_release(m->scene.store, data.faces);
  return ref;
}

/* No format may write a boolean operation without operands. Tests a single operand, an empty object, and an object of a
 * class that the format omits. */
static void test_left_out(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  vs_ref nothing = test_node(&m, 1, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0), surface = open_surface(&m);
  test_draw(&m, test_pair(&m, VS_UNION, test_pair(&m, VS_DIFFERENCE, test_box(&m, 0, 0, 0, 1, 1, 1), nothing), surface));
  warnings = 0;
  char *text = written(&m, "scad");
  assert_lacks(text, "difference");
  assert_holds(text, "union() {\n  cube([1, 1, 1]);\n  polyhedron(");
  assert_int_equal(warnings, 1);
  assert_holds(last_warning, "open surfaces are drawn as thin slabs");
  free(text);
  warnings = 0;
  text = written(&m, "off"); /* the file contains the box and a triangle */
  assert_holds(text, "OFF\n11 13 0\n");
  assert_holds(text, "\n3 8 9 10\n");
  assert_int_equal(warnings, 0);
  free(text);
  text = written(&m, "stl-ascii"); /* the file contains only the box */
  int facets = 0;
  for (const char *at = text; (at = strstr(at, "facet normal")) != NULL; at++) facets++;
  assert_int_equal(facets, 12);
  assert_int_equal(warnings, 1);
  assert_holds(last_warning, "open surfaces are omitted");
  free(text);
  test_model_close(&m);

  test_model_open(&m);
  test_draw(&m, open_surface(&m));
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_null(written_quietly(&m, "stl-ascii", NULL, &e));
  assert_int_equal(e.kind, VS_ERROR_MODEL);
  test_model_close(&m);

  test_model_open(&m); /* OpenSCAD's format draws a curve as thin rods, with a warning */
  test_draw(&m, test_any(&m, VS_LINE));
  warnings = 0;
  text = written(&m, "scad");
  assert_holds(text, "cylinder(h = ");
  assert_int_equal(warnings, 1);
  assert_holds(last_warning, "drawn as thin rods");
  free(text);
  test_model_close(&m);
}

static void test_templates(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  vs_ref shared = test_pair(&m, VS_UNION, test_box(&m, 0, 0, 0, 1, 1, 1), test_sphere(&m, 0, 0, 2, 1));
  for (int i = 0; i < 3; i++) {
    vs_node_retain(shared.node);
    test_draw(&m, test_move(&m, 3.0 * i + 1, 0, 0, shared));
  }
  vs_node_release(shared.node);
  char *text = written(&m, "pov");
  const char *first = strstr(text, "box {");
  assert_non_null(first);
  assert_null(strstr(first + 1, "box {"));
  assert_holds(text, "#declare T1 =\n  union {\n");
  assert_holds(text, "object {\n  T1\n  translate <4, 0, 0>\n}\n");
  free(text);
  text = written(&m, "scad");
  assert_holds(text, "module part1() {\n  union() {\n");
  assert_holds(text, "translate([7, 0, 0])\n  part1();\n");
  free(text);
  test_model_close(&m);
}

static void test_singular(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  vs_ref box = test_box(&m, 0, 0, 0, 1, 1, 1);
  vs_affine flat = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(1, 1, 0));
  test_draw(&m, test_node(&m, 77, VS_TRANSFORM, &(struct vs_transform){ .matrix = flat }, &box, 1));
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_null(written_quietly(&m, "pov", NULL, &e));
  assert_int_equal(e.kind, VS_ERROR_MODEL);
  assert_non_null(e.origin);
  assert_int_equal(e.origin->line, 77);
  test_model_close(&m);
}

/* ---- depth ---- */

static void test_deep(void **state) {
  (void)state;
  enum { depth = 200000 };
  test_model m;
  test_model_open(&m);
  vs_ref all = test_box(&m, 0, 0, 0, 1, 1, 1);
  for (int i = 1; i <= depth; i++) {
    vs_ref next = i % 2 == 0 ? test_box(&m, i, 0, 0, i + 1, 1, 1) : test_sphere(&m, i, 0, 0, 0.25);
    all = test_pair(&m, i % 2 == 0 ? VS_UNION : VS_DIFFERENCE, all, next);
  }
  test_draw(&m, all);
  static const char *const formats[] = { "tree", "pov", "scad" };
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
    char *text = written(&m, formats[i]);
    /* Deeply nested subtrees must not be indented further than a fixed limit. */
    size_t deepest = 0, indent = 0;
    bool start = true;
    for (const char *c = text; *c != '\0'; c++) {
      if (*c == '\n') start = true, indent = 0;
      else if (start && *c == ' ') indent++;
      else start = false;
      if (indent > deepest) deepest = indent;
    }
    assert_true(deepest <= 130);
    free(text);
  }
  test_model_close(&m);
}

/* ---- memory ---- */

static void test_no_memory(void **state) {
  (void)state;
  static const char *const formats[] = { "tree", "pov", "scad", "x3d" };
  for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
    test_model m;
    test_model_open(&m);
    vs_ref shared = test_pair(&m, VS_UNION, test_box(&m, 0, 0, 0, 1, 1, 1), test_paint(&m, "steel", test_any(&m, VS_WEDGE)));
    vs_node_retain(shared.node);
    test_draw(&m, shared);
    test_draw(&m, test_move(&m, 1, 2, 3, shared));
    test_draw(&m, test_any(&m, VS_PYRAMID));
    char *good = written(&m, formats[f]), *text = NULL;
    size_t bytes = vs_store_bytes(m.store);
    int failures = 0;
    for (size_t n = 1; text == NULL; n++) {
      assert_true(n < 10000);
      vs_error e = { VS_ERROR_NONE, NULL, "" };
      vs_store_fail_at(m.store, n);
      text = written_quietly(&m, formats[f], NULL, &e);
      vs_store_fail_at(m.store, 0);
      if (text == NULL) {
        assert_int_equal(e.kind, VS_ERROR_MEMORY);
        failures++;
      }
      assert_int_equal(vs_store_bytes(m.store), bytes);
    }
    assert_true(failures > 3);
    assert_string_equal(text, good);
    free(text);
    free(good);
    test_model_close(&m);
  }
}

static void test_files(void **state) {
  (void)state;
  test_model m;
  test_model_open(&m);
  test_draw(&m, test_box(&m, 0, 0, 0, 1, 1, 1));
  place p;
  place_open(&p, "out.pov");
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  assert_true(vs_export(&m.scene, NULL, p.path, NULL, &e));
  assert_int_equal(place_files(&p), 1);

  /* An export that fails must keep the old file, and leave no other file in the folder. */
  struct stat before, after;
  assert_int_equal(stat(p.path, &before), 0);
  vs_ref box = test_box(&m, 0, 0, 0, 1, 1, 1);
  vs_affine flat = vs_affine_scaling(vs_v3(0, 0, 0), vs_v3(1, 0, 1));
  test_draw(&m, test_node(&m, 77, VS_TRANSFORM, &(struct vs_transform){ .matrix = flat }, &box, 1));
  assert_false(vs_export(&m.scene, NULL, p.path, NULL, &e));
  assert_int_equal(stat(p.path, &after), 0);
  assert_int_equal(before.st_ino, after.st_ino);
  assert_int_equal(before.st_size, after.st_size);
  assert_int_equal(place_files(&p), 1);

  assert_false(vs_export(&m.scene, NULL, p.folder, NULL, &e));
  assert_int_equal(e.kind, VS_ERROR_FILE);
  assert_false(vs_export(&m.scene, vs_export_format_find("tree"), p.folder, NULL, &e));
  assert_holds(e.message, "it is a folder");
  assert_false(vs_export(&m.scene, NULL, "/nowhere/at/all/x.pov", NULL, &e)); /* the export fails before it makes any
                                                                               * file */
  assert_int_equal(e.kind, VS_ERROR_FILE);
  assert_false(vs_export(&m.scene, NULL, "x.unknown", NULL, &e));
  assert_int_equal(e.kind, VS_ERROR_FILE);
  test_model_close(&m);
  test_model_open(&m);
  test_draw(&m, test_box(&m, 0, 0, 0, 1, 1, 1));
  if (access("/dev/full", W_OK) == 0) {
    assert_false(vs_export(&m.scene, vs_export_format_find("tree"), "/dev/full", NULL, &e));
    assert_int_equal(e.kind, VS_ERROR_FILE);
    assert_holds(e.message, "the disk is full");
  }
  place_close(&p);
  test_model_close(&m);
}

static void test_formats(void **state) {
  (void)state;
  assert_null(vs_export_format_find("jpg"));
  assert_string_equal(vs_export_format_find("a/b.c/house.PNG")->suffix, "png");
  assert_string_equal(vs_export_format_find("openscad")->suffix, "scad");
  for (size_t i = 0; i < vs_export_format_count(); i++)
    for (size_t k = 0; k < i; k++) assert_string_not_equal(vs_export_format_at(i)->name, vs_export_format_at(k)->name);
  assert_string_equal(vs_export_format_find("x.stl")->name, "stl"); /* two formats have the suffix .stl;
                                                                     * vs_export_format_find must return the format
                                                                     * "stl" */
  assert_string_equal(vs_export_format_find("stl-ascii")->suffix, "stl");
}

/* ---- workers ---- */

static void test_openscad_takes_all(void **state) {
  (void)state;
  if (!installed("openscad")) SKIP_TEST("no openscad (package openscad)");
  test_model m;
  test_model_open(&m);
  static const vs_kind kinds[] = { VS_BOX, VS_WEDGE, VS_SPHERE, VS_CYLINDER, VS_CONE, VS_CUT_CONE, VS_PYRAMID, VS_TORUS, VS_POLYFACE_MESH };
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    vs_ref r = test_any(&m, kinds[i]);
    vs_node_retain(r.node);
    test_draw(&m, test_paint(&m, "gold", test_move(&m, 30.0 * (double)i, 0, 0, r)));
    test_draw(&m, test_move(&m, 0, 50, 0, test_pair(&m, VS_DIFFERENCE, r, test_sphere(&m, 0, 0, 0, 2))));
  }
  place p, q;
  place_open(&p, "out.scad");
  place_open(&q, "out.csg");
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  if (!vs_export(&m.scene, NULL, p.path, NULL, &e)) fail_msg("%s", e.message);
  char command[512], line[512];
  snprintf(command, sizeof command, "HOME=%s openscad --hardwarnings -o %s %s 2>&1", q.folder, q.path, p.path);
  FILE *said = popen(command, "r");
  assert_non_null(said);
  while (fgets(line, sizeof line, said) != NULL)
    if (strstr(line, "ERROR") != NULL || strstr(line, "WARNING") != NULL) fail_msg("openscad: %s", line);
  assert_int_equal(pclose(said), 0);
  struct stat info;
  assert_int_equal(stat(q.path, &info), 0);
  assert_true(info.st_size > 1000);
  place_close(&p);
  snprintf(command, sizeof command, "rm -rf %s", q.folder);
  assert_int_equal(system(command), 0);
  test_model_close(&m);
}

/* A format that contains only the union of the solids must warn about each class of objects that it omits. */
static void test_tells_what_is_left_out(void **state) {
  (void)state;
  static const struct { const char *name; const vs_backend *backend; } all[] = {
#define VS_FORMAT(suffix, backend, name, worker, binary, doc) { name, &vs_backend_##backend },
#include "backends/backends.def"
  };
  size_t solids_alone = 0;
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    const vs_backend *b = all[i].backend;
    if ((!b->solid && !b->copies) || vs_backend_has(b, VS_LOOSE)) continue;
    solids_alone++;
    for (int class_ = VS_CURVE; class_ < VS_MIXED; class_++)
      if (class_ != VS_SOLID && !b->omit[class_]) fail_msg("%s: no word on leaving out class %d", all[i].name, class_);
  }
  assert_true(solids_alone > 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_tells_what_is_left_out), cmocka_unit_test(test_numbers),
    cmocka_unit_test(test_numbers_locale), cmocka_unit_test(test_tree_reads_back), cmocka_unit_test(test_tree_golden),
    cmocka_unit_test(test_tree_refuses), cmocka_unit_test(test_deflate), cmocka_unit_test(test_openscad_words),
    cmocka_unit_test(test_x3d_words), cmocka_unit_test(test_stl_words), cmocka_unit_test(test_left_out),
    cmocka_unit_test(test_templates), cmocka_unit_test(test_singular), cmocka_unit_test(test_deep),
    cmocka_unit_test(test_no_memory), cmocka_unit_test(test_files), cmocka_unit_test(test_formats),
    cmocka_unit_test(test_openscad_takes_all),
  };
  return cmocka_run_group_tests_name("backends", tests, NULL, NULL);
}
