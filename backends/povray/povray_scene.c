/* Writes the general part of a POV-Ray scene: header, camera, light, sky, ground. povray_shapes.c writes shapes,
 * povray_materials.c materials.
 *
 * Appearance: linear light (assumed_gamma 1), a warm parallel sun (with a soft edge in the final quality), a pale sky
 * sphere that radiosity turns into fill light, and no ambient term. The user's text enters the scene only as letters
 * and digits of names. */
#include "backends/povray/povray_scene.h"

#include <math.h>

#include "backends/povray/povray.h"
#include "backends/povray/povray_edges.h"
#include "backends/povray/povray_files.h"
#include "backends/povray/povray_lamps.h"
#include "backends/povray/povray_meshes.h"
#include "backends/povray/povray_shapes.h"
#include "backends/povray/povray_sky.h"
#include "backends/povray/povray_worker.h"
#include "backends/view.h"
#include "geometry/measure/bounds.h"
#include "geometry/measure/inside.h"

static const double pi = 3.14159265358979323846;

static void pov_vector(vs_writer *w, const char *before, vs_vec3 v) {
  vs_puts(w, before);
  vs_put_triple(w, "<", v, ", ", ">");
}

static void pov_word(vs_writer *w, const char *before, double x, const char *after) {
  vs_puts(w, before);
  vs_put_number(w, x);
  vs_puts(w, after);
}

/* ---- the strength of the light ---- */

/* Returns true if vs converts POV-Ray's light to the final picture, with a tone curve. The light is then as outdoors,
 * where the sun is several times as bright as the sky. Otherwise the light is limited, because colours brighter than
 * white are cut off. */
static bool pov_is_developed(const vs_emitter *e) { return e->backend->render != NULL; }
/* Returns the strength of the light at dusk, as a fraction of the light by day, multiplied by the gain
 * (vs_povray_gain). A sky that is a picture has its own light. */
static double pov_dusk(const vs_emitter *e) {
  const vs_scene *s = e->scene;
  return s->has_sun && s->sky_image == NULL ? vs_sky_light_twilight(s->sun_altitude) * vs_povray_gain(s) : 1;
}
static double pov_sky_strength(const vs_emitter *e) {
  return pov_is_developed(e) && e->scene->sky_image == NULL ? 1.6 * pov_dusk(e) : pov_dusk(e);
}
/* Returns the strength of a draft's lights without shadows. They represent the light that the sky and the walls
 * scatter. */
static double pov_fill_strength(const vs_emitter *e) { return pov_is_developed(e) ? 2.1 : 1; }
static double pov_sun_strength(const vs_emitter *e) { return pov_is_developed(e) ? 2 * pov_sky_strength(e) : 1.25; }
/* Returns true if the sky has physical luminances. In a .pov, the light of such a sky is reduced by the same factor as
 * the sun. */
static bool pov_is_physical(const vs_emitter *e) { return e->scene->sky_kind != VS_SKY_PLAIN; }
static double pov_strength(const vs_emitter *e) {
  return vs_povray_gain(e->scene) * (pov_is_developed(e) ? 1 : 1.25 / 3.2);
}
static vs_povray_daylight pov_daylight(const vs_emitter *e, const vs_look *l) {
  return vs_povray_daylight_of(e->scene, vs_look_sun(e->scene, l), pov_strength(e));
}
/* Returns true if the scene has no direct light from the sun or the moon. */
static bool pov_is_sunless(const vs_emitter *e, const vs_look *l) {
  const vs_scene *s = e->scene;
  if (pov_is_physical(e)) return vs_v3_equal(vs_sky_light_sun_of_scene(s, vs_look_sun(s, l)), vs_v3(0, 0, 0));
  return s->no_sun || s->style == VS_STYLE_ARCTIC || s->style == VS_STYLE_TECHNICAL ||
         (s->has_sun && s->sun_altitude <= 0);
}
/* Returns the brightness that a draft adds to all surfaces, regardless of their direction, so that none is black.
 * Returns 0 for pictures with bounced light. */
double vs_povray_ambient(const vs_emitter *e) {
  return e->options->quality == VS_RENDER_DRAFT ? 0.05 * pov_fill_strength(e) : 0;
}

/* ---- the surroundings of the model ---- */

/* Writes the depth of focus of the camera. The diameter of a lens's opening is its focal length divided by its
 * f-number. POV-Ray's samples lie in half of its parameter `aperture` (tests/workers/focus.sh measures that). */
