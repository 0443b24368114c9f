/* Owns how a drawing is looked at: the camera, framed to show everything, and where the sun stands. All formats
 * ask here. */
#ifndef VS_BACKENDS_VIEW_H
#define VS_BACKENDS_VIEW_H

#include "model/scene.h"

typedef struct {
  vs_vec3 eye, target;
  vs_vec3 right, up, forward; /* unit, orthogonal */
  bool parallel;
  double angle;               /* horizontal field of view, radians; perspective. Of a panorama that of what shows none
                               * */
  double width;               /* of the visible rectangle, model units; parallel */
  bool upright;               /* perspective: the picture stands upright, its middle is the target */
  bool panorama;              /* all round the eye, forward level and in the middle: equal angles are equal lengths */
} vs_look;

/* aspect: width by height of the picture. bounds: of the drawing, which the look centres on; boxes: of its parts, at
 * least one. */
vs_look vs_look_find(const vs_scene *scene, const vs_bounds *bounds, const vs_bounds *boxes, size_t box_count,
    double aspect);
/* direction: its length along the look's forward is 1, and that of a panorama's is 1. */
typedef struct { vs_vec3 from, direction; } vs_look_line;
/* Returns the line of sight through the middle of a pixel, counted from 0 at the upper left. */
vs_look_line vs_look_ray(const vs_look *look, uint32_t columns, uint32_t rows, uint32_t column, uint32_t row);
/* The angle of a panorama's height, radians: its pixels are square, where it does not reach past straight up and
 * down. */
double vs_look_height(uint32_t columns, uint32_t rows);
/* Is the sun that of the sky's picture? A sun of the program's own goes before it. */
bool vs_look_sun_is_pictured(const vs_scene *scene);
/* Unit vector towards the sun; without a sun in the scene or its sky's picture a good one for this look: over the
 * viewer's left shoulder. */
vs_vec3 vs_look_sun(const vs_scene *scene, const vs_look *look);

#endif
