/* Recognizes nodes that are placed copies of a unit form, such as a box of size 2 (unit_forms.h). */
#include "geometry/shapes/unit_forms.h"

#include "geometry/frame.h"
#include "geometry/primitives/solid_triangles.h"

static vs_affine unit_between(vs_vec3 p, vs_vec3 q) {
  vs_vec3 half = vs_v3_scale(vs_v3_sub(q, p), 0.5), middle = vs_v3_scale(vs_v3_add(p, q), 0.5);
  return (vs_affine){ { { half.x, 0, 0, middle.x }, { 0, half.y, 0, middle.y }, { 0, 0, half.z, middle.z } } };
}

static vs_affine unit_on_axis(vs_vec3 base, vs_vec3 top, double radius, double across) {
  vs_vec3 axis = vs_v3_sub(top, base);
  vs_affine frame = vs_frame_on_axis(vs_v3_scale(vs_v3_add(base, top), 0.5), axis);
  vs_affine size = { { { radius, 0, 0, 0 }, { 0, across, 0, 0 }, { 0, 0, vs_v3_length(axis) / 2, 0 } } };
  return vs_affine_multiply(&frame, &size);
}

static bool unit_round(vs_unit unit, const vs_fineness *f, double radius, int segments, vs_affine place,
                       vs_unit_copy *out) {
  *out = (vs_unit_copy){ unit, vs_fineness_turn(f, radius, segments), segments > 0, place };
  return true;
}

bool vs_unit_of(const vs_node *n, const vs_fineness *f, vs_unit_copy *out) {
  if (n->kind == VS_BOX) {
    *out = (vs_unit_copy){ .unit = VS_UNIT_BOX, .place = unit_between(VS_AS(box, n)->p, VS_AS(box, n)->q) };
    return true;
  }
  if (n->kind == VS_WEDGE) {
    *out = (vs_unit_copy){ .unit = VS_UNIT_WEDGE, .place = unit_between(VS_AS(wedge, n)->p, VS_AS(wedge, n)->q) };
    return true;
  }
  if (n->kind == VS_SPHERE) {
    const struct vs_sphere *s = VS_AS(sphere, n);
    double r = s->radius;
    vs_affine place = { { { r, 0, 0, s->center.x }, { 0, r, 0, s->center.y }, { 0, 0, r, s->center.z } } };
    return unit_round(VS_UNIT_SPHERE, f, r, s->segments, place, out);
  }
  if (n->kind == VS_CYLINDER) {
    const struct vs_cylinder *c = VS_AS(cylinder, n);
    return unit_round(VS_UNIT_CYLINDER, f, c->radius, c->segments, unit_on_axis(c->base, c->top, c->radius, c->radius),
                      out);
  }
  if (n->kind == VS_CONE) {
    const struct vs_cone *c = VS_AS(cone, n);
    return unit_round(VS_UNIT_CONE, f, c->radius, c->segments, unit_on_axis(c->base, c->apex, c->radius, c->radius),
                      out);
  }
  if (n->kind == VS_E_CONE) {
    const struct vs_e_cone *c = VS_AS(e_cone, n);
    if (c->top_radius != 0 && c->top_radius != c->base_radius) return false;
    return unit_round(c->top_radius == 0 ? VS_UNIT_CONE : VS_UNIT_CYLINDER, f, fmax(c->base_radius, c->base_across),
                      c->segments, unit_on_axis(c->base, c->top, c->base_radius, c->base_across), out);
  }
  return false;
}

bool vs_unit_mesh(vs_unit unit, int turn, vs_mesh *out) {
  vs_vec3 low = vs_v3(-1, -1, -1), high = vs_v3(1, 1, 1), foot = vs_v3(0, 0, -1), head = vs_v3(0, 0, 1);
  switch (unit) {
  case VS_UNIT_BOX: return vs_solid_box(out, low, high);
  case VS_UNIT_WEDGE: return vs_solid_wedge(out, low, high);
  case VS_UNIT_SPHERE: return vs_solid_sphere(out, vs_v3(0, 0, 0), 1, turn);
  case VS_UNIT_CYLINDER: return vs_solid_frustum(out, (vs_disc){ foot, 1 }, (vs_disc){ head, 1 }, turn, true);
  case VS_UNIT_CONE: return vs_solid_frustum(out, (vs_disc){ foot, 1 }, (vs_disc){ head, 0 }, turn, true);
  case VS_UNIT_COUNT: break;
  }
  return false;
}