static void pov_focus(vs_emitter *e, const vs_look *l) {
  const vs_scene *s = e->scene;
  const char *samples = "4 confidence 0.5 variance 1/64";
  if (s->view != VS_VIEW_CAMERA || !(s->aperture > 0)) return;
  double away = vs_v3_dot(vs_v3_sub(vs_v3_scale(s->focus, e->unit), l->eye), l->forward);
  double opening = s->lens / 1000 / s->aperture * e->unit / vs_scene_metres(s);
  if (e->options->quality == VS_RENDER_GOOD) samples = "19 confidence 0.9 variance 1/128";
  if (e->options->quality == VS_RENDER_FINAL) samples = "61 confidence 0.95 variance 1/1024";
  pov_vector(e->out, "  focal_point ", vs_v3_add(l->eye, vs_v3_scale(l->forward, away)));
  pov_word(e->out, "\n  aperture ", 2 * opening, "\n  blur_samples ");
  vs_puts(e->out, samples);
  vs_puts(e->out, "\n");
}

static void pov_camera(vs_emitter *e, const vs_look *l, int width, int height) {
  vs_writer *w = e->out;
  vs_puts(w, "camera {\n");
  if (l->parallel) { /* writes look_at, because the camera's axes as written vectors would not be perpendicular to the
                      * last digit */
    vs_puts(w, "  orthographic\n");
    pov_vector(w, "  location ", l->eye);
    pov_vector(w, "\n  sky ", l->up);
    pov_word(w, "\n  right -x*", l->width, "\n");
    pov_word(w, "  up y*", l->width, "*image_height/image_width\n");
    pov_vector(w, "  look_at ", l->target);
    vs_puts(w, "\n}\n");
    return;
  }
  if (l->panorama) {
    uint32_t columns = (uint32_t)width, rows = (uint32_t)height;
    vs_puts(w, "  spherical\n");
    pov_vector(w, "  location ", l->eye);
    pov_vector(w, "\n  direction ", l->forward);
    /* POV-Ray rotates a panorama's rays around `right` and `up`, in left-handed coordinates. */
    pov_vector(w, "\n  right ", vs_v3_scale(l->right, -1));
    pov_vector(w, "\n  up ", vs_v3_scale(l->up, -1));
    pov_word(w, "\n  angle 360 ", vs_look_height(columns, rows) * (180 / pi), "\n}\n");
    return;
  }
  if (l->upright) { /* in an upright view, the picture plane is vertical, so `right` and `up` are not perpendicular to
                     * the line of sight */
    vs_vec3 level = vs_v3_unit(vs_v3(l->forward.x, l->forward.y, 0));
    double wide = 2 * tan(l->angle / 2);
    pov_vector(w, "  location ", l->eye);
    pov_vector(w, "\n  direction ", vs_v3_scale(l->forward, 1 / vs_v3_dot(l->forward, level)));
    pov_vector(w, "\n  right ", vs_v3_scale(l->right, wide));
    pov_word(w, "\n  up z*", wide, "*image_height/image_width\n");
    pov_focus(e, l);
    vs_puts(w, "}\n");
    return;
  }
  pov_vector(w, "  location ", l->eye);
  pov_vector(w, "\n  sky ", fabs(l->forward.z) > 0.999999 ? l->up : vs_v3(0, 0, 1));
  vs_puts(w, "\n  right -x*image_width/image_height\n");
  pov_word(w, "  angle ", l->angle * (180 / pi), "\n");
  pov_vector(w, "  look_at ", l->target);
  vs_puts(w, "\n");
  pov_focus(e, l);
  vs_puts(w, "}\n");
}

/* The place of the sun in the scene: the direction towards it, the middle of the drawing, and the sun's distance from
 * there. */
typedef struct { vs_vec3 sun, middle; double far; } pov_sun_place;

