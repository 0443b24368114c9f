/* Computes the light of the sky and the sun: clear skies with the polynomials and tables of Preetham, Shirley and Smits
 * (1999), overcast skies by ISO 15469, twilight by P. M. Janiczek and J. A. DeYoung, U.S. Naval Observatory Circular
 * 171 (1987). */
#include "geometry/sky_light.h"

#include <math.h>
#include <stddef.h>

static const double pi = 3.14159265358979323846;

static vs_vec3 linear_srgb(double x, double y, double z) { /* converts CIE XYZ to linear sRGB by IEC 61966-2-1 */
  return vs_v3(fmax(0, 3.2406 * x - 1.5372 * y - 0.4986 * z), fmax(0, -0.9689 * x + 1.8758 * y + 0.0415 * z),
               fmax(0, 0.0557 * x - 0.2040 * y + 1.0570 * z));
}

/* ---- the sky: appendix A.2 of the paper ---- */

static double distribution(const vs_sky_light *s, int i, double cos_zenith, double cos_sun) {
  double gamma = acos(fmax(-1, fmin(1, cos_sun)));
  return (1 + s->of[i].a * exp(s->of[i].b / fmax(cos_zenith, 1e-3))) *
         (1 + s->of[i].c * exp(s->of[i].d * gamma) + s->of[i].e * cos_sun * cos_sun);
}

/* Returns a chromaticity (x or y) of the zenith, from a polynomial with the coefficients k. Its rows belong to the
 * square of the turbidity, the turbidity and 1; its columns to the powers 3 to 0 of the sun's angle from the zenith. */
static double zenith_chromaticity(const double k[3][4], double turbidity, double angle) {
  double sum = 0;
  for (int row = 0; row < 3; row++)
    sum = sum * turbidity + ((k[row][0] * angle + k[row][1]) * angle + k[row][2]) * angle + k[row][3];
  return sum;
}

/* Returns the illuminance of twilight in lx for the sun's altitude in degrees. For each of four ranges of altitude, its
 * logarithm is a polynomial of altitude / 90 degrees (Circular 171). */
static double twilight_illuminance(double altitude) {
  static const struct { double from, of[4]; } ranges[] = {
    { -0.8, { 2.88, 22.26, -207.64, 1034.30 } }, { -5, { 2.88, 21.81, -258.11, -858.36 } },
    { -12, { 2.70, 12.17, -431.69, -1899.83 } }, { -18, { 13.84, 262.72, 1447.42, 2797.93 } },
  };
  size_t i = 0;
  double x = fmax(altitude, -18) / 90;
  while (i < sizeof ranges / sizeof *ranges - 1 && altitude < ranges[i].from) i++;
  const double *k = ranges[i].of;
  return pow(10, ((k[3] * x + k[2]) * x + k[1]) * x + k[0]);
}

double vs_sky_light_twilight(double altitude) {
  return altitude < 0 ? fmin(1, twilight_illuminance(altitude) / twilight_illuminance(0)) : 1;
}

static double altitude_of(vs_vec3 sun) { return asin(fmax(-1, fmin(1, sun.z))) * 180 / pi; }

/* Sets quantity i of the sky (0: Y, 1: x, 2: y). It has the value `zenith` at the zenith, and the gradation 1 + a exp(b
 * / cos theta) at the angle theta from the zenith. */
static void gradation(vs_sky_light *s, int i, double zenith, double a, double b) {
  s->of[i].scale = zenith / (1 + a * exp(b)), s->of[i].a = a, s->of[i].b = b;
}

