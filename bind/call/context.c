/* Returns single members of vs_bind (context.h). */
#include "bind/call/context.h"

#include "bind/state.h"

vs_job *vs_bind_job(vs_scheme *vm) { return &vs_bind_of(vm)->job; }
vs_scene *vs_bind_scene(vs_scheme *vm) { return &vs_bind_of(vm)->scene; }
bool vs_bind_handing(vs_scheme *vm) { return vs_bind_of(vm)->handing; }
size_t vs_bind_most_triangles(vs_scheme *vm) { return vs_bind_of(vm)->mesh_triangles; }
size_t vs_bind_refused(vs_scheme *vm) { return vs_bind_of(vm)->refused; }
vs_derivation *vs_bind_growing(vs_scheme *vm) { return vs_bind_of(vm)->growing; }
