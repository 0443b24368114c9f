/* Implements points and gvectors of dual numbers (dual_points.h). A dual number carries the derivative of its value.
 *
 * A dual point is a dual number whose value is a point and whose slope (derivative) is a gvector. Each procedure in
 * this file splits its arguments into coordinates, which are numbers or dual numbers. It computes with the arithmetic
 * of numbers, and joins the results to a point. Nested dual numbers therefore need no special code. Coordinates are
 * kept in roots of the garbage collector. */
#include "bind/functions/dual_points.h"

#include <math.h>

#include "bind/procedures.h"
#include "bind/records.h"
#include "vm/numbers/dual.h"
#include "vm/values/heap.h"

/* Sets *out to coordinate i of a point or gvector, which may be dual. */
static bool coordinate(vs_scheme *vm, vs_value v, int i, vs_value *out) {
  if (!vs_is_dual(v)) return *out = vs_flonum(vs_as_flat(v)->at[i]), true;
  VS_ROOTS(vm, r, 3);
  r[0] = v;
  return coordinate(vm, vs_as_dual(v)->value, i, &r[1]) &&
         (vs_is(vs_dual_base(vs_as_dual(r[0])->slope), VS_T_FLAT) ? coordinate(vm, vs_as_dual(r[0])->slope, i, &r[2])
                                                                  : (r[2] = vs_fix(0), true)) &&
         vs_make_dual(vm, vs_fixnum(vs_as_dual(r[0])->level), r[1], r[2], out);
}

/* Sets *out to a point or gvector (tag) with three coordinates, which may be dual. `at` points to roots of the garbage
 * collector. */
static bool together(vs_scheme *vm, uint32_t tag, const vs_value *at, vs_value *out) {
  int64_t level = vs_dual_level(at, 3);
  if (level < 0) {
    double d[3];
    for (int i = 0; i < 3; i++)
      if (!vs_number_double(vm, at[i], &d[i])) return false;
    return vs_make_flat(vm, tag, d, 3, out);
  }
  VS_ROOTS(vm, r, 8);
  for (int i = 0; i < 3; i++) r[i] = vs_dual_value(at[i], level), r[3 + i] = vs_dual_slope(at[i], level);
  return together(vm, tag, r, &r[6]) && together(vm, VS_FLAT_VECTOR, r + 3, &r[7]) &&
         vs_make_dual(vm, level, r[6], r[7], out);
}

static bool dot3(vs_scheme *vm, const vs_value *a, const vs_value *b, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[1] = vs_fix(0);
  for (int i = 0; i < 3; i++)
    if (!vs_number_mul(vm, a[i], b[i], &r[0]) || !vs_number_add(vm, r[1], r[0], &r[1])) return false;
  return *out = r[1], true;
}
static bool length3(vs_scheme *vm, const vs_value *a, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  return dot3(vm, a, a, &r[0]) && vs_dual_function(vm, sqrt, r[0], out);
}
/* sets out[0] to rho cos phi and out[1] to rho sin phi */
static bool polar2(vs_scheme *vm, vs_value rho, vs_value phi, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  r[0] = rho, r[1] = phi;
  return vs_dual_function(vm, cos, r[1], &out[0]) && vs_number_mul(vm, r[0], out[0], &out[0]) &&
         vs_dual_function(vm, sin, r[1], &out[1]) && vs_number_mul(vm, r[0], out[1], &out[1]);
}

typedef enum {
  CARTESIAN,
  POLAR,
  CYLINDRICAL,
  SPHERICAL,
  PART,
  DIFFERENCE,
  SUM,
  LESS,
  TIMES,
  OVER,
  DOT,
  CROSS,
  LENGTH,
  APART,
  UNIT,
  BETWEEN,
  TURNS
} rule;

/* The procedures that accept dual numbers. `shape` has a letter for each argument: p for a point or gvector, n for a
 * number. `tag` is the kind of the result, 0 for a number. `with` has a bit for each coordinate that a number argument
 * sets. For a procedure that returns a coordinate, `with` is the index of this coordinate. If numbers follow a p, the
 * result is that point plus the vector of the numbers. */
