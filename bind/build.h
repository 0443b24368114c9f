/* Owns the interface of build.c: the small steps that every procedure of the geometry ends with. vs_bind_give_X makes a
 * value of an X; vs_bind_take_X (call/take.h) reads an X out of a value. */
#ifndef VS_BIND_BUILD_H
#define VS_BIND_BUILD_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

vs_status vs_bind_make(vs_args *f, vs_kind kind, const void *data, const vs_ref *children, size_t n, vs_value *out);
/* For argument 0 that is several curves or surfaces (geometry/parts.h): the union of what one makes of each. */
vs_status vs_bind_each_part(vs_args *f, vs_procedure_fn *one, vs_value *out);
/* the empty object, with a warning once a place */
vs_status vs_bind_empty(vs_args *f, const char *why, vs_value *out);
vs_status vs_bind_give_node(vs_args *f, vs_node *node, vs_value *out);    /* takes the reference over */
/* The figure *out, drawn as in the plane XY, stands in the plane instead (#:plane): about its place where the form
 * takes one point, else as the plane's own coordinates say. */
vs_status vs_bind_stand(vs_args *f, const vs_arg *plane, vs_value *out);
vs_status vs_bind_give_point(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_give_vector(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_give_real(vs_args *f, double d, vs_value *out);
vs_status vs_bind_give_matrix(vs_args *f, const vs_affine *m, vs_value *out);
vs_affine vs_bind_take_matrix(const double *sixteen); /* the upper three rows */

#endif
