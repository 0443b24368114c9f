/* Tests photometric files of lamps, and the search for the sun in panoramas. Intensities and symmetries are compared
 * with formulas, and files are damaged at random. The test paints suns into skies and searches for them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "geometry/light/ies.h"
#include "geometry/light/panorama_sun.h"
#include "geometry/light/radiance.h"

static const double pi = 3.14159265358979323846;
static const char asymmetric[] = "IESNA91\r\n[TEST] x\r\nTILT=NONE\r\n1,1000,2,3,5,1,1,0,0,0\r\n1 1 20\r\n0 45 90\r\n"
                                 "0 90 180 270 360\r\n500 400 0\r\n500 250 0\r\n500 100 0\r\n500 50 0\r\n500 400 0\r\n";

static bool reads(vs_store *s, const char *text, vs_ies *out, vs_error *e) {
  return vs_ies_read(s, "a.ies", text, strlen(text), out, e);
}
static void near_to(double x, double expected, double by) {
  if (!(fabs(x - expected) <= by)) fail_msg("%.12g, not %.12g", x, expected);
}

static void test_intensities(void **state) {
  (void)state;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_ies x;
  vs_error e = { 0 };
  assert_true(reads(s, asymmetric, &x, &e));
  near_to(vs_ies_candelas(&x, 0, 77), 1000, 1e-9);
  near_to(vs_ies_candelas(&x, 45, 90), 500, 1e-9);
  near_to(vs_ies_candelas(&x, 45, -90), 100, 1e-9);
  near_to(vs_ies_candelas(&x, 22.5, 45), (1000 + 650) / 2., 1e-9);
  near_to(vs_ies_candelas(&x, 91, 0), 0, 0);
  near_to(x.most, 1000, 0);
  vs_ies_free(&x);
  /* three lamps with data for a quarter turn, for a half turn that begins at 90 degrees, and for one direction that
   * applies to all directions */
  assert_true(reads(s, "TILT=NONE\n1 1 1 2 2 1 1 0 0 0 1 1 1 0 90 0 90 8 6 8 2", &x, &e));
  near_to(vs_ies_candelas(&x, 90, 135), 4, 1e-9);
  near_to(vs_ies_candelas(&x, 90, 180), 6, 1e-9);
  near_to(vs_ies_candelas(&x, 90, 270), 2, 1e-9);
  vs_ies_free(&x);
  assert_true(reads(s, "TILT=NONE\n1 1 1 1 3 1 1 0 0 0 1 1 1 90 90 180 270 8 6 4", &x, &e));
  near_to(vs_ies_candelas(&x, 90, 0), 6, 1e-9);
  near_to(vs_ies_candelas(&x, 90, 45), 7, 1e-9);
  near_to(vs_ies_candelas(&x, 90, 315), 5, 1e-9);
  vs_ies_free(&x);
  assert_true(reads(s, "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0 0.5 1 1 0 180 0 20 20", &x, &e));
  near_to(vs_ies_candelas(&x, 117, 200), 10, 1e-9);
  vs_ies_free(&x);
  vs_store_release(s);
}

static void test_wrong_files(void **state) {
  (void)state;
  static const struct { const char *text, *said; } rows[] = {
    { "", "a.ies:0: this is no IES file: it has no line TILT=NONE" },
    { "IESNA91\nTILT=INCLUDE\n", "a.ies:2: only IES files with TILT=NONE can be read" },
    { "TILT=NONE\n", "a.ies:2: the file ends before the number of lamps, a number from 1 to 1e+06" },
    { "TILT=NONE\n1 1 1 2 1 3 1", "a.ies:2: only photometry of type C (the number 1) can be read" },
    { "TILT=NONE\n1 1 1 2.5 1 1 1", "a.ies:2: a count must be a whole number" },
    { "TILT=NONE\n1 1 nan", "a.ies:2: the multiplier of candelas must be a number from 0 to 1e+06, got nan" },
    { "TILT=NONE\n1 1 1 2000 2000 1 1 0 0 0\n1 1 1\n0", "a.ies:3: the file has fewer numbers than its angles need" },
    { "TILT=NONE\n1 1 1 2 1 1 1 0 0 0\n1 1 1\n9 3\n0\n1 1", "a.ies:4: the angles must ascend" },
    { "TILT=NONE\n1 1 1 2 2 1 1 0 0 0\n1 1 1\n0 90\n0 45\n1 1 1 1",
      "a.ies:5: the horizontal angles must go from 0 to 0, 90, 180 or 360, or from 90 to 270" },
    { "TILT=NONE\n1 1 1 2 1 1 1 0 0 0\n1 1 1\n0 90\n0\n1 -1",
      "a.ies:6: an intensity in candelas must be a number from 0 to 1e+09, got -1" },
    { "TILT=NONE\n1 1 1 2 1 1 1 0 0 0\n1 1 1\n0 90\n0\n0 0", "a.ies:6: the lamp gives no light" },
  };
  vs_store *s = vs_store_new(NULL, NULL);
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    vs_ies x;
    vs_error e = { 0 };
    assert_false(reads(s, rows[i].text, &x, &e));
    assert_string_equal(e.message, rows[i].said);
  }
  /* changes, removes or cuts off random bytes: reading must return an error or a lamp, and lose no memory */
  uint32_t seed = 1;
  for (int i = 0; i < 20000; i++) {
    char text[sizeof asymmetric];
    vs_ies x;
    vs_error e = { 0 };
    memcpy(text, asymmetric, sizeof text);
    for (int k = 0; k < 3; k++) {
      seed = seed * 1664525u + 1013904223u;
      text[(seed >> 8) % (sizeof text - 1)] = "0123456789 -.,eE\n\0x9"[(seed >> 24) % 20];
    }
    if (vs_ies_read(s, "a.ies", text, (seed >> 4) % sizeof text, &x, &e)) {
      double c = vs_ies_candelas(&x, (seed >> 8) % 181, (seed >> 16) % 360);
      assert_true(c >= 0 && c <= x.most * 1.000001);
      vs_ies_free(&x);
    } else assert_true(e.message[0] != 0);
  }
  assert_int_equal(vs_store_bytes(s), 0);
  vs_store_release(s);
}

