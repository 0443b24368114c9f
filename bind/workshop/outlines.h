/* Declares the functions of outlines.c: the closed curves around regions and flat surfaces. */
#ifndef VS_BIND_WORKSHOP_OUTLINES_H
#define VS_BIND_WORKSHOP_OUTLINES_H

#include "model/node.h"

typedef struct vs_args vs_args;

/* Returns the closed curves around the region, the flat surface or the closed curves in `ref`, which must be resolved.
 * Outer curves come first, then holes. Each has the layers and materials of ref. For a region of curves these are its
 * own curves, otherwise closed lines. The call's memory owns the nodes. If ref has no outline, sets the error and
 * returns NULL. */
vs_ref *vs_bind_outlines(vs_args *f, vs_ref ref, size_t *count);

#endif
