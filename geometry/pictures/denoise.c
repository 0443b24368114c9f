/* Implements the joint bilateral filter: each pixel becomes the mean of its neighbours, weighted by distance and
 * similarity.
 *
 * The similarity is determined from pictures without noise (Petschnigg and others, Digital Photography with Flash and
 * No-Flash Image Pairs, SIGGRAPH 2004). Here these are the layers of albedo (albedo.R .G .B) and normal (N.X .Y .Z), so
 * that edges of shape and colour stay sharp. The logarithm of the picture's own light counts too, with less weight, to
 * keep the edges of shadows. If the picture has no such layers, only its light counts (Tomasi and Manduchi, Bilateral
 * Filtering for Gray and Color Images, ICCV 1998). */
#include "geometry/pictures/denoise.h"

#include <math.h>
#include <string.h>

enum { REACH = 5, LAYERS = 6 };

typedef struct {
  uint32_t columns, rows;
  const float *color[3];
  const float *layer[LAYERS]; /* channels of the albedo (colour of surfaces) and of the surfaces' normals; all are
                               * present, or all are NULL */
  const float *light;         /* light[i]: logarithm of the luminance of pixel i */
  bool guided;
} guide;

/* Returns how unlike the pixels a and b are: squared differences, each divided by twice the variance of its channel,
 * summed over the channels. */
static double unlike(const guide *g, size_t a, size_t b) {
  const double albedo = 1 / (2 * 0.05 * 0.05), normal = 1 / (2 * 0.15 * 0.15), light = g->guided ? 0.6 : 0.25;
  double d = (double)g->light[a] - (double)g->light[b], sum = d * d / (2 * light * light);
  for (int k = 0; g->guided && k < LAYERS; k++) {
    d = (double)g->layer[k][a] - (double)g->layer[k][b];
    sum += d * d * (k < 3 ? albedo : normal);
  }
  return sum;
}

static void smooth(const guide *g, uint32_t x, uint32_t y, float *const to[3]) {
  const double spread = 1 / (2 * 2.5 * 2.5);
  size_t at = (size_t)y * g->columns + x;
  double weight = 0, sum[3] = { 0, 0, 0 };
  for (int dy = -REACH; dy <= REACH; dy++)
    for (int dx = -REACH; dx <= REACH; dx++) {
      int64_t u = (int64_t)x + dx, v = (int64_t)y + dy;
      if (u < 0 || v < 0 || u >= g->columns || v >= g->rows) continue;
      size_t other = (size_t)v * g->columns + (size_t)u;
      double w = exp(-(dx * dx + dy * dy) * spread - unlike(g, at, other));
      weight += w;
      for (int k = 0; k < 3; k++) sum[k] += w * (double)g->color[k][other];
    }
  for (int k = 0; k < 3; k++) to[k][at] = weight > 0 ? (float)(sum[k] / weight) : g->color[k][at];
}

bool vs_exr_smooth(vs_exr *x, bool *layers, vs_error *e) {
  static const char *const names[LAYERS] = { "albedo.R", "albedo.G", "albedo.B", "N.X", "N.Y", "N.Z" };
  float *to[3] = { vs_exr_find(x, "R"), vs_exr_find(x, "G"), vs_exr_find(x, "B") };
  if (!to[0] || !to[1] || !to[2]) return vs_error_set(e, VS_ERROR_MODEL, NULL, "the EXR picture has no R, G and B");
  size_t n = (size_t)x->columns * x->rows, bytes = 4 * n * sizeof(float);
  float *was = vs_store_realloc(x->store, NULL, 0, bytes);
  if (!was) return vs_error_memory(e, NULL);
  guide g = { .columns = x->columns, .rows = x->rows, .light = was + 3 * n, .guided = true };
  for (size_t k = 0; k < 3; k++) {
    g.color[k] = memcpy(was + k * n, to[k], n * sizeof(float));
    for (size_t i = 0; i < n; i++)
      if (!isfinite(was[k * n + i])) was[k * n + i] = 0; /* sets a component that is infinite or NaN to 0, because it
                                                          * would spread to all pixels within the filter's window */
  }
  for (int k = 0; k < LAYERS; k++) g.guided = (g.layer[k] = vs_exr_find(x, names[k])) != NULL && g.guided;
  for (size_t i = 0; i < n; i++) {
    double l = 0;
    for (size_t k = 0; k < 3; k++) l += vs_raster_share[k] * (double)was[k * n + i];
    was[3 * n + i] = (float)log(fmax(l, 1e-4));
  }
  bool ok = true;
  for (uint32_t y = 0; ok && y < x->rows; y++) {
    ok = vs_store_going(x->store, x->columns * 64, e);
    for (uint32_t i = 0; ok && i < x->columns; i++) smooth(&g, i, y, to);
  }
  vs_store_realloc(x->store, was, bytes, 0);
  *layers = g.guided;
  return ok;
}
