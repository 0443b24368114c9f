/* Owns the interface of baking: which groups of an X3D file become triangles. */
#ifndef VS_BACKENDS_X3D_BAKE_H
#define VS_BACKENDS_X3D_BAKE_H

#include "backends/x3d/x3d.h"

bool vs_x3d_settle(vs_emitter *e); /* bakes what has to be, and finds the paints of templates */
/* About how many bytes of text a form is as triangles with so many facets a turn. */
double vs_x3d_form_bytes(vs_x3d_form form, double facets);
double vs_x3d_batch_bytes(const vs_x3d *x, const vs_x3d_group *g); /* the same of a group's triangles and lines */

#endif
