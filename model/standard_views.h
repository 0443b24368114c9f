/* Declares the views that every model has: its plan, its section and views from six sides. */
#ifndef VS_MODEL_STANDARD_VIEWS_H
#define VS_MODEL_STANDARD_VIEWS_H

#include "model/scene.h"

/* whole: whether the sheet of all views contains the view. */
typedef struct { const char *name; vs_view view; vs_cut cut; bool whole; } vs_standard_view;
/* Returns the index-th of them, or NULL after the last. */
const vs_standard_view *vs_standard_view_at(size_t index);

/* Sets a plan's horizontal cut: 1.2 m above the ground if the model reaches more than 1.5 m above it, otherwise 1.2 m
 * above the model's lowest point. */
void vs_standard_cut_plan(const vs_scene *scene, const vs_bounds *b, vs_scene_view *v);
/* Returns the view for a model with these bounds. The cut of a plan is left to the caller. */
vs_scene_view vs_standard_view_for(const vs_standard_view *row, const vs_bounds *b);

#endif
