/* Converts arguments that are values: numbers, booleans, texts, points, lines, planes, matrices. Each function belongs
 * to a row of contracts.def. It sets *out, or the error. */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bind/call/call.h"
#include "bind/call/give.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/records.h"
#include "bind/warnings.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"

static bool finite3(const double *d) { return isfinite(d[0]) && isfinite(d[1]) && isfinite(d[2]); }
static vs_vec3 vec_of(const double *d) { return vs_v3(d[0], d[1], d[2]); }
static bool has_length(vs_vec3 v) { return v.x != 0 || v.y != 0 || v.z != 0; }

static bool symbol_is(vs_value v, const char *name) { return vs_is_symbol(v) && !strcmp(vs_as_symbol(v)->name, name); }

/* The names of the world's axes, and of the planes perpendicular to them. */
static const char *const axis_names[3] = { "x", "y", "z" }, *const plane_names[3] = { "yz", "xz", "xy" };

static bool world_axis(vs_value v, const char *const names[3], vs_vec3 *out) {
  for (int i = 0; i < 3; i++)
    if (symbol_is(v, names[i])) return *out = vs_v3(i == 0, i == 1, i == 2), true;
  return false;
}

/* Converts an axis or a plane to out->line. A name or a gvector means a line through the origin. A record of kind
 * `kind` (an axis or a plane) contains the point and direction. */
static bool convert_line(vs_value v, const char *const names[3], uint32_t kind, vs_arg *out) {
  out->line.at = vs_v3(0, 0, 0);
  if (world_axis(v, names, &out->line.direction)) return true;
  if (vs_is_flat(v, VS_FLAT_VECTOR)) return out->line.direction = vec_of(vs_as_flat(v)->at), true;
  if (!vs_is_flat(v, kind)) return false;
  out->line.at = vec_of(vs_as_flat(v)->at), out->line.direction = vec_of(vs_as_flat(v)->at + 3);
  return true;
}

bool vs_bind_take_axis(vs_value v, vs_arg *out) { return convert_line(v, axis_names, VS_FLAT_AXIS, out); }
static bool is_plane(vs_value v, vs_arg *out) { /* reads a plane as its point and normal */
  return convert_line(v, plane_names, VS_FLAT_PLANE, out);
}

vs_status vs_convert_text(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  char *text;
  size_t bytes;
  if (!vs_is_string(v) && !vs_is_symbol(v)) return vs_bind_refuse_kind(f, p, v);
  if (!vs_bind_take_text(f->vm, v, &text, &bytes)) return VS_ERROR;
  char *kept = vs_bind_scratch(f, bytes);
  if (kept) memcpy(kept, text, bytes);
  vs_mem(f->vm, text, bytes, 0);
  out->text.at = kept, out->text.length = bytes - 1;
  return kept ? VS_OK : VS_ERROR;
}

vs_status vs_convert_real(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_bind_take_number(f->vm, v, &out->real)) return vs_bind_refuse_kind(f, p, v);
  if (!isfinite(out->real)) return vs_bind_refuse(f, p->name, "finite", v);
  return VS_OK;
}

