/* Owns the physical sky of a POV-Ray scene: `(sky #:turbidity 3)`. The number 1 is 10,000 cd/m2, as vs falsecolor has
 * it, times the strength that the picture's light has. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_SKY_H
#define VS_BACKENDS_POVRAY_POVRAY_SKY_H

#include "backends/backend.h"
#include "geometry/sky_light.h"

typedef struct {
  vs_sky_light sky;
  double per_candela; /* the scene's number of 1 cd/m2 */
  vs_vec3 sun;        /* the light of the sun, as POV-Ray's colour of a light */
  vs_vec3 floor;      /* how bright a floor of middle grey lies under both */
  double fill;        /* a level surface's light from the sky, in the scene's numbers */
} vs_povray_daylight;

/* sun: towards it. strength: 1 in a picture that is developed. */
vs_povray_daylight vs_povray_daylight_of(const vs_scene *scene, vs_vec3 sun, double strength);
/* The macro VS_Sky(Transmit): a pigment of the sky's colours by the direction from the origin, below the horizon that
 * of the horizon; and the sphere round the scene. */
void vs_povray_daylight_sky(vs_writer *w, const vs_povray_daylight *d);

#endif
