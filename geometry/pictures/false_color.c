/* Computes false colours, and draws the legend with its digits. */
#include "geometry/pictures/false_color.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double clamped(double x) { return x > 0 ? (x < 1 ? x : 1) : 0; }

/* ---- colours of numbers ---- */

static int by_value(const void *a, const void *b) {
  float x = *(const float *)a, y = *(const float *)b;
  return (x > y) - (x < y);
}

/* greatest number of pixels, evenly distributed, from which the range of the scale is computed */
enum { SAMPLES = 16384 };

vs_color_scale vs_color_scale_of(const float *at, size_t count, bool logarithmic, const char *unit) {
  vs_color_scale s = { .least = logarithmic ? 0.1 : 0, .most = 1, .logarithmic = logarithmic, .unit = unit };
  float sample[SAMPLES];
  size_t step = count / SAMPLES + 1, n = 0;
  for (size_t i = 0; i < count; i += step)
    if (isfinite(at[i]) && (!logarithmic || at[i] > 0)) sample[n++] = at[i];
  if (n) {
    qsort(sample, n, sizeof *sample, by_value);
    s.least = (double)sample[n / 100], s.most = (double)sample[n - 1 - n / 100];
    if (logarithmic) s.least = fmax(s.least, s.most * 1e-6);
    if (!(s.most > s.least)) s.most = logarithmic ? s.least * 10 : s.least + 1;
  }
  return s;
}

static double share_of(const vs_color_scale *s, double x) {
  if (isnan(x)) return 0;
  if (!s->logarithmic) return clamped((x - s->least) / (s->most - s->least));
  return x > 0 ? clamped(log(x / s->least) / log(s->most / s->least)) : 0;
}

static void palette(double x, unsigned char rgb[3]) {
  static const double fit[3][6] = {
      { 0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943 },
      { 0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604 },
      { 0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973 } };
  for (int k = 0; k < 3; k++) {
    double sum = 0;
    for (int i = 5; i >= 0; i--) sum = sum * x + fit[k][i];
    rgb[k] = (unsigned char)lround(255 * clamped(sum));
  }
}

void vs_false_color(const vs_color_scale *s, double x, unsigned char rgb[3]) {
  double share = share_of(s, x);
  if (s->steps > 1) share = fmin(floor(share * s->steps), s->steps - 1) / (s->steps - 1);
  palette(share, rgb);
}

/* ---- the legend; a letter is five dots wide and seven dots high ---- */

enum { LETTER_WIDE = 5, LETTER_HIGH = 7, ADVANCE = 6, STRIP = 76, BAR = 14, MARGIN = 6 };

static const struct { char letter; unsigned char rows[LETTER_HIGH]; } letters[] = {
    { '0', { 14, 17, 19, 21, 25, 17, 14 } }, { '1', { 4, 12, 4, 4, 4, 4, 14 } }, { '2', { 14, 17, 1, 6, 8, 16, 31 } },
    { '3', { 31, 2, 4, 2, 1, 17, 14 } }, { '4', { 2, 6, 10, 18, 31, 2, 2 } }, { '5', { 31, 16, 30, 1, 1, 17, 14 } },
    { '6', { 6, 8, 16, 30, 17, 17, 14 } }, { '7', { 31, 1, 2, 4, 8, 8, 8 } }, { '8', { 14, 17, 17, 14, 17, 17, 14 } },
    { '9', { 14, 17, 17, 15, 1, 2, 12 } }, { '.', { 0, 0, 0, 0, 0, 12, 12 } }, { '-', { 0, 0, 0, 31, 0, 0, 0 } },
    { 'c', { 0, 0, 14, 16, 16, 17, 14 } }, { 'd', { 1, 1, 13, 19, 17, 17, 15 } }, { '/', { 1, 1, 2, 4, 8, 16, 16 } },
    { 'm', { 0, 0, 26, 21, 21, 21, 21 } }, { 'h', { 16, 16, 22, 25, 17, 17, 17 } }, { 'e', { 0, 0, 14, 17, 31, 16,
        14 } },
    { 'l', { 12, 4, 4, 4, 4, 4, 14 } }, { 'x', { 0, 0, 17, 10, 4, 10, 17 } },
    { ':', { 0, 12, 12, 0, 12, 12, 0 } }, { '+', { 0, 4, 4, 31, 4, 4, 0 } } };

