/* Declares the functions of outlines.c: the closed curves around regions and flat surfaces. */
#ifndef VS_BIND_WORKSHOP_OUTLINES_H
#define VS_BIND_WORKSHOP_OUTLINES_H

#include "model/node.h"

typedef struct vs_args vs_args;

/* Returns the closed curves around the region, flat surface or closed curves in `ref`: first outer curves, then holes.
 * Sections and shadows in ref must already be computed (vs_bind_resolve). Each curve has the layers and materials of
 * ref. For a region that was made from curves, the results are these curves, otherwise closed lines. The nodes are
 * released when the call ends. If ref has no outline, sets the error and returns NULL. */
vs_ref *vs_bind_outlines(vs_args *f, vs_ref ref, size_t *count);

#endif
