/* Declares the functions of straighten.c, which decides which bends the result may lose. */
#ifndef VS_KERNEL_MESH_STRAIGHTEN_H
#define VS_KERNEL_MESH_STRAIGHTEN_H

#include "kernel/mesh/result_state.h"

/* Finds the planes with exactly one facet. Returns false on failure. */
bool vs_sheets_begin(vs_result_state *w);
/* Returns true if the edge with the uses a and b can be a seam: an edge between two facets of one sheet. */
bool vs_sheets_seam(const vs_result_state *w, const vs_use *a, const vs_use *b);
/* Finds the sheets that may lose bends; w->sheets stays NULL if there are none. Returns false on failure. */
bool vs_sheets_plan(vs_result_state *w);
/* Merges faces over their seams, and sets gone, parent and whole. *any: true if there is a seam to merge over. Returns
 * false on failure. */
bool vs_sheets_merge(vs_result_state *w, bool *any);
/* Checks the result after corners have been dropped. Gives up the merging of sheets where it is unsafe or has dropped
 * no corner. *again: true if the caller must merge and drop again. Returns false on failure. */
bool vs_sheets_check(vs_result_state *w, bool *again);
/* Tests a merged face, whose sides are in t. *simple: true if the sides intersect or touch only at their ends. Only
 * faces of sheets are tested. If *simple is false, the sheet is given up and the result is invalid: the caller makes it
 * again. Several threads may call this function at the same time. */
bool vs_sheets_simple(const vs_result_state *w, uint32_t face, vs_kernel *k, vs_triangulation *t, bool *simple);
/* Exchanges diagonals of the face's triangles until each triangle faces the same way as the sheet. If this is
 * impossible, marks the result as invalid. */
void vs_sheets_mend(const vs_result_state *w, uint32_t face, vs_triangulation *t);
bool vs_sheets_spoiled(const vs_result_state *w);
void vs_sheets_give_up(vs_result_state *w); /* gives up the merging of all sheets */
void vs_sheets_free(vs_kernel *k, vs_result_state *w);

#endif