static const struct {
  vs_procedure_fn *fn;
  const char *shape;
  uint8_t rule, tag, with;
} rows[] = {
  { vs_p_xyz, "nnn", CARTESIAN, VS_FLAT_POINT, 7 },
  { vs_p_vxyz, "nnn", CARTESIAN, VS_FLAT_VECTOR, 7 },
  { vs_p_xy, "nn", CARTESIAN, VS_FLAT_POINT, 3 },
  { vs_p_xz, "nn", CARTESIAN, VS_FLAT_POINT, 5 },
  { vs_p_yz, "nn", CARTESIAN, VS_FLAT_POINT, 6 },
  { vs_p_add_xyz, "pnnn", CARTESIAN, VS_FLAT_POINT, 7 },
  { vs_p_add_xy, "pnn", CARTESIAN, VS_FLAT_POINT, 3 },
  { vs_p_add_xz, "pnn", CARTESIAN, VS_FLAT_POINT, 5 },
  { vs_p_add_yz, "pnn", CARTESIAN, VS_FLAT_POINT, 6 },
  { vs_p_add_x, "pn", CARTESIAN, VS_FLAT_POINT, 1 },
  { vs_p_add_y, "pn", CARTESIAN, VS_FLAT_POINT, 2 },
  { vs_p_add_z, "pn", CARTESIAN, VS_FLAT_POINT, 4 },
  { vs_p_pol, "nn", POLAR, VS_FLAT_POINT, 0 },
  { vs_p_vpol, "nn", POLAR, VS_FLAT_VECTOR, 0 },
  { vs_p_add_pol, "pnn", POLAR, VS_FLAT_POINT, 0 },
  { vs_p_cyl, "nnn", CYLINDRICAL, VS_FLAT_POINT, 0 },
  { vs_p_vcyl, "nnn", CYLINDRICAL, VS_FLAT_VECTOR, 0 },
  { vs_p_add_cyl, "pnnn", CYLINDRICAL, VS_FLAT_POINT, 0 },
  { vs_p_sph, "nnn", SPHERICAL, VS_FLAT_POINT, 0 },
  { vs_p_vsph, "nnn", SPHERICAL, VS_FLAT_VECTOR, 0 },
  { vs_p_add_sph, "pnnn", SPHERICAL, VS_FLAT_POINT, 0 },
  { vs_p_cx, "p", PART, 0, 0 },
  { vs_p_cy, "p", PART, 0, 1 },
  { vs_p_cz, "p", PART, 0, 2 },
  { vs_p_p_to_q, "pp", DIFFERENCE, VS_FLAT_VECTOR, 0 },
  { vs_p_p_minus_p, "pp", LESS, VS_FLAT_VECTOR, 0 },
  { vs_p_v_minus_v, "pp", LESS, VS_FLAT_VECTOR, 0 },
  { vs_p_p_plus_v, "pp", SUM, VS_FLAT_POINT, 0 },
  { vs_p_p_minus_v, "pp", LESS, VS_FLAT_POINT, 0 },
  { vs_p_v_plus_v, "pp", SUM, VS_FLAT_VECTOR, 0 },
  { vs_p_v_times_r, "pn", TIMES, VS_FLAT_VECTOR, 0 },
  { vs_p_v_over_r, "pn", OVER, VS_FLAT_VECTOR, 0 },
  { vs_p_dot, "pp", DOT, 0, 0 },
  { vs_p_cross, "pp", CROSS, VS_FLAT_VECTOR, 0 },
  { vs_p_length, "p", LENGTH, 0, 0 },
  { vs_p_distance, "pp", APART, 0, 0 },
  { vs_p_unitize, "p", UNIT, VS_FLAT_VECTOR, 0 },
  { vs_p_mid, "pp", BETWEEN, VS_FLAT_POINT, 0 },
  { vs_p_intermediate_point, "ppn", BETWEEN, VS_FLAT_POINT, 0 },
  { vs_p_degrees_radians, "n", TURNS, 0, 0 },
  { vs_p_radians_degrees, "n", TURNS, 0, 1 },
};

/* Computes row `row` of the table. r points to roots of the garbage collector. r[0..2]: coordinates of the first point;
 * r[3..5]: of the second point; r[6..8]: the number arguments; r[9..11]: the result; r[12..]: temporary values. */
