/* Declares the computation of illuminance from a picture: the light that reaches a surface is computed from the light
 * that it reflects and its reflectance. */
#ifndef VS_GEOMETRY_PICTURES_ILLUMINANCE_H
#define VS_GEOMETRY_PICTURES_ILLUMINANCE_H

#include "geometry/files/exr.h"

/* The channels of a picture from which illuminance is computed. A pointer is NULL if the picture does not have its
 * channel. */
typedef struct { const float *light[3], *albedo[3], *upward; /* light, albedo: channels of light and of surface colour;
                                                              * upward: channel N.Z, the vertical component of the
                                                              * surface's normal */ } vs_lit_surfaces;

vs_lit_surfaces vs_lit_surfaces_of(const vs_exr *x);
bool vs_lit_surfaces_are_known(const vs_lit_surfaces *s);
/* Returns the illuminance of the surface at the pixel: pi / r times the reflected light, where r is the reflectance of
 * the matt surface. Returns NaN if the pixel shows no surface, or r is below a two-hundredth. */
double vs_illuminance_at(const vs_lit_surfaces *s, size_t pixel);
/* Returns true if the pixel shows a floor: a surface that faces up and is horizontal within 3 degrees. */
bool vs_is_floor(const vs_lit_surfaces *s, size_t pixel);

#endif
