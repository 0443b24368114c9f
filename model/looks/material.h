/* Owns materials: the looks of surfaces. The store interns them by value (vs_store_material); they live as long as
 * it. */
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
  VS_PATTERN_PICTURE, /* a picture from a file: it has no row in the table, since it has no name */
  VS_PATTERN_COUNT
} vs_pattern;

/* The pattern of a material. Back-ends with patterns lay it on faces in its real size: upright on walls, along x and y
 * on floors. Other back-ends show only the material's colour. */
typedef struct {
  vs_pattern kind;
  double red, green, blue;     /* the second colour: of joints, veins, grain; sRGB, 0..1 */
  double size;                 /* the width of one unit, or of a picture, in metres; 0: the pattern's own */
  double angle;                /* its rotation on the face in degrees, anticlockwise seen from outside */
  const vs_picture *picture;   /* of VS_PATTERN_PICTURE; NULL: none */
} vs_material_pattern;

typedef struct {
  const char *name;            /* interned; "": it has no name */
  double red, green, blue;     /* sRGB, 0..1 */
  double roughness, metallic, transparency; /* 0..1 */
  double ior;                  /* index of refraction; 1 for a transparent material: it is thin, and light passes
                                * straight */
  vs_material_pattern pattern;
} vs_material;

uint64_t vs_material_hash(const vs_material *m);
vs_material vs_material_of_color(double red, double green, double blue); /* sRGB; matt paint, no name, no pattern */
const char *vs_pattern_name(vs_pattern p);               /* returns "none" for VS_PATTERN_NONE */
bool vs_pattern_find(const char *name, vs_pattern *out); /* returns false if no pattern has that name */
double vs_pattern_size(const vs_material_pattern *p);    /* in metres: the material's own, or else the pattern's */

/* Returns the height of the pattern's picture in metres. */
double vs_pattern_height(const vs_material_pattern *p);

#endif
