/* Declares the converters of convert_*.c. Each contract has a converter, which turns an argument into C data. */
#ifndef VS_BIND_CALL_CONVERT_H
#define VS_BIND_CALL_CONVERT_H

#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;
typedef struct vs_bind_param vs_bind_param;

/* Fills `out` from v for parameter p. Returns VS_ERROR with the error set if v breaks the contract. */
typedef vs_status vs_convert_fn(vs_args *f, const vs_bind_param *p, vs_value v, vs_arg *out);

vs_convert_fn vs_convert_angle;
vs_convert_fn vs_convert_any;
vs_convert_fn vs_convert_axis;
vs_convert_fn vs_convert_boolean;
vs_convert_fn vs_convert_cut;
vs_convert_fn vs_convert_direction;
vs_convert_fn vs_convert_faces;
vs_convert_fn vs_convert_factor;
vs_convert_fn vs_convert_material;
vs_convert_fn vs_convert_matrix;
vs_convert_fn vs_convert_name;
vs_convert_fn vs_convert_natural;
vs_convert_fn vs_convert_numeric;
vs_convert_fn vs_convert_object;
vs_convert_fn vs_convert_own_axis;
vs_convert_fn vs_convert_path;
vs_convert_fn vs_convert_place;
vs_convert_fn vs_convert_plane;
vs_convert_fn vs_convert_point;
vs_convert_fn vs_convert_points;
vs_convert_fn vs_convert_positive;
vs_convert_fn vs_convert_radius;
vs_convert_fn vs_convert_real;
vs_convert_fn vs_convert_refs;
vs_convert_fn vs_convert_rule;
vs_convert_fn vs_convert_scope;
vs_convert_fn vs_convert_segments;
vs_convert_fn vs_convert_sides;
vs_convert_fn vs_convert_some;
vs_convert_fn vs_convert_string;
vs_convert_fn vs_convert_tangent;
vs_convert_fn vs_convert_text;
vs_convert_fn vs_convert_things;
vs_convert_fn vs_convert_unit;
vs_convert_fn vs_convert_vector;

/* Converts the n arguments of a rest parameter to a list of objects. Each argument is an item or a nested list of
 * items. */
vs_status vs_convert_all_refs(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out);
vs_status vs_convert_all_points(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out);
vs_status vs_convert_all_things(vs_args *f, const vs_bind_param *p, const vs_value *v, size_t n, vs_arg *out);

/* Flattens a list of objects. If an element is no object, returns false and sets *bad to the element. If another error
 * is already set, *bad is VS_ABSENT. */
bool vs_bind_take_refs(vs_args *f, vs_value list, vs_ref **out, size_t *count, vs_value *bad);
/* If v is an axis, sets out->line and returns true. Sets no error. */
bool vs_bind_take_axis(vs_value v, vs_arg *out);

#endif
