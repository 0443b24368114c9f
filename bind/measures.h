/* Declares the measures of objects, implemented in measures.c. */
#ifndef VS_BIND_MEASURES_H
#define VS_BIND_MEASURES_H

#include "geometry/frame.h"
#include "model/job.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Callback for long computations; vm is the vs_scheme. Returns true to continue. On an interrupt, sets the error and
 * returns false. */
bool vs_bind_keep_going(void *vm, double done);
/* Replaces sections, shadows and edges in argument i by the curves and regions that they represent. */
vs_status vs_bind_resolve(vs_args *f, int i);
/* Sets *out to the bounds that (bounding-box o) returns for argument i. The argument must be finite, and its sections
 * and shadows computed. If it fails, sets the error and returns false. */
bool vs_bind_drawn_bounds(vs_args *f, int i, vs_bounds *out);
/* Sets *out to the bounds of an object; for an intersection or difference, computes them from the bounds of its
 * operands. If the bounds require it, computes sections and shadows in the object first. If it fails, sets *e and
 * returns false. */
bool vs_bind_bounds(vs_scheme *vm, vs_ref ref, vs_bounds *out, vs_error *e);

#endif
