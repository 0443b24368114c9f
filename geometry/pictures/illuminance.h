/* Owns illuminance by a picture: the light that reaches a surface, from the light that it sends and the part of it that
 * it sends back. */
#ifndef VS_GEOMETRY_PICTURES_ILLUMINANCE_H
#define VS_GEOMETRY_PICTURES_ILLUMINANCE_H

#include "geometry/files/exr.h"

/* The channels of a picture that it goes by; at least one is NULL where the picture has no such. */
typedef struct { const float *light[3], *albedo[3], *upward; /* N.Z */ } vs_lit_surfaces;

vs_lit_surfaces vs_lit_surfaces_of(const vs_exr *x);
bool vs_lit_surfaces_are_known(const vs_lit_surfaces *s);
/* A matt surface of the reflectance r that gets E sends out E r / pi in every direction: so E is pi times its light
 * over its reflectance, by colours, weighed as luminance is, in the picture's numbers. A NaN: nothing is seen in the
 * pixel, or what is seen sends less than a two-hundredth back. */
double vs_illuminance_at(const vs_lit_surfaces *s, size_t pixel);
/* Is what the pixel shows a floor: a surface that looks up, within 3 degrees? */
bool vs_is_floor(const vs_lit_surfaces *s, size_t pixel);

#endif
