/* Owns how bright and of what colour a clear sky and its sun are. The model is that of A. J. Preetham, P. Shirley and
 * B. Smits, A Practical Analytic Model for Daylight, SIGGRAPH 1999. */
#ifndef VS_GEOMETRY_SKY_LIGHT_H
#define VS_GEOMETRY_SKY_LIGHT_H

#include "model/vec.h"

/* The turbidities for which the model's polynomials give a sky: 2 a very clear one, 10 haze. */
#define VS_TURBIDITY_LEAST 2
#define VS_TURBIDITY_MOST 10

/* The sky's luminance Y in cd/m2 and its chromaticities x and y (CIE 1931). Each is, in a direction at the angle theta
 * from the zenith and gamma from the sun, scale (1 + A exp(B / cos theta)) (1 + C exp(D gamma) + E cos^2 gamma): the
 * distribution of R. Perez, R. Seals and J. Michalsky, Solar Energy 50(3), 1993. */
typedef struct {
  vs_vec3 sun;                                   /* unit, towards the sun, not below the horizon */
  struct { double scale, a, b, c, d, e; } of[3]; /* Y, x, y */
} vs_sky_light;

/* turbidity: within the limits above. sun: a unit vector; for a sun below the horizon the sky is that of sunrise. */
vs_sky_light vs_sky_light_of(double turbidity, vs_vec3 sun);
/* Luminance and chromaticities in a direction of length 1; what is below the horizon is as the horizon is. */
vs_vec3 vs_sky_light_xyy(const vs_sky_light *sky, vs_vec3 direction);
/* The same as linear sRGB in cd/m2; colours out of its gamut lack what would be negative. */
vs_vec3 vs_sky_light_at(const vs_sky_light *sky, vs_vec3 direction);
/* The light that a level surface gets from the whole sky, as linear sRGB in lx. */
vs_vec3 vs_sky_light_level(const vs_sky_light *sky);
/* The light that a surface square to the sun gets from it through the air, as linear sRGB in lx; nothing at an altitude
 * (in degrees) below the horizon. */
vs_vec3 vs_sky_light_sun(double turbidity, double altitude);

#endif