/* Writes the light of the sun or the moon. */
static void pov_direct_light(vs_emitter *e, const vs_look *l, const pov_sun_place *p) {
  vs_writer *w = e->out;
  vs_puts(w, "light_source {\n");
  pov_vector(w, "  ", vs_v3_add(p->middle, vs_v3_scale(p->sun, p->far)));
  if (pov_is_physical(e)) {
    vs_put_triple(w, "\n  color rgb <", pov_daylight(e, l).sun, ", ", ">");
  } else if (vs_look_sun_is_pictured(e->scene)) { /* the brightness of a white surface is the light that it receives,
                                                   * divided by pi */
    vs_vec3 light = vs_v3_scale(e->scene->picture_sun_light, 1 / pi);
    vs_put_triple(w, "\n  color rgb <", light, ", ", ">");
  } else {
    vs_puts(w, pov_is_developed(e) ? "\n  color rgb <1, 0.95, 0.87>" : "\n  color rgb <1, 0.94, 0.84>");
    pov_word(w, " * ", pov_sun_strength(e), "");
  }
  vs_puts(w, "\n  parallel\n");
  pov_vector(w, "  point_at ", p->middle);
  /* area_light gives shadows a soft edge; computing it takes several times as long as all other work */
  if (e->options->quality == VS_RENDER_FINAL || e->scene->style == VS_STYLE_MODEL) {
    /* The keyword `orient` rotates the area of the light towards the lit point, so only the lengths of its two vectors
     * matter. POV-Ray requires exactly equal lengths, so the vectors are parallel to the axes. */
    pov_vector(w, "\n  area_light ", vs_v3(0.012 * p->far, 0, 0));
    pov_vector(w, ", ", vs_v3(0, 0.012 * p->far, 0));
    vs_puts(w, ", 3, 3 adaptive 1 circular orient");
  }
  vs_puts(w, "\n}\n");
}

/* Writes three lights without shadows, because a draft has no radiosity. The first shines from the side opposite to the
 * sun and brightens the shadows. The second shines from the eye, the third from the ground. */
static void pov_fill_lights(vs_emitter *e, const vs_look *l, const pov_sun_place *p) {
  vs_writer *w = e->out;
  double fill = pov_fill_strength(e);
  /* scales `fill` by the light of this sky on a horizontal surface; for the plain sky it is 0.75 */
  if (pov_is_physical(e)) fill *= pov_daylight(e, l).fill / 0.75;
  else fill *= pov_dusk(e);
  pov_vector(w, "light_source { ", vs_v3_add(p->middle, vs_v3(-p->sun.x * p->far, -p->sun.y * p->far,
                                                              fabs(p->sun.z) * p->far)));
  vs_puts(w, " color rgb <0.4, 0.44, 0.5>");
  if (fill != 1) pov_word(w, " * ", fill, "");
  vs_puts(w, " shadowless parallel ");
  pov_vector(w, "point_at ", p->middle);
  pov_vector(w, " }\nlight_source { ", vs_v3_sub(p->middle, vs_v3_scale(l->forward, p->far)));
  pov_word(w, " color rgb ", 0.16 * fill, " shadowless parallel ");
  pov_vector(w, "point_at ", p->middle);
  pov_vector(w, " }\nlight_source { ", vs_v3_sub(p->middle, vs_v3(0, 0, p->far)));
  pov_word(w, " color rgb <0.13, 0.125, 0.115> * ", fill, " shadowless parallel ");
  pov_vector(w, "point_at ", p->middle);
  vs_puts(w, " }\n");
}

static void pov_sun(vs_emitter *e, const vs_look *l, double diagonal) {
  pov_sun_place p = { vs_look_sun(e->scene, l),
                      vs_v3_scale(vs_v3_add(e->bounds.min, e->bounds.max), 0.5 * e->unit), 20 * diagonal };
  if (!pov_is_sunless(e, l)) pov_direct_light(e, l, &p);
  if (e->options->quality == VS_RENDER_DRAFT) pov_fill_lights(e, l, &p);
}

/* Writes a picture as the sky. The middle of the picture is in the north, +Y. */
static void pov_sky_image(vs_emitter *e) {
  vs_writer *w = e->out;
  vs_puts(w, "sky_sphere {\n  pigment { image_map { ");
  bool taken = vs_look_sun_is_pictured(e->scene) && e->folder != NULL;
  if (!vs_povray_put_picture(e, taken ? e->scene->sky_sunless : e->scene->sky_image, 0)) w->failed = true;
  vs_puts(w, " map_type 1 interpolate 2 } rotate x*90 rotate -z*90 }\n}\n");
}

/* Returns true for a plain model, for which the program has set no ground, sky, lamps or fog. The program vs then adds
 * a pale ground at the model's lowest point, unless the eye is below it, where the ground would hide the model. */
static bool pov_is_studio(const vs_emitter *e, const vs_look *l) {
  const vs_scene *s = e->scene;
  bool above = l->parallel ? l->forward.z < -0.01 : l->eye.z > e->bounds.min.z * e->unit;
  return pov_is_developed(e) && above && !s->has_ground && !s->sky_given && s->lamp_count == 0 &&
         !(s->fog_visibility > 0) && !l->panorama;
}

