/* Reads the positional arguments of a checked call (positional.h). */
#include "bind/call/positional.h"

#include "bind/call/call.h"
#include "model/assert.h"

/* Returns argument i, which the procedure's row must contain. */
static const vs_arg *argument(const vs_args *f, int i) {
  VS_ASSERT(i >= 0 && i < VS_CALL_ARGUMENTS);
  return &f->arg[i];
}

vs_scheme *vs_call_vm(const vs_args *f) { return f->vm; }
vs_bind *vs_call_bind(const vs_args *f) { return f->bind; }
vs_store *vs_call_store(const vs_args *f) { return f->store; }

vs_value vs_arg_value(const vs_args *f, int i) { return argument(f, i)->value; }
bool vs_arg_given(const vs_args *f, int i) { return argument(f, i)->given; }
bool vs_arg_boolean(const vs_args *f, int i) { return argument(f, i)->boolean; }
double vs_arg_real(const vs_args *f, int i) { return argument(f, i)->real; }
int64_t vs_arg_integer(const vs_args *f, int i) { return argument(f, i)->integer; }
const char *vs_arg_text(const vs_args *f, int i) { return argument(f, i)->text.at; }
size_t vs_arg_text_length(const vs_args *f, int i) { return argument(f, i)->text.length; }
vs_vec3 vs_arg_point(const vs_args *f, int i) { return argument(f, i)->point; }

vs_arg_axis vs_arg_line(const vs_args *f, int i) {
  const vs_arg *a = argument(f, i);
  return (vs_arg_axis){ a->line.at, a->line.direction };
}

vs_affine vs_arg_matrix(const vs_args *f, int i) { return argument(f, i)->matrix; }

vs_arg_point_list vs_arg_points(const vs_args *f, int i) {
  const vs_arg *a = argument(f, i);
  return (vs_arg_point_list){ a->points.at, a->points.count };
}

vs_ref vs_arg_ref(const vs_args *f, int i) { return argument(f, i)->ref; }

vs_arg_ref_list vs_arg_refs(const vs_args *f, int i) {
  const vs_arg *a = argument(f, i);
  return (vs_arg_ref_list){ a->refs.at, a->refs.count };
}

struct vs_scope *vs_arg_scope(const vs_args *f, int i) { return argument(f, i)->scope; }
