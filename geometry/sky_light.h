/* Declares the luminance and colour of a sky and of its sun or moon. The clear sky is that of A. J. Preetham, P.
 * Shirley and B. Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999. The overcast sky is type 1 of ISO
 * 15469. */
#ifndef VS_GEOMETRY_SKY_LIGHT_H
#define VS_GEOMETRY_SKY_LIGHT_H

#include "model/scene.h"
#include "model/vec.h"

/* Range of turbidities (haze of the air) for which the model's polynomials describe a sky: 2 is a very clear sky, 10 is
 * haze. */
#define VS_TURBIDITY_LEAST 2
#define VS_TURBIDITY_MOST 10

/* The distribution of the sky's luminance Y in cd/m2 and of its chromaticities x and y (CIE 1931). Each is scale (1 + A
 * exp(B / cos theta)) (1 + C exp(D gamma) + E cos^2 gamma), by R. Perez, R. Seals and J. Michalsky, Solar Energy 50(3),
 * 1993. theta, gamma: angles of a direction from the zenith and from the sun. */
typedef struct {
  vs_vec3 sun;                                   /* unit vector towards the sun, not below the horizon */
  struct { double scale, a, b, c, d, e; } of[3]; /* coefficients for the luminance Y (of[0]) and the chromaticities x
                                                  * and y (of[1], of[2]) in the formula of Perez */
} vs_sky_light;

/* Returns the clear sky. turbidity: from VS_TURBIDITY_LEAST to VS_TURBIDITY_MOST; sun: unit vector towards the sun.
 * With the sun below the horizon, the sky has the colours of sunrise and the measured illuminance of twilight from -6
 * degrees downwards. */
vs_sky_light vs_sky_light_of(double turbidity, vs_vec3 sun);
/* Returns the overcast sky; sun: unit vector towards the sun, which the clouds hide. The zenith is three times as
 * bright as the horizon. A horizontal surface has 300 + 21000 sin a lx, where a is the sun's altitude. */
vs_sky_light vs_sky_light_overcast(vs_vec3 sun);
/* Returns the night sky: blue overhead, with the light of a city at the horizon. A horizontal surface has 0.5 lx, as
 * under a clear sky over a large city. */
vs_sky_light vs_sky_light_night(void);
/* Returns the illuminance in twilight as a fraction of the illuminance at sunrise, for the sun's altitude in degrees; 1
 * if the altitude is at least 0. Below -18 degrees it does not decrease further. */
double vs_sky_light_twilight(double altitude);
/* Returns the sky of a scene whose sky_kind is not VS_SKY_PLAIN, for a unit vector towards the scene's sun. */
vs_sky_light vs_sky_light_of_scene(const vs_scene *scene, vs_vec3 sun);
/* Returns the illuminance of a surface perpendicular to the rays of the scene's sun, or at night of the moon, as linear
 * sRGB in lx. sun: unit vector towards the sun. Returns 0 if the sun is hidden by clouds, below the horizon, or turned
 * off. */
vs_vec3 vs_sky_light_sun_of_scene(const vs_scene *scene, vs_vec3 sun);
/* Returns the luminance Y in cd/m2 and the chromaticities x and y of the sky in a direction of length 1. Directions
 * below the horizon have the values of the horizon. */
vs_vec3 vs_sky_light_xyy(const vs_sky_light *sky, vs_vec3 direction);
/* Returns the light of the sky in a direction of length 1, as linear sRGB in cd/m2. Negative components, of a colour
 * outside the gamut, become 0. */
vs_vec3 vs_sky_light_at(const vs_sky_light *sky, vs_vec3 direction);
/* Returns the illuminance of a horizontal surface by the whole sky, as linear sRGB in lx. */
vs_vec3 vs_sky_light_level(const vs_sky_light *sky);
/* Returns the illuminance by the sun, through the atmosphere, of a surface perpendicular to its rays, as linear sRGB in
 * lx. altitude: the sun's angle above the horizon in degrees. If the sun is below the horizon, the result is 0. */
vs_vec3 vs_sky_light_sun(double turbidity, double altitude);

#endif
