/* Computes the camera's position and the direction of the sun (view.h).
 *
 * The directions of the view are fixed (right r, up u, forward f), and the camera must show the whole drawing. Each
 * corner of the bounds limits the position of the eye from two sides. A corner with the coordinates (x, y, z) along r,
 * u, f is inside the picture if |x - ex| <= (z + D) t. Here t is the tangent of half the angle of view, D the distance
 * of the eye behind the origin of these coordinates, and ex its shift along r. The maxima of x - z t and of -x - z t
 * over the corners determine the smallest D, and its ex. The same computation for y gives another D. The camera uses
 * the greater D. */
#include "backends/view.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static vs_vec3 look_unit(vs_vec3 v) {
  double length = vs_v3_length(v);
  return length > 0 ? vs_v3_scale(v, 1 / length) : vs_v3(0, 0, 1);
}

static void look_axes(vs_look *l, vs_vec3 forward, vs_vec3 up) {
  l->forward = look_unit(forward);
  vs_vec3 right = vs_v3_cross(l->forward, up);
  if (vs_v3_length(right) < 1e-9 * vs_v3_length(up)) right = vs_v3_cross(l->forward, vs_v3(0, 1, 0));
  l->right = look_unit(right);
  l->up = vs_v3_cross(l->right, l->forward);
}

static void look_frame(vs_look *l, const vs_bounds *b, const vs_bounds *boxes, size_t box_count, double aspect) {
  const double margin = 1.08;
  vs_vec3 middle = vs_v3_scale(vs_v3_add(b->min, b->max), 0.5);
  double diagonal = vs_v3_length(vs_v3_sub(b->max, b->min));
  double tx = tan(l->angle / 2) / margin, ty = tan(l->angle / 2) / aspect / margin;
  double right = -INFINITY, left = -INFINITY, top = -INFINITY, bottom = -INFINITY;
  double x_min = INFINITY, x_max = -INFINITY, y_min = INFINITY, y_max = -INFINITY;
  for (size_t i = 0; i < 8 * box_count; i++) {
    const vs_bounds *box = &boxes[i / 8];
    vs_vec3 corner = vs_v3_sub(vs_v3((i & 1) ? box->max.x : box->min.x, (i & 2) ? box->max.y : box->min.y, (i & 4)
        ? box->max.z : box->min.z), middle);
    double x = vs_v3_dot(corner, l->right), y = vs_v3_dot(corner, l->up), z = vs_v3_dot(corner, l->forward);
    right = fmax(right, x - z * tx);
    left = fmax(left, -x - z * tx);
    top = fmax(top, y - z * ty);
    bottom = fmax(bottom, -y - z * ty);
    x_min = fmin(x_min, x), x_max = fmax(x_max, x);
    y_min = fmin(y_min, y), y_max = fmax(y_max, y);
  }
  if (l->parallel) {
    l->width = margin * fmax(x_max - x_min, (y_max - y_min) * aspect);
    if (!(l->width > 0)) l->width = 1;
    l->target = vs_v3_add(middle, vs_v3_add(vs_v3_scale(l->right, (x_min + x_max) / 2), vs_v3_scale(l->up,
        (y_min + y_max) / 2)));
    l->eye = vs_v3_sub(l->target, vs_v3_scale(l->forward, 2 * diagonal + l->width));
    return;
  }
  double distance = fmax((right + left) / (2 * tx), (top + bottom) / (2 * ty));
  if (!(distance > 0)) distance = 1;
  double dx = (right - left) / 2, dy = (top - bottom) / 2;
  l->target = vs_v3_add(middle, vs_v3_add(vs_v3_scale(l->right, dx), vs_v3_scale(l->up, dy)));
  l->eye = vs_v3_sub(l->target, vs_v3_scale(l->forward, distance));
}

