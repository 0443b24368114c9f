/* Declares the functions of outlines.c: the closed curves around regions and flat surfaces. */
#ifndef VS_BIND_WORKSHOP_OUTLINES_H
#define VS_BIND_WORKSHOP_OUTLINES_H

#include "model/node.h"

typedef struct vs_args vs_args;

/* Returns the closed curves around the region, flat surface or closed curves `ref`, which are resolved: outer ones
 * first, then holes, each in ref's layers and materials. A region of curves gives its own curves, anything else closed
 * lines. The call owns the nodes. Returns NULL with the error set if ref has no outline. */
vs_ref *vs_bind_outlines(vs_args *f, vs_ref ref, size_t *count);

#endif
