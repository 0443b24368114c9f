/* Declares the skies of a POV-Ray scene that have luminances: clear, overcast, night. The number 1 means 10,000 cd/m2,
 * as in vs falsecolor, divided by the gain and times the strength of the picture's light. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_SKY_H
#define VS_BACKENDS_POVRAY_POVRAY_SKY_H

#include "backends/backend.h"
#include "geometry/sky_light.h"

typedef struct {
  vs_sky_light sky;
  double per_candela; /* number in the scene that means 1 cd/m2 */
  vs_vec3 sun;        /* light of the sun, as the colour of a light in POV-Ray */
  vs_vec3 floor;      /* brightness of a middle grey floor in the light of sun and sky, in the scene's numbers */
  double fill;        /* light of the sky on a horizontal surface, in the scene's numbers */
} vs_povray_daylight;

/* Returns the gain of the scene's light, a power of 2: 1 by day. In twilight and at night, all lights of the scene are
 * multiplied by the gain, because POV-Ray smooths no edge between two dark colours, and half floats have few digits
 * below 0.0001. A picture that vs develops is divided by the gain again. */
double vs_povray_gain(const vs_scene *scene);
/* Returns the daylight of a scene. sun: direction towards the sun. strength: 1 in a picture that vs develops. */
vs_povray_daylight vs_povray_daylight_of(const vs_scene *scene, vs_vec3 sun, double strength);
/* Writes the macro VS_Sky(Transmit): a pigment of the sky's colours by the direction from the origin. Directions below
 * the horizon have the horizon's colour. Also writes the sphere around the scene. */
void vs_povray_daylight_sky(vs_writer *w, const vs_povray_daylight *d);

#endif
