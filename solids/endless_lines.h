/* Declares the replacement of lines without end by finite lines. */
#ifndef VS_SOLIDS_ENDLESS_LINES_H
#define VS_SOLIDS_ENDLESS_LINES_H

#include "solids/resolve.h"

/* Resolves all objects that the scene draws (solids/resolve.h), with the scene's tolerance. Lines without end become as
 * long as the other drawn objects, and are drawn last. If options->warns is true, the job receives a warning for each
 * such line outside the drawing. Returns false and sets e on failure. */
bool vs_scene_resolve(vs_scene *scene, const vs_kernel_options *options, vs_error *e);

#endif
