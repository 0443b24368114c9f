/* Declares the rendering of pictures by POV-Ray. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_WORKER_H
#define VS_BACKENDS_POVRAY_POVRAY_WORKER_H

#include "backends/povray/povray_materials.h"

/* vs_povray_render_png renders a scene with POV-Ray and writes the picture to the output file as .png,
 * vs_povray_render_exr as .exr. */
bool vs_povray_render_png(vs_emitter *e, const char *scene, const char *output);
bool vs_povray_render_exr(vs_emitter *e, const char *scene, const char *output);

#endif
