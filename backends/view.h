/* Owns the view of a drawing: the camera, framed to show everything, and the sun's place. All formats use it. */
#ifndef VS_BACKENDS_VIEW_H
#define VS_BACKENDS_VIEW_H

#include "model/scene.h"

typedef struct {
  vs_vec3 eye, target;
  vs_vec3 right, up, forward; /* unit, orthogonal */
  bool parallel;
  double angle;               /* horizontal field of view, radians; perspective. For a panorama, that of formats that
                               * cannot show one */
  double width;               /* of the visible rectangle, model units; parallel */
  bool upright;               /* perspective: the picture's plane is vertical, the target is in its centre */
  bool panorama;              /* a full turn about the eye, forward level and in the centre: equal angles have equal
                               * lengths */
} vs_look;

/* aspect: width divided by height of the picture. bounds: of the drawing; the look is centred on them. boxes: of its
 * parts, at least one. */
vs_look vs_look_find(const vs_scene *scene, const vs_bounds *bounds, const vs_bounds *boxes, size_t box_count,
    double aspect);
/* A line of sight. The direction has length 1 along the look's forward; in a panorama its own length is 1. */
typedef struct { vs_vec3 from, direction; } vs_look_line;
/* Returns the line of sight through the middle of a pixel, counted from 0 at the upper left. */
vs_look_line vs_look_ray(const vs_look *look, uint32_t columns, uint32_t rows, uint32_t column, uint32_t row);
/* Returns the vertical angle of a panorama, radians. Its pixels are square, unless they would reach past straight up
 * and down. */
double vs_look_height(uint32_t columns, uint32_t rows);
/* Returns true if the sun is that of the sky's picture. A sun that the program sets has precedence. */
bool vs_look_sun_is_pictured(const vs_scene *scene);
/* Returns the unit vector towards the sun. If neither the scene nor its sky's picture has a sun, it is a good one for
 * this look: over the viewer's left shoulder. */
vs_vec3 vs_look_sun(const vs_scene *scene, const vs_look *look);

#endif
