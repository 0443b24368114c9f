/* Implements the procedures that create solids. A procedure whose solid would have no volume returns the empty object,
 * and warns once for each place of a call in the program. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/precision.h"
#include "bind/call/refuse.h"

#define REAL(i) (f->arg[i].real)
#define POINT(i) (f->arg[i].point)

static int32_t segments(const vs_args *f) { /* returns the number of facets of a full turn; 0: it is computed from the
                                             * tolerance */
  return f->key[0].given ? (int32_t)f->key[0].integer : vs_bind_segments(f->vm);
}

/* ---- boxes and wedges ---- */

/* Computes two opposite corners of a box or wedge from either form of the arguments: two points, or a point and sizes.
 * Returns false if the solid has no volume. */
static bool corners(const vs_args *f, vs_vec3 *least, vs_vec3 *most) {
  vs_vec3 p = POINT(0), q;
  if (f->form == 0) q = POINT(1);
  else {
    vs_vec3 half = vs_v3(fabs(REAL(1)) / 2, fabs(REAL(2)) / 2, fabs(REAL(3)) / 2), c = p;
    p = vs_v3_sub(c, half), q = vs_v3_add(c, half);
  }
  *least = vs_v3(fmin(p.x, q.x), fmin(p.y, q.y), fmin(p.z, q.z));
  *most = vs_v3(fmax(p.x, q.x), fmax(p.y, q.y), fmax(p.z, q.z));
  return least->x < most->x && least->y < most->y && least->z < most->z;
}

/* Refuses negative sizes. The order of two corner points does not matter. */
static vs_status refuse_sizes(vs_args *f) {
  static const char *const names[] = { "c", "dx", "dy", "dz" };
  if (f->form == 1)
    for (int i = 1; i < 4; i++)
      if (REAL(i) < 0) return vs_bind_refuse(f, names[i], "positive", f->arg[i].value);
  return VS_OK;
}

vs_status vs_p_make_box(vs_args *f, vs_value *out) {
  struct vs_box d = { 0 };
  if (!refuse_sizes(f)) return VS_ERROR;
  if (!corners(f, &d.p, &d.q)) return vs_bind_empty(f, "a box without width, depth or height", out);
  return vs_bind_make(f, VS_BOX, &d, NULL, 0, out);
}
vs_status vs_p_make_wedge(vs_args *f, vs_value *out) {
  struct vs_wedge d = { 0 };
  if (!refuse_sizes(f)) return VS_ERROR;
  if (!corners(f, &d.p, &d.q)) return vs_bind_empty(f, "a wedge without width, depth or height", out);
  return vs_bind_make(f, VS_WEDGE, &d, NULL, 0, out);
}

/* ---- round solids ---- */

vs_status vs_p_make_sphere(vs_args *f, vs_value *out) {
  if (REAL(1) == 0) return vs_bind_empty(f, "r is 0", out);
  return vs_bind_make(f, VS_SPHERE,
                      &(struct vs_sphere){ .center = POINT(0), .radius = REAL(1), .segments = segments(f) }, NULL, 0,
                      out);
}

vs_status vs_p_make_cylinder(vs_args *f, vs_value *out) {
  struct vs_cylinder d = { .base = POINT(0), .radius = REAL(2), .segments = segments(f) };
  d.top = f->form == 0 ? POINT(1) : vs_v3(d.base.x, d.base.y, d.base.z + REAL(1));
  if (d.radius == 0) return vs_bind_empty(f, "r is 0", out);
  if (vs_v3_equal(d.base, d.top))
    return vs_bind_empty(f, f->form == 0 ? "c1 and c2 are the same point" : "h is 0", out);
  return vs_bind_make(f, VS_CYLINDER, &d, NULL, 0, out);
}

vs_status vs_p_make_cone(vs_args *f, vs_value *out) {
  struct vs_cone d = { .base = POINT(0), .apex = POINT(1), .radius = REAL(2), .segments = segments(f) };
  if (d.radius == 0) return vs_bind_empty(f, "r is 0", out);
  if (vs_v3_equal(d.base, d.apex)) return vs_bind_empty(f, "base and apex are the same point", out);
  return vs_bind_make(f, VS_CONE, &d, NULL, 0, out);
}

