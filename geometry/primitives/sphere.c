/* Implements the sphere. */
#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool sphere_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  (void)e;
  vs_reach_ball(b, a, VS_AS(sphere, n)->center, 0, VS_AS(sphere, n)->radius);
  return true;
}

static bool sphere_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  const struct vs_sphere *x = VS_AS(sphere, n);
  int turn = vs_fineness_turn(f, x->radius, x->segments);
  return vs_solid_fits(turn, turn / 2, "sphere", e) &&
         (vs_solid_sphere(out, x->center, x->radius, turn) || vs_error_memory(e, NULL));
}

static bool sphere_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const double pi = 3.14159265358979323846;
  double r = VS_AS(sphere, n)->radius;
  (void)area, (void)e;
  m->volume = 4 * pi / 3 * r * r * r;
  m->area = 4 * pi * r * r;
  m->centroid = VS_AS(sphere, n)->center;
  return true;
}

static bool sphere_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  vs_vec3 d = vs_v3_sub(p, VS_AS(sphere, n)->center);
  (void)q, (void)height;
  return vs_v3_dot(d, d) <= VS_AS(sphere, n)->radius * VS_AS(sphere, n)->radius;
}

static vs_node *sphere_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  VS_MOVED(sphere, d.segments ? map->upright : map->even);
  d.center = vs_affine_point(a, d.center);
  d.radius *= map->scale;
  return vs_node_new(s, VS_SPHERE, &d, NULL, 0);
}

static vs_node *sphere_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_sphere d = *VS_AS(sphere, n);
  d.radius += by;
  return vs_node_new(s, VS_SPHERE, &d, NULL, 0);
}

VS_SHAPE(sphere, NULL, sphere_grown, NULL);
