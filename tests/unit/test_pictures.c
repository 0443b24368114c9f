/* Tests geometry/pictures and EXR files. Tone curves are compared with published values, and measures of the difference
 * of two pictures with formulas. Also tests exposure by the histogram, noise and edges, and files that are cut short or
 * changed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/files/exr_read.h"
#include "geometry/measure/openness.h"
#include "geometry/files/png_read.h"
#include "geometry/files/png_write.h"
#include "geometry/pictures/denoise.h"
#include "geometry/pictures/false_color.h"
#include "geometry/pictures/picture_difference.h"
#include "geometry/pictures/tone.h"

/* Computes the screen's values (0 to 255) of a single colour r, g, b of linear light, at a fixed exposure in stops. */
static void screen(vs_tone_curve curve, double stops, float r, float g, float b, unsigned char rgb[3]) {
  vs_light light = { &r, &g, &b, 1, 1 };
  vs_tone tone = { .curve = curve, .fixed = true, .stops = stops };
  assert_true(vs_tone_apply(&light, &tone, rgb) == stops);
}

static int grey(vs_tone_curve curve, double stops, float x) {
  unsigned char rgb[3];
  screen(curve, stops, x, x, x, rgb);
  assert_in_range(rgb[0], rgb[1] - 1 > 0 ? rgb[1] - 1 : 0, rgb[1] + 1);
  return rgb[1];
}

/* By IEC 61966-2-1, middle grey (.18) has the screen value 118 of 255; .0031308 is the end of the curve's straight
 * part. */
static void test_linear(void **state) {
  (void)state;
  assert_int_equal(grey(VS_TONE_LINEAR, 0, 0.18f), 118);
  assert_int_equal(grey(VS_TONE_LINEAR, 0, 0.0031308f), 10);
  assert_int_equal(grey(VS_TONE_LINEAR, 1, 0.5f), 255);
  assert_int_equal(grey(VS_TONE_LINEAR, 0, 7), 255);
  assert_int_equal(grey(VS_TONE_LINEAR, 0, -7), 0);
}

/* Tests that every screen value is the integer nearest to the formula of IEC 61966-2-1, also for dark colours in the
 * formula's linear part. */
static void test_screen(void **state) {
  (void)state;
  for (int i = 0; i <= 200000; i++) {
    float x = (float)(i % 2 ? i / 200000. : pow(i / 200000., 4));
    double v = (double)x <= 0.0031308 ? 12.92 * (double)x : 1.055 * pow((double)x, 1 / 2.4) - 0.055;
    unsigned char rgb[3];
    screen(VS_TONE_LINEAR, 0, x, x, x, rgb);
    assert_true(rgb[1] == lround(255 * v) || fabs(255 * v - floor(255 * v) - 0.5) < 1e-9);
  }
}

/* The tone curve PBR Neutral of Khronos. Values below .76 only decrease by .04, the reflection of dielectrics. A peak
 * of 1.72, which is above .76, becomes 1 - .24^2 / (1.72 + .24 - .76) = .952. */
static void test_neutral(void **state) {
  (void)state;
  unsigned char rgb[3];
  assert_int_equal(grey(VS_TONE_NEUTRAL, 0, 0.54f), 188); /* .54 decreases by .04 to .5, which is 188 on the screen */
  assert_int_equal(grey(VS_TONE_NEUTRAL, 0, 1.76f), 250);
  screen(VS_TONE_NEUTRAL, 0, 0.5f, 0.08f, 0.08f, rgb);
  assert_int_equal(rgb[0], 181); /* the screen value of the linear value .46 */
  assert_int_equal(rgb[1], 56);  /* the screen value of the linear value .04 */
  assert_in_range(grey(VS_TONE_NEUTRAL, 0, 1000), 254, 255);
}

/* Tests Hable's filmic curve: the expected value is his formula, with his constants, at 2 * .18, divided by its value
 * at the white of 11.2. */
