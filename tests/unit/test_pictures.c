/* Owns the tests of geometry/pictures: tone curves beside the published values, exposure by the histogram. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "geometry/pictures/tone.h"

/* The screen's numbers of one colour, at a fixed exposure. */
static void screen(vs_tone_curve curve, double stops, float r, float g, float b, unsigned char rgb[3]) {
  vs_light light = { &r, &g, &b, 1 };
  vs_tone tone = { .curve = curve, .fixed = true, .stops = stops };
  assert_true(vs_tone_apply(&light, &tone, rgb) == stops);
}

static int grey(vs_tone_curve curve, double stops, float x) {
  unsigned char rgb[3];
  screen(curve, stops, x, x, x, rgb);
  assert_in_range(rgb[0], rgb[1] - 1 > 0 ? rgb[1] - 1 : 0, rgb[1] + 1);
  return rgb[1];
}

/* IEC 61966-2-1: middle grey is 118 (0.4613 of 255), .0031308 the end of the straight part. */
static void test_linear(void **state) {
  (void)state;
  assert_int_equal(grey(VS_TONE_LINEAR, 0, 0.18f), 118);
  assert_int_equal(grey(VS_TONE_LINEAR, 0, 0.0031308f), 10);
  assert_int_equal(grey(VS_TONE_LINEAR, 1, 0.5f), 255);
  assert_int_equal(grey(VS_TONE_LINEAR, 0, 7), 255);
  assert_int_equal(grey(VS_TONE_LINEAR, 0, -7), 0);
}

/* Khronos: what is below .76 stays but for .04, the reflection of dielectrics; a peak of 1.72 behind it is drawn in to
 * 1 - .24^2 / (1.72 + .24 - .76) = .952. */
static void test_neutral(void **state) {
  (void)state;
  unsigned char rgb[3];
  assert_int_equal(grey(VS_TONE_NEUTRAL, 0, 0.54f), 188); /* .5 */
  assert_int_equal(grey(VS_TONE_NEUTRAL, 0, 1.76f), 250);
  screen(VS_TONE_NEUTRAL, 0, 0.5f, 0.08f, 0.08f, rgb);
  assert_int_equal(rgb[0], 181); /* .46 */
  assert_int_equal(rgb[1], 56);  /* .04 */
  assert_in_range(grey(VS_TONE_NEUTRAL, 0, 1000), 254, 255);
}

/* Hable's constants at 2 * .18 and white 11.2. */
static void test_filmic(void **state) {
  (void)state;
  double x = 0.36, w = 11.2;
  double fx = (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
  double fw = (w * (0.15 * w + 0.05) + 0.004) / (w * (0.15 * w + 0.5) + 0.06) - 0.02 / 0.3;
  assert_int_equal(grey(VS_TONE_FILMIC, 0, 0.18f), (int)lround(255 * (1.055 * pow(fx / fw, 1 / 2.4) - 0.055)));
  assert_int_equal(grey(VS_TONE_FILMIC, 0, 5.6f), 255);
  assert_int_equal(grey(VS_TONE_FILMIC, 0, 0), 0);
}

/* AgX has ten stops below middle grey and 6.5 above: what is outside is black and white. */
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

/* A gain of light is found by the exposure, whatever the curve: the picture is the same. */
static void test_exposure(void **state) {
  (void)state;
  enum { COUNT = 1000 };
  float at[COUNT], brighter[COUNT];
  unsigned char a[3 * COUNT], b[3 * COUNT];
  for (int i = 0; i < COUNT; i++) at[i] = 0.02f + 0.001f * (float)i, brighter[i] = 8 * at[i];
  for (int curve = VS_TONE_NEUTRAL; curve <= VS_TONE_LINEAR; curve++) {
    vs_light one = { at, at, at, COUNT }, two = { brighter, brighter, brighter, COUNT };
    vs_tone tone = { .curve = (vs_tone_curve)curve, .stops = -0.5 };
    double first = vs_tone_apply(&one, &tone, a), second = vs_tone_apply(&two, &tone, b);
    assert_true(fabs(first - second - 3) < 1e-9);
    assert_memory_equal(a, b, sizeof a);
  }
}

/* Nothing, black, numbers that are none. */
static void test_odd_light(void **state) {
  (void)state;
  float at[3] = { NAN, INFINITY, -INFINITY };
  unsigned char rgb[9];
  vs_light odd = { at, at, at, 3 }, none = { at, at, at, 0 };
  for (int curve = VS_TONE_NEUTRAL; curve <= VS_TONE_LINEAR; curve++) {
    vs_tone tone = { .curve = (vs_tone_curve)curve };
    assert_true(vs_tone_apply(&none, &tone, rgb) == 0);
    assert_true(vs_tone_apply(&odd, &tone, rgb) == 0);
    assert_in_range(rgb[0], 0, 2);
    assert_in_range(rgb[3], 250, 255);
    assert_in_range(rgb[6], 0, 2);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_linear), cmocka_unit_test(test_neutral),  cmocka_unit_test(test_filmic),
    cmocka_unit_test(test_agx),    cmocka_unit_test(test_exposure), cmocka_unit_test(test_odd_light),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
