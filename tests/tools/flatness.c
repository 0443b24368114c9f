/* Measures how evenly a plain wall is lit in a picture: `flatness FILE X Y WIDTH HEIGHT` prints `RMS WORST MEAN` of
 * that part of the picture. It fits smooth shading, a polynomial of degree 3 in x and y, to the grey levels (0 to 255).
 * RMS is the root mean square of the differences from this polynomial, WORST the difference that 1 % of the pixels
 * exceed, MEAN the mean grey level. */
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>

enum { TERMS = 10, LEVELS = 256 };

static void terms_at(double x, double y, double t[TERMS]) {
  double px = (3 * x * x - 1) / 2, py = (3 * y * y - 1) / 2; /* px, py: Legendre polynomials, which keep the equations
                                                              * well conditioned */
  const double all[TERMS] = { 1, x, y, px, x * y, py, (5 * x * x * x - 3 * x) / 2, px * y, x * py, (5 * y * y * y - 3 * y) / 2 };
  for (int i = 0; i < TERMS; i++) t[i] = all[i];
}

/* Solves the equations by Gauss-Jordan elimination. The matrix is positive definite if there are enough pixels. */
static void solve(double a[TERMS][TERMS + 1]) {
  for (int k = 0; k < TERMS; k++)
    for (int i = 0; i < TERMS; i++) {
      double f = a[i][k] / a[k][k];
      for (int j = k; i != k && j <= TERMS; j++) a[i][j] -= f * a[k][j];
    }
}

int main(int argc, char **argv) {
  png_image image = { .version = PNG_IMAGE_VERSION };
  if (argc != 6) return fprintf(stderr, "flatness: FILE X Y WIDTH HEIGHT\n"), 1;
  int x0 = atoi(argv[2]), y0 = atoi(argv[3]), width = atoi(argv[4]), height = atoi(argv[5]);
  if (!png_image_begin_read_from_file(&image, argv[1])) return fprintf(stderr, "flatness: %s\n", image.message), 1;
  image.format = PNG_FORMAT_RGB;
  unsigned char *pixels = malloc(PNG_IMAGE_SIZE(image));
  if (!pixels || !png_image_finish_read(&image, NULL, pixels, 0, NULL)) return fprintf(stderr, "flatness: %s\n", image.message), 1;
  if (x0 < 0 || y0 < 0 || width < 8 || height < 8 || x0 + width > (int)image.width || y0 + height > (int)image.height)
    return fprintf(stderr, "flatness: the part lies outside of the picture, or is too small\n"), 1;
  double a[TERMS][TERMS + 1] = { { 0 } }, t[TERMS], squares = 0, mean = 0, count = (double)width * height;
  static size_t levels[LEVELS * 10];
  for (int pass = 0; pass < 2; pass++) {
    for (int y = 0; y < height; y++)
      for (int x = 0; x < width; x++) {
        const unsigned char *p = pixels + 3 * ((size_t)(y0 + y) * image.width + (size_t)(x0 + x));
        double grey = (p[0] + p[1] + p[2]) / 3.;
        terms_at(2. * x / (width - 1) - 1, 2. * y / (height - 1) - 1, t);
        for (int i = 0; pass == 0 && i < TERMS; i++) {
          for (int j = 0; j < TERMS; j++) a[i][j] += t[i] * t[j];
          a[i][TERMS] += t[i] * grey;
        }
        if (pass == 0) mean += grey / count;
        double away = grey;
        for (int i = 0; pass == 1 && i < TERMS; i++) away -= t[i] * a[i][TERMS] / a[i][i];
        if (pass == 1) squares += away * away, levels[(size_t)fmin(fabs(away) * 10, LEVELS * 10 - 1)]++;
      }
    if (pass == 0) solve(a);
  }
  size_t above = 0, level = LEVELS * 10;
  while (level > 0 && (double)(above += levels[level - 1]) <= count / 100) level--;
  printf("%.2f %.1f %.1f\n", sqrt(squares / count), (double)level / 10, mean);
  free(pixels);
  return 0;
}
