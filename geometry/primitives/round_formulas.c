/* Implements formulas that several round shapes share. */
#include "geometry/primitives/round_formulas.h"

#include <math.h>

#include "geometry/measure/reach.h"
#include "geometry/primitives/solid_triangles.h"

static const double pi = 3.14159265358979323846;

void vs_frustum_measure(vs_measure *m, vs_vec3 base, double r, vs_vec3 top, double s) {
  vs_vec3 axis = vs_v3_sub(top, base);
  double h = vs_v3_length(axis), weight = r * r + r * s + s * s;
  m->volume = pi * h * weight / 3;
  m->area = pi * (r * r + s * s + (r + s) * hypot(h, r - s));
  m->centroid = vs_v3_add(base, vs_v3_scale(axis, weight > 0 ? (r * r + 2 * r * s + 3 * s * s) / (4 * weight) : 0.5));
}

bool vs_frustum_holds(vs_vec3 q, double height, double base_radius, double top_radius) {
  if (q.z < 0 || q.z > height) return false;
  double r = base_radius + (top_radius - base_radius) * q.z / height;
  return q.x * q.x + q.y * q.y <= r * r;
}

/* ---- the cylinder, the cone and the cut cone; all three are treated as cut cones ---- */

typedef struct {
  vs_vec3 base, top;
  double base_radius, top_radius;
  int segments;
} frustum;

/* Returns the cut cone that equals n, which is a cylinder, cone or cut cone. */
static frustum frustum_of(const vs_node *n) {
  VS_ASSERT(n->kind == VS_CYLINDER || n->kind == VS_CONE || n->kind == VS_CUT_CONE);
  if (n->kind == VS_CYLINDER) {
    const struct vs_cylinder *x = VS_AS(cylinder, n);
    return (frustum) { x->base, x->top, x->radius, x->radius, (int)x->segments };
  }
  if (n->kind == VS_CONE) {
    const struct vs_cone *x = VS_AS(cone, n);
    return (frustum) { x->base, x->apex, x->radius, 0, (int)x->segments };
  }
  const struct vs_cut_cone *x = VS_AS(cut_cone, n);
  return (frustum) { x->base, x->top, x->base_radius, x->top_radius, (int)x->segments };
}

bool vs_round_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  frustum x = frustum_of(n);
  vs_vec3 axis = vs_v3_sub(x.top, x.base);
  (void)e;
  vs_reach_disc(b, a, x.base, axis, x.base_radius);
  vs_reach_disc(b, a, x.top, axis, x.top_radius);
  return true;
}

bool vs_round_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  frustum x = frustum_of(n);
  int turn = vs_fineness_turn(f, fmax(x.base_radius, x.top_radius), x.segments);
  vs_disc base = { x.base, x.base_radius }, top = { x.top, x.top_radius };
  return vs_solid_frustum(out, base, top, turn, true) || vs_error_memory(e, NULL);
}

bool vs_round_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  frustum x = frustum_of(n);
  (void)area, (void)e;
  vs_frustum_measure(m, x.base, x.base_radius, x.top, x.top_radius);
  return true;
}

bool vs_round_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  frustum x = frustum_of(n);
  (void)p;
  return vs_frustum_holds(q, height, x.base_radius, x.top_radius);
}

void vs_round_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  frustum x = frustum_of(n);
  *base = x.base, *top = x.top;
}

/* Computes the circumference of the ellipse with half axes a and b by the arithmetic-geometric mean: 2 pi (a^2 - sum of
 * 2^(k-1) c_k^2) / agm(a, b). */
double vs_ellipse_length(double a, double b) {
  double x = fmax(a, b), y = fmin(a, b), sum = 0, weight = 0.5;
  VS_ASSERT(a >= 0 && b >= 0);
  if (!(y > 1e-300)) return 4 * x;
  for (double c = sqrt((x - y) * (x + y)), square = x * x;; weight *= 2) {
    sum += weight * c * c;
    if (fabs(c) <= 1e-15 * x) return 2 * pi * (square - sum) / x;
    double mean = (x + y) / 2;
    c = (x - y) / 2;
    y = sqrt(x * y);
    x = mean;
  }
}
