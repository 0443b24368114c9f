/* Owns the interface of measures.c: the measures of objects. */
#ifndef VS_BIND_MEASURES_H
#define VS_BIND_MEASURES_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* For what works long in the layers below: polls; false: the condition is set. context is the vs_scheme */
bool vs_bind_keep_going(void *vm, double done);
/* sections, shadows and edges in argument i become what they are in space */
vs_status vs_bind_resolve(vs_args *f, int i);
/* The bounds of argument i, which is finite and resolved, as (bounding-box o) tells them. False: the error is set. */
bool vs_bind_drawn_bounds(vs_args *f, int i, vs_bounds *out);
/* Bounds around an object, those of the parts of what is cut; where they need its mesh, that is made. */
bool vs_bind_bounds(vs_scheme *vm, vs_ref ref, vs_bounds *out, vs_error *e);

#endif
