/* Prints figures of pictures for the tests. `pngstat FILE` prints `WIDTH HEIGHT COLOURS EDGES INK STEP CLIPPED`:
 *
 *   COLOURS  number of different colours, of 15 bits each
 *   EDGES    pixels in 1000 that clearly differ from their left neighbour; flat or smooth pictures have none
 *   INK      number of dark pixels; a partly covered pixel counts in part
 *   STEP     largest mean difference (0 to 255) between a row and the row above; a horizontal line makes it large
 *   CLIPPED  pixels in 1000 of which red, green or blue is 255
 *
 * `pngstat FILE OTHER` prints how many pixels in 1000 clearly differ between the two pictures. */
#include <math.h>
#include <png.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

/* Returns the picture's pixels of three bytes, or NULL after printing the reason of a failure. */
static unsigned char *load(const char *file, png_image *image) {
  *image = (png_image){.version = PNG_IMAGE_VERSION};
  unsigned char *pixels = NULL;
  if (png_image_begin_read_from_file(image, file)) {
    image->format = PNG_FORMAT_RGB;
    pixels = malloc(PNG_IMAGE_SIZE(*image));
    if (pixels && png_image_finish_read(image, NULL, pixels, 0, NULL)) return pixels;
  }
  fprintf(stderr, "pngstat: %s: %s\n", file, image->message);
  free(pixels);
  return NULL;
}

static int apart(const unsigned char *p, const unsigned char *q) { return abs(p[0] - q[0]) + abs(p[1] - q[1]) + abs(p[2] - q[2]) > 40; }

static double largest_step(const unsigned char *pixels, size_t width, size_t height) {
  double largest = 0;
  for (size_t y = 1; y < height; y++) {
    double sum = 0;
    for (size_t i = 3 * width * y; i < 3 * width * (y + 1); i++) sum += abs(pixels[i] - pixels[i - 3 * width]);
    if (sum > largest) largest = sum;
  }
  return largest / (3 * (double)width);
}

int main(int argc, char **argv) {
  png_image image, other = {.version = PNG_IMAGE_VERSION};
  if (argc < 2 || argc > 3) return fprintf(stderr, "pngstat: one or two files, please\n"), 1;
  unsigned char *pixels = load(argv[1], &image), *beside = argc > 2 ? load(argv[2], &other) : NULL;
  size_t count = (size_t)image.width * image.height, colours = 0, edges = 0, clipped = 0;
  bool ok = pixels && (argc == 2 || (beside && other.width == image.width && other.height == image.height));
  double ink = 0;
  static unsigned char seen[1 << 15];
  for (size_t i = 0; ok && i < count; i++) {
    const unsigned char *p = pixels + 3 * i;
    unsigned key = (unsigned)(p[0] >> 3) << 10 | (unsigned)(p[1] >> 3) << 5 | p[2] >> 3;
    colours += !seen[key];
    seen[key] = 1;
    clipped += p[0] == 255 || p[1] == 255 || p[2] == 255;
    int lightest = p[0] > p[1] ? p[0] : p[1];
    if (p[2] > lightest) lightest = p[2];
    ink += lightest > 190 ? 0 : 1 - pow(lightest / 190., 2.2); /* adds the fraction of the pixel that black covers, in
                                                                * linear light */
    if (beside) edges += (size_t)apart(p, beside + 3 * i);
    else if (i % image.width) edges += (size_t)apart(p, p - 3);
  }
  if (ok && beside) printf("%zu\n", edges * 1000 / count);
  else if (ok) printf("%u %u %zu %zu %.0f %.1f %.1f\n", image.width, image.height, colours, edges * 1000 / count, ink,
                      largest_step(pixels, image.width, image.height), 1000. * (double)clipped / (double)count);
  free(pixels);
  free(beside);
  return !ok;
}
