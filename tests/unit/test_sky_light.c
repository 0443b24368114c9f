/* Tests the physical skies. Luminance and colour are compared with the paper's formulas, evaluated by another program
 * (numpy, in double precision). Daylight is compared with the clear skies of the Illuminating Engineering Society, the
 * overcast sky with the formulas of Moon and Spencer and of Krochmann, and twilight with the definitions of
 * astronomers. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "geometry/sky_light.h"

static const double degree = 3.14159265358979323846 / 180;

static vs_vec3 towards(double zenith, double azimuth) {
  return vs_v3(sin(zenith * degree) * cos(azimuth * degree), sin(zenith * degree) * sin(azimuth * degree),
               cos(zenith * degree));
}
static double luminance(vs_vec3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }
static void near_to(double x, double expected, double share) {
  if (!(fabs(x - expected) <= share * fabs(expected))) fail_msg("%.12g, not %.12g", x, expected);
}

static void test_formulas(void **state) {
  static const struct { double turbidity, altitude, zenith, azimuth, expected[3]; } rows[] = {
    { 2, 45, 0, 0, { 4469.641885636957, 0.24095190378430026, 0.24372211880057187 } },
    { 2, 45, 30, 0, { 11298.343311893528, 0.2609783942574678, 0.2660399211180343 } },
    { 2, 45, 60, 90, { 6821.127934858814, 0.24068468075020089, 0.24779586770339085 } },
    { 2, 45, 80, 180, { 11860.877728449106, 0.26087202918533153, 0.2757731239009715 } },
    { 3, 60, 0, 0, { 10413.086912171777, 0.2534341841195564, 0.25979252200500785 } },
    { 3, 60, 30, 0, { 26288.012990661064, 0.2786594070484509, 0.2917569830402706 } },
    { 3, 60, 60, 90, { 8003.709393203532, 0.2513339668811019, 0.2638791803484374 } },
    { 6, 10, 0, 0, { 3800.592436115032, 0.28016004004917044, 0.30086214853646176 } },
    { 6, 10, 60, 90, { 3870.5455332546367, 0.309843174933678, 0.33389811675972125 } },
    { 8, 30, 30, 0, { 19638.542474953305, 0.3028067917323476, 0.31159778836875424 } },
    { 8, 30, 80, 180, { 6393.010275863902, 0.3495301972830459, 0.35534960372108626 } },
  };
  (void)state;
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    vs_sky_light s = vs_sky_light_of(rows[i].turbidity, towards(90 - rows[i].altitude, 0));
    vs_vec3 got = vs_sky_light_xyy(&s, towards(rows[i].zenith, rows[i].azimuth));
    near_to(got.x, rows[i].expected[0], 1e-7);
    near_to(got.y, rows[i].expected[1], 1e-7);
    near_to(got.z, rows[i].expected[2], 1e-7);
  }
}

/* For a clear day, the Society's Lighting Handbook (8th edition) gives 127.5 klx exp(-0.21 / sin a) for a surface that
 * faces the sun at altitude a. A turbidity of 2 gives nearly this value. For the sky on a horizontal surface it gives
 * 0.8 + 15.5 sqrt(sin a) klx, which the model is known to exceed (G. Zotti, A. Wilkie and W. Purgathofer, A Critical
 * Review of the Preetham Skylight Model, WSCG 2007). */
static void test_daylight(void **state) {
  (void)state;
  for (double altitude = 15; altitude <= 75; altitude += 10) {
    double high = sin(altitude * degree);
    near_to(luminance(vs_sky_light_sun(2, altitude)), 127500 * exp(-0.21 / high), 0.06);
    vs_sky_light s = vs_sky_light_of(2, towards(90 - altitude, 30));
    double share = luminance(vs_sky_light_level(&s)) / (800 + 15500 * sqrt(high));
    assert_true(share > 1 && share < 2.5);
  }
}

static void test_colours(void **state) {
  (void)state;
  vs_sky_light clear = vs_sky_light_of(2, towards(45, 0)), hazy = vs_sky_light_of(8, towards(45, 0));
  vs_vec3 blue = vs_sky_light_at(&clear, towards(30, 180)), pale = vs_sky_light_at(&hazy, towards(30, 180));
  assert_true(blue.z / blue.x > 2.5 && pale.z / pale.x < 0.8 * blue.z / blue.x);
  near_to(luminance(blue), vs_sky_light_xyy(&clear, towards(30, 180)).x, 1e-3);
  vs_vec3 noon = vs_sky_light_sun(2, 60), evening = vs_sky_light_sun(2, 5);
  assert_true(noon.x / noon.z < 1.35 && evening.x / evening.z > 3);
  assert_true(luminance(vs_sky_light_sun(8, 45)) < 0.6 * luminance(vs_sky_light_sun(2, 45)));
}

