/* Declares the removal of the sun from a picture of a whole sky. */
#ifndef VS_GEOMETRY_LIGHT_PANORAMA_SUN_H
#define VS_GEOMETRY_LIGHT_PANORAMA_SUN_H

#include "geometry/files/exr.h"
#include "model/vec.h"

typedef struct {
  vs_vec3 direction; /* unit, towards the sun; the picture's middle is the north, +Y, its top the zenith */
  vs_vec3 light;     /* illuminance of a surface perpendicular to the direction: the picture's numbers times their solid
                      * angles */
} vs_panorama_sun;

/* Finds the sun in a picture of light, twice as wide as high, and replaces it by the light around it. Returns false if
 * the picture has no sun; it is then unchanged. */
bool vs_panorama_take_sun(vs_exr *x, vs_panorama_sun *sun);

#endif
