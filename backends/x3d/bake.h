/* Declares baking: the conversion of groups of an X3D file to triangles. */
#ifndef VS_BACKENDS_X3D_BAKE_H
#define VS_BACKENDS_X3D_BAKE_H

#include "backends/x3d/x3d.h"

/* Converts objects that no Transform can place to triangles, and determines the paints of templates. */
bool vs_x3d_settle(vs_emitter *e);

#endif