/* In the overcast sky of P. Moon and D. E. Spencer (1942), the first standard of the CIE, the luminance at the height h
 * is (1 + 2 sin h) / 3 of the zenith's. Type 1 of ISO 15469 differs by at most a tenth of the zenith's luminance. */
static void test_overcast(void **state) {
  (void)state;
  for (double altitude = 0; altitude <= 90; altitude += 15) {
    vs_sky_light s = vs_sky_light_overcast(towards(90 - altitude, 40));
    double zenith = luminance(vs_sky_light_at(&s, towards(0, 0)));
    near_to(luminance(vs_sky_light_level(&s)), 300 + 21000 * sin(altitude * degree), 1e-6);
    for (double h = 0; h <= 90; h += 10) {
      double share = luminance(vs_sky_light_at(&s, towards(90 - h, 13 * h))) / zenith;
      assert_true(fabs(share - (1 + 2 * sin(h * degree)) / 3) < 0.1);
    }
  }
}

/* Daylight is 3.4 lx when civil twilight ends, 0.008 lx when nautical twilight ends, and 760 lx at sunrise (US Naval
 * Observatory, Circular 171). */
static void test_twilight(void **state) {
  (void)state;
  near_to(vs_sky_light_twilight(-6) * 758.6, 3.4, 0.03);
  near_to(vs_sky_light_twilight(-12) * 758.6, 0.008, 0.05);
  for (double a = 10; a > -30; a -= 0.125) {
    double here = vs_sky_light_twilight(a), lower = vs_sky_light_twilight(a - 0.125);
    assert_true(here <= 1 && lower > 0 && lower <= here && lower > 0.8 * here);
    if (a <= -18.125) assert_true(lower == here);
    vs_sky_light s = vs_sky_light_of(3, towards(90 - a, 10)), t = vs_sky_light_of(3, towards(90 - a - 0.125, 10));
    double level = luminance(vs_sky_light_level(&s));
    if (a <= -6) near_to(level, 758.6 * here, 1e-3);
    if (a < -0.125) assert_true(level <= luminance(vs_sky_light_level(&t)) * 1.001);
  }
}

/* At night the zenith is dark and blue, the horizon bright and yellowish. The moon gives light while it is up. */
static void test_night(void **state) {
  (void)state;
  vs_scene scene = { .sky_kind = VS_SKY_NIGHT };
  vs_sky_light s = vs_sky_light_of_scene(&scene, towards(50, 0));
  vs_vec3 zenith = vs_sky_light_at(&s, towards(0, 0)), horizon = vs_sky_light_at(&s, towards(90, 0));
  near_to(luminance(vs_sky_light_level(&s)), 0.5, 1e-6);
  assert_true(luminance(horizon) > 3 * luminance(zenith));
  assert_true(zenith.z > 1.5 * zenith.x && horizon.x > horizon.z);
  near_to(luminance(vs_sky_light_sun_of_scene(&scene, towards(50, 0))), 0.25, 0.01);
  assert_true(luminance(vs_sky_light_sun_of_scene(&scene, towards(91, 0))) == 0);
  scene.no_sun = true;
  assert_true(luminance(vs_sky_light_sun_of_scene(&scene, towards(50, 0))) == 0);
}

/* Tests that all values are finite: below the horizon, at the limits of the parameters, and straight up and down. The
 * night has no sun. */
static void test_limits(void **state) {
  (void)state;
  assert_true(luminance(vs_sky_light_sun(3, 0)) == 0 && luminance(vs_sky_light_sun(3, -20)) == 0);
  for (double t = VS_TURBIDITY_LEAST; t <= VS_TURBIDITY_MOST; t += 1)
    for (double altitude = -90; altitude <= 90; altitude += 5) {
      vs_sky_light s = vs_sky_light_of(t, towards(90 - altitude, 77));
      assert_true(s.sun.z >= 0);
      assert_true(luminance(vs_sky_light_level(&s)) > 100 * vs_sky_light_twilight(altitude));
      for (double zenith = 0; zenith <= 180; zenith += 10) {
        vs_vec3 c = vs_sky_light_at(&s, towards(zenith, 3 * zenith));
        assert_true(isfinite(luminance(c)) && luminance(c) > 0 && luminance(c) < 2e5);
      }
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_formulas), cmocka_unit_test(test_daylight), cmocka_unit_test(test_colours),
    cmocka_unit_test(test_overcast), cmocka_unit_test(test_twilight), cmocka_unit_test(test_night),
    cmocka_unit_test(test_limits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
