/* Declares the removal of the sun from a picture of a whole sky. */
#ifndef VS_GEOMETRY_LIGHT_PANORAMA_SUN_H
#define VS_GEOMETRY_LIGHT_PANORAMA_SUN_H

#include "geometry/files/exr.h"
#include "model/vec.h"

typedef struct {
  vs_vec3 direction; /* unit vector towards the sun, with Z up; the middle of the picture is north (+Y), and its top is
                      * the zenith */
  vs_vec3 light;     /* illuminance (red, green, blue) that the sun gives to a surface perpendicular to its rays: the
                      * sum of its pixels' values times their solid angles */
} vs_panorama_sun;

/* Finds the sun in a picture of the sky that is twice as wide as high, and replaces it by the light around it. Returns
 * false if the picture has no sun; it is then unchanged. */
bool vs_panorama_take_sun(vs_exr *x, vs_panorama_sun *sun);

#endif
