/* Removes the sun from a picture of a sky.
 *
 * The sun is a small disc, a hundred thousand times as bright as the sky. Only few of the renderer's random rays hit
 * it, so the picture becomes blotched. A separate light for the sun is exact and casts a shadow. The sun and its glare
 * are the light within the angle `reach` of the brightest pixel, as far as it exceeds the mean of the ring of sky from
 * `reach` to `ring`. The direction of the sun is the centroid of that light. */
#include "geometry/light/panorama_sun.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
static const double reach = 2.5, ring = 4; /* reach: greatest angle from the sun's centre, in degrees, of light that
                                            * belongs to the sun; ring: outer angle of the ring of sky around it */
static const double times = 20;            /* the picture has a sun if its brightest pixel is at least this many times
                                            * as bright as the ring of sky around it */

typedef struct { const float *plane[3]; uint32_t columns, rows; } panorama;

static double luminance_at(const panorama *p, size_t i) {
  double sum = 0;
  for (int k = 0; k < 3; k++) sum += vs_raster_share[k] * p->plane[k][i];
  return isfinite(sum) ? sum : 0;
}

static double height_of(const panorama *p, uint32_t row) { return pi / 2 - (row + 0.5) * pi / p->rows; }
static vs_vec3 direction_of(const panorama *p, uint32_t row, uint32_t column) {
  double up = height_of(p, row), east = ((column + 0.5) / p->columns - 0.5) * 2 * pi;
  return vs_v3(cos(up) * sin(east), cos(up) * cos(east), sin(up));
}
/* Returns the solid angle, in sr, of a pixel in the row. It lies between two altitudes and two meridians. row must be
 * below p->rows. */
static double angle_of(const panorama *p, uint32_t row) {
  double top = pi / 2 - row * pi / p->rows, bottom = pi / 2 - (row + 1) * pi / p->rows;
  VS_ASSERT(row < p->rows);
  return 2 * pi / p->columns * (sin(top) - sin(bottom));
}

static bool brightest(const panorama *p, uint32_t *row, uint32_t *column) {
  double most = 0;
  for (uint32_t y = 0; y < p->rows; y++)
    for (uint32_t x = 0; x < p->columns; x++) {
      double here = luminance_at(p, (size_t)y * p->columns + x);
      if (here > most) most = here, *row = y, *column = x;
    }
  return most > 0;
}

typedef void each_fn(void *to, const panorama *p, size_t pixel, double angle, vs_vec3 direction);

/* Calls `each` for each pixel whose angle from the direction `middle` is between `from` and `end` degrees. */
static void within(const panorama *p, vs_vec3 middle, double from, double end, each_fn *each, void *to) {
  double high = asin(fmax(-1, fmin(1, middle.z)));
  VS_ASSERT(from <= end);
  for (uint32_t y = 0; y < p->rows; y++) {
    if (fabs(height_of(p, y) - high) * 180 / pi > end + 180. / p->rows) continue;
    for (uint32_t x = 0; x < p->columns; x++) {
      vs_vec3 d = direction_of(p, y, x);
      double off = acos(fmax(-1, fmin(1, vs_v3_dot(d, middle)))) * 180 / pi;
      if (off >= from && off < end) each(to, p, (size_t)y * p->columns + x, angle_of(p, y), d);
    }
  }
}

typedef struct { double light[3], angle; vs_vec3 middle; double weight, around[3]; float *plane[3]; } gathered;

static void add_light(void *to, const panorama *p, size_t i, double angle, vs_vec3 d) {
  gathered *g = to;
  (void)d;
  g->angle += angle;
  for (int k = 0; k < 3; k++) g->light[k] += angle * (isfinite(p->plane[k][i]) ? p->plane[k][i] : 0);
}

static void add_excess(void *to, const panorama *p, size_t i, double angle, vs_vec3 d) {
  gathered *g = to;
  double sum = 0;
  for (int k = 0; k < 3; k++) {
    double more = fmax(0, (isfinite(p->plane[k][i]) ? p->plane[k][i] : 0) - g->around[k]) * angle;
    g->light[k] += more;
    sum += vs_raster_share[k] * more;
  }
  g->middle = vs_v3_add(g->middle, vs_v3_scale(d, sum));
  g->weight += sum;
}

static void cover(void *to, const panorama *p, size_t i, double angle, vs_vec3 d) {
  gathered *g = to;
  (void)p, (void)angle, (void)d;
  for (int k = 0; k < 3; k++)
    if (!(g->plane[k][i] <= g->around[k])) g->plane[k][i] = (float)g->around[k];
}

bool vs_panorama_take_sun(vs_exr *x, vs_panorama_sun *sun) {
  gathered g = { .plane = { vs_exr_find(x, "R"), vs_exr_find(x, "G"), vs_exr_find(x, "B") } };
  panorama p = { { g.plane[0], g.plane[1], g.plane[2] }, x->columns, x->rows };
  uint32_t row = 0, column = 0;
  if (!p.plane[0] || !p.plane[1] || !p.plane[2] || x->columns < 64 || !brightest(&p, &row, &column)) return false;
  double peak = luminance_at(&p, (size_t)row * x->columns + column);
  vs_vec3 middle = direction_of(&p, row, column);
  for (int turn = 0; turn < 2; turn++) { /* the first pass collects the light around the brightest pixel; the second
                                          * pass collects it around the centroid that the first has found */
    g.angle = 0, g.weight = 0, g.middle = vs_v3(0, 0, 0);
    for (int k = 0; k < 3; k++) g.light[k] = 0;
    within(&p, middle, reach, ring, add_light, &g);
    if (!(g.angle > 0)) return false;
    double around = 0;
    for (int k = 0; k < 3; k++) g.around[k] = g.light[k] / g.angle, around += vs_raster_share[k] * g.around[k];
    if (peak < times * around) return false;
    for (int k = 0; k < 3; k++) g.light[k] = 0;
    within(&p, middle, 0, reach, add_excess, &g);
    if (!(g.weight > 0)) return false;
    middle = vs_v3_unit(g.middle);
  }
  *sun = (vs_panorama_sun){ middle, vs_v3(g.light[0], g.light[1], g.light[2]) };
  within(&p, middle, 0, reach, cover, &g);
  return true;
}
