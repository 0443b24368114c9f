/* Declares the earth in drawings. It fills the space below the ground that the model does not occupy. */
#ifndef VS_BACKENDS_DRAWING_EARTH_H
#define VS_BACKENDS_DRAWING_EARTH_H

#include "backends/drawing/flat_view.h"
#include "solids/hidden_lines.h"

/* The triangles of a view, in the view's coordinates. They include the cut faces. */
typedef struct {
  const vs_vec3 *points;
  const uint32_t (*triangles)[3];
  size_t point_count, triangle_count;
  size_t closed;   /* number of triangles of solids, which precede the other triangles */
  double slack;    /* lengths up to this count as zero */
  double nearest;  /* in a perspective view, the least distance from the eye */
} vs_earth_model;

/* Appends to `veil` the triangles, in the view's coordinates, behind which the earth hides everything. In an elevation
 * they cover everything below the ground. In a section they are the earth in the plane of the cut, and the earth also
 * becomes a fill of the view. In a view from above they are the plane of the ground, except where the model occupies
 * it.
 *
 * A room or court below the ground contains no earth if the model encloses it. A view from below the ground has no such
 * triangles. A slanting view gets edges where walls rise from the ground. Returns false if memory is out, with the
 * emitter's error set. */
bool vs_flat_earth(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil, vs_sight_edges *edges);

#endif
