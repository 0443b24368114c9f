/* Owns objects deformed by hexahedra: the trilinear map of an object's bounds onto eight corners.
 *
 * An object is meshed once and kept while it is the one that is placed; a hexahedron that is a moved or turned copy
 * of an earlier one gets that one's mesh, placed. Corner c of the eight is the image of the bounds' corner whose x,
 * y, z are at their high ends where the bits 1, 2, 4 of c are set. */
#ifndef VS_RULES_DEFORM_H
#define VS_RULES_DEFORM_H

#include "bind/bind.h"

typedef struct vs_deformer vs_deformer;

vs_deformer *vs_deformer_new(vs_bind *b); /* NULL: out of memory */
void vs_deformer_free(vs_deformer *d);    /* NULL is fine */
/* Returns the object deformed: placed, where the map is affine. NULL: the condition is set. */
vs_node *vs_deformer_apply(vs_deformer *d, const vs_vec3 corner[8], vs_ref object, const vs_bounds *bounds);

#endif
