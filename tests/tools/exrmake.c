/* Makes small EXR pictures for tests: `exrmake WIDTH HEIGHT OUT.exr [plain|noisy|layers|grey|sun]`. From left to right
 * the light increases exponentially from 0.01 to 4.
 *
 *   noisy   adds noise of a tenth of the light
 *   layers  adds the layers albedo, normal, depth and id; the id's place is a.vs:1:2 in the upper half, else b.vs:30:4
 *   grey    writes a single channel Y
 *   sun     a sky of 0.2, with north in the middle of the picture; a disc of 1 degree at azimuth 250 and
 *           altitude 30 lights a surface that faces it with 3 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/files/exr.h"

static double chance(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (*seed >> 8) / 16777216.0;
}

static double sky(const vs_exr *x, size_t pixel) {
  const double pi = 3.14159265358979323846, degree = pi / 180;
  double up = pi / 2 - ((double)(pixel / x->columns) + 0.5) * pi / x->rows;
  double east = (((double)(pixel % x->columns) + 0.5) / x->columns - 0.5) * 2 * pi, a = 250 * degree, h = 30 * degree;
  double cosine = sin(up) * sin(h) + cos(up) * cos(h) * cos(east - a), radius = degree;
  return 0.2 + (cosine > cos(radius) ? 3 / (2 * pi * (1 - cos(radius))) : 0);
}

int main(int argc, char **argv) {
  static const char *const names[] = { "R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "N.X", "N.Y", "N.Z" };
  const char *kind = argc > 4 ? argv[4] : "plain";
  bool layers = !strcmp(kind, "layers"), noisy = strcmp(kind, "plain") != 0, sun = !strcmp(kind, "sun"), grey = !strcmp(kind, "grey");
  vs_error e = { VS_ERROR_NONE, NULL, "" };
  uint32_t seed = 1;
  if (argc < 4) return fputs("exrmake: WIDTH HEIGHT OUT [KIND]\n", stderr), 2;
  vs_exr x = { .store = vs_store_new(NULL, NULL), .columns = (uint32_t)atoi(argv[1]), .rows = (uint32_t)atoi(argv[2]) };
  size_t pixels = (size_t)x.columns * x.rows;
  for (size_t k = 0; k < (grey ? 1u : layers ? 9u : 3u); k++) {
    float *at = vs_exr_add(&x, grey ? "Y" : names[k], sun ? VS_EXR_FLOAT : VS_EXR_HALF, &e);
    for (size_t i = 0; at && i < pixels; i++) {
      double light = 0.01 * pow(400, (double)(i % x.columns) / fmax(x.columns - 1, 1));
      at[i] = (float)(sun ? sky(&x, i) : k < 3 ? light * (1 + (noisy ? 0.2 * (chance(&seed) - 0.5) : 0)) : k < 6 ? 0.5 : k == 8);
    }
  }
  if (layers) {
    float *id = vs_exr_add(&x, "id", VS_EXR_WHOLE, &e), *depth = vs_exr_add(&x, "Z", VS_EXR_FLOAT, &e);
    for (size_t i = 0; id && depth && i < pixels; i++)
      id[i] = i % x.columns == 0 ? 0 : i < pixels / 2 ? 1 : 2, depth[i] = (float)(3 + (double)i / (double)pixels);
    vs_exr_add_text(&x, VS_EXR_SOURCES, "a.vs:1:2\nb.vs:30:4\n", 19, &e);
  }
  vs_made_bytes made;
  FILE *f = fopen(argv[3], "wb");
  if (!f || !vs_exr_write(&x, &made, &e)) return fprintf(stderr, "exrmake: %s\n", e.message), 1;
  bool ok = fwrite(made.at, 1, made.size, f) == made.size;
  vs_store *store = x.store;
  vs_exr_free(&x);
  vs_store_realloc(store, made.at, made.room, 0);
  vs_store_release(store);
  return fclose(f) == 0 && ok ? 0 : 1;
}
