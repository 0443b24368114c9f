/* Declares the last steps of geometric procedures, implemented in build.c. They turn nodes into the
 * values that procedures return. */
#ifndef VS_BIND_BUILD_H
#define VS_BIND_BUILD_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_arg vs_arg;
typedef struct vs_args vs_args;
typedef vs_status vs_procedure_fn(vs_args *f, vs_value *out);

vs_status vs_bind_make(vs_args *f, vs_kind kind, const void *data, const vs_ref *children, size_t n, vs_value *out);
/* Calls the procedure `one` for each curve or surface of argument 0 (geometry/parts.h). Sets *out to the union of the
 * results. */
vs_status vs_bind_each_part(vs_args *f, vs_procedure_fn *one, vs_value *out);
/* Sets *out to the empty object. Warns with the text `why`, once for each place of a call in the program. */
vs_status vs_bind_empty(vs_args *f, const char *why, vs_value *out);
vs_status vs_bind_give_node(vs_args *f, vs_node *node, vs_value *out);    /* Sets *out to an object of the node, whose
                                                                           * reference it takes over. */
/* Moves the figure *out from the plane XY into `plane` (#:plane). If the call's form has one point argument, the figure
 * is rotated about this point. Otherwise the figure's X and Y become coordinates in the plane. */
vs_status vs_bind_stand(vs_args *f, const vs_arg *plane, vs_value *out);

#endif
