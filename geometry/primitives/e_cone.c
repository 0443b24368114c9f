/* Implements the elliptical cone, truncated or pointed. */
#include <math.h>

#include "geometry/frame.h"
#include "geometry/measure/reach.h"
#include "geometry/primitives/round_formulas.h"
#include "geometry/primitives/shape.h"
#include "geometry/primitives/solid_triangles.h"

/* Returns the radius of the top along Y of the cone's frame, whose Z is the cone's axis; the member top_radius is the
 * radius along X. */
static double top_across(const struct vs_e_cone *x) { return x->top_radius * (x->base_across / x->base_radius); }

static bool e_cone_bounds(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e) {
  const struct vs_e_cone *x = VS_AS(e_cone, n);
  vs_affine frame = vs_frame_on_axis(x->base, vs_v3_sub(x->top, x->base));
  (void)e;
  vs_reach_oval(b, a, &frame, x->base, x->base_radius, x->base_across);
  vs_reach_oval(b, a, &frame, x->top, x->top_radius, top_across(x));
  return true;
}

static bool e_cone_triangles(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  const struct vs_e_cone *x = VS_AS(e_cone, n);
  double widest = fmax(x->base_radius, x->base_across) * fmax(1, x->top_radius / x->base_radius);
  int turn = vs_fineness_turn(f, widest, x->segments);
  vs_oval base = { x->base, x->base_radius, x->base_across }, top = { x->top, x->top_radius, top_across(x) };
  return vs_solid_oval_frustum(out, base, top, turn, true) || vs_error_memory(e, NULL);
}

/* The lateral area is (1 + k) / 2 times the circumference of an ellipse. The base has the half axes a and b, the top k
 * times these, and the height is h. At the scale w from 1 to k, the element of area is w sqrt(h^2 (b^2 cos^2 + a^2
 * sin^2) + (k - 1)^2 a^2 b^2). */
static bool e_cone_measure(const vs_node *n, bool area, vs_measure *m, vs_error *e) {
  const struct vs_e_cone *x = VS_AS(e_cone, n);
  (void)area, (void)e;
  vs_vec3 axis = vs_v3_sub(x->top, x->base);
  double h = vs_v3_length(axis), ra = x->base_radius, rb = x->base_across, k = x->top_radius / ra;
  double weight = 1 + k + k * k, slant = (k - 1) * ra * rb;
  m->volume = 3.14159265358979323846 * h * ra * rb * weight / 3;
  m->area = 3.14159265358979323846 * ra * rb * (1 + k * k) +
            (1 + k) / 2 * vs_ellipse_length(hypot(h * rb, slant), hypot(h * ra, slant));
  m->centroid = vs_v3_add(x->base, vs_v3_scale(axis, (1 + 2 * k + 3 * k * k) / (4 * weight)));
  return true;
}

static bool e_cone_holds(const vs_node *n, vs_vec3 p, vs_vec3 q, double height) {
  const struct vs_e_cone *x = VS_AS(e_cone, n);
  (void)p;
  return vs_frustum_holds(vs_v3(q.x, q.y * (x->base_radius / x->base_across), q.z), height, x->base_radius,
                          x->top_radius);
}

static vs_node *e_cone_moved(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits) {
  struct vs_e_cone d = *VS_AS(e_cone, n);
  bool stands = d.top.x == d.base.x && d.top.y == d.base.y && d.top.z > d.base.z; /* true if the axis points up, so that
                                                                                   * the ellipse's half axes lie along X
                                                                                   * and Y */
  *fits = map->upright || (map->plain && stands);
  if (!*fits) return NULL;
  d.base = vs_affine_point(a, d.base);
  d.top = vs_affine_point(a, d.top);
  d.base_radius *= a->m[0][0];
  d.base_across *= a->m[1][1];
  d.top_radius *= a->m[0][0];
  return vs_node_new(s, VS_E_CONE, &d, NULL, 0);
}

static void e_cone_axis(const vs_node *n, vs_vec3 *base, vs_vec3 *top) {
  *base = VS_AS(e_cone, n)->base, *top = VS_AS(e_cone, n)->top;
}

VS_SHAPE(e_cone, e_cone_axis, NULL, NULL);
