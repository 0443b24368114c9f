/* Owns the interface of what decides which bends a result may lose. */
#ifndef VS_KERNEL_MESH_STRAIGHTEN_H
#define VS_KERNEL_MESH_STRAIGHTEN_H

#include "kernel/mesh/result_state.h"

/* Which planes have one facet. */
bool vs_sheets_begin(vs_result_state *w);
/* Can the edge between two faces be a seam? */
bool vs_sheets_seam(const vs_result_state *w, const vs_use *a, const vs_use *b);
/* Finds the sheets that may lose bends; w->sheets stays NULL where there are none. */
bool vs_sheets_plan(vs_result_state *w);
/* Merges over their seams: gone, parent, whole. *any: there are some. */
bool vs_sheets_merge(vs_result_state *w, bool *any);
/* After needless corners were dropped: gives up the sheets where that is not safe, or where nothing was dropped.
 * *again: there were such. */
bool vs_sheets_check(vs_result_state *w, bool *again);
/* *simple: the sides of what the face is merged with, in t, cross or touch nowhere but at their ends; of a sheet that
 * is asked. Else the sheet is given up, and the result is spoiled: it is to be made again. Threads may ask at once. */
bool vs_sheets_simple(const vs_result_state *w, uint32_t face, vs_kernel *k, vs_triangulation *t, bool *simple);
/* Turns edges of its triangles so that each is as flat as the sheet; else the same. */
void vs_sheets_mend(const vs_result_state *w, uint32_t face, vs_triangulation *t);
bool vs_sheets_spoiled(const vs_result_state *w);
void vs_sheets_give_up(vs_result_state *w); /* all of them */
void vs_sheets_free(vs_kernel *k, vs_result_state *w);

#endif
