/* Implements the torus about the Z direction. */
#include <math.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

static bool torus_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  (void)e;
  vs_reach_ball(b, a, VS_AS(torus, n)->center, VS_AS(torus, n)->radius, VS_AS(torus, n)->tube_radius);
  return true;
}

static bool torus_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  const struct vs_torus *x = VS_AS(torus, n);
  int around = vs_fineness_turn(f, x->radius + x->tube_radius, x->segments),
      across = vs_fineness_turn(f, x->tube_radius, x->segments);
  if (!vs_solid_fits(around, across, "torus", e)) return false;
  return vs_solid_torus(out, x->center, x->radius, x->tube_radius, around, across) || vs_error_memory(e, NULL);
}

static bool torus_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const double pi = 3.14159265358979323846;
  double r = VS_AS(torus, n)->radius, t = VS_AS(torus, n)->tube_radius;
  (void)area, (void)e;
  m->volume = 2 * pi * pi * r * t * t;
  m->area = 4 * pi * pi * r * t;
  if (t > r) { /* If the tube's disc crosses the axis, only its part on one side counts: the other part rotates within
                * the space of the first. */
    double a = acos(-r / t), s = sin(a);
    m->volume = 2 * pi * (r * t * t * (a - s * cos(a)) + 2.0 / 3 * t * t * t * s * s * s);
    m->area = 4 * pi * t * (r * a + t * s);
  }
  m->centroid = VS_AS(torus, n)->center;
  return true;
}

static bool torus_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_torus *x = VS_AS(torus, n);
  vs_vec3 d = vs_v3_sub(p, x->center);
  double across = hypot(d.x, d.y) - x->radius;
  (void)q, (void)height;
  return across * across + d.z * d.z <= x->tube_radius * x->tube_radius;
}

static vs_node *torus_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  VS_MOVED(torus, d.segments ? map->upright : map->level);
  d.center = vs_affine_point(a, d.center);
  d.radius *= map->scale;
  d.tube_radius *= map->scale;
  return vs_node_new(s, VS_TORUS, &d, NULL, 0);
}

static vs_node *torus_grown(vs_store *s, const vs_node *n, double by) {
  struct vs_torus d = *VS_AS(torus, n);
  d.tube_radius = fmin(d.tube_radius + by, d.radius);
  return vs_node_new(s, VS_TORUS, &d, NULL, 0);
}

VS_SHAPE(torus, NULL, torus_grown, NULL);