/* Returns the illuminance of a horizontal surface by the whole sky, in lx. */
static double illuminance_of(const vs_sky_light *s) {
  vs_vec3 c = vs_sky_light_level(s);
  return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

static void set_illuminance(vs_sky_light *s, double illuminance) {
  s->of[0].scale *= illuminance / illuminance_of(s);
}

/* Darkens the sky of sunrise for the sun's altitude in degrees. The model's sunrise is brighter than the measured one.
 * Therefore the sky approaches the measured illuminance gradually, and has it from -6 degrees, the end of civil
 * twilight, downwards. */
static void darken(vs_sky_light *s, double altitude) {
  double excess = twilight_illuminance(0) / illuminance_of(s);
  s->of[0].scale *= vs_sky_light_twilight(altitude) * pow(excess, fmin(1, -altitude / 6));
}

vs_sky_light vs_sky_light_of(double turbidity, vs_vec3 sun) {
  static const double slope[3][5] = { { 0.1787, -0.3554, -0.0227, 0.1206, -0.0670 },
                                      { -0.0193, -0.0665, -0.0004, -0.0641, -0.0033 },
                                      { -0.0167, -0.0950, -0.0079, -0.0441, -0.0109 } };
  static const double least[3][5] = { { -1.4630, 0.4275, 5.3251, -2.5771, 0.3703 },
                                      { -0.2592, 0.0008, 0.2125, -0.8989, 0.0452 },
                                      { -0.2608, 0.0092, 0.2102, -1.6537, 0.0529 } };
  static const double x_zenith[3][4] = { { 0.00166, -0.00375, 0.00209, 0 },
                                         { -0.02903, 0.06377, -0.03202, 0.00394 },
                                         { 0.11693, -0.21196, 0.06052, 0.25886 } };
  static const double y_zenith[3][4] = { { 0.00275, -0.00610, 0.00317, 0 },
                                         { -0.04214, 0.08970, -0.04153, 0.00516 },
                                         { 0.15346, -0.26756, 0.06670, 0.26688 } };
  double t = turbidity;
  vs_sky_light s = { .sun = sun };
  VS_ASSERT(turbidity >= VS_TURBIDITY_LEAST && turbidity <= VS_TURBIDITY_MOST);
  if (sun.z < 0) s.sun = vs_v3_unit(vs_v3(sun.x, sun.y, 0));
  if (!(vs_v3_length(s.sun) > 0)) s.sun = vs_v3(1, 0, 0); /* a sun straight below has no azimuth; the direction +X is
                                                           * used */
  double angle = acos(fmin(1, s.sun.z)), chi = (4. / 9 - t / 120) * (pi - 2 * angle);
  double zenith[] = { 1000 * ((4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192),
                      zenith_chromaticity(x_zenith, t, angle), zenith_chromaticity(y_zenith, t, angle) };
  for (int i = 0; i < 3; i++) {
    s.of[i].a = slope[i][0] * t + least[i][0], s.of[i].b = slope[i][1] * t + least[i][1];
    s.of[i].c = slope[i][2] * t + least[i][2], s.of[i].d = slope[i][3] * t + least[i][3];
    s.of[i].e = slope[i][4] * t + least[i][4];
    s.of[i].scale = zenith[i] / distribution(&s, i, 1, s.sun.z);
  }
  if (sun.z < 0) darken(&s, altitude_of(sun));
  return s;
}

/* vs_sky_light_overcast uses the gradation of ISO 15469, sky type 1 (a = 4, b = -0.7), the colour of the standard
 * illuminant D65, and the illuminance of J. Krochmann, Lichttechnik 15 (1963). With the sun below the horizon, the
 * illuminance falls as in twilight. */
vs_sky_light vs_sky_light_overcast(vs_vec3 sun) {
  vs_sky_light s = { .sun = vs_v3(0, 0, 1) };
  gradation(&s, 0, 1, 4, -0.7);
  gradation(&s, 1, 0.3127, 0, 0);
  gradation(&s, 2, 0.3290, 0, 0);
  set_illuminance(&s, 300 * vs_sky_light_twilight(altitude_of(sun)) + 21000 * fmax(0, sun.z));
  return s;
}

/* vs_sky_light_night uses the gradation of the clear skies of ISO 15469 (a = -1, b = -0.32). The chromaticities change
 * with it, from a blue zenith to the light of lamps at the horizon. */
vs_sky_light vs_sky_light_night(void) {
  vs_sky_light s = { .sun = vs_v3(0, 0, 1) };
  gradation(&s, 0, 1, -1, -0.32);
  gradation(&s, 1, 0.23, -0.43, -0.32);
  gradation(&s, 2, 0.235, -0.40, -0.32);
  set_illuminance(&s, 0.5);
  return s;
}

vs_sky_light vs_sky_light_of_scene(const vs_scene *scene, vs_vec3 sun) {
  VS_ASSERT(scene->sky_kind != VS_SKY_PLAIN);
  if (scene->sky_kind == VS_SKY_OVERCAST) return vs_sky_light_overcast(sun);
  if (scene->sky_kind == VS_SKY_NIGHT) return vs_sky_light_night();
  return vs_sky_light_of(scene->turbidity, sun);
}

vs_vec3 vs_sky_light_sun_of_scene(const vs_scene *scene, vs_vec3 sun) {
  const vs_vec3 moon = { 0.23, 0.25, 0.31 }; /* illuminance of the full moon in clear air as linear sRGB in lx, together
                                              * 0.25 lx */
  VS_ASSERT(scene->sky_kind != VS_SKY_PLAIN);
  if (scene->no_sun || scene->sky_kind == VS_SKY_OVERCAST) return vs_v3(0, 0, 0);
  if (scene->sky_kind == VS_SKY_NIGHT) return sun.z > 0 ? moon : vs_v3(0, 0, 0);
  return vs_sky_light_sun(scene->turbidity, altitude_of(sun));
}

vs_vec3 vs_sky_light_xyy(const vs_sky_light *s, vs_vec3 d) {
  double v[3];
  VS_ASSERT(fabs(vs_v3_dot(d, d) - 1) < 1e-6);
  for (int i = 0; i < 3; i++) v[i] = s->of[i].scale * distribution(s, i, d.z, vs_v3_dot(d, s->sun));
  return vs_v3(v[0], v[1], v[2]);
}

vs_vec3 vs_sky_light_at(const vs_sky_light *s, vs_vec3 direction) {
  vs_vec3 c = vs_sky_light_xyy(s, direction);
  return linear_srgb(c.x * c.y / c.z, c.x, c.x * (1 - c.y - c.z) / c.z);
}

/* vs_sky_light_level integrates the light over the sky by the midpoint rule, in steps of equal size in azimuth and in
 * sin^2 of the zenith angle. */
vs_vec3 vs_sky_light_level(const vs_sky_light *s) {
  enum { RINGS = 48, SECTORS = 96 };
  vs_vec3 sum = vs_v3(0, 0, 0);
  for (int ring = 0; ring < RINGS; ring++)
    for (int sector = 0; sector < SECTORS; sector++) {
      double across = sqrt((ring + 0.5) / RINGS), azimuth = 2 * pi * (sector + 0.5) / SECTORS;
      vs_vec3 d = vs_v3(across * cos(azimuth), across * sin(azimuth), sqrt(1 - across * across));
      sum = vs_v3_add(sum, vs_sky_light_at(s, d));
    }
  return vs_v3_scale(sum, pi / (RINGS * SECTORS));
}

/* ---- the sun: appendix A.1 of the paper, table 2 ---- */

/* Table of wavelengths: row i is 380 nm + 10 nm * i. Columns: the sun's radiance outside the atmosphere in W/(cm2 um
 * sr), the absorption of ozone and of water in 1/cm, and the CIE 1931 observer. Other gases absorb only above 750
 * nm. */
static const struct { double radiance, ozone, water, x, y, z; } wave[] = {
  { 1655.9, 0, 0, 0.001368, 0.000039, 0.006450 },       { 1623.37, 0, 0, 0.004243, 0.000120, 0.020050 },
  { 2112.75, 0, 0, 0.014310, 0.000396, 0.067850 },      { 2588.82, 0, 0, 0.043510, 0.001210, 0.207400 },
  { 2582.91, 0, 0, 0.134380, 0.004000, 0.645600 },      { 2423.23, 0, 0, 0.283900, 0.011600, 1.385600 },
  { 2676.05, 0, 0, 0.348280, 0.023000, 1.747060 },      { 2965.83, 0.003, 0, 0.336200, 0.038000, 1.772110 },
  { 3054.54, 0.006, 0, 0.290800, 0.060000, 1.669200 },  { 3005.75, 0.009, 0, 0.195360, 0.090980, 1.287640 },
  { 3066.37, 0.014, 0, 0.095640, 0.139020, 0.812950 },  { 2883.04, 0.021, 0, 0.032010, 0.208020, 0.465180 },
  { 2871.21, 0.030, 0, 0.004900, 0.323000, 0.272000 },  { 2782.5, 0.040, 0, 0.009300, 0.503000, 0.158200 },
  { 2710.06, 0.048, 0, 0.063270, 0.710000, 0.078250 },  { 2723.36, 0.063, 0, 0.165500, 0.862000, 0.042160 },
  { 2636.13, 0.075, 0, 0.290400, 0.954000, 0.020300 },  { 2550.38, 0.085, 0, 0.433450, 0.994950, 0.008750 },
  { 2506.02, 0.103, 0, 0.594500, 0.995000, 0.003900 },  { 2531.16, 0.120, 0, 0.762100, 0.952000, 0.002100 },
  { 2535.59, 0.120, 0, 0.916300, 0.870000, 0.001650 },  { 2513.42, 0.115, 0, 1.026300, 0.757000, 0.001100 },
  { 2463.15, 0.125, 0, 1.062200, 0.631000, 0.000800 },  { 2417.32, 0.120, 0, 1.002600, 0.503000, 0.000340 },
  { 2368.53, 0.105, 0, 0.854450, 0.381000, 0.000190 },  { 2321.21, 0.090, 0, 0.642400, 0.265000, 0.000050 },
  { 2282.77, 0.079, 0, 0.447900, 0.175000, 0.000020 },  { 2233.98, 0.067, 0, 0.283500, 0.107000, 0 },
  { 2197.02, 0.057, 0, 0.164900, 0.061000, 0 },         { 2152.67, 0.048, 0, 0.087400, 0.032000, 0 },
  { 2109.79, 0.036, 0, 0.046770, 0.017000, 0 },         { 2072.83, 0.028, 0.016, 0.022700, 0.008210, 0 },
  { 2024.04, 0.023, 0.024, 0.011359, 0.004102, 0 },     { 1987.08, 0.018, 0.0125, 0.005790, 0.002091, 0 },
  { 1942.72, 0.014, 1, 0.002899, 0.001047, 0 },         { 1907.24, 0.011, 0.87, 0.001440, 0.000520, 0 },
  { 1862.89, 0.010, 0.061, 0.000690, 0.000249, 0 },     { 1825.92, 0.009, 0.001, 0.000332, 0.000120, 0 },
};

vs_vec3 vs_sky_light_sun(double turbidity, double altitude) {
  const double disc = 6.807e-5; /* solid angle of the sun in sr: a disc with an apparent radius of 0.2667 degrees */
  const double lumens = 683, ozone_cm = 0.35, water_cm = 2, aerosol = 0.04608 * turbidity - 0.04586;
  double sum[3] = { 0 };
  if (!(altitude > 0)) return vs_v3(0, 0, 0);
  double air = 1 / (sin(altitude * pi / 180) + 0.15 * pow(3.885 + altitude, -1.253)); /* length of the sun's path
                                                                                       * through the air, as a multiple
                                                                                       * of the path from the zenith, by
                                                                                       * Kasten's formula */
  for (size_t i = 0; i < sizeof wave / sizeof *wave; i++) {
    double um = 0.38 + 0.01 * (double)i, wet = wave[i].water * water_cm * air;
    double through = exp(-0.008735 * pow(um, -4.08) * air - aerosol * pow(um, -1.3) * air -
                         wave[i].ozone * ozone_cm * air - 0.2385 * wet / pow(1 + 20.07 * wet, 0.45));
    double w = 1e4 * wave[i].radiance * through * disc * lumens * 0.01; /* illuminance in lx by the wavelengths of this
                                                                         * row, an interval of 0.01 um; the CIE
                                                                         * observer's weights follow */
    sum[0] += w * wave[i].x, sum[1] += w * wave[i].y, sum[2] += w * wave[i].z;
  }
  return linear_srgb(sum[0], sum[1], sum[2]);
}
