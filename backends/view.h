/* Declares the view of a drawing: the camera, which shows all of the drawing, and the direction of the sun. All formats
 * use it. */
#ifndef VS_BACKENDS_VIEW_H
#define VS_BACKENDS_VIEW_H

#include "model/scene.h"

typedef struct {
  vs_vec3 eye, target;
  vs_vec3 right, up, forward; /* perpendicular unit vectors: the directions of the view */
  bool parallel;
  double angle;               /* horizontal field of view of a perspective, in radians; for a panorama, the field of
                               * view in formats that cannot show panoramas */
  double width;               /* width of the visible rectangle of a parallel view, in model units */
  bool upright;               /* whether the picture plane of a perspective is vertical, with the target in the centre
                               * of the picture */
  bool panorama;              /* whether the picture is a full turn around the eye, with `forward` horizontal and in the
                               * centre; equal angles then have equal lengths */
} vs_look;

/* Returns the look (camera) that shows the whole drawing. The aspect is the width of the picture divided by its height.
 * The look is centred on the centre of `bounds`, the bounds of the drawing. The `boxes` are the bounds of its parts, at
 * least one. */
vs_look vs_look_find(const vs_scene *scene, const vs_bounds *bounds, const vs_bounds *boxes, size_t box_count,
    double aspect);
/* Converts a point of the model to coordinates of the view: x to the right, y up, z away from the viewer. In a
 * perspective the origin is the eye. These coordinates are left-handed: a triangle seen from its front is clockwise. */
vs_vec3 vs_look_to_view(const vs_look *look, vs_vec3 p);
/* Converts a point from coordinates of the view to those of the model. */
vs_vec3 vs_look_from_view(const vs_look *look, vs_vec3 p);
/* A line of sight from a point. The component of its direction along `forward` is 1; in a panorama its direction is a
 * unit vector. */
typedef struct { vs_vec3 from, direction; } vs_look_line;
/* Returns the line of sight through the centre of the pixel in this column and row, counted from 0 at the upper
 * left. */
vs_look_line vs_look_ray(const vs_look *look, uint32_t columns, uint32_t rows, uint32_t column, uint32_t row);
/* Returns the vertical angle of a panorama in radians. Its pixels are square, unless the angle would then exceed half a
 * turn. */
double vs_look_height(uint32_t columns, uint32_t rows);
/* Returns true if the picture of the sky determines the sun's direction. A sun that the program sets has precedence. */
bool vs_look_sun_is_pictured(const vs_scene *scene);
/* Returns the unit vector towards the sun. If neither the scene nor the picture of its sky has a sun, the sun is behind
 * the viewer's left shoulder. */
vs_vec3 vs_look_sun(const vs_scene *scene, const vs_look *look);

#endif
