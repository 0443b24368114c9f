/* Declares the functions that decide which bends the result may lose: corners where a cut passes between facets that
 * the grid has split. */
#ifndef VS_KERNEL_MESH_STRAIGHTEN_H
#define VS_KERNEL_MESH_STRAIGHTEN_H

#include "kernel/mesh/result_state.h"

/* Sets w->lone[p] for each plane p: the only facet in the plane, or VS_NONE. Returns false on failure. */
bool vs_sheets_begin(vs_result_state *w);
/* Returns true if an edge can be a seam: an edge between two facets of one sheet (planar facet that the grid has
 * split). a, b: the edge as a boundary edge of each of its two faces. */
bool vs_sheets_seam(const vs_result_state *w, const vs_use *a, const vs_use *b);
/* Finds the sheets (planar facets that the grid has split) whose cuts may lose bends; w->sheets stays NULL if there are
 * none. Returns false on failure. */
bool vs_sheets_plan(vs_result_state *w);
/* Merges faces across the edges at which the grid has split a planar facet. Sets w->gone, w->parent and w->whole. *any:
 * true if there is such an edge. Returns false on failure. */
bool vs_sheets_merge(vs_result_state *w, bool *any);
/* Checks the result after corners have been dropped. Gives up the merging of faces where it is unsafe or has dropped no
 * corner. *again: true if the caller must merge faces and drop corners again. Returns false on failure. */
bool vs_sheets_check(vs_result_state *w, bool *again);
/* Sets *simple to true if the sides of the merged face's border, in t, intersect and touch each other only at their
 * ends. Tests only faces of facets that the grid has split. If *simple is false, gives up the merging of these faces,
 * and the caller makes the result again. Several threads may call this function at the same time. */
bool vs_sheets_simple(const vs_result_state *w, uint32_t face, vs_kernel *k, vs_triangulation *t, bool *simple);
/* Exchanges diagonals of the face's triangles until each triangle faces in the direction of the facet that the grid has
 * split. If this is impossible, marks the result as invalid. */
void vs_sheets_mend(const vs_result_state *w, uint32_t face, vs_triangulation *t);
bool vs_sheets_spoiled(const vs_result_state *w);
void vs_sheets_give_up(vs_result_state *w); /* gives up all merging of faces across edges at which the grid has split a
                                             * planar facet */
void vs_sheets_free(vs_kernel *k, vs_result_state *w);

#endif