typedef struct { vs_vec3 zenith, haze; } pov_air;

/* Returns the colours of the sky overhead and at the horizon, as values on a screen (sRGB). The sky above a plain model
 * is paler, so that shadows are less blue. */
static pov_air pov_air_of(const vs_emitter *e, const vs_look *l) {
  const vs_scene *s = e->scene;
  pov_air a = { vs_v3(0.46, 0.66, 0.9), vs_v3(0.93, 0.95, 0.96) };
  if (pov_is_studio(e, l)) a.zenith = vs_v3(0.76, 0.81, 0.88);
  if (vs_povray_is_white(s)) a.zenith = a.haze = vs_v3(0.97, 0.97, 0.97);
  if (!s->has_sky) return a;
  a.zenith = vs_v3(s->sky[0], s->sky[1], s->sky[2]);
  double pale = 0.45 * fmax(a.zenith.x, fmax(a.zenith.y, a.zenith.z));
  a.haze = vs_v3_add(vs_v3(pale, pale, pale), vs_v3_scale(a.zenith, 0.55));
  return a;
}

/* Returns the linear light of the sRGB colour c, multiplied by the strength. In a scene, the keyword srgb converts a
 * colour in the same way (IEC 61966-2-1). */
static vs_vec3 pov_light_of(vs_vec3 c, double strength) {
  double x[] = { c.x, c.y, c.z };
  for (int i = 0; i < 3; i++) x[i] = strength * (x[i] <= 0.04045 ? x[i] / 12.92 : pow((x[i] + 0.055) / 1.055, 2.4));
  return vs_v3(x[0], x[1], x[2]);
}

/* Returns the brightness of the floor that the sky sphere shows below the horizon. Two thirds of its light come from
 * the sun, the rest from the sky. */
static double pov_floor(const vs_emitter *e, const pov_air *air, bool sunless) {
  double full = pov_is_developed(e) ? 2.8 : 1, sky = 1;
  if (e->scene->has_sky) {
    const vs_vec3 plain = pov_light_of(vs_v3(0.93, 0.95, 0.96), 1), own = pov_light_of(air->haze, 1);
    sky = fmin(1, (0.2126 * own.x + 0.7152 * own.y + 0.0722 * own.z) /
                  (0.2126 * plain.x + 0.7152 * plain.y + 0.0722 * plain.z));
  }
  return full * ((sunless ? 0 : 2) + sky) / 3;
}

/* Writes the sky as bands of colour. From below to above: a pale floor below the horizon, haze at the horizon, and blue
 * (or the model's colour) above it. */
static void pov_sky(vs_emitter *e, const vs_look *l) {
  vs_writer *w = e->out;
  if (pov_is_physical(e)) {
    vs_povray_daylight day = pov_daylight(e, l);
    vs_povray_daylight_sky(w, &day);
    return;
  }
  if (e->scene->sky_image != NULL) {
    pov_sky_image(e);
    return;
  }
  pov_air air = pov_air_of(e, l);
  double above = pov_sky_strength(e), floor = pov_dusk(e) * pov_floor(e, &air, pov_is_sunless(e, l));
  double tint = vs_povray_is_white(e->scene) ? 0 : 0.01;
  struct { double at, strength; vs_vec3 color; } bands[] = {
      { 0, floor, vs_v3(0.78, 0.78, 0.78 - tint) }, { 0.36, floor, vs_v3(0.9, 0.9, 0.9 - tint) },
      { 0.5, above, air.haze },
      { 0.56, above, air.haze }, { 0.63, above, air.haze }, { 0.71, above, air.haze }, { 0.8, above, air.haze },
      { 0.9, above, air.haze }, { 1, above, air.zenith } };
  for (size_t i = 3; i < sizeof bands / sizeof *bands; i++) { /* the colour changes along a smooth curve, because a kink
                                                               * would be visible as an edge */
    double share = 1 - pow(2 - 2 * bands[i].at, 2.2);
    bands[i].color = vs_v3_add(vs_v3_scale(air.haze, 1 - share), vs_v3_scale(air.zenith, share));
  }
  vs_puts(w, "sky_sphere {\n  pigment {\n    gradient z\n    color_map {\n");
  for (size_t i = 0; i < sizeof bands / sizeof *bands; i++) {
    vs_putf(w, "      [%.2f color ", bands[i].at);
    bool screen = !pov_is_developed(e) && bands[i].strength == 1;
    vs_puts(w, screen ? "srgb " : "rgb ");
    vs_put_triple(w, "<", screen ? bands[i].color : pov_light_of(bands[i].color, bands[i].strength), ", ", ">]\n");
  }
  vs_puts(w, "    }\n    scale 2 translate -z\n  }\n}\n");
}

