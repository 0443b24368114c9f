/* Owns the interface of measures.c: the measures of objects. */
#ifndef VS_BIND_MEASURES_H
#define VS_BIND_MEASURES_H

#include "geometry/frame.h"
#include "model/node.h"
#include "vm/machine/native.h"

typedef struct vs_args vs_args;

/* Polls during long work of the layers below; context is the vs_scheme. Returns false with the condition set. */
bool vs_bind_keep_going(void *vm, double done);
/* Replaces sections, shadows and edges in argument i by their geometry in space. */
vs_status vs_bind_resolve(vs_args *f, int i);
/* Sets *out to the bounds that (bounding-box o) returns for argument i, which must be finite and resolved. Returns
 * false with the error set. */
bool vs_bind_drawn_bounds(vs_args *f, int i, vs_bounds *out);
/* Sets *out to bounds of an object; of a cut one, to those of its parts. Resolves the object if its bounds need it.
 * Returns false with *e set. */
bool vs_bind_bounds(vs_scheme *vm, vs_ref ref, vs_bounds *out, vs_error *e);

#endif