static void dot(const vs_pixels *c, uint32_t x, uint32_t y, const unsigned char rgb[3]) {
  if (x < c->columns && y < c->rows) memcpy(c->rgb + 3 * ((size_t)y * c->columns + x), rgb, 3);
}

void vs_picture_text(const vs_pixels *c, uint32_t x, uint32_t y, const char *text) {
  static const unsigned char ink[3] = { 32, 32, 32 };
  for (; *text; text++, x += ADVANCE)
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++)
      for (uint32_t dy = 0; letters[i].letter == *text && dy < LETTER_HIGH; dy++)
        for (uint32_t dx = 0; dx < LETTER_WIDE; dx++)
          if (letters[i].rows[dy] >> (LETTER_WIDE - 1 - dx) & 1) dot(c, x + dx, y + dy, ink);
}

static void write_number(const vs_pixels *c, uint32_t x, uint32_t y, double value) {
  char text[24];
  snprintf(text, sizeof text, value >= 1000 && value < 1e7 ? "%.0f" : "%.4g", value);
  vs_picture_text(c, x, y, text);
}

/* Draws the legend into the picture c: a bar with the colours from bottom to top, the unit above it, and round numbers
 * beside it where there is room. left: column where the legend begins. */
static void draw_legend(const vs_pixels *c, const vs_color_scale *s, uint32_t left) {
  uint32_t top = LETTER_HIGH + 2 * MARGIN, bottom = c->rows - MARGIN - LETTER_HIGH / 2, length = bottom - top;
  static const unsigned char ink[3] = { 32, 32, 32 };
  vs_picture_text(c, left + MARGIN, MARGIN, s->unit);
  for (uint32_t y = top; y <= bottom; y++) {
    double share = (double)(bottom - y) / length, x = s->least + share * (s->most - s->least);
    unsigned char rgb[3];
    if (s->logarithmic) x = s->least * pow(s->most / s->least, share);
    vs_false_color(s, x, rgb);
    for (uint32_t dx = 0; dx < BAR; dx++) dot(c, left + MARGIN + dx, y, rgb);
  }
  static const double rounds[] = { 1, 2, 5 };
  double gap = pow(10, floor(log10((s->most - s->least) / 4))), last = 1e9;
  while (!s->logarithmic && (s->most - s->least) / gap > 8) gap *= (s->most - s->least) / gap > 16 ? 5 : 2;
  for (int i = 0; i < 400; i++) {
    int place = s->logarithmic ? i + 3 * (int)floor(log10(s->least)) : i;
    double x = s->logarithmic ? rounds[i % 3] * pow(10, floor(log10(s->least)) + i / 3)
                              : (ceil(s->least / gap - 1e-9) + place) * gap;
    if (x > s->most * (1 + 1e-9)) break;
    if (x < s->least) continue;
    double y = bottom - share_of(s, x) * length;
    if (last - y < LETTER_HIGH + 3) continue;
    last = y;
    for (uint32_t dx = 0; dx < 3; dx++) dot(c, left + MARGIN + BAR + dx, (uint32_t)lround(y), ink);
    write_number(c, left + MARGIN + BAR + 5, (uint32_t)lround(y) - LETTER_HIGH / 2, x);
  }
}

bool vs_false_color_picture(vs_store *store, const vs_pixel_numbers *numbers, const vs_color_scale *s, vs_pixels *out,
                            vs_error *e) {
  uint32_t columns = numbers->columns, rows = numbers->rows;
  *out = (vs_pixels){ NULL, columns + STRIP, rows > 64 ? rows : 64 }; /* the legend needs at least 64 rows, so a lower
                                                                       * picture gets blank rows */
  size_t bytes = (size_t)out->columns * out->rows * 3;
  out->rgb = vs_store_realloc(store, NULL, 0, bytes);
  if (!out->rgb) return vs_error_memory(e, NULL);
  memset(out->rgb, 244, bytes);
  for (uint32_t y = 0; y < rows; y++)
    for (uint32_t x = 0; x < columns; x++) {
      double value = (double)numbers->at[(size_t)y * columns + x];
      if (!isnan(value)) vs_false_color(s, value, out->rgb + 3 * ((size_t)y * out->columns + x));
    }
  draw_legend(out, s, columns);
  return true;
}
