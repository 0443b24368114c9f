/* Declares the skies of a POV-Ray scene that have physical luminances: clear, overcast, night. A value of 1 in the
 * scene represents 10,000 cd/m2, as in vs falsecolor, divided by the gain and multiplied by the strength of the
 * picture's light. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_SKY_H
#define VS_BACKENDS_POVRAY_POVRAY_SKY_H

#include "backends/backend.h"
#include "geometry/sky_light.h"

typedef struct {
  vs_sky_light sky;
  double per_candela; /* value in the scene that represents a luminance of 1 cd/m2 */
  vs_vec3 sun;        /* light of the sun, as the colour of a light in POV-Ray */
  vs_vec3 floor;      /* brightness of a grey floor in the light of sun and sky, as a value of the scene */
  double fill;        /* light of the sky on a horizontal surface, as a value of the scene */
} vs_povray_daylight;

/* Returns the gain of the scene's light, a power of 2: 1 by day. In twilight and at night, the strength of every light
 * is multiplied by the gain. If vs makes the final picture, it divides the light by the gain again. */
double vs_povray_gain(const vs_scene *scene);
/* Returns the data of a scene's daylight. sun: direction towards the sun. strength: factor for the light; 1 if vs
 * converts it to the final picture. */
vs_povray_daylight vs_povray_daylight_of(const vs_scene *scene, vs_vec3 sun, double strength);
/* Writes the macro VS_Sky(Transmit): a pigment of the sky's colours by the direction from the origin. Directions below
 * the horizon have the horizon's colour. Also writes the sphere around the scene. */
void vs_povray_daylight_sky(vs_writer *w, const vs_povray_daylight *d);

#endif
