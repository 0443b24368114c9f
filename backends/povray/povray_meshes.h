/* Declares triangles as POV-Ray's text. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_MESHES_H
#define VS_BACKENDS_POVRAY_POVRAY_MESHES_H

#include "backends/povray/povray.h"

/* If POV-Ray would take long to combine a difference or an intersection in a picture, writes it as triangles and
 * returns VS_WHOLE. Otherwise writes nothing and returns VS_LOWER. */
vs_emit_status vs_povray_solid(vs_emitter *e, const vs_ref *ref);

vs_emit_fn vs_povray_polyface;

#endif
