/* Declares functions that create the Scheme values of points, gvectors, numbers and matrices. vs_bind_give_X creates a
 * value from an X; vs_bind_take_X (take.h) reads an X from a value. */
#ifndef VS_BIND_CALL_GIVE_H
#define VS_BIND_CALL_GIVE_H

#include "geometry/frame.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

vs_status vs_bind_give_point(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_give_vector(vs_args *f, vs_vec3 p, vs_value *out);
vs_status vs_bind_give_real(vs_args *f, double d, vs_value *out);
vs_status vs_bind_give_matrix(vs_args *f, const vs_affine *m, vs_value *out);
/* Returns the upper three rows of a 4x4 matrix, whose sixteen numbers are stored row by row. */
vs_affine vs_bind_take_matrix(const double *sixteen);

#endif
