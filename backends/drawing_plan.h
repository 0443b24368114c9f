/* Declares the plan of a drawing's text: entries, templates and materials. */
#ifndef VS_BACKENDS_DRAWING_PLAN_H
#define VS_BACKENDS_DRAWING_PLAN_H

#include "backends/backend.h"

void vs_plan_operations(vs_drive *d); /* sets the members operation, brief and facets_at of d */
/* Gives the material the next number if it has no number yet. Returns false, and sets e's error, if memory is out. */
bool vs_plan_material(vs_emitter *e, const vs_material *m);
/* Plans all drawn objects. Returns false, and sets e's error, if memory is out, the user interrupts, or a warning about
 * an omitted object is an error. */
bool vs_plan_scene(vs_emitter *e);

#endif
