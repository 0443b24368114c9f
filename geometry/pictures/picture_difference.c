/* Measures the difference of two pictures: in linear light, and by structural similarity on the screen.
 *
 * Structural similarity is that of Wang, Bovik, Sheikh and Simoncelli, Image Quality Assessment: From Error Visibility
 * to Structural Similarity, IEEE Transactions on Image Processing 13(4), 2004. It uses means, variances and covariance
 * under a Gaussian window of 11 x 11 pixels with sigma 1.5, K1 .01 and K2 .03. It compares the luma of the developed
 * pictures. Both pictures are developed with the exposure of the first picture. The pixels at the border are repeated
 * beyond it. */
#include "geometry/pictures/picture_difference.h"

#include <math.h>

#include "geometry/files/raster.h"

enum { REACH = 5 };
typedef struct { double *at, *scratch; uint32_t columns, rows; const double *window; } plane;

static uint32_t within(int64_t x, uint32_t count) { return x < 0 ? 0 : x >= count ? count - 1 : (uint32_t)x; }

/* Blurs a plane (one number for each pixel) with the Gaussian window, first along the rows and then along the
 * columns. */
static void blur(const plane *p) {
  for (uint32_t y = 0; y < p->rows; y++)
    for (uint32_t x = 0; x < p->columns; x++) {
      double sum = 0;
      for (int i = -REACH; i <= REACH; i++)
        sum += p->window[i + REACH] * p->at[(size_t)y * p->columns + within((int64_t)x + i, p->columns)];
      p->scratch[(size_t)y * p->columns + x] = sum;
    }
  for (uint32_t y = 0; y < p->rows; y++)
    for (uint32_t x = 0; x < p->columns; x++) {
      double sum = 0;
      for (int i = -REACH; i <= REACH; i++)
        sum += p->window[i + REACH] * p->scratch[(size_t)within((int64_t)y + i, p->rows) * p->columns + x];
      p->at[(size_t)y * p->columns + x] = sum;
    }
}

static void develop(const vs_light *light, double stops, unsigned char *rgb, double *luma) {
  vs_tone tone = { .curve = VS_TONE_NEUTRAL, .fixed = true, .stops = stops };
  vs_tone_apply(light, &tone, rgb);
  for (size_t i = 0; i < vs_light_pixels(light); i++) {
    luma[i] = 0;
    for (size_t k = 0; k < 3; k++) luma[i] += vs_raster_share[k] * rgb[3 * i + k];
  }
}

/* Returns the structural similarity of the pictures a and b, which have equal sizes; 1 if they are equal. `work`:
 * memory for six planes, with one number for each pixel. `rgb`: memory for the bytes of a picture. */
static double similarity(const vs_light *a, const vs_light *b, double *work, unsigned char *rgb) {
  const double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  double window[2 * REACH + 1], sum = 0, *of[6];
  size_t n = vs_light_pixels(a);
  VS_ASSERT(vs_light_pixels(a) == vs_light_pixels(b));
  for (int i = -REACH; i <= REACH; i++) sum += window[i + REACH] = exp(-i * i / (2 * 1.5 * 1.5));
  for (int i = 0; i <= 2 * REACH; i++) window[i] /= sum;
  for (size_t k = 0; k < 6; k++) of[k] = work + k * n;
  double stops = vs_tone_exposure(a, VS_TONE_NEUTRAL);
  develop(a, stops, rgb, of[0]);
  develop(b, stops, rgb, of[1]);
  for (size_t i = 0; i < n; i++)
    of[2][i] = of[0][i] * of[0][i], of[3][i] = of[1][i] * of[1][i], of[4][i] = of[0][i] * of[1][i];
  for (size_t k = 0; k < 5; k++) blur(&(plane){ of[k], of[5], a->columns, a->rows, window });
  sum = 0;
  for (size_t i = 0; i < n; i++) {
    double ma = of[0][i], mb = of[1][i], va = of[2][i] - ma * ma, vb = of[3][i] - mb * mb, both = of[4][i] - ma * mb;
    sum += (2 * ma * mb + c1) * (2 * both + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
  }
  return sum / (double)n;
}

bool vs_picture_measure_gap(vs_store *store, const vs_light *a, const vs_light *b, float *each,
                            vs_picture_gap *out, vs_error *e) {
  size_t n = vs_light_pixels(a), bytes = n * 6 * sizeof(double);
  double *work = vs_store_realloc(store, NULL, 0, bytes);
  unsigned char *rgb = vs_store_realloc(store, NULL, 0, n * 3);
  bool ok = work && rgb;
  double sum = 0, squares = 0;
  VS_ASSERT(a->columns == b->columns && a->rows == b->rows);
  *out = (vs_picture_gap){ .peak_ratio = INFINITY };
  for (size_t i = 0; ok && i < n; i++) {
    const double d[3] = { fabs((double)a->red[i] - (double)b->red[i]), fabs((double)a->green[i] - (double)b->green[i]),
                          fabs((double)a->blue[i] - (double)b->blue[i]) };
    double largest = fmax(d[0], fmax(d[1], d[2]));
    if (each) each[i] = (float)((d[0] + d[1] + d[2]) / 3);
    sum += d[0] + d[1] + d[2];
    squares += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (largest > out->most) out->most = largest, out->worst = i;
  }
  if (ok) {
    out->mean = sum / (3 * (double)n), out->root = sqrt(squares / (3 * (double)n));
    if (out->root > 0) out->peak_ratio = -20 * log10(out->root);
    out->similarity = similarity(a, b, work, rgb);
  }
  if (work) vs_store_realloc(store, work, bytes, 0);
  if (rgb) vs_store_realloc(store, rgb, n * 3, 0);
  return ok || vs_error_memory(e, NULL);
}