static void test_filmic(void **state) {
  (void)state;
  double x = 0.36, w = 11.2;
  double fx = (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
  double fw = (w * (0.15 * w + 0.05) + 0.004) / (w * (0.15 * w + 0.5) + 0.06) - 0.02 / 0.3;
  assert_int_equal(grey(VS_TONE_FILMIC, 0, 0.18f), (int)lround(255 * (1.055 * pow(fx / fw, 1 / 2.4) - 0.055)));
  assert_int_equal(grey(VS_TONE_FILMIC, 0, 5.6f), 255);
  assert_int_equal(grey(VS_TONE_FILMIC, 0, 0), 0);
}

/* The tone curve AgX covers ten stops below middle grey and 6.5 above. Darker light becomes black, brighter light
 * white. */
static void test_agx(void **state) {
  (void)state;
  int last = -1;
  for (double stop = -11; stop <= 7; stop += 0.25) {
    int now = grey(VS_TONE_AGX, 0, (float)(0.18 * exp2(stop)));
    assert_true(now >= last);
    last = now;
  }
  assert_in_range(grey(VS_TONE_AGX, 0, (float)(0.18 * exp2(6.6))), 253, 255);
  assert_in_range(grey(VS_TONE_AGX, 0, 0), 0, 2);
  assert_in_range(grey(VS_TONE_AGX, 0, 0.18f), 90, 120);
}

/* Tests that the automatic exposure compensates for brighter light: for every curve, the picture does not change when
 * all light is multiplied by a factor. */
static void test_exposure(void **state) {
  (void)state;
  enum { COUNT = 1000 };
  float at[COUNT], brighter[COUNT];
  unsigned char a[3 * COUNT], b[3 * COUNT];
  for (int i = 0; i < COUNT; i++) at[i] = 0.02f + 0.001f * (float)i, brighter[i] = 8 * at[i];
  for (int curve = VS_TONE_NEUTRAL; curve <= VS_TONE_LINEAR; curve++) {
    vs_light one = { at, at, at, COUNT, 1 }, two = { brighter, brighter, brighter, COUNT, 1 };
    vs_tone tone = { .curve = (vs_tone_curve)curve, .stops = -0.5 };
    double first = vs_tone_apply(&one, &tone, a), second = vs_tone_apply(&two, &tone, b);
    assert_true(fabs(first - second - 3) < 1e-9);
    assert_memory_equal(a, b, sizeof a);
  }
}

/* Tests dithering, which adds noise before rounding to screen values. A gradient over few screen values has no band
 * wider than 8 pixels, and keeps its mean. White and black do not change. A dithered part of a picture equals that part
 * of the dithered whole picture. */
static void test_dither(void **state) {
  (void)state;
  enum { WIDE = 512, HIGH = 16, LEFT = 37, TOP = 5 };
  static float at[WIDE * HIGH], part[WIDE * HIGH];
  static unsigned char rgb[3 * WIDE * HIGH], cut_rgb[3 * WIDE * HIGH];
  for (int i = 0; i < WIDE * HIGH; i++) at[i] = 0.5f + 0.02f * (float)(i % WIDE) / WIDE;
  vs_light light = { at, at, at, WIDE, HIGH };
  vs_tone tone = { .curve = VS_TONE_LINEAR, .fixed = true, .dither = true };
  vs_tone_apply(&light, &tone, rgb);
  double sum = 0, wanted = 0;
  for (int x = 0, band = 0; x < WIDE; x++) {
    bool flat = true; /* whether each pixel of this column equals its neighbour in the column before */
    for (int y = 0; y < HIGH; y++) {
      unsigned char here = rgb[3 * (y * WIDE + x)];
      flat = flat && here == rgb[3 * (x ? x - 1 : 0)];
      sum += here, wanted += 255 * (1.055 * pow((double)at[x], 1 / 2.4) - 0.055);
    }
    band = flat ? band + 1 : 0;
    assert_true(band <= 8);
  }
  assert_true(fabs(sum - wanted) / (WIDE * HIGH) < 0.02);
  for (int y = TOP; y < HIGH; y++)
    for (int x = LEFT; x < WIDE; x++) part[(y - TOP) * (WIDE - LEFT) + x - LEFT] = at[y * WIDE + x];
  vs_light piece = { part, part, part, WIDE - LEFT, HIGH - TOP };
  tone.left = LEFT, tone.top = TOP;
  vs_tone_apply(&piece, &tone, cut_rgb);
  for (int y = TOP; y < HIGH; y++)
    assert_memory_equal(&rgb[3 * (y * WIDE + LEFT)], &cut_rgb[3 * (y - TOP) * (WIDE - LEFT)], 3 * (WIDE - LEFT));
  for (int i = 0; i < WIDE * HIGH; i++) at[i] = i < WIDE ? 0 : 1;
  vs_tone_apply(&light, &tone, rgb);
  for (int i = 0; i < WIDE * HIGH; i++) assert_int_equal(rgb[3 * i], i < WIDE ? 0 : 255);
}

/* Tests pictures of light that have no pixels, NaN or infinities. */
static void test_odd_light(void **state) {
  (void)state;
  float at[3] = { NAN, INFINITY, -INFINITY };
  unsigned char rgb[9];
  vs_light odd = { at, at, at, 3, 1 }, none = { at, at, at, 0, 0 };
  for (int curve = VS_TONE_NEUTRAL; curve <= VS_TONE_LINEAR; curve++) {
    vs_tone tone = { .curve = (vs_tone_curve)curve };
    assert_true(vs_tone_apply(&none, &tone, rgb) == 0);
    assert_true(vs_tone_apply(&odd, &tone, rgb) == 0);
    assert_in_range(rgb[0], 0, 2);
    assert_in_range(rgb[3], 250, 255);
    assert_in_range(rgb[6], 0, 2);
  }
}

/* ---- EXR files ---- */

enum { WIDE = 40, HIGH = 37, PIXELS = WIDE * HIGH };

/* Returns a random number from 0 to 1, equal in every run and on every machine. */
static double chance(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (*seed >> 8) / 16777216.0;
}

/* Makes a picture of two painted areas, grey 0.2 and 0.8. The light has noise, but the layers (albedo, normal, depth)
 * have none. */
static void make_picture(vs_store *store, vs_exr *x, double noise) {
  static const char *const names[] = { "R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "N.X", "N.Y", "N.Z" };
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  uint32_t seed = 7;
  *x = (vs_exr){ .store = store, .columns = WIDE, .rows = HIGH };
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    float *at = vs_exr_add(x, names[k], VS_EXR_HALF, &e);
    assert_non_null(at);
    for (size_t i = 0; i < PIXELS; i++) {
      float paint = i % WIDE < WIDE / 2 ? 0.2f : 0.8f;
      at[i] = k < 3 ? paint * (float)(1 + noise * (chance(&seed) - 0.5)) : k < 6 ? paint : k == 8 ? 1 : 0;
    }
  }
  float *id = vs_exr_add(x, "id", VS_EXR_WHOLE, &e), *depth = vs_exr_add(x, "Z", VS_EXR_FLOAT, &e);
  for (size_t i = 0; i < PIXELS; i++) id[i] = (float)(i * 11000), depth[i] = 1 / (1 + (float)i);
  static const char sources[] = "a.vs:1:2\nb.vs:3:4\n";
  assert_true(vs_exr_add_text(x, VS_EXR_SOURCES, sources, sizeof sources - 1, &e));
}

static void test_exr_round_trip(void **state) {
  (void)state;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_made_bytes made[2];
  vs_exr x, y;
  make_picture(store, &x, 0.3);
  for (int i = 0; i < 2; i++) assert_true(vs_exr_write(&x, &made[i], &e));
  size_t size = made[0].size;
  assert_int_equal(size, made[1].size);
  assert_memory_equal(made[0].at, made[1].at, size);
  assert_true(vs_exr_read(store, &(vs_file_bytes){ "x", made[0].at, size }, NULL, &y, &e));
  assert_int_equal(y.columns, WIDE);
  assert_int_equal(y.rows, HIGH);
  assert_int_equal(y.count, x.count);
  assert_string_equal(y.texts[VS_EXR_SOURCES].at, x.texts[VS_EXR_SOURCES].at);
  assert_memory_equal(vs_exr_find(&y, "id"), vs_exr_find(&x, "id"), PIXELS * sizeof(float));
  assert_memory_equal(vs_exr_find(&y, "Z"), vs_exr_find(&x, "Z"), PIXELS * sizeof(float));
  for (size_t i = 0; i < PIXELS; i++)
    assert_true(fabsf(vs_exr_find(&y, "R")[i] - vs_exr_find(&x, "R")[i]) <= vs_exr_find(&x, "R")[i] / 1024);
  vs_exr_free(&y);
  /* a file that is cut off at any length, or randomly changed, gives a picture or a message */
  unsigned char *copy = malloc(size);
  for (size_t n = 0; n < size; n += n < 1000 ? 1 : 37) {
    e = (vs_error){ VS_ERROR_NONE, NULL, "" };
    assert_false(vs_exr_read(store, &(vs_file_bytes){ "x", memcpy(copy, made[0].at, n), n }, NULL, &y, &e));
    assert_true(e.kind == VS_ERROR_MODEL && *e.message);
  }
  uint32_t seed = 3;
  for (int i = 0; i < 1500; i++) {
    memcpy(copy, made[0].at, size);
    for (int k = 0; k < 3; k++) {
      size_t at = (size_t)(chance(&seed) * (i % 2 ? 700 : (double)size));
      copy[at < size ? at : 0] = (unsigned char)(256 * chance(&seed));
    }
    e = (vs_error){ VS_ERROR_NONE, NULL, "" };
    if (vs_exr_read(store, &(vs_file_bytes){ "x", copy, size }, NULL, &y, &e)) vs_exr_free(&y);
    else assert_true(e.kind != VS_ERROR_NONE && (*e.message || e.kind == VS_ERROR_MEMORY));
  }
  free(copy);
  for (int i = 0; i < 2; i++) vs_store_realloc(store, made[i].at, made[i].room, 0);
  vs_exr_free(&x);
  vs_store_release(store);
}

/* Tests that all 65,536 half floats have the values of IEEE 754. */
static void test_halves(void **state) {
  (void)state;
  enum { SIDE = 256 };
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x = { .store = store, .columns = SIDE, .rows = SIDE }, y;
  vs_made_bytes made = { NULL, 0, 0 };
  float *plane = vs_exr_add(&x, "Y", VS_EXR_HALF, &e);
  assert_non_null(plane);
  for (int i = 0; i < SIDE * SIDE; i++) {
    int exponent = i >> 10 & 31, fraction = i & 1023;
    double value = exponent == 31 ? (fraction ? (double)NAN : (double)INFINITY)
                   : exponent     ? ldexp(1024 + fraction, exponent - 25)
                                  : ldexp(fraction, -24);
    plane[i] = (float)(i & 0x8000 ? -value : value);
  }
  assert_true(vs_exr_write(&x, &made, &e));
  assert_true(vs_exr_read(store, &(vs_file_bytes){ "x", made.at, made.size }, NULL, &y, &e));
  const float *back = vs_exr_find(&y, "Y");
  for (int i = 0; i < SIDE * SIDE; i++)
    assert_true(isnan(plane[i]) ? isnan(back[i]) : back[i] == plane[i] && signbit(back[i]) == signbit(plane[i]));
  vs_exr_free(&x);
  vs_exr_free(&y);
  vs_store_realloc(store, made.at, made.room, 0);
  vs_store_release(store);
}

/* Tests that pixels are unchanged after they are written as PNG and read: a picture of noise, and a picture of a single
 * pixel. */
static void test_png(void **state) {
  (void)state;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  const uint32_t sizes[][2] = { { 301, 97 }, { 1, 1 } };
  for (int k = 0; k < 2; k++) {
    uint32_t columns = sizes[k][0], rows = sizes[k][1], seed = 5;
    size_t count = (size_t)columns * rows;
    unsigned char *rgb = malloc(3 * count);
    vs_made_bytes made = { NULL, 0, 0 };
    for (size_t i = 0; i < 3 * count; i++) rgb[i] = (unsigned char)(i % 7 < 3 ? 256 * chance(&seed) : 40);
    assert_true(vs_png_write(store, &(vs_pixels){ rgb, columns, rows }, &made, &e));
    vs_png_pixels p;
    assert_true(vs_png_read(store, &(vs_file_bytes){ "x", made.at, made.size }, &p, &e));
    assert_true(p.columns == columns && p.high == rows);
    for (size_t i = 0; i < count; i++)
      for (unsigned c = 0; c < 3; c++) assert_true(lround(255 * vs_png_at(&p, i, c)) == rgb[3 * i + c]);
    vs_store_realloc(store, p.rows, p.room, 0);
    vs_store_realloc(store, made.at, made.room, 0);
    free(rgb);
  }
  vs_store_release(store);
}

static double spread(const float *at, uint32_t from, uint32_t to) {
  double sum = 0, squares = 0, n = 0;
  for (uint32_t y = 0; y < HIGH; y++)
    for (uint32_t i = from; i < to; i++) {
      double v = (double)at[y * WIDE + i];
      sum += v, squares += v * v, n++;
    }
  return sqrt(fmax(squares / n - sum / n * (sum / n), 0)) / (sum / n);
}

/* Tests that denoising reduces noise to a quarter or less, and that the edge between two painted areas stays in
 * place. */
static void test_denoise(void **state) {
  (void)state;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_exr x;
  bool layers = false;
  make_picture(store, &x, 0.4);
  float *red = vs_exr_find(&x, "R");
  double before = spread(red, 0, WIDE / 2);
  assert_true(vs_exr_smooth(&x, &layers, &e));
  assert_true(layers);
  assert_true(before > 0.1);
  assert_true(spread(red, 0, WIDE / 2) < before / 4);
  assert_true(spread(red, WIDE / 2, WIDE) < before / 4);
  for (uint32_t y = 0; y < HIGH; y++) {
    assert_true(fabsf(red[y * WIDE + WIDE / 2 - 1] - 0.2f) < 0.03f);
    assert_true(fabsf(red[y * WIDE + WIDE / 2] - 0.8f) < 0.12f);
  }
  vs_exr_free(&x);
  vs_store_release(store);
}

/* Tests the measures of the difference of two pictures. A constant difference of .1 is 20 dB, equal pictures are
 * reported as equal, and noise lowers the similarity. */
static void test_gap(void **state) {
  (void)state;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_picture_gap gap;
  float a[PIXELS], b[PIXELS], each[PIXELS];
  uint32_t seed = 1;
  for (size_t i = 0; i < PIXELS; i++) a[i] = 0.2f + 0.5f * (float)(i % WIDE) / WIDE, b[i] = a[i] + 0.1f;
  vs_light one = { a, a, a, WIDE, HIGH }, two = { b, b, b, WIDE, HIGH };
  assert_true(vs_picture_measure_gap(store, &one, &one, each, &gap, &e));
  assert_true(gap.most == 0 && isinf(gap.peak_ratio) && fabs(gap.similarity - 1) < 1e-12 && each[5] == 0);
  assert_true(vs_picture_measure_gap(store, &one, &two, each, &gap, &e));
  assert_true(fabs(gap.peak_ratio - 20) < 1e-4 && fabs(gap.most - 0.1) < 1e-6 && fabsf(each[9] - 0.1f) < 1e-6f);
  double steady = gap.similarity;
  for (size_t i = 0; i < PIXELS; i++) b[i] = a[i] + (float)(0.2 * (chance(&seed) - 0.5));
  b[777] = a[777] + 0.5f;
  assert_true(vs_picture_measure_gap(store, &one, &two, NULL, &gap, &e));
  assert_int_equal(gap.worst, 777);
  assert_true(gap.similarity < steady && gap.similarity > 0);
  vs_store_release(store);
}

/* Tests false colours, which show numbers on a scale: the ends of the scale, its steps, and numbers outside the
 * scale. */
static void test_false_color(void **state) {
  (void)state;
  float at[1000];
  unsigned char low[3], high[3], rgb[3];
  for (int i = 0; i < 1000; i++) at[i] = (float)(i + 1);
  vs_color_scale s = vs_color_scale_of(at, 1000, true, "cd/m2");
  assert_in_range(s.least, 10, 12);
  assert_in_range(s.most, 988, 991);
  vs_false_color(&s, s.least, low);
  vs_false_color(&s, s.most, high);
  vs_false_color(&s, -5, rgb);
  assert_memory_equal(rgb, low, 3);
  vs_false_color(&s, 1e9, rgb);
  assert_memory_equal(rgb, high, 3);
  vs_false_color(&s, NAN, rgb);
  assert_memory_equal(rgb, low, 3);
  assert_true(high[0] > 2 * high[2] && low[0] < 60 && low[1] < 60); /* the high end of the scale is red, the low end
                                                                     * dark */
  vs_color_scale steps = { .least = 0, .most = 10, .steps = 5, .unit = "h" };
  vs_false_color(&steps, 0.1, low);
  vs_false_color(&steps, 1.9, rgb);
  assert_memory_equal(rgb, low, 3);
  vs_false_color(&steps, 2.1, rgb);
  assert_memory_not_equal(rgb, low, 3);
}

/* ---- rays ---- */

/* Tests a ray in the plane of a box's side: the ray hits the box if it runs along that side, but not if it passes
 * beside it. */
static void test_ray_box(void **state) {
  (void)state;
  vs_bounds b = { vs_v3(0, 0, 0), vs_v3(1, 2, 3) };
  for (int k = 0; k < 4; k++) {
    vs_vec3 down = vs_v3(0, 0, k % 2 ? -1 : 1), from = vs_v3(0, k < 2 ? 1 : 2, k % 2 ? 12 : -9);
    assert_true(vs_ray_meets_box(&b, from, down, INFINITY));
    from.x = 1;
    assert_true(vs_ray_meets_box(&b, from, down, INFINITY));
    assert_false(vs_ray_meets_box(&b, from, down, 8));
    from.x = 1 + 1e-9;
    assert_false(vs_ray_meets_box(&b, from, down, INFINITY));
  }
}

/* Compares the intersections of a ray with triangles, found by a tree of bounding boxes, with those found by testing
 * every triangle. Tests triangles of all sizes, and many triangles at one place. */
static void test_ray_tree(void **state) {
  (void)state;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  for (int kind = 0; kind < 3; kind++) {
    vs_mesh m = { 0 };
    vs_ray_tree t;
    uint32_t seed = 5;
    for (uint32_t i = 0; i < (kind == 2 ? 0u : 700u); i++) {
      double size = kind ? 0 : pow(10, 2 * chance(&seed) - 2);
      vs_vec3 at = kind ? vs_v3(0.5, 0.5, 0.5) : vs_v3(chance(&seed), chance(&seed), chance(&seed));
      for (int k = 0; k < 3; k++) {
        vs_vec3 off = vs_v3(chance(&seed) - 0.5, chance(&seed) - 0.5, chance(&seed) - 0.5);
        assert_true(vs_mesh_add_vertex(&m, vs_v3_add(at, vs_v3_scale(off, size + 0.01)), NULL));
      }
      assert_true(vs_mesh_add_triangle(&m, 3 * i, 3 * i + 1, 3 * i + 2));
    }
    assert_true(vs_ray_tree_make(&t, store, &m, &e));
    size_t met = 0;
    for (int i = 0; i < 2000; i++) {
      vs_vec3 from = vs_v3(3 * chance(&seed) - 1, 3 * chance(&seed) - 1, 3 * chance(&seed) - 1);
      vs_vec3 to = vs_v3(chance(&seed), chance(&seed), chance(&seed));
      if (kind == 1) to = vs_v3_add(vs_v3(0.495, 0.495, 0.495), vs_v3_scale(to, 0.01));
      vs_vec3 direction = vs_v3_sub(to, from);
      if (i % 5 == 0) direction = vs_v3(0, 0, i % 2 ? 1 : -1);
      double nearest = INFINITY, at, any;
      for (size_t k = 0; k < m.triangle_count; k++) {
        const vs_vec3 p[3] = { m.vertices[3 * k], m.vertices[3 * k + 1], m.vertices[3 * k + 2] };
        nearest = fmin(nearest, vs_ray_meets_triangle(p, from, direction));
      }
      size_t hit = vs_ray_tree_meet(&t, from, direction, INFINITY, false, &at);
      assert_true(at == nearest && (hit == m.triangle_count) == isinf(nearest));
      assert_true((vs_ray_tree_meet(&t, from, direction, INFINITY, true, &any) == m.triangle_count) == isinf(nearest));
      met += hit < m.triangle_count;
    }
    assert_true(kind == 2 ? met == 0 : met > 0);
    vs_ray_tree_free(&t);
    vs_mesh_free(&m);
  }
  vs_store_release(store);
}

/* Tests openness: the fraction of directions, weighted by the cosine, in which no surface is within the distance `far`.
 *
 * Beside a wall at the distance d, larger than `far` in extent, a direction hits the wall within `far` if its component
 * towards the wall is more than c = d / far. Seen from above, these directions are a segment of the unit disc with the
 * area acos c - c sqrt(1 - c c). Beside a wall of the height h, with an infinite `far`, the hidden fraction is half of
 * 1 - d / sqrt(d d + h h). */
static void test_openness(void **state) {
  (void)state;
  vs_store *store = vs_store_new(NULL, NULL);
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  vs_mesh m;
  vs_ray_tree t, none;
  m = (vs_mesh){ 0 };
  const double wide = 1e5, high = 2;
  for (int i = 0; i < 4; i++)
    assert_true(vs_mesh_add_vertex(&m, vs_v3(1, i & 1 ? wide : -wide, i & 2 ? high : 0), NULL));
  assert_true(vs_mesh_add_triangle(&m, 0, 1, 3) && vs_mesh_add_triangle(&m, 0, 3, 2));
  vs_mesh empty;
  empty = (vs_mesh){ 0 };
  assert_true(vs_ray_tree_make(&t, store, &m, &e) && vs_ray_tree_make(&none, store, &empty, &e));
  const struct { vs_surrounding round; vs_vec3 from, normal; double open; } cases[] = {
    { { &none, -INFINITY, 1 }, vs_v3(0, 0, 0), vs_v3(0, 0, 1), 1 },
    { { &none, 0, 1e9 }, vs_v3(0, 0, 1), vs_v3(1, 0, 0), 0.5 },        /* on a wall, the infinite ground hides half of
                                                                        * the directions */
    { { &none, 0, 1e9 }, vs_v3(0, 0, 1), vs_v3(0, 0, -1), 0 },         /* below a ceiling, the infinite ground hides all
                                                                        * directions */
    { { &t, -INFINITY, 2 }, vs_v3(0, 0, 0), vs_v3(0, 0, 1), 1 - (acos(0.5) - 0.5 * sqrt(0.75)) / acos(-1) },
    { { &t, -INFINITY, 1e9 }, vs_v3(-1, 0, 0), vs_v3(0, 0, 1), 1 - 0.5 * (1 - 2 / sqrt(8)) },
    { { &t, -INFINITY, 0.9 }, vs_v3(0, 0, 0), vs_v3(0, 0, 1), 1 },     /* the surface is further away than `far`, so it
                                                                        * hides no direction */
  };
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    double sum = 0;
    enum { SEEDS = 500 };
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
      double open = vs_openness(&cases[c].round, cases[c].from, cases[c].normal, seed);
      assert_true(open == vs_openness(&cases[c].round, cases[c].from, cases[c].normal, seed));
      assert_true(fabs(open - cases[c].open) < 0.09);
      sum += open / SEEDS;
    }
    assert_true(fabs(sum - cases[c].open) < 0.004);
  }
  vs_ray_tree_free(&t);
  vs_mesh_free(&m);
  vs_mesh_free(&empty);
  vs_store_release(store);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_linear), cmocka_unit_test(test_neutral),  cmocka_unit_test(test_filmic),
    cmocka_unit_test(test_agx),    cmocka_unit_test(test_exposure), cmocka_unit_test(test_odd_light),
    cmocka_unit_test(test_dither),
    cmocka_unit_test(test_exr_round_trip), cmocka_unit_test(test_denoise), cmocka_unit_test(test_gap),
    cmocka_unit_test(test_false_color), cmocka_unit_test(test_ray_tree),
    cmocka_unit_test(test_screen), cmocka_unit_test(test_halves), cmocka_unit_test(test_png),
    cmocka_unit_test(test_ray_box), cmocka_unit_test(test_openness),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
