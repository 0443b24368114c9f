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

/* Appends to `veil` the triangles, in the view's coordinates, behind which the earth below the ground hides the model.
 * In a section, the earth in the plane of the cut also becomes a fill of the view. Returns false if memory is out, with
 * the emitter's error set. */
bool vs_flat_earth(vs_emitter *e, vs_flat_view *v, const vs_earth_model *m, vs_mesh *veil, vs_sight_edges *edges);

#endif