/* ---- suns in panoramas ---- */

static vs_vec3 towards(double azimuth, double altitude) {
  double a = azimuth * pi / 180, h = altitude * pi / 180;
  return vs_v3(sin(a) * cos(h), cos(a) * cos(h), sin(h));
}

/* Paints a sky that is bluer at the top, with a solar disc of half a degree in it. Each pixel is the mean of SUB x SUB
 * sample points. */
static void paint(vs_exr *x, vs_vec3 sun, double bright) {
  enum { SUB = 8 };
  static const char *const names[] = { "R", "G", "B" };
  const double around[] = { 0.3, 0.5, 0.9 }, disc[] = { 1, 0.9, 0.7 };
  float *planes[3];
  for (int k = 0; k < 3; k++) assert_non_null(planes[k] = vs_exr_add(x, names[k], VS_EXR_FLOAT, NULL));
  for (uint32_t y = 0; y < x->rows; y++)
    for (uint32_t i = 0; i < x->columns; i++) {
      double up = pi / 2 - (y + 0.5) * pi / x->rows, east = ((i + 0.5) / x->columns - 0.5) * 2 * pi, share = 0;
      vs_vec3 middle = vs_v3(cos(up) * sin(east), cos(up) * cos(east), sin(up));
      bool near = vs_v3_dot(middle, sun) > cos(2 * pi / 180);
      for (int v = 0; near && v < SUB * SUB; v++) {
        double h = up + ((v / SUB + 0.5) / SUB - 0.5) * pi / x->rows,
               a = east + ((v % SUB + 0.5) / SUB - 0.5) * 2 * pi / x->columns;
        share += vs_v3_dot(vs_v3(cos(h) * sin(a), cos(h) * cos(a), sin(h)), sun) > cos(0.266 * pi / 180);
      }
      share /= SUB * SUB;
      for (int k = 0; k < 3; k++)
        planes[k][(size_t)y * x->columns + i] = (float)(around[k] * (1 - 0.4 * sin(up)) + share * bright * disc[k]);
    }
}

static void test_suns(void **state) {
  (void)state;
  static const double places[][2] = { { 0, 30 }, { 143, 52.3 }, { 180, 10 }, { 359.9, 75 }, { 250, 3 } };
  for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
    vs_store *s = vs_store_new(NULL, NULL);
    vs_exr x = { .store = s, .columns = 2048, .rows = 1024 };
    vs_panorama_sun sun;
    vs_vec3 where = towards(places[i][0], places[i][1]);
    double bright = 40000, angle = 2 * pi * (1 - cos(0.266 * pi / 180));
    paint(&x, where, bright);
    assert_true(vs_panorama_take_sun(&x, &sun));
    /* the direction found is within 0.1 degrees of the painted sun; half a degree would be sufficient */
    assert_true(vs_v3_dot(sun.direction, where) > cos(0.1 * pi / 180));
    near_to(sun.light.x, bright * angle, 0.02 * bright * angle);
    near_to(sun.light.y, 0.9 * bright * angle, 0.02 * bright * angle);
    near_to(sun.light.z, 0.7 * bright * angle, 0.02 * bright * angle);
    float most = 0;
    for (size_t k = 0; k < (size_t)x.columns * x.rows; k++) most = fmaxf(most, vs_exr_find(&x, "B")[k]);
    assert_true(most < 1.3); /* after the sun's removal, no pixel is much brighter than the sky, whose brightness is
                              * about 0.9 */
    assert_false(vs_panorama_take_sun(&x, &sun));
    vs_exr_free(&x);
    assert_int_equal(vs_store_bytes(s), 0);
    vs_store_release(s);
  }
}

/* Tests a Radiance file (.hdr) with run-length coded rows and with plain rows. A file that is cut off at any byte must
 * be an error. */
static void test_radiance(void **state) {
  (void)state;
  unsigned char file[256];
  size_t size = (size_t)snprintf((char *)file, sizeof file, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n");
  static const unsigned char row[] = { 2, 2, 0, 8, 136, 128, 136, 64, 2, 32, 32, 134, 0, 136, 136 };
  memcpy(file + size, row, sizeof row), size += sizeof row;
  for (int i = 0; i < 8; i++) memcpy(file + size, (unsigned char[]){ 10, 20, 30, 136 }, 4), size += 4;
  vs_store *s = vs_store_new(NULL, NULL);
  vs_exr x;
  vs_error e = { 0 };
  assert_true(vs_radiance_read(s, &(vs_file_bytes){ "a.hdr", file, size }, &x, &e));
  assert_int_equal(x.columns, 8);
  near_to(vs_exr_find(&x, "R")[3], 128.5, 0);
  near_to(vs_exr_find(&x, "G")[0], 64.5, 0);
  near_to(vs_exr_find(&x, "B")[8], 30.5, 0);
  vs_exr_free(&x);
  for (size_t i = 0; i < size; i++) {
    assert_false(vs_radiance_read(s, &(vs_file_bytes){ "a.hdr", file, i }, &x, &e));
    assert_true(x.count == 0 || x.store != NULL);
  }
  assert_int_equal(vs_store_bytes(s), 0);
  vs_store_release(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_intensities), cmocka_unit_test(test_wrong_files), cmocka_unit_test(test_suns),
    cmocka_unit_test(test_radiance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
