/* Owns what tests ask of a picture: `pngstat FILE` prints `WIDTH HEIGHT COLOURS EDGES`, how many different colours it has (of 15 bits) and how
 * many of 1000 pixels differ plainly from their left neighbour: flat or smooth pictures have no edges, models do. */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
  png_image image = {.version = PNG_IMAGE_VERSION};
  if (argc != 2 || !png_image_begin_read_from_file(&image, argv[1])) {
    fprintf(stderr, "pngstat: %s\n", argc == 2 ? image.message : "one file, please");
    return 1;
  }
  image.format = PNG_FORMAT_RGB;
  unsigned char *pixels = malloc(PNG_IMAGE_SIZE(image));
  if (!pixels || !png_image_finish_read(&image, NULL, pixels, 0, NULL)) {
    fprintf(stderr, "pngstat: %s\n", image.message);
    return 1;
  }
  static unsigned char seen[1 << 15];
  size_t count = (size_t)image.width * image.height, colours = 0, edges = 0;
  for (size_t i = 0; i < count; i++) {
    const unsigned char *p = pixels + 3 * i;
    unsigned key = (unsigned)(p[0] >> 3) << 10 | (unsigned)(p[1] >> 3) << 5 | p[2] >> 3;
    colours += !seen[key];
    seen[key] = 1;
    if (i % image.width) edges += abs(p[0] - p[-3]) + abs(p[1] - p[-2]) + abs(p[2] - p[-1]) > 40;
  }
  printf("%u %u %zu %zu\n", image.width, image.height, colours, edges * 1000 / count);
  free(pixels);
  return 0;
}
