/* Owns the interface of build.c: the last steps of each procedure of the geometry. vs_bind_give_X makes a value of an
 * X; vs_bind_take_X (call/take.h) reads an X from a value. */
#ifndef VS_BIND_BUILD_H
#define VS_BIND_BUILD_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

vs_status vs_bind_make(vs_args *f, vs_kind kind, const void *data, const vs_ref *children, size_t n, vs_value *out);
/* Argument 0 is several curves or surfaces (geometry/parts.h): calls `one` with each, and returns the union of the
 * results. */
vs_status vs_bind_each_part(vs_args *f, vs_procedure_fn *one, vs_value *out);
/* returns the empty object, with a warning once for each place */
vs_status vs_bind_empty(vs_args *f, const char *why, vs_value *out);
vs_status vs_bind_give_node(vs_args *f, vs_node *node, vs_value *out);    /* takes over the reference */
/* Moves the figure *out from the plane XY into the plane (#:plane). If the form takes one point, the figure turns about
 * it; otherwise its coordinates become the plane's own. */
vs_status vs_bind_stand(vs_args *f, const vs_arg *plane, vs_value *out);
vs_status vs_bind_give_point(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_give_vector(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_give_real(vs_args *f, double d, vs_value *out);
vs_status vs_bind_give_matrix(vs_args *f, const vs_affine *m, vs_value *out);
vs_affine vs_bind_take_matrix(const double *sixteen); /* returns the upper three rows */

#endif
