/* Declares the bounds of a drawing and of its parts. They determine its fineness (the size of facets) and its
 * camera. */
#ifndef VS_BACKENDS_CAMERA_BOXES_H
#define VS_BACKENDS_CAMERA_BOXES_H

#include "backends/backend.h"

/* Computes e->bounds, e->boxes and the fineness of the drawing. Returns false, and sets e's error, if the drawing has
 * no bounds or shows nothing. */
bool vs_drive_bounds(vs_emitter *e);
/* Computes the bounds that the camera shows: e->framed and e->boxes, without the material that cuts remove. The
 * fineness still depends on the bounds of all operands, as it does when the model is measured. Returns false on
 * failure. */
bool vs_drive_frame(vs_emitter *e);
/* Sets the error that the format shows no object of the drawing; returns false. */
bool vs_drive_nothing(vs_emitter *e);

#endif