/* Writes a second layer of the ground: haze of the sky's colour, so that no line separates ground and sky. The haze
 * begins at NEAR times the size of the framed drawing, and is complete at FAR times that size. */
static void pov_ground_haze(vs_emitter *e, const vs_look *l, double diagonal, double z) {
  enum { COUNT = 10 };
  const double near = 1.3, far = 60, at[COUNT] = { far, 30, 15, 9, 6, 4, 3, 2.2, 1.7, near };
  vs_writer *w = e->out;
  vs_vec3 haze = pov_air_of(e, l).haze;
  vs_vec3 middle = vs_v3_scale(vs_v3_add(e->bounds.min, e->bounds.max), 0.5 * e->unit);
  vs_vec3 foot = vs_v3(middle.x, middle.y, z);
  bool physical = pov_is_physical(e);
  vs_puts(w, "  texture {\n    pigment { spherical ");
  vs_puts(w, physical ? "pigment_map {\n" : "color_map {\n");
  double reach = far * fmax(diagonal, vs_v3_length(vs_v3_sub(l->eye, middle)));
  for (int i = 0; i < COUNT; i++) {
    double clear = i == 0 ? 0 : 1 - pow(1 - near / at[i], 2.2);
    pov_word(w, "      [", 1 - at[i] / far, " ");
    if (physical) { /* The haze has the colour of the sky behind it, as seen from the eye. Positions are in the
                     * coordinates of the colour map. */
      pov_word(w, "VS_Sky(", clear, ") ");
      pov_vector(w, "translate ", vs_v3_scale(vs_v3_sub(l->eye, foot), 1 / reach));
      vs_puts(w, "]\n");
      continue;
    }
    vs_puts(w, "color srgbt <");
    for (int k = 0; k < 3; k++) pov_word(w, "", k == 0 ? haze.x : k == 1 ? haze.y : haze.z, ", ");
    pov_word(w, "", clear, ">]\n");
  }
  pov_word(w, "    } scale ", reach, "");
  pov_vector(w, " translate ", foot);
  pov_word(w, " }\n    finish { ambient 0 diffuse 0 emission ", physical ? 1 : pov_sky_strength(e), " }\n  }\n");
}

/* Returns the light of fog: the light of the sky at the horizon. Under a physical sky, it is the light of a cloud. A
 * cloud reflects 0.7 of the sun's and the sky's light, a grey floor 0.3. */
static vs_vec3 pov_fog_light(const vs_emitter *e, const vs_look *l) {
  if (pov_is_physical(e)) return vs_v3_scale(pov_daylight(e, l).floor, 0.7 / 0.3);
  return pov_light_of(pov_air_of(e, l).haze, e->scene->sky_image == NULL ? pov_sky_strength(e) : 1);
}

/* Writes the fog. Light decreases with the distance as exp(-x / distance); at the visibility (meteorological optical
 * range), a twentieth remains. Above its height, fog of type 2 becomes thinner, so the sky overhead is visible. */
static void pov_fog(vs_emitter *e, const vs_look *l) {
  const vs_scene *s = e->scene;
  vs_writer *w = e->out;
  if (!(s->fog_visibility > 0)) return;
  const vs_material *m = s->fog_color;
  vs_vec3 light = m ? pov_light_of(vs_v3(m->red, m->green, m->blue), pov_sky_strength(e)) : pov_fog_light(e, l);
  bool level = isfinite(s->fog_height);
  vs_puts(w, level ? "fog {\n  fog_type 2" : "fog {\n ");
  pov_word(w, " distance ", s->fog_visibility * e->unit / log(20), "");
  vs_put_triple(w, " color rgb <", light, ", ", ">");
  if (level) {
    double foot = s->has_ground ? s->ground_z : e->bounds.min.z;
    pov_word(w, " up z fog_offset ", (foot + s->fog_height) * e->unit, "");
    pov_word(w, " fog_alt ", s->fog_height * e->unit, "");
  }
  vs_puts(w, "\n}\n");
}

/* Writes the ground as an infinite plane, with haze at large distances. If the sky is a picture, which has its own
 * horizon, there is no haze. */
