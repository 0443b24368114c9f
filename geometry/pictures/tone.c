/* Computes exposure and tone curves. Each formula is published; its source is named beside it. */
#include "geometry/pictures/tone.h"

#include <math.h>

#include "geometry/files/raster.h"

/* ---- exposure ---- */

/* A histogram of luminance by its logarithm to base 2, in stops (factors of two). BINS_A_STOP: bins for each stop;
 * LEAST_STOP: lowest stop; STOPS: number of stops. */
enum { BINS_A_STOP = 16, LEAST_STOP = -24, STOPS = 48, BINS = STOPS * BINS_A_STOP };

static double luminance(const vs_light *l, size_t i) {
  return vs_raster_share[0] * (double)l->red[i] + vs_raster_share[1] * (double)l->green[i] +
         vs_raster_share[2] * (double)l->blue[i];
}

/* Returns the logarithm to base 2 of the luminance below which `count` of the pixels in the histogram lie. */
static double quantile(const size_t bins[BINS], double count) {
  size_t sum = 0;
  int i = 0;
  while (i < BINS - 1 && (double)(sum += bins[i]) <= count) i++;
  return LEAST_STOP + (i + 0.5) / BINS_A_STOP;
}

/* For each tone curve, the value to which exposure scales the 99th percentile of the picture's light; the curve maps it
 * to slightly less than white. */
static const double bright_end[] = {
    [VS_TONE_NEUTRAL] = 1.1, [VS_TONE_AGX] = 3.8, [VS_TONE_FILMIC] = 4, [VS_TONE_LINEAR] = 0.9 };

/* Returns by how many stops (factors of two) a picture with this mean luminance should look darker than a picture of
 * the day: 0 from 3 cd/m2 (Krawczyk, Myszkowski and Seidel, SCCG 2005). A mean of 1 is 10,000 cd/m2. */
static double night_stops(double mean) {
  const double least = 3;
  double y = 1e4 * mean, key = 1.03 - 2 / (2 + log10(fmin(y, least) + 1));
  return log2(key / (1.03 - 2 / (2 + log10(least + 1))));
}

double vs_tone_exposure(const vs_light *light, vs_tone_curve curve) {
  size_t bins[BINS] = { 0 }, count = 0;
  double sum = 0;
  for (size_t i = 0; i < vs_light_pixels(light); i++) {
    double l = luminance(light, i);
    if (!(l > 0) || !isfinite(l)) continue;
    double stop = log2(l), bin = floor((stop - LEAST_STOP) * BINS_A_STOP);
    bins[bin < 0 ? 0 : bin >= BINS ? BINS - 1 : (size_t)bin]++;
    sum += stop;
    count++;
  }
  if (!count) return 0;
  /* By Reinhard's method, the grey that the average becomes is a quarter of .18 to four times .18, by its place in the
   * range. Here it is never more than half a stop below .18. */
  double least = quantile(bins, 0.01 * (double)count), most = quantile(bins, 0.99 * (double)count);
  double average = fmin(fmax(sum / (double)count, least), most), range = most - least;
  double place = range > 0 ? (2 * average - least - most) / range : 0; /* position of the average in the range of
                                                                        * luminances, from -1 at the dark end to 1 at
                                                                        * the bright end */
  double key = log2(0.18) + 2 * fmax(place, -0.25);
  /* white: exposure, in stops, with which the brightest part of the picture just becomes white. By Reinhard's key
   * alone, a white building in the sun would be grey. */
  double dark = night_stops(exp2(average)), white = log2(bright_end[curve]) - most, lit = key + dark - average;
  /* night: weight, from 0 to 1, of the rule for night, by which lit parts stay below white. It grows over one stop, so
   * that the exposure has no jump. */
  double night = fmin(1, -dark);
  return (1 - night) * fmax(lit, white) + night * fmin(lit, white);
}

/* ---- tone curves: from linear light to linear light of a screen, 0 to 1 ---- */

/* lesser and greater are faster than fmin and fmax, which check for NaN and are function calls. */
static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double greater(double a, double b) { return a > b ? a : b; }

static inline double cut(double x) { return x > 0 ? (x < 1 ? x : 1) : 0; }

static void linear(const double in[3], double out[3]) {
  for (int k = 0; k < 3; k++) out[k] = cut(in[k]);
}

/* Khronos PBR Neutral Tone Mapper (2024), https://github.com/KhronosGroup/ToneMapping. Light that surfaces reflect
 * keeps its colour. Brighter light is compressed below white and loses its colour. */
static void neutral(const double in[3], double out[3]) {
  const double start = 0.8 - 0.04, desaturation = 0.15;
  double least = greater(lesser(in[0], lesser(in[1], in[2])), 0);
  double offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
  double peak = greater(in[0], greater(in[1], in[2])) - offset;
  double d = 1 - start, drawn = peak < start ? peak : 1 - d * d / (peak + d - start);
  double pale = peak < start ? 0 : 1 - 1 / (desaturation * (peak - drawn) + 1);
  double gain = peak < start ? 1 : drawn / peak;
  for (int k = 0; k < 3; k++) {
    double x = (in[k] - offset) * gain;
    out[k] = cut(x + pale * (drawn - x));
  }
}

/* Filmic curve of John Hable, http://filmicworlds.com/blog/filmic-tonemapping-operators/. a: shoulder strength; b,
 * c: strength and angle of the linear part; d, e, f: the toe. The input 11.2 becomes white; the caller doubles the
 * light. */
