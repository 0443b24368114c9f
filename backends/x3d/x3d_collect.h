/* Declares the conversion of a drawing to groups. */
#ifndef VS_BACKENDS_X3D_X3D_COLLECT_H
#define VS_BACKENDS_X3D_X3D_COLLECT_H

#include "backends/x3d/x3d.h"

bool vs_x3d_open(vs_emitter *e, vs_x3d_notation notation); /* allocates the state of the back-end, e->state */
/* Returns true if X3D has a form for the node (box, sphere, cylinder, cone). Sets *form, and *place to the map from the
 * form to the node's own coordinates. */
bool vs_x3d_form_of(const vs_emitter *e, const vs_node *n, vs_x3d_form *form, vs_affine *place);
/* vs_x3d_bake_node adds the triangles of a node to the group `to`, and vs_x3d_bake_item those of an item (an object for
 * which X3D has a form). */
bool vs_x3d_bake_node(vs_emitter *e, vs_x3d_group *to, const vs_ref *ref, const vs_affine *place, uint32_t paint);
bool vs_x3d_bake_item(vs_emitter *e, vs_x3d_group *to, const vs_x3d_item *item);
vs_x3d_batch *vs_x3d_batches(vs_emitter *e, vs_x3d_group *g); /* returns the group's batches, allocated at the first
                                                               * call, or NULL if memory is out */

#endif
