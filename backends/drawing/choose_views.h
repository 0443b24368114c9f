/* Declares the choice of the views of a drawing. */
#ifndef VS_BACKENDS_DRAWING_CHOOSE_VIEWS_H
#define VS_BACKENDS_DRAWING_CHOOSE_VIEWS_H

#include "backends/drawing/flat_view.h"

/* Sets *out to the views to draw; the caller frees them with vs_emit_release. Returns false on failure, with e's error
 * set. */
bool vs_drawing_choose(vs_emitter *e, vs_flat_view **out, size_t *count, size_t *room);
/* Returns the length of a model unit in millimetres. */
double vs_drawing_unit(const vs_scene *scene);

#endif
