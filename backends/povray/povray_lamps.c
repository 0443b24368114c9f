/* Writes the lamps of a scene for POV-Ray.
 *
 * A lamp is a point light that fades with the square of the distance, inside a small invisible globe. In each direction
 * the globe transmits a fraction of the light: the intensity in the lamp's file, divided by the greatest intensity. The
 * globe's pigment has this fraction as transparency, by which POV-Ray multiplies light. The pigment is a map of maps,
 * by the horizontal and by the vertical angle, with an entry for each angle of the file. POV-Ray interpolates linearly
 * between entries, as the file's format requires. Thus the scene itself contains the light, and a .pov needs no file
 * beside it.
 *
 * Brightness: a white surface that faces a light of strength 1 has the brightness 1. Its luminance is the illuminance
 * divided by pi. POV-Ray's light fades as 2 / (1 + (distance / fade_distance)^2), which differs from the inverse square
 * by one in ten thousand at a metre. */
#include "backends/povray/povray_lamps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/light/ies.h"

enum { ENTRIES = 254 };
static const double pi = 3.14159265358979323846, globe = 0.01 /* globe: radius of a lamp's globe, and fade_distance of
                                                               * its light, in metres */,
                    margin = 0.001 /* margin: distance of a pattern's values from 0 and 1 */;

static void put_number(vs_writer *w, const char *before, double x, const char *after) {
  vs_puts(w, before);
  vs_put_number(w, x);
  vs_puts(w, after);
}

/* The lamp's own axes: its central direction, its first horizontal direction, and a second horizontal direction, which
 * is rotated from the first by a quarter turn. The rotation is anticlockwise as seen from above a hanging lamp. */
typedef struct { vs_vec3 down, first, second; } lamp_axes;

static lamp_axes axes_of(const vs_scene_lamp *l) {
  vs_vec3 down = vs_v3_unit(vs_v3_sub(l->to, l->at)), back = vs_v3_scale(down, -1);
  /* The smallest rotation from straight down to the lamp's central direction is also applied to the horizontal
   * directions x and y. */
  vs_vec3 x = vs_v3(1, 0, 0), y = vs_v3(0, 1, 0);
  if (fabs(back.z) < 1 - 1e-12) {
    vs_vec3 axis = vs_v3_unit(vs_v3_cross(vs_v3(0, 0, 1), back));
    double angle = acos(fmax(-1, fmin(1, back.z)));
    vs_affine turn = vs_affine_rotation(vs_v3(0, 0, 0), axis, angle);
    x = vs_affine_point(&turn, x), y = vs_affine_point(&turn, y);
  } else if (back.z < 0) y = vs_v3(0, -1, 0);
  double t = l->turn * pi / 180;
  return (lamp_axes){ down, vs_v3_add(vs_v3_scale(x, cos(t)), vs_v3_scale(y, sin(t))),
                      vs_v3_sub(vs_v3_scale(y, cos(t)), vs_v3_scale(x, sin(t))) };
}

/* The angles at which a globe's maps have entries, ascending. POV-Ray allows at most 256 entries. If the lamp's file
 * has more angles, they are replaced by angles at equal steps. */
typedef struct { double at[ENTRIES]; uint32_t count; } globe_angles;

static globe_angles verticals_of(const vs_ies *ies) {
  globe_angles a = { .count = ies->verticals };
  const double *file = ies->at;
  if (a.count <= ENTRIES) return memcpy(a.at, file, a.count * sizeof *file), a;
  double from = file[0], to = file[ies->verticals - 1];
  for (a.count = 0; a.count < ENTRIES; a.count++) a.at[a.count] = from + (to - from) * a.count / (ENTRIES - 1);
  return a;
}

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Returns the horizontal angles of the lamp's file, from 0 to 360 degrees, including those that follow from its
 * symmetry. A single angle means that the lamp shines equally in all horizontal directions. */
static globe_angles horizontals_of(const vs_ies *ies) {
  globe_angles a = { .count = 0 };
  const double *file = ies->at + ies->verticals;
  if (ies->horizontals == 1) return a.count = 1, a;
  a.at[a.count++] = 0, a.at[a.count++] = 360;
  bool fits = ies->horizontals <= (ENTRIES - 2) / 4;
  for (uint32_t i = 0; fits && i < ies->horizontals; i++) {
    const double images[4] = { file[i], 180 - file[i], 180 + file[i], 360 - file[i] };
    for (int k = 0; k < 4; k++) a.at[a.count++] = fmod(images[k] + 360, 360);
  }
  qsort(a.at, a.count, sizeof *a.at, ascending);
  uint32_t kept = 1;
  for (uint32_t i = 1; i < a.count; i++)
    if (a.at[i] > a.at[kept - 1] + 1e-9) a.at[kept++] = a.at[i];
  a.count = kept;
  if (fits) return a;
  for (a.count = 0; a.count < ENTRIES; a.count++) a.at[a.count] = 360. * a.count / (ENTRIES - 1);
  return a;
}

