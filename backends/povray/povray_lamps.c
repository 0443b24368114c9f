/* Owns lamps in a scene for POV-Ray.
 *
 * A lamp is a point of light that fades by the square of the distance, within a small globe that nobody sees. The globe
 * lets through, in each direction, the share of the brightest direction's light that the lamp's file says: its pigment
 * is a picture, made here, of that share all round, as transparency, which POV-Ray takes for light in proportion.
 *
 * A white surface square to a light of 1 has the number 1; its luminance is the illuminance over pi. POV-Ray's light
 * fades as 2 / (1 + (distance / fade_distance)^2), which is the inverse square but for one in ten thousand at a
 * metre. */
#include "backends/povray/povray_lamps.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/povray/povray_files.h"
#include "geometry/files/exr.h"
#include "geometry/light/ies.h"

enum { COLUMNS = 720, ROWS = 360 }; /* half a degree */
static const double pi = 3.14159265358979323846, globe = 0.01 /* metres: its radius, and fade_distance */;

static void put_number(vs_writer *w, const char *before, double x, const char *after) {
  vs_puts(w, before);
  vs_put_number(w, x);
  vs_puts(w, after);
}

/* The lamp's own axes: where it shines to, its first horizontal direction, and the second a quarter further,
 * anticlockwise as seen from above a lamp that hangs. */
typedef struct { vs_vec3 down, first, second; } lamp_axes;

static lamp_axes axes_of(const vs_scene_lamp *l) {
  vs_vec3 down = vs_v3_unit(vs_v3_sub(l->to, l->at)), back = vs_v3_scale(down, -1);
  /* the smallest turn from hanging to this direction carries x and y along */
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

/* The share of the brightest intensity in all directions, as a panorama in an EXR file: in its middle what is down, on
 * top the first direction, for POV-Ray blends the top and the bottom of a picture, and these are alike as a rule. */
static bool put_shares(vs_emitter *e, const vs_ies *ies, size_t number) {
  vs_exr x = { .store = e->scene->store, .columns = COLUMNS, .rows = ROWS };
  float *planes[3];
  static const char *const names[] = { "B", "G", "R" };
  for (int k = 0; k < 3; k++) {
    planes[k] = vs_exr_add(&x, names[k], VS_EXR_HALF, e->error);
    if (planes[k] == NULL) return vs_exr_free(&x), false;
  }
  for (int row = 0; row < ROWS; row++)
    for (int column = 0; column < COLUMNS; column++) {
      double up = pi / 2 - (row + 0.5) * pi / ROWS, east = ((column + 0.5) / COLUMNS - 0.5) * 2 * pi;
      double down = cos(up) * cos(east), first = sin(up), second = -cos(up) * sin(east);
      double vertical = acos(fmax(-1, fmin(1, down))) * 180 / pi, horizontal = atan2(second, first) * 180 / pi;
      float share = (float)(vs_ies_candelas(ies, vertical, horizontal) / ies->most);
      for (int k = 0; k < 3; k++) planes[k][row * COLUMNS + column] = share;
    }
  unsigned char *bytes = NULL;
  size_t size = 0, room = 0;
  char name[32];
  snprintf(name, sizeof name, "lamp%zu.exr", number);
  bool ok = vs_exr_write(&x, &bytes, &size, &room, e->error) && vs_povray_put_own_file(e, name, bytes, size);
  if (bytes != NULL) vs_store_realloc(e->scene->store, bytes, room, 0);
  vs_exr_free(&x);
  return ok;
}

static bool put_globe(vs_emitter *e, const vs_scene_lamp *l, const vs_ies *ies, size_t number, double radius) {
  vs_writer *w = e->out;
  vs_vec3 at = vs_v3_scale(l->at, e->unit);
  vs_put_triple(w, "sphere {\n  <", at, ", ", ">, ");
  put_number(w, "", radius, "\n  texture {\n    pigment {\n      image_pattern { exr ");
  if (!put_shares(e, ies, number)) return false;
  vs_puts(w, " map_type 1 interpolate 2 }\n      color_map { [0 rgbt <0, 0, 0, 0>] [1 rgbt <0, 0, 0, 1>] }\n"
             "      rotate x*90 rotate -z*90 matrix <");
  lamp_axes a = axes_of(l); /* the panorama's east, north and zenith, and its place */
  vs_put_triple(w, "", vs_v3_scale(a.second, -1), ", ", ", ");
  vs_put_triple(w, "", a.down, ", ", ", ");
  vs_put_triple(w, "", a.first, ", ", ", ");
  vs_put_triple(w, "", at, ", ", ">\n    }\n    finish { ambient 0 diffuse 0 }\n  }\n");
  return vs_puts(w, "  no_image no_reflection no_radiosity\n}\n");
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
    bool round = l->ies != NULL && e->folder == NULL;
    if (l->ies != NULL) candelas = l->dim * (round ? vs_ies_lumens(&ies) / (4 * pi) : ies.most);
    vs_put_triple(w, "light_source {\n  <", vs_v3_scale(l->at, e->unit), ", ", ">\n  color rgb ");
    vs_put_triple(w, "<", vs_v3_scale(l->color, candelas * per_candela / pi / (2 * globe * globe)), ", ", ">\n");
    put_number(w, "  fade_distance ", radius, " fade_power 2\n}\n");
    if (round) vs_putf(w, "/* %016llx */\n", (unsigned long long)l->ies->hash); /* another file is another text */
    bool ok = l->ies == NULL || round || put_globe(e, l, &ies, i + 1, radius);
    vs_ies_free(&ies);
    if (round &&
        !vs_emit_warn_once(e, NULL, "in a .pov a lamp's light goes round evenly: its IES file is for pictures"))
      return false;
    if (!ok) return false;
  }
  return !w->failed;
}
