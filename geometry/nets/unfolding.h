/* Declares the unfolding of closed meshes to flat pieces that do not overlap, with glue tabs. */
#ifndef VS_GEOMETRY_NETS_UNFOLDING_H
#define VS_GEOMETRY_NETS_UNFOLDING_H

#include "geometry/nets/flat_net.h"
#include "model/long_work.h"

/* Joins the flat faces of the net into few pieces that do not overlap in the plane. Returns false when memory is out,
 * or the caller interrupts. */
bool vs_flat_net_unfold(vs_flat_net *s, vs_long_work work);

/* A glue tab at a cut edge: a flap that is glued to another part of the paper model. */
typedef struct {
  uint32_t triangle, edge; /* the triangle that has the tab, and the index of the cut edge */
  vs_vec2 at[2];           /* the two outer corners of the tab; at[0] belongs to the first end of its edge along the
                            * border */
} vs_glue_tab;
/* Finds a glue tab of at most `width` for each cut edge. *tabs: array of *count tabs, which the caller frees; they
 * overlap no triangle and no other tab. *missing: number of cut edges without room for a tab. Returns false when memory
 * is out. */
bool vs_flat_net_tabs(const vs_flat_net *s, double width, vs_glue_tab **tabs, size_t *count, size_t *missing);

#endif
