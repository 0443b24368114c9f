/* Declares triangles in POV-Ray's words. */
#ifndef VS_BACKENDS_POVRAY_POVRAY_MESHES_H
#define VS_BACKENDS_POVRAY_POVRAY_MESHES_H

#include "backends/povray/povray.h"

/* Of a difference or an intersection in a picture: where POV-Ray takes long to combine it, writes it as triangles and
 * answers VS_WHOLE; else VS_LOWER, and nothing is written. */
vs_emit_status vs_povray_solid(vs_emitter *e, const vs_ref *ref);

vs_emit_fn vs_povray_polyface;

#endif
