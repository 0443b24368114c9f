/* Owns what a back-end is handed: the drawn references and how to look at them. Plain data. */
#ifndef VS_MODEL_SCENE_H
#define VS_MODEL_SCENE_H

#include "model/node.h"

typedef enum { VS_VIEW_EXTENTS, VS_VIEW_CAMERA, VS_VIEW_TOP, VS_VIEW_BOTTOM, VS_VIEW_FRONT, VS_VIEW_BACK, VS_VIEW_LEFT, VS_VIEW_RIGHT, VS_VIEW_ISO } vs_view;

typedef struct {
  vs_store *store;           /* retained */
  vs_ref *drawn;             /* in drawing order; nodes retained */
  size_t drawn_count, drawn_room;
  const char *title;         /* interned; the model file's name without folder, or "model" */
  vs_view view;
  vs_vec3 eye, target;       /* VS_VIEW_CAMERA */
  double lens;               /* mm, 35 mm equivalent; 35 by default */
  bool has_sun;              /* else each back-end's pleasant default */
  double sun_azimuth, sun_altitude; /* degrees; azimuth clockwise from +Y */
  bool has_sky;
  double sky[3];             /* sRGB */
  const char *sky_image;     /* a file with the whole sky, twice as wide as high; NULL: none */
  const char *sky_format;    /* of it: "png" "jpeg" "exr" "hdr" */
  bool has_ground;
  double ground_z;
  const vs_material *ground_material; /* or NULL */
  const char *units;         /* "m", "mm", "cm", "in", "ft" */
  double tolerance;          /* chord height in model units; 0: by the rule of geometry/tessellate.h */
  int segments;              /* 0: by tolerance; --segments */
} vs_scene;

void vs_scene_init(vs_scene *scene, vs_store *store); /* retains the store */
bool vs_scene_draw(vs_scene *scene, vs_ref ref);      /* retains; false: out of memory */
void vs_scene_free(vs_scene *scene);

#endif
