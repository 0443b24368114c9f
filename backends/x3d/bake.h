/* Declares baking: which groups of an X3D file become triangles. */
#ifndef VS_BACKENDS_X3D_BAKE_H
#define VS_BACKENDS_X3D_BAKE_H

#include "backends/x3d/x3d.h"

bool vs_x3d_settle(vs_emitter *e); /* converts as many groups to triangles as necessary, and determines the paints of
                                    * templates */
/* Returns the approximate number of bytes of a form's triangles as text, with this many facets in a full turn. */
double vs_x3d_form_bytes(vs_x3d_form form, double facets);
double vs_x3d_batch_bytes(const vs_x3d *x, const vs_x3d_group *g); /* returns the approximate number of bytes of a
                                                                    * group's triangles and lines */

#endif
