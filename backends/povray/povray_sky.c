/* Writes the physical sky as functions of POV-Ray: a formula for the luminance Y and the colour x and y in each
 * direction, and a pigment for each of red, green and blue. The mean of the three pigments is the colour. */
#include "backends/povray/povray_sky.h"

#include <math.h>

static void word(vs_writer *w, const char *before, double x, const char *after) {
  vs_puts(w, before);
  vs_put_number(w, x);
  vs_puts(w, after);
}

double vs_povray_gain(const vs_scene *scene) {
  const double night = 0.5 / 5000; /* illuminance of the night, as a fraction of that of a dull day */
  double dark = scene->has_sun && scene->sky_image == NULL ? vs_sky_light_twilight(scene->sun_altitude) : 1;
  if (scene->sky_kind == VS_SKY_NIGHT) dark = night;
  return exp2(round(-log2(dark)));
}

vs_povray_daylight vs_povray_daylight_of(const vs_scene *scene, vs_vec3 sun, double strength) {
  const double pi = 3.14159265358979323846, grey = 0.3;
  vs_povray_daylight d = { .sky = vs_sky_light_of_scene(scene, sun), .per_candela = strength * 1e-4 };
  /* A white surface that faces a light of strength 1 has the brightness 1 in the scene. Its luminance is the
   * illuminance divided by pi. */
  double per_lux = d.per_candela / pi;
  vs_vec3 level = vs_sky_light_level(&d.sky);
  d.sun = vs_v3_scale(vs_sky_light_sun_of_scene(scene, sun), per_lux);
  d.floor = vs_v3_scale(vs_v3_add(vs_v3_scale(d.sun, fmax(0, sun.z)), vs_v3_scale(level, per_lux)), grey);
  d.fill = (0.2126 * level.x + 0.7152 * level.y + 0.0722 * level.z) * per_lux;
  return d;
}

/* Returns the greatest value of red, green and blue in the sky, which is the end of the pigments' colour maps. It is
 * the maximum over a grid of directions, with a tenth added as margin. */
static double brightest(const vs_povray_daylight *d) {
  vs_vec3 c = vs_sky_light_at(&d->sky, d->sky.sun);
  double most = fmax(c.x, fmax(c.y, c.z));
  for (int ring = 0; ring <= 45; ring++)
    for (int sector = 0; sector < 90; sector++) {
      double up = sin(2 * ring / 57.29577951308232), across = sqrt(1 - up * up), a = 4 * sector / 57.29577951308232;
      c = vs_sky_light_at(&d->sky, vs_v3(across * cos(a), across * sin(a), up));
      most = fmax(most, fmax(c.x, fmax(c.y, c.z)));
    }
  return 1.1 * most * d->per_candela;
}

void vs_povray_daylight_sky(vs_writer *w, const vs_povray_daylight *d) {
  static const char *const value[] = { "Y", "Cx", "Cy" };
  static const char *const light[] = { "R", "G", "B" };
  static const double from_xyz[3][3] = { { 3.2406, -1.5372, -0.4986 }, { -0.9689, 1.8758, 0.0415 },
                                         { 0.0557, -0.2040, 1.0570 } };
  double most = brightest(d);
  vs_puts(w, "// The sky by the formula of Perez, Seals and Michalsky (1993): a direction's height, its angle from the "
             "sun, luminance and chromaticities\n");
  vs_puts(w, "#declare VS_Up = function(x,y,z) { max(z/max(1e-9, sqrt(x*x + y*y + z*z)), .001) }\n");
  word(w, "#declare VS_Gap = function(x,y,z) { acos(max(-1, min(1, (x*", d->sky.sun.x, "");
  word(w, " + y*", d->sky.sun.y, "");
  word(w, " + max(0, z)*", d->sky.sun.z, ")/max(1e-9, sqrt(x*x + y*y + pow(max(0, z), 2)))))) }\n");
  for (int i = 0; i < 3; i++) {
    vs_puts(w, "#declare VS_");
    vs_puts(w, value[i]);
    word(w, " = function(h,g) { ", d->sky.of[i].scale * (i == 0 ? d->per_candela / most : 1), "");
    word(w, "*(1 + ", d->sky.of[i].a, "");
    word(w, "*exp(", d->sky.of[i].b, "/h))*(1 + ");
    word(w, "", d->sky.of[i].c, "*exp(");
    word(w, "", d->sky.of[i].d, "*g) + ");
    word(w, "", d->sky.of[i].e, "*pow(cos(g), 2)) }\n");
  }
  for (int i = 0; i < 3; i++) { /* conversion from Yxy: X = Y x/y, Z = Y (1 - x - y)/y */
    const double *k = from_xyz[i];
    vs_puts(w, "#declare VS_");
    vs_puts(w, light[i]);
    word(w, " = function(h,g) { max(0, min(.9999, VS_Y(h,g)*((", k[0] - k[2], "*VS_Cx(h,g) + ");
    word(w, "", k[2], ")/VS_Cy(h,g) + ");
    word(w, "", k[1] - k[2], "))) }\n");
  }
  vs_puts(w, "#macro VS_Sky(Transmit) average pigment_map {");
  for (int i = 0; i < 3; i++) {
    vs_puts(w, "\n  [1 function { VS_");
    vs_puts(w, light[i]);
    vs_puts(w, "(VS_Up(x,y,z), VS_Gap(x,y,z)) } color_map { [0 rgbt <0, 0, 0, Transmit>] [1 rgbt <");
    for (int k = 0; k < 3; k++) word(w, "", k == i ? 3 * most : 0, ", ");
    vs_puts(w, "Transmit>] }]");
  }
  vs_puts(w, " } #end\nsky_sphere {\n  pigment {\n    function { .5 + .4999*z }\n    pigment_map {\n");
  vs_put_triple(w, "      [0 color rgb <", vs_v3_scale(d->floor, 0.8), ", ", ">]\n");
  vs_put_triple(w, "      [.36 color rgb <", d->floor, ", ", ">]\n");
  vs_puts(w, "      [.5 VS_Sky(0)]\n      [1 VS_Sky(0)]\n    }\n  }\n}\n");
}
