/* Declares materials: the appearance of surfaces. The store keeps one copy of each (vs_store_material) until the store
 * is freed. */
#ifndef VS_MODEL_LOOKS_MATERIAL_H
#define VS_MODEL_LOOKS_MATERIAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/looks/picture.h"

typedef enum {
  VS_PATTERN_NONE,
#define VS_PATTERN(id, name, size, shows) VS_PATTERN_##id,
#include "model/looks/patterns.def"
  VS_PATTERN_PICTURE, /* a picture from a file; patterns.def has no row for it, since it has no name */
  VS_PATTERN_COUNT
} vs_pattern;

/* The pattern of a material. Formats that support patterns draw it on faces in its real size: upright on walls, along x
 * and y on floors. Other formats show only the material's colour. */
typedef struct {
  vs_pattern kind;
  double red, green, blue;     /* second colour of the pattern (joints, veins, grain): sRGB components, 0 to 1 */
  double size;                 /* width of one unit of the pattern, or of the picture, in metres; 0: the pattern's
                                * default */
  double angle;                /* rotation of the pattern on the face in degrees, anticlockwise seen from outside */
  const vs_picture *picture;   /* the picture if kind is VS_PATTERN_PICTURE, else NULL */
} vs_material_pattern;

typedef struct {
  const char *name;            /* name of the material, interned; "" for a material without a name */
  double red, green, blue;     /* colour of the material's surface: sRGB components, 0 to 1 */
  double roughness, metallic, transparency; /* roughness, metallic share and transparency of the surface, each from 0 to
                                             * 1 */
  double ior;                  /* refractive index; a transparent material of index 1 is thin and does not bend light */
  vs_material_pattern pattern;
} vs_material;

extern const vs_material vs_material_default;  /* the material that the procedure make-material returns if it is called
                                                * without keywords */
extern const double vs_pattern_darkening;      /* factor by which the second colour of a pattern is darker than the
                                                * material's colour */

uint64_t vs_material_hash(const vs_material *m);
vs_material vs_material_of_color(double red, double green, double blue); /* Returns a matt material of an sRGB colour
                                                                          * (components 0 to 1), without name and
                                                                          * pattern. */
const char *vs_pattern_name(vs_pattern p);               /* Returns the pattern's name; "none" for VS_PATTERN_NONE. */
bool vs_pattern_find(const char *name, vs_pattern *out); /* Sets *out to the pattern with this name. Returns false if no
                                                          * pattern has this name. */
double vs_pattern_size(const vs_material_pattern *p);    /* Returns the width of one unit of the pattern in metres:
                                                          * the width that the material sets, or else the pattern's
                                                          * default. */

/* Returns the height of one unit of the pattern, or of the picture, on the surface, in metres. */
double vs_pattern_height(const vs_material_pattern *p);

#endif
