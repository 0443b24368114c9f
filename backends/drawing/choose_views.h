/* Owns the choice of the views of a drawing. */
#ifndef VS_BACKENDS_DRAWING_CHOOSE_VIEWS_H
#define VS_BACKENDS_DRAWING_CHOOSE_VIEWS_H

#include "backends/drawing/flat_view.h"

/* The views that are to be drawn, the caller's to free by vs_emit_release. False: failed, and the error says why. */
bool vs_drawing_choose(vs_emitter *e, vs_flat_view **out, size_t *count, size_t *room);
/* Width of a model unit in millimetres. */
double vs_drawing_unit(const vs_scene *scene);

#endif
