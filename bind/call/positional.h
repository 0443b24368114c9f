/* Declares functions that read the positional arguments of a checked call. A native that uses neither the form of the
 * call nor its keywords includes this header instead of call.h, and then does not depend on the members of vs_args.
 * Argument i must exist in the row of the procedure, and have the kind that the function reads. */
#ifndef VS_BIND_CALL_POSITIONAL_H
#define VS_BIND_CALL_POSITIONAL_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;
typedef struct vs_bind vs_bind;

/* An array of points; its memory is freed when the call ends. */
typedef struct { vs_vec3 *at; size_t count; } vs_arg_point_list;
typedef struct { vs_ref *at; size_t count; } vs_arg_ref_list;
/* An axis, or a plane by a point and its normal. */
typedef struct { vs_vec3 at, direction; } vs_arg_axis;

vs_scheme *vs_call_vm(const vs_args *f);
vs_bind *vs_call_bind(const vs_args *f);
vs_store *vs_call_store(const vs_args *f);

vs_value vs_arg_value(const vs_args *f, int i); /* Returns argument i as it was passed, unconverted. */
bool vs_arg_given(const vs_args *f, int i);
bool vs_arg_boolean(const vs_args *f, int i);
double vs_arg_real(const vs_args *f, int i);
int64_t vs_arg_integer(const vs_args *f, int i);
const char *vs_arg_text(const vs_args *f, int i); /* Returns the UTF-8 text of argument i, a string or symbol, with a
                                                   * NUL. */
size_t vs_arg_text_length(const vs_args *f, int i); /* Returns the number of bytes in the text of argument i, without
                                                     * the NUL. */
vs_vec3 vs_arg_point(const vs_args *f, int i);    /* Returns the coordinates of argument i, a point or gvector. */
vs_arg_axis vs_arg_line(const vs_args *f, int i);
vs_affine vs_arg_matrix(const vs_args *f, int i);
vs_arg_point_list vs_arg_points(const vs_args *f, int i);
vs_ref vs_arg_ref(const vs_args *f, int i);       /* Returns argument i, an object; if it is a list of objects, returns
                                                   * their union. */
vs_arg_ref_list vs_arg_refs(const vs_args *f, int i);
struct vs_scope *vs_arg_scope(const vs_args *f, int i);

#endif