vs_status vs_p_make_cut_cone(vs_args *f, vs_value *out) {
  struct vs_cut_cone d = {
    .base = POINT(0), .base_radius = REAL(1), .top = POINT(2), .top_radius = REAL(3), .segments = segments(f)
  };
  if (d.base_radius == 0 && d.top_radius == 0) return vs_bind_empty(f, "r1 and r2 are 0", out);
  if (vs_v3_equal(d.base, d.top)) return vs_bind_empty(f, "c1 and c2 are the same point", out);
  return vs_bind_make(f, VS_CUT_CONE, &d, NULL, 0, out);
}

vs_status vs_p_make_capsule(vs_args *f, vs_value *out) {
  struct vs_capsule d = { .base = POINT(0), .top = POINT(1), .radius = REAL(2), .segments = segments(f) };
  if (d.radius == 0) return vs_bind_empty(f, "r is 0", out);
  if (!vs_v3_equal(d.base, d.top)) return vs_bind_make(f, VS_CAPSULE, &d, NULL, 0, out);
  struct vs_sphere ball = { .center = d.base, .radius = d.radius, .segments = d.segments };
  return vs_bind_make(f, VS_SPHERE, &ball, NULL, 0, out);
}

vs_status vs_p_make_e_cone(vs_args *f, vs_value *out) {
  struct vs_e_cone d = { .base = POINT(0),
                         .base_radius = REAL(1),
                         .base_across = REAL(2),
                         .top = POINT(3),
                         .top_radius = REAL(4),
                         .segments = segments(f) };
  if (vs_v3_equal(d.base, d.top)) return vs_bind_empty(f, "c1 and c2 are the same point", out);
  if (d.base_radius == 0 || d.base_across == 0) return vs_bind_empty(f, "r1 or r1* is 0", out);
  return vs_bind_make(f, VS_E_CONE, &d, NULL, 0, out);
}

vs_status vs_p_make_superellipsoid(vs_args *f, vs_value *out) {
  struct vs_superellipsoid d = { .e = REAL(0), .n = REAL(1), .size = REAL(2), .segments = segments(f) };
  const double least = 0.001, most = 20; /* bounds of a superellipsoid's exponents: outside them the shape is nearly a
                                          * box or vanishes, and powers overflow or underflow */
  if (d.e < least || d.e > most) return vs_bind_refuse(f, "e", "from 0.001 to 20", f->arg[0].value);
  if (d.n < least || d.n > most) return vs_bind_refuse(f, "n", "from 0.001 to 20", f->arg[1].value);
  if (d.size == 0) return vs_bind_empty(f, "s is 0", out);
  return vs_bind_make(f, VS_SUPERELLIPSOID, &d, NULL, 0, out);
}

vs_status vs_p_make_half_space(vs_args *f, vs_value *out) {
  struct vs_half_space d = { .point = f->arg[0].line.at, .normal = vs_v3_unit(f->arg[0].line.direction) };
  return vs_bind_make(f, VS_HALF_SPACE, &d, NULL, 0, out);
}

vs_status vs_p_make_torus(vs_args *f, vs_value *out) {
  struct vs_torus d = { .center = POINT(0), .radius = REAL(1), .tube_radius = REAL(2), .segments = segments(f) };
  if (d.tube_radius == 0) return vs_bind_empty(f, "tube-r is 0", out);
  if (d.radius == 0) return vs_bind_empty(f, "r is 0", out);
  if (d.tube_radius > d.radius)
    return vs_bind_refuse(f, "tube-r", "at most r: a torus that crosses itself is no solid", f->arg[2].value);
  return vs_bind_make(f, VS_TORUS, &d, NULL, 0, out);
}

/* ---- pyramids ---- */

static vs_status pyramid(vs_args *f, double top_radius, vs_value *out) {
  struct vs_pyramid d = { .base = POINT(0),
                          .base_radius = REAL(1),
                          .sides = (int32_t)f->arg[2].integer,
                          .top = POINT(3),
                          .top_radius = top_radius };
  if (d.base_radius == 0 && d.top_radius == 0) return vs_bind_empty(f, "both radii are 0", out);
  if (vs_v3_equal(d.base, d.top)) return vs_bind_empty(f, "c1 and c2 are the same point", out);
  return vs_bind_make(f, VS_PYRAMID, &d, NULL, 0, out);
}
vs_status vs_p_make_pyramid(vs_args *f, vs_value *out) { return pyramid(f, f->arg[4].given ? REAL(4) : 0, out); }
vs_status vs_p_make_prism(vs_args *f, vs_value *out) { return pyramid(f, REAL(1), out); }

vs_status vs_p_empty_object(vs_args *f, vs_value *out) { return vs_bind_empty(f, NULL, out); }
