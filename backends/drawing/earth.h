/* Declares the earth of drawings, which is below the ground where the model does not displace it. */
#ifndef VS_BACKENDS_DRAWING_EARTH_H
#define VS_BACKENDS_DRAWING_EARTH_H

#include "backends/drawing/flat_view.h"
#include "solids/hidden_lines.h"

/* The triangles of a view, in the view's coordinates. They include the cut faces. */
typedef struct {
  const vs_vec3 *points;
  const uint32_t (*triangles)[3];
  size_t point_count, triangle_count;
  size_t closed;   /* number of triangles of solids, which come first in the list */
  double slack;    /* lengths up to this count as zero */
  double nearest;  /* in a perspective view, the least distance from the eye */
} vs_earth_model;

/* Appends to `veil` the triangles, in the view's coordinates, behind which the earth hides everything. In an elevation
 * they cover everything below the ground. In a section they are the earth in the plane of the cut, and the earth also
 * becomes a fill of the view. In a view from above they are the ground itself, except where the model displaces it.
 *
 * A room or court below the ground contains no earth if the model encloses it. A view from below the ground has no such
 * triangles. Where walls rise from the ground, a slanting view gets edges. Returns false if memory is out, with the
 * emitter's error set. */
bool vs_flat_earth(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil, vs_sight_edges *edges);

#endif
