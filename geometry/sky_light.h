/* Declares the luminance and colour of a clear sky and its sun. The model is that of A. J. Preetham, P. Shirley and B.
 * Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999. */
#ifndef VS_GEOMETRY_SKY_LIGHT_H
#define VS_GEOMETRY_SKY_LIGHT_H

#include "model/vec.h"

/* Range of turbidities for which the model's polynomials describe a sky: 2 is a very clear sky, 10 is haze. */
#define VS_TURBIDITY_LEAST 2
#define VS_TURBIDITY_MOST 10

/* The distribution of the sky's luminance Y in cd/m2 and of its chromaticities x and y (CIE 1931). theta is the angle
 * of a direction from the zenith, gamma its angle from the sun. Each quantity is scale (1 + A exp(B / cos theta)) (1 +
 * C exp(D gamma) + E cos^2 gamma). The formula is that of R. Perez, R. Seals and J. Michalsky, Solar Energy 50(3),
 * 1993. */
typedef struct {
  vs_vec3 sun;                                   /* unit vector towards the sun, not below the horizon */
  struct { double scale, a, b, c, d, e; } of[3]; /* coefficients of Y, x and y, in this order */
} vs_sky_light;

/* Returns the sky for a turbidity from VS_TURBIDITY_LEAST to VS_TURBIDITY_MOST and a unit vector towards the sun. For a
 * sun below the horizon, returns the sky at sunrise. */
vs_sky_light vs_sky_light_of(double turbidity, vs_vec3 sun);
/* Returns luminance Y and chromaticities x and y of the sky in a direction of length 1. Below the horizon, they are
 * those at the horizon. */
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
