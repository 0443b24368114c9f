/* Declares the luminance and colour of a clear sky and its sun. The model is that of A. J. Preetham, P. Shirley and B.
 * Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999. */
#ifndef VS_GEOMETRY_SKY_LIGHT_H
#define VS_GEOMETRY_SKY_LIGHT_H

#include "model/vec.h"

/* The range of turbidities for which the model's polynomials give a sky: 2 is a very clear sky, 10 is haze. */
#define VS_TURBIDITY_LEAST 2
#define VS_TURBIDITY_MOST 10

/* The sky's luminance Y in cd/m2 and its chromaticities x and y (CIE 1931). In a direction at the angle theta from the
 * zenith and gamma from the sun, each is scale (1 + A exp(B / cos theta)) (1 + C exp(D gamma) + E cos^2 gamma): the
 * distribution of R. Perez, R. Seals and J. Michalsky, Solar Energy 50(3), 1993. */
typedef struct {
  vs_vec3 sun;                                   /* unit, towards the sun, not below the horizon */
  struct { double scale, a, b, c, d, e; } of[3]; /* Y, x, y */
} vs_sky_light;

/* Returns the sky for a turbidity within the limits above and a unit vector towards the sun. For a sun below the
 * horizon it is the sky of sunrise. */
vs_sky_light vs_sky_light_of(double turbidity, vs_vec3 sun);
/* Returns luminance and chromaticities in a direction of length 1; below the horizon, those at the horizon. */
vs_vec3 vs_sky_light_xyy(const vs_sky_light *sky, vs_vec3 direction);
/* Returns the same as linear sRGB in cd/m2; components that a colour outside the gamut would make negative are 0. */
vs_vec3 vs_sky_light_at(const vs_sky_light *sky, vs_vec3 direction);
/* Returns the illuminance of a level surface from the whole sky, as linear sRGB in lx. */
vs_vec3 vs_sky_light_level(const vs_sky_light *sky);
/* Returns the sun's illuminance, through the atmosphere, of a surface perpendicular to its rays, as linear sRGB in lx;
 * 0 if the altitude (degrees) is below the horizon. */
vs_vec3 vs_sky_light_sun(double turbidity, double altitude);

#endif