static void pov_ground(vs_emitter *e, const vs_look *l, double diagonal, double pixel) {
  vs_writer *w = e->out;
  bool plain = e->scene->style == VS_STYLE_MODEL || vs_povray_is_white(e->scene);
  const vs_material *m = plain ? NULL : e->scene->ground_material;
  bool studio = !e->scene->has_ground;
  double lift = 1e-5 * diagonal; /* lift: distance by which the ground is lowered, so that it is not coplanar with the
                                  * bottoms of objects */
  double z = (studio ? e->bounds.min.z : e->scene->ground_z) * e->unit - lift;
  if (m != NULL) vs_povray_prepare_texture(e, m, pixel);
  pov_word(w, "plane {\n  z, ", z, "\n  texture {\n");
  if (m != NULL) vs_povray_texture(e, m, pixel);
  else {
    const char *color = vs_povray_is_white(e->scene) ? "<0.85, 0.85, 0.85>"
                        : studio ? "<0.82, 0.82, 0.81>" : "<0.77, 0.76, 0.73>";
    vs_puts(w, "    pigment { color srgb ");
    vs_puts(w, color);
    pov_word(w, " }\n    finish { ambient ", vs_povray_ambient(e), " diffuse 0.8 }\n");
  }
  vs_puts(w, "  }\n");
  if (e->scene->sky_image == NULL) pov_ground_haze(e, l, diagonal, z);
  if (m != NULL) vs_povray_interior(e, m);
  vs_puts(w, "}\n");
}

/* Returns the settings for radiosity: the light that sky and walls reflect on each other. Without it, rooms are dark.
 *
 * count: a room with a small window needs many rays, few of which go through the window. error_bound 1 uses samples
 * within their error, and nearest_count many at a time. This costs less than more samples, and leaves no blotches on
 * walls. The setting minimum_reuse, a fraction of the picture's width, prevents a sample for each pixel of outdoor
 * detail: the example of the station takes a third of the time. The setting adc_bailout ends a ray that carries less
 * than a tenth of the light, such as reflections of panes: this again halves the station's time.
 *
 * With always_sample off, a point that the first pass (pretrace) has not sampled gets the light of its neighbours, or
 * without neighbours the mean of all samples, a grey patch. Therefore pretrace_end, also a fraction of the picture's
 * width, is so small that small faces in caves and coffers are sampled. In exchange, count is 100 instead of 150. */
static const char *pov_radiosity(vs_render_quality q) {
  switch (q) {
  case VS_RENDER_DRAFT: break;
  case VS_RENDER_GOOD:
    return "radiosity { count 100 error_bound 1 recursion_limit 3 nearest_count 20 low_error_factor 0.7 "
           "minimum_reuse 0.04 gray_threshold 0.3 brightness 1 adc_bailout 0.1 ";
  case VS_RENDER_FINAL:
    return "radiosity { count 600 error_bound 0.8 recursion_limit 3 nearest_count 20 low_error_factor 0.6 "
           "gray_threshold 0.3 brightness 1 ";
  }
  return "";
}

/* Writes the settings of radiosity. A run of POV-Ray that reads samples of light from a file computes as few new
 * samples as possible (povray_plan.c). */
static void pov_put_radiosity(vs_emitter *e) {
  vs_render_quality quality = e->options->quality;
  if (quality == VS_RENDER_DRAFT) return;
  vs_puts(e->out, pov_radiosity(quality));
  if (pov_is_developed(e))
    vs_puts(e->out, "#ifdef (VS_Samples) pretrace_start 1 pretrace_end 1 always_sample off #else ");
  vs_puts(e->out, "pretrace_start 0.08 pretrace_end 0.01 ");
  if (quality == VS_RENDER_GOOD) vs_puts(e->out, "always_sample off ");
  vs_puts(e->out, pov_is_developed(e) ? "#end }\n" : "}\n");
}

/* Returns the length of a model unit in the scene. Because POV-Ray has absolute tolerances, very small and very large
 * drawings are scaled by a power of ten to a size of some tens of units. */
static double pov_unit(double diagonal) {
  return diagonal > 0.1 && diagonal < 1e5 ? 1 : pow(10, 1 - floor(log10(diagonal)));
}

/* Returns half the width of a picture plane at the distance 1 from the eye. For a panorama, returns half a turn in
 * radians. */
static double pov_half_width(const vs_look *l) { return l->panorama ? pi : tan(l->angle / 2); }

/* Returns the data for the thickness of curves: at least two pixels and at least 1/450 of the picture's width. Points
 * very close to the camera, or behind it, are treated as if at a small distance. */