static double hable(double x) {
  const double a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
  return (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f;
}

static void filmic(const double in[3], double out[3]) {
  for (int k = 0; k < 3; k++) out[k] = cut(hable(2 * fmax(in[k], 0)) / hable(11.2));
}

/* The sigmoid of AgX, over its range of 16.5 stops, as a polynomial:
 * https://iolite-engine.com/blog_posts/minimal_agx_implementation */
static double sigmoid(double x) {
  double x2 = x * x, x4 = x2 * x2;
  return 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
}

/* The tone curve AgX: a matrix mixes the colours, the sigmoid is applied to each colour, and the inverse matrix
 * separates the colours again. The contrast, a power of 1.35, is that of the look 'punchy'. */
static void agx(const double in[3], double out[3]) {
  static const double inset[3][3] = {
      { 0.842479062253094, 0.0784335999999992, 0.0792237451477643 },
      { 0.0423282422610123, 0.878468636469772, 0.0791661274605434 },
      { 0.0423756549057051, 0.0784336, 0.879142973793104 } };
  static const double outset[3][3] = {
      { 1.19687900512017, -0.0980208811401368, -0.0990297440797205 },
      { -0.0528968517574562, 1.15190312990417, -0.0989611768448433 },
      { -0.0529716355144438, -0.0980434501171241, 1.15107367264116 } };
  const double least = -12.47393, most = 4.026069;
  double v[3];
  for (int k = 0; k < 3; k++) {
    double x = inset[k][0] * in[0] + inset[k][1] * in[1] + inset[k][2] * in[2];
    double stop = fmin(fmax(log2(fmax(x, 1e-10)), least), most);
    v[k] = pow(cut(sigmoid((stop - least) / (most - least))), 1.35);
  }
  for (int k = 0; k < 3; k++) {
    double x = outset[k][0] * v[0] + outset[k][1] * v[1] + outset[k][2] * v[2];
    out[k] = pow(cut(x), 2.2);
  }
}

/* ---- conversion of a picture ---- */

/* A table that converts light to sRGB bytes. `at[i]`: least light for which byte i is the nearest. `first[k]`: byte
 * with which the search begins for light in part k of COARSE equal parts of 0 to 1. */
enum { COARSE = 4096 };
typedef struct { double at[256]; unsigned char first[COARSE + 1]; } screen_steps;

static void screen_prepare(screen_steps *s) {
  int b = 0;
  s->at[0] = 0;
  for (int i = 1; i < 256; i++) {
    double v = (i - 0.5) / 255;
    s->at[i] = v <= 12.92 * 0.0031308 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
  }
  for (int i = 0; i <= COARSE; i++) {
    while (b < 255 && s->at[b + 1] <= (double)i / COARSE) b++;
    s->first[i] = (unsigned char)b;
  }
}

static unsigned char screen(const screen_steps *s, double x) { /* returns the sRGB byte of the linear light x, 0 to 1 */
  unsigned b = s->first[(size_t)(x * COARSE)];
  while (b < 255 && s->at[b + 1] <= x) b++;
  return (unsigned char)b;
}

/* Returns the element, from 0 to 63, of B. E. Bayer's 8 by 8 dither matrix for a pixel. Each number occurs once in the
 * matrix. */
static unsigned bayer(uint32_t column, uint32_t row) {
  unsigned n = 0, mixed = column ^ row;
  for (unsigned bit = 0; bit < 3; bit++)
    n |= (row >> bit & 1) << (4 - 2 * bit) | (mixed >> bit & 1) << (5 - 2 * bit);
  return n;
}

/* Returns the sRGB byte of the linear light x, 0 to 1, by ordered dithering. Pixels of equal light are rounded up or
 * down, so that their mean is about exact. `n`: element of the dither matrix for the pixel. */
static unsigned char dithered(const screen_steps *s, double x, unsigned n) {
  unsigned b = screen(s, x);
  if (b == 0 || b == 255) return (unsigned char)b;
  /* above: difference between x and the middle of byte b's range, in units of this range: -0.5 to 0.5 */
  double above = (x - s->at[b]) / (s->at[b + 1] - s->at[b]) - 0.5, threshold = (n + 0.5) / 64;
  return (unsigned char)(above > 0 ? b + (above > threshold) : b - (-above > threshold));
}

double vs_tone_apply(const vs_light *light, const vs_tone *tone, unsigned char *rgb) {
  static void (*const curves[])(const double in[3], double out[3]) = {
      [VS_TONE_NEUTRAL] = neutral, [VS_TONE_AGX] = agx, [VS_TONE_FILMIC] = filmic, [VS_TONE_LINEAR] = linear };
  double stops = tone->stops + (tone->fixed ? 0 : vs_tone_exposure(light, tone->curve)), gain = exp2(stops);
  screen_steps steps;
  VS_ASSERT((size_t)tone->curve <= VS_TONE_LINEAR);
  screen_prepare(&steps);
  for (size_t i = 0; i < vs_light_pixels(light); i++) {
    const float from[3] = { light->red[i], light->green[i], light->blue[i] };
    double in[3], out[3];
    for (int k = 0; k < 3; k++) in[k] = isnan(from[k]) ? 0 : lesser(greater((double)from[k], 0), 1e6) * gain;
    curves[tone->curve](in, out);
    unsigned n = bayer(tone->left + (uint32_t)(i % light->columns), tone->top + (uint32_t)(i / light->columns));
    for (int k = 0; k < 3; k++)
      rgb[3 * i + (size_t)k] = tone->dither ? dithered(&steps, cut(out[k]), n) : screen(&steps, cut(out[k]));
  }
  return stops;
}
