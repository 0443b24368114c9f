/* Declares the replacement of lines without end. */
#ifndef VS_SOLIDS_ENDLESS_LINES_H
#define VS_SOLIDS_ENDLESS_LINES_H

#include "solids/resolve.h"

/* Resolves all objects that the scene draws, at its tolerance. Lines without end become lines as long as the other
 * drawn objects, and are drawn last. */
bool vs_scene_resolve(vs_scene *scene, const vs_kernel_options *options, const vs_resolve_notes *notes, vs_error *e);

#endif
