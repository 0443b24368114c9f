/* Declares the marks of broken rules in drawings (require-that). */
#ifndef VS_BACKENDS_DRAWING_FAULT_MARKS_H
#define VS_BACKENDS_DRAWING_FAULT_MARKS_H

#include "backends/drawing/flat_view.h"

/* Adds a fill to a view with a cut for each object that breaks a rule: its section or, in plans, the shadow of an
 * object below the cut. Returns false, with the emitter's error set, on failure. */
bool vs_flat_faults(vs_emitter *e, vs_flat_view *v);

#endif
