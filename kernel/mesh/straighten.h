/* Declares the interface of straighten.c, which decides which bends a result may lose. */
#ifndef VS_KERNEL_MESH_STRAIGHTEN_H
#define VS_KERNEL_MESH_STRAIGHTEN_H

#include "kernel/mesh/result_state.h"

/* Finds the planes that have one facet. */
bool vs_sheets_begin(vs_result_state *w);
/* Returns true if the edge between two faces can be a seam. */
bool vs_sheets_seam(const vs_result_state *w, const vs_use *a, const vs_use *b);
/* Finds the sheets that may lose bends; w->sheets stays NULL if there are none. */
bool vs_sheets_plan(vs_result_state *w);
/* Merges faces over their seams; sets gone, parent and whole. *any: there are such seams. */
bool vs_sheets_merge(vs_result_state *w, bool *any);
/* After needless corners are dropped: gives up the sheets for which that is not safe, or in which nothing was dropped.
 * *again: the caller must repeat both steps. */
bool vs_sheets_check(vs_result_state *w, bool *again);
/* *simple: the sides of the merged face, in t, intersect or touch only at their ends; tested for sheets. Else the sheet
 * is given up and the result is spoiled: the caller makes it again. Threads may call it at the same time. */
bool vs_sheets_simple(const vs_result_state *w, uint32_t face, vs_kernel *k, vs_triangulation *t, bool *simple);
/* Turns edges of the face's triangles so that each faces as the sheet does; if that fails, spoils the result. */
void vs_sheets_mend(const vs_result_state *w, uint32_t face, vs_triangulation *t);
bool vs_sheets_spoiled(const vs_result_state *w);
void vs_sheets_give_up(vs_result_state *w); /* gives up all sheets */
void vs_sheets_free(vs_kernel *k, vs_result_state *w);

#endif
