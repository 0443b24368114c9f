/* Computes the illuminance of surfaces, and recognizes floors, in rendered pictures. */
#include "geometry/pictures/illuminance.h"

#include <math.h>

#include "geometry/files/raster.h"

vs_lit_surfaces vs_lit_surfaces_of(const vs_exr *x) {
  static const char *const light[] = { "R", "G", "B" }, *const albedo[] = { "albedo.R", "albedo.G", "albedo.B" };
  vs_lit_surfaces s = { .upward = vs_exr_find(x, "N.Z") };
  for (int k = 0; k < 3; k++) s.light[k] = vs_exr_find(x, light[k]), s.albedo[k] = vs_exr_find(x, albedo[k]);
  return s;
}

bool vs_lit_surfaces_are_known(const vs_lit_surfaces *s) {
  bool known = s->upward != NULL;
  for (int k = 0; k < 3; k++) known = known && s->light[k] && s->albedo[k];
  return known;
}

double vs_illuminance_at(const vs_lit_surfaces *s, size_t pixel) {
  const double pi = 3.14159265358979323846, least = 0.005;
  double sum = 0, weight = 0;
  for (int k = 0; k < 3; k++) { /* skips colours that the surface does not reflect, such as blue of a red surface,
                                 * because they give no information about the light */
    double r = (double)s->albedo[k][pixel];
    if (!(r >= least)) continue;
    sum += vs_raster_share[k] * (double)s->light[k][pixel] / r, weight += vs_raster_share[k];
  }
  return weight > 0 ? pi * sum / weight : (double)NAN;
}

bool vs_is_floor(const vs_lit_surfaces *s, size_t pixel) { return s->upward[pixel] > 0.9986f; }