/* Returns a pattern's value for an angle, from 0 at angle 0 to 1 at `whole`. The value keeps a margin from 0 and 1,
 * where POV-Ray's patterns wrap around. */
static double entry_at(double angle, double whole) { return margin + (1 - 2 * margin) * angle / whole; }

static void put_entry(vs_writer *w, double at, double share) {
  put_number(w, "[", at, " rgbt <0, 0, 0, ");
  put_number(w, "", share, ">]");
}

/* Writes the pigment along a meridian of the globe, by the angle from straight down. Its transparency is the intensity
 * in a direction as a fraction of the greatest intensity. */
static void put_meridian(vs_writer *w, const vs_ies *ies, const globe_angles *verticals, double horizontal) {
  const double *at = verticals->at, last = at[verticals->count - 1];
  vs_puts(w, "function { ");
  put_number(w, "", margin, " + ");
  put_number(w, "", (1 - 2 * margin) / pi, " * acos(max(-1, min(1, z / max(sqrt(x*x + y*y + z*z), 1e-30)))) }\n"
                                           "      color_map { ");
  if (at[0] > 0) put_entry(w, entry_at(at[0], 180), 0);
  for (uint32_t i = 0; i < verticals->count; i++) {
    if (i > 0 && i % 4 == 0) vs_puts(w, "\n        ");
    put_entry(w, entry_at(at[i], 180), vs_ies_candelas(ies, at[i], horizontal) / ies->most);
  }
  if (last < 180) put_entry(w, entry_at(last, 180), 0);
  vs_puts(w, " }");
}

/* Writes the globe around a lamp. In the globe's coordinates x is the lamp's first horizontal direction, y the second,
 * and z points down. */
static void put_globe(vs_emitter *e, const vs_scene_lamp *l, const vs_ies *ies, double radius) {
  vs_writer *w = e->out;
  vs_vec3 at = vs_v3_scale(l->at, e->unit);
  globe_angles verticals = verticals_of(ies), horizontals = horizontals_of(ies);
  put_number(w, "sphere {\n  0, ", radius, "\n  texture {\n    pigment {\n      ");
  if (horizontals.count > 1) {
    vs_puts(w, "function { ");
    put_number(w, "", margin, " + ");
    put_number(w, "", (1 - 2 * margin) / (2 * pi), " * (atan2(y, x) + select(y, 2*pi, 0)) }\n      pigment_map {\n");
    for (uint32_t i = 0; i < horizontals.count; i++) {
      put_number(w, "      [", entry_at(horizontals.at[i], 360), " ");
      put_meridian(w, ies, &verticals, horizontals.at[i]);
      vs_puts(w, "]\n");
    }
    vs_puts(w, "      }\n");
  } else {
    put_meridian(w, ies, &verticals, 0);
    vs_puts(w, "\n");
  }
  lamp_axes a = axes_of(l);
  vs_puts(w, "    }\n    finish { ambient 0 diffuse 0 }\n  }\n  matrix <");
  vs_put_triple(w, "", a.first, ", ", ", ");
  vs_put_triple(w, "", a.second, ", ", ", ");
  vs_put_triple(w, "", a.down, ", ", ", ");
  vs_put_triple(w, "", at, ", ", ">\n  no_image no_reflection no_radiosity\n}\n");
}

bool vs_povray_lamps(vs_emitter *e, double per_candela) {
  vs_writer *w = e->out;
  double radius = globe * e->unit / vs_scene_metres(e->scene);
  for (size_t i = 0; i < e->scene->lamp_count; i++) {
    const vs_scene_lamp *l = &e->scene->lamps[i];
    vs_ies ies = { .store = e->scene->store };
    double candelas = l->lumens / (4 * pi);
    if (l->ies != NULL && !vs_ies_read(e->scene->store, "", (const char *)l->ies->bytes, l->ies->size, &ies, e->error))
      return false;
    if (l->ies != NULL) candelas = l->dim * ies.most;
    vs_put_triple(w, "light_source {\n  <", vs_v3_scale(l->at, e->unit), ", ", ">\n  color rgb ");
    vs_put_triple(w, "<", vs_v3_scale(l->color, candelas * per_candela / pi / (2 * globe * globe)), ", ", ">\n");
    put_number(w, "  fade_distance ", radius, " fade_power 2\n}\n");
    if (l->ies != NULL) put_globe(e, l, &ies, radius);
    vs_ies_free(&ies);
  }
  return !w->failed;
}