static vs_status convert_integer(vs_args *f, const vs_bind_param *p, vs_value v, int64_t low, int64_t high,
                                 vs_arg *out) {
  if (!vs_is_fixnum(v)) return vs_bind_refuse_kind(f, p, v);
  out->integer = vs_fixnum(v);
  if (out->integer > high && high == INT32_MAX) return vs_bind_refuse(f, p->name, "at most 2147483647", v);
  return out->integer >= low && out->integer <= high ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_any(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  (void)f, (void)p, (void)v, (void)out;
  return VS_OK;
}

vs_status vs_convert_radius(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return !vs_convert_real(f, p, v, out) ? VS_ERROR : out->real >= 0 ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_positive(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return !vs_convert_real(f, p, v, out) ? VS_ERROR : out->real > 0 ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_unit(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_convert_real(f, p, v, out)) return VS_ERROR;
  return out->real >= 0 && out->real <= 1 ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

/* Converts an angle. Warns if it is an integer above 6, which is probably in degrees. Does not warn if the same call in
 * the program had a smaller integer before, as in a counting loop. */
vs_status vs_convert_angle(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_convert_real(f, p, v, out)) return VS_ERROR;
  if (vs_is_fixnum(v) && out->real != 0 && fabs(out->real) <= 6) vs_bind_clear(f->bind, "degrees");
  else if (vs_is_fixnum(v) && out->real != 0) {
    char name[64];
    vs_bind_warn(f->bind, "degrees", "%s: %.0f radians are %.1f turns; (degrees->radians %.0f)?",
        vs_bind_own_name(f, name), out->real, fabs(out->real) / 6.283185307179586, out->real);
  }
  return VS_OK;
}

vs_status vs_convert_some(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return convert_integer(f, p, v, 1, INT32_MAX, out);
}

vs_status vs_convert_natural(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return convert_integer(f, p, v, 0, INT32_MAX, out);
}

vs_status vs_convert_sides(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return convert_integer(f, p, v, 3, 100000, out);
}

vs_status vs_convert_segments(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (v == VS_FALSE) return out->integer = 0, VS_OK;
  return convert_integer(f, p, v, 3, 100000, out);
}

vs_status vs_convert_boolean(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  out->boolean = v != VS_FALSE;
  return v == VS_TRUE || v == VS_FALSE ? VS_OK : vs_bind_refuse_kind(f, p, v);
}

vs_status vs_convert_string(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  bool fits = vs_is_string(v) || (p->contract == VS_C_SHEET && vs_is_symbol(v));
  return fits ? vs_convert_text(f, p, v, out) : vs_bind_refuse_kind(f, p, v);
}

vs_status vs_convert_name(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return vs_is_symbol(v) ? vs_convert_text(f, p, v, out) : vs_bind_refuse_kind(f, p, v);
}

vs_status vs_convert_point(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_is_flat(v, VS_FLAT_POINT)) return vs_bind_refuse_kind(f, p, v);
  out->point = vec_of(vs_as_flat(v)->at);
  return finite3(vs_as_flat(v)->at) ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_vector(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_is_flat(v, VS_FLAT_VECTOR)) return vs_bind_refuse_kind(f, p, v);
  out->point = vec_of(vs_as_flat(v)->at);
  return finite3(vs_as_flat(v)->at) ? VS_OK : vs_bind_refuse(f, p->name, "of finite coordinates", v);
}

vs_status vs_convert_direction(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (world_axis(v, axis_names, &out->point)) return VS_OK;
  if (!vs_convert_vector(f, p, v, out)) return VS_ERROR;
  return has_length(out->point) ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_place(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_is_flat(v, VS_FLAT_POINT) && !vs_is_flat(v, VS_FLAT_VECTOR)) return vs_bind_refuse_kind(f, p, v);
  return out->point = vec_of(vs_as_flat(v)->at), VS_OK;
}

vs_status vs_convert_numeric(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (vs_is(v, VS_T_FLAT)) return VS_OK;
  return vs_bind_take_number(f->vm, v, &out->real) ? VS_OK : vs_bind_refuse_kind(f, p, v);
}

static vs_status check_line(vs_args *f, const vs_bind_param *p, vs_value v, const vs_arg *out) {
  bool fits = has_length(out->line.direction) && finite3(&out->line.direction.x) && finite3(&out->line.at.x);
  return fits ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_axis(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return vs_bind_take_axis(v, out) ? check_line(f, p, v, out) : vs_bind_refuse_kind(f, p, v);
}

vs_status vs_convert_plane(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  return is_plane(v, out) ? check_line(f, p, v, out) : vs_bind_refuse_kind(f, p, v);
}

/* Converts a cutting plane. A number means a horizontal plane at this height; the part of the object below the plane is
 * kept. */
vs_status vs_convert_cut(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (v == VS_FALSE) return VS_OK;
  if (!vs_bind_take_number(f->vm, v, &out->real)) return vs_convert_plane(f, p, v, out);
  double height = out->real;
  out->line.at = vs_v3(0, 0, height), out->line.direction = vs_v3(0, 0, -1);
  return check_line(f, p, v, out);
}

vs_status vs_convert_matrix(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (!vs_is_flat(v, VS_FLAT_MATRIX)) return vs_bind_refuse_kind(f, p, v);
  return out->matrix = vs_bind_take_matrix(vs_as_flat(v)->at), VS_OK;
}

vs_status vs_convert_factor(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  double d[3];
  if (vs_is_flat(v, VS_FLAT_VECTOR)) {
    memcpy(d, vs_as_flat(v)->at, sizeof d);
  } else if (vs_is_pair(v) && vs_list_length(v) == 3) {
    vs_value l = v;
    for (int i = 0; i < 3; i++, l = vs_cdr(l))
      if (!vs_bind_take_number(f->vm, vs_car(l), &d[i])) return vs_bind_refuse_kind(f, p, v);
  } else if (vs_bind_take_number(f->vm, v, &d[0])) {
    d[1] = d[2] = d[0];
  } else {
    return vs_bind_refuse_kind(f, p, v);
  }
  out->point = vec_of(d);
  return finite3(d) && d[0] > 0 && d[1] > 0 && d[2] > 0 ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

/* Converts the direction of a tangent. A number means the angle of a direction in the XY plane. */
vs_status vs_convert_tangent(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  if (vs_is_flat(v, VS_FLAT_VECTOR)) {
    out->point = vec_of(vs_as_flat(v)->at);
  } else if (!vs_convert_real(f, p, v, out)) {
    return VS_ERROR;
  } else {
    double s, c;
    vs_sincos(out->real, &s, &c);
    out->point = vs_v3(c, s, 0);
  }
  return finite3(&out->point.x) && has_length(out->point) ? VS_OK : vs_bind_refuse_condition(f, p, v);
}

vs_status vs_convert_own_axis(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out) {
  for (int i = 0; i < 3; i++)
    if (symbol_is(v, axis_names[i])) return out->integer = i, VS_OK;
  return vs_bind_refuse_kind(f, p, v);
}