vs_look vs_look_find(const vs_scene *scene, const vs_bounds *bounds, const vs_bounds *boxes, size_t box_count,
    double aspect) {
  const double film = 36; /* width of 35 mm film in mm, by which a lens's focal length determines the field of view */
  vs_look l = { .angle = 2 * atan(film / 2 / 45) };
  vs_vec3 up = vs_v3(0, 0, 1), north = vs_v3(0, 1, 0);
  switch (scene->view) {
  case VS_VIEW_CAMERA:
    l.angle = 2 * atan(film / 2 / (scene->lens > 0 ? scene->lens : 35));
    l.eye = scene->eye;
    l.target = scene->target;
    look_axes(&l, vs_v3_sub(l.target, l.eye), up);
    l.upright = scene->upright;
    return l;
  case VS_VIEW_PANORAMA:
    l.eye = scene->eye, l.target = scene->target, l.angle = pi / 2, l.panorama = true;
    vs_vec3 ahead = vs_v3_sub(l.target, l.eye);
    look_axes(&l, vs_v3(ahead.x, ahead.y, 0), up);
    return l;
  case VS_VIEW_ALONG: l.parallel = true; look_axes(&l, vs_v3_sub(scene->target, scene->eye), up); break;
  case VS_VIEW_EXTENTS: look_axes(&l, vs_v3(-0.62, 1, -0.5), up); break;
  case VS_VIEW_TOP: l.parallel = true; look_axes(&l, vs_v3(0, 0, -1), north); break;
  case VS_VIEW_BOTTOM: l.parallel = true; look_axes(&l, vs_v3(0, 0, 1), north); break;
  case VS_VIEW_FRONT: l.parallel = true; look_axes(&l, vs_v3(0, 1, 0), up); break;
  case VS_VIEW_BACK: l.parallel = true; look_axes(&l, vs_v3(0, -1, 0), up); break;
  case VS_VIEW_LEFT: l.parallel = true; look_axes(&l, vs_v3(1, 0, 0), up); break;
  case VS_VIEW_RIGHT: l.parallel = true; look_axes(&l, vs_v3(-1, 0, 0), up); break;
  case VS_VIEW_ISO: l.parallel = true; look_axes(&l, vs_v3(-1, 1, -1), up); break;
  }
  look_frame(&l, bounds, boxes, box_count, aspect);
  return l;
}

bool vs_look_sun_is_pictured(const vs_scene *scene) { return scene->sky_sunless != NULL && !scene->has_sun; }

vs_vec3 vs_look_sun(const vs_scene *scene, const vs_look *look) {
  const double degree = pi / 180;
  if (scene->has_sun) {
    double azimuth = scene->sun_azimuth * degree, altitude = scene->sun_altitude * degree;
    return vs_v3(sin(azimuth) * cos(altitude), cos(azimuth) * cos(altitude), sin(altitude));
  }
  if (vs_look_sun_is_pictured(scene)) return scene->picture_sun;
  /* The sun is on the viewer's side of the model, and to the left of the line of sight. In a view from above, the sun
   * is at the upper left, as on maps. */
  vs_vec3 near = vs_v3(-look->forward.x, -look->forward.y, 0), left = vs_v3(-look->right.x, -look->right.y, 0);
  if (vs_v3_length(near) < 0.2) near = vs_v3(look->up.x, look->up.y, 0);
  vs_vec3 across = look_unit(vs_v3_add(vs_v3_scale(look_unit(near), 0.62), vs_v3_scale(look_unit(left), 0.78)));
  return vs_v3(across.x * cos(44 * degree), across.y * cos(44 * degree), sin(44 * degree));
}

vs_vec3 vs_look_to_view(const vs_look *l, vs_vec3 p) {
  vs_vec3 d = l->parallel ? p : vs_v3_sub(p, l->eye);
  return vs_v3(vs_v3_dot(d, l->right), vs_v3_dot(d, l->up), vs_v3_dot(d, l->forward));
}

vs_vec3 vs_look_from_view(const vs_look *l, vs_vec3 p) {
  vs_vec3 flat = vs_v3_add(vs_v3_scale(l->right, p.x), vs_v3_scale(l->up, p.y));
  vs_vec3 d = vs_v3_add(flat, vs_v3_scale(l->forward, p.z));
  return l->parallel ? d : vs_v3_add(l->eye, d);
}

double vs_look_height(uint32_t columns, uint32_t rows) { return fmin(2 * pi * rows / columns, pi); }

vs_look_line vs_look_ray(const vs_look *look, uint32_t columns, uint32_t rows, uint32_t column, uint32_t row) {
  double x = (column + 0.5) / columns * 2 - 1, y = (1 - (row + 0.5) / rows * 2) * rows / columns;
  if (look->panorama) {
    double round = x * pi, above = (0.5 - (row + 0.5) / rows) * vs_look_height(columns, rows);
    vs_vec3 level = vs_v3_add(vs_v3_scale(look->forward, cos(round)), vs_v3_scale(look->right, sin(round)));
    vs_vec3 direction = vs_v3_add(vs_v3_scale(level, cos(above)), vs_v3_scale(look->up, sin(above)));
    return (vs_look_line){ look->eye, direction };
  }
  double half = look->parallel ? look->width / 2 : tan(look->angle / 2);
  vs_vec3 ahead = look->forward, up = look->up;
  if (look->upright && !look->parallel) { /* in an upright view, the picture plane is vertical */
    vs_vec3 level = vs_v3_unit(vs_v3(look->forward.x, look->forward.y, 0));
    ahead = vs_v3_scale(look->forward, 1 / vs_v3_dot(look->forward, level)), up = vs_v3(0, 0, 1);
  }
  vs_vec3 aside = vs_v3_add(vs_v3_scale(look->right, x * half), vs_v3_scale(up, y * half));
  if (look->parallel) return (vs_look_line){ vs_v3_add(look->eye, aside), look->forward };
  return (vs_look_line){ look->eye, vs_v3_add(ahead, aside) };
}