static bool compute(vs_scheme *vm, size_t row, const char *shape, int n, vs_value *r, vs_value *out) {
  vs_value *p = r, *q = r + 3, *x = r + 6, *to = r + 9, *s = r + 12;
  bool ok = true, moved = shape[0] == 'p' && n > 1;
  for (int i = 0; i < 3; i++) to[i] = vs_fix(0);
  switch ((rule)rows[row].rule) {
  case CARTESIAN:
    for (int i = 0, k = 0; i < 3; i++)
      if (rows[row].with >> i & 1) to[i] = x[k++];
    break;
  case POLAR: ok = polar2(vm, x[0], x[1], to); break;
  case CYLINDRICAL: ok = polar2(vm, x[0], x[1], to), to[2] = x[2]; break;
  case SPHERICAL: ok = polar2(vm, x[0], x[2], s) && (to[2] = s[0], true) && polar2(vm, s[1], x[1], to); break;
  case PART: return *out = p[rows[row].with], true;
  case DIFFERENCE:
  case LESS:
  case APART:
    for (int i = 0; ok && i < 3; i++)
      ok = rows[row].rule == LESS ? vs_number_sub(vm, p[i], q[i], &to[i]) : vs_number_sub(vm, q[i], p[i], &to[i]);
    if (ok && rows[row].rule == APART) return length3(vm, to, out);
    break;
  case SUM:
    for (int i = 0; ok && i < 3; i++) ok = vs_number_add(vm, p[i], q[i], &to[i]);
    break;
  case TIMES:
  case OVER:
    for (int i = 0; ok && i < 3; i++)
      ok = rows[row].rule == OVER ? vs_number_div(vm, p[i], x[0], &to[i]) : vs_number_mul(vm, p[i], x[0], &to[i]);
    break;
  case DOT: return dot3(vm, p, q, out);
  case LENGTH: return length3(vm, p, out);
  case CROSS:
    for (int i = 0; ok && i < 3; i++) {
      int j = (i + 1) % 3, k = (i + 2) % 3;
      ok = vs_number_mul(vm, p[j], q[k], &s[0]) && vs_number_mul(vm, p[k], q[j], &s[1]) &&
           vs_number_sub(vm, s[0], s[1], &to[i]);
    }
    break;
  case UNIT:
    ok = length3(vm, p, &s[0]);
    for (int i = 0; ok && i < 3; i++) ok = vs_number_div(vm, p[i], s[0], &to[i]);
    break;
  case BETWEEN:
    if (n == 2) x[0] = vs_flonum(.5);
    for (int i = 0; ok && i < 3; i++)
      ok = vs_number_sub(vm, q[i], p[i], &s[0]) && vs_number_mul(vm, s[0], x[0], &s[0]) &&
           vs_number_add(vm, p[i], s[0], &to[i]);
    break;
  case TURNS:
    s[0] = vs_flonum(rows[row].with ? 57.29577951308232 : .017453292519943295);
    return vs_number_mul(vm, x[0], s[0], out);
  }
  if (rows[row].rule <= SPHERICAL && moved)
    for (int i = 0; ok && i < 3; i++) ok = vs_number_add(vm, p[i], to[i], &to[i]);
  return ok && together(vm, rows[row].tag, to, out);
}

bool vs_dual_points(vs_scheme *vm, vs_procedure_fn *procedure, vs_value *a, int n, vs_value *out, vs_status *status) {
  size_t row = 0, count = sizeof rows / sizeof *rows;
  while (row < count && rows[row].fn != procedure) row++;
  if (row == count || n != (int)strlen(rows[row].shape)) return false;
  VS_ROOTS(vm, r, 16);
  vs_value *record = r, *number = r + 6;
  for (int i = 0; i < n; i++) {
    bool flat = vs_is(vs_dual_base(a[i]), VS_T_FLAT);
    if (rows[row].shape[i] == 'n') {
      if (flat || !vs_is_scalar(a[i])) return false;
      *number++ = a[i];
      continue;
    }
    uint32_t tag = flat ? vs_as_flat(vs_dual_base(a[i]))->h.flags : 0;
    if (tag != VS_FLAT_POINT && tag != VS_FLAT_VECTOR) return false;
    for (int k = 0; k < 3; k++)
      if (!coordinate(vm, a[i], k, record + k)) return *status = VS_ERROR, true;
    record += 3;
  }
  *status = compute(vm, row, rows[row].shape, n, r, out) ? VS_OK : VS_ERROR;
  return true;
}