static vs_pen pov_pen(const vs_emitter *e, const vs_look *l, int width) {
  double across = fmax(2. / width, 1. / 450); /* thickness of curves as a fraction of the picture's width */
  if (l->parallel) return (vs_pen){ .least = across * l->width / 2 };
  double share = across * pov_half_width(l);
  return (vs_pen){ .eye = l->eye, .forward = l->forward, .share = share,
      .least = share * 1e-3 * vs_bounds_diagonal(&e->bounds) };
}

/* Returns the width of a pixel in the scene, at the nearest point of the drawing's bounding box. The camera l is in the
 * scene's units. */
static double pov_pixel(const vs_emitter *e, const vs_look *l, int width) {
  if (l->parallel) return l->width / width;
  const double low[] = { e->bounds.min.x, e->bounds.min.y, e->bounds.min.z };
  const double high[] = { e->bounds.max.x, e->bounds.max.y, e->bounds.max.z };
  const double eye[] = { l->eye.x, l->eye.y, l->eye.z };
  double square = 0;
  for (int i = 0; i < 3; i++) {
    double out = fmax(fmax(low[i] * e->unit - eye[i], eye[i] - high[i] * e->unit), 0);
    square += out * out;
  }
  double least = 0.02 * vs_bounds_diagonal(&e->bounds) * e->unit; /* least assumed distance to the nearest point, for an
                                                                   * eye among the walls */
  return fmax(sqrt(square), least) * 2 * pov_half_width(l) / width;
}

/* Returns the greatest distance of a chord from its arc, as a fraction of the drawing's tolerance. The distance is an
 * eighth of a pixel at the nearest point of the drawing, but between a sixteenth of the tolerance and the tolerance. */
static double pov_chord(const vs_emitter *e, double pixel) {
  if (e->job->limits.mesh_triangles > 0) return 1;
  return fmin(1, fmax(1. / 16, pixel / 8 / e->unit / e->drawing_facets.tolerance));
}

/* Warns, with the object's place, if the eye is inside an object, so that the picture shows only its dark inside.
 * Returns false with the error set. */
static bool pov_tell_eye(vs_emitter *e, const vs_look *look) {
  for (size_t i = 0; !look->parallel && i < e->scene->drawn_count; i++) {
    const vs_ref *r = &e->scene->drawn[i];
    vs_vec3 p = look->eye;
    vs_bounds b;
    bool inside = false;
    vs_error none = { 0 }; /* skips curves and surfaces, which have no inside */
    if (!vs_node_bounds(r->node, &b, &none) || p.x < b.min.x || p.y < b.min.y || p.z < b.min.z || p.x > b.max.x ||
        p.y > b.max.y || p.z > b.max.z)
      continue;
    if (vs_node_contains(r->node, p, &inside, &none) && inside &&
        !vs_emit_warn_once(e, r, "the camera is inside this object: the picture shows the object's inside"))
      return false;
  }
  return true;
}

static int pov_width(const vs_emitter *e) { return e->options->width > 0 ? e->options->width : 1024; }
static int pov_height(const vs_emitter *e) { return e->options->height > 0 ? e->options->height : 768; }

bool vs_povray_begin(vs_emitter *e) {
  vs_writer *w = e->out;
  int width = pov_width(e), height = pov_height(e);
  double diagonal = vs_v3_length(vs_v3_sub(e->bounds.max, e->bounds.min));
  if (!(diagonal > 0)) diagonal = 1;
  e->unit = pov_unit(diagonal);
  vs_puts(w, "// ");
  vs_povray_name(w, e->scene->title);
  vs_putf(w, ": a scene for POV-Ray 3.7, made by VisualScheme\n// povray +W%d +H%d +A0.1 THIS-FILE\n#version 3.7;\n",
          width, height);
  vs_puts(w, "global_settings {\n  assumed_gamma 1\n  max_trace_level 12\n  ");
  /* Light is reflected repeatedly between the faces of a pane. This setting ends a ray that carries less than a
   * fiftieth of a pixel's light. */
  if (pov_is_developed(e) && e->options->quality != VS_RENDER_FINAL) vs_puts(w, "adc_bailout 0.02\n  ");
  pov_put_radiosity(e);
  vs_puts(w, "}\n#default { texture { pigment { color srgb ");
  vs_puts(w, vs_povray_is_white(e->scene) ? "<0.93, 0.93, 0.93>" : "<0.86, 0.85, 0.83>");
  vs_puts(w, " } finish { ambient ");
  pov_word(w, "", vs_povray_ambient(e), " diffuse 0.82 } } }\n\n");
  vs_look look = vs_look_find(e->scene, &e->framed, e->boxes, e->box_count, (double)width / height);
  if (pov_is_developed(e) && !pov_tell_eye(e, &look)) return false;
  e->pen = pov_pen(e, &look, width);
  look.eye = vs_v3_scale(look.eye, e->unit), look.target = vs_v3_scale(look.target, e->unit), look.width *= e->unit;
  diagonal *= e->unit;
  double pixel = pov_pixel(e, &look, width);
  if (pov_is_developed(e)) e->facets.tolerance *= e->chord = pov_chord(e, pixel);
  if (e->unit != 1) {
    vs_puts(w, "// ");
    vs_put_number(w, 1 / e->unit);
    vs_puts(w, " units of the model are one here\n");
  }
  pov_camera(e, &look, width, height);
  pov_sun(e, &look, diagonal);
  pov_sky(e, &look);
  pov_fog(e, &look);
  if (!vs_povray_lamps(e, 1e-4 * pov_strength(e))) return false;
  vs_puts(w, "\n");
  for (size_t i = 1; i <= vs_emit_material_count(e); i++)
    vs_povray_declare_material(e, vs_emit_material_at(e, i), pixel);
  if (e->scene->has_ground || pov_is_studio(e, &look)) pov_ground(e, &look, diagonal, pixel);
  return !w->failed;
}

