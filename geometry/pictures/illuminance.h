/* Declares illuminance from a picture: the light that reaches a surface, from the light that it reflects and its
 * reflectance. */
#ifndef VS_GEOMETRY_PICTURES_ILLUMINANCE_H
#define VS_GEOMETRY_PICTURES_ILLUMINANCE_H

#include "geometry/files/exr.h"

/* The channels of a picture that illuminance uses; if the picture lacks one, at least one is NULL. */
typedef struct { const float *light[3], *albedo[3], *upward; /* N.Z */ } vs_lit_surfaces;

vs_lit_surfaces vs_lit_surfaces_of(const vs_exr *x);
bool vs_lit_surfaces_are_known(const vs_lit_surfaces *s);
/* Returns the illuminance. A matt surface of reflectance r that receives E reflects E r / pi in every direction.
 * Therefore E is pi times its light divided by its reflectance, for each colour, weighted as luminance, in the
 * picture's units. NaN: the pixel shows nothing, or a surface with a reflectance below a two-hundredth. */
double vs_illuminance_at(const vs_lit_surfaces *s, size_t pixel);
/* Returns true if the pixel shows a floor: a surface that is level within 3 degrees and faces up. */
bool vs_is_floor(const vs_lit_surfaces *s, size_t pixel);

#endif