bool vs_povray_end(vs_emitter *e) {
  int width = pov_width(e), height = pov_height(e);
  return (e->scene->style != VS_STYLE_TECHNICAL || vs_povray_edges(e, width, height)) && !e->out->failed;
}

#define POVRAY_SHARED(more)                                                                                            \
  .begin = vs_povray_begin, .item = vs_povray_item, .end = vs_povray_end, .define = vs_povray_define, \
  .use = vs_povray_use, \
  .highlights = VS_MARKS_PAINT, .ghosts = VS_MARKS_PAINT, .family = "povray", .native = "povray",              \
  .traits = VS_SHOWS_GHOSTS_IN_DRAFTS | VS_PARTS_FLUSH | VS_INKS | VS_LAYS | VS_GROUPS | VS_KEEPS_TEXT | VS_FRAMES |   \
            (more),                                                                                                    \
  .emit = {                                                                                                            \
    [VS_LINE] = { vs_povray_line, "POV-Ray has no lines: curves are drawn as thin rods" },                             \
    [VS_ARC] = { NULL, NULL }, [VS_CIRCLE] = { NULL, NULL }, [VS_SPLINE] = { NULL, NULL },                             \
    [VS_REGION] = { vs_povray_region, NULL }, [VS_TEXT] = { vs_povray_region, NULL }, \
    [VS_BOX] = { vs_povray_box, NULL }, [VS_SPHERE] = { vs_povray_sphere, NULL }, \
    [VS_CYLINDER] = { vs_povray_cylinder, NULL }, [VS_CONE] = { vs_povray_cone, NULL }, \
    [VS_CUT_CONE] = { vs_povray_cut_cone, NULL }, \
    [VS_HALF_SPACE] = { vs_povray_half_space, NULL },                                                                  \
    [VS_E_CONE] = { vs_povray_e_cone, NULL }, [VS_SUPERELLIPSOID] = { vs_povray_superellipsoid, NULL },                \
    [VS_TORUS] = { vs_povray_torus, NULL }, [VS_REVOLVE] = { vs_povray_revolve, NULL }, \
    [VS_POLYFACE_MESH] = { vs_povray_polyface, NULL }, [VS_EXTRUDE] = { vs_povray_extrude, NULL }, \
    [VS_TRANSFORM] = { vs_povray_transform, NULL }, [VS_MATERIAL] = { vs_povray_material, NULL }, \
    [VS_LAYER] = { vs_povray_layer, NULL }, [VS_NATIVE] = { vs_povray_native, NULL }, \
    [VS_UNION] = { vs_povray_csg, NULL }, [VS_INTERSECTION] = { vs_povray_csg, NULL }, \
    [VS_DIFFERENCE] = { vs_povray_csg, NULL }, \
  }

const vs_backend vs_backend_povray = { POVRAY_SHARED(0) };
const vs_backend vs_backend_povray_png = { POVRAY_SHARED(VS_KEEPS_ORIGINS), .render = vs_povray_render_png };
const vs_backend vs_backend_povray_exr = { POVRAY_SHARED(VS_KEEPS_ORIGINS), .render = vs_povray_render_exr };
