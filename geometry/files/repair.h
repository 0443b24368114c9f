/* Declares the functions for the repair of points and faces that do not close, and the report of the edges where they
 * do not. */
#ifndef VS_GEOMETRY_FILES_REPAIR_H
#define VS_GEOMETRY_FILES_REPAIR_H

#include "geometry/files/meshfile.h"

/* Makes equal points one, and removes points without a face. Returns false when memory is out. */
bool vs_face_list_compact(vs_face_list *l);

typedef struct {
  size_t count;      /* edges that are used more often in one direction than in the other; equal points are one */
  size_t face;       /* a face of the first such edge, zero-based */
  vs_vec3 from, to;
} vs_open_edges;
/* false: out of memory or interrupted; s may be NULL */
bool vs_face_list_open(vs_store *s, const vs_face_list *l, vs_open_edges *out, vs_error *e);

typedef struct {
  size_t welded;     /* points that became one with a nearby point */
  size_t dropped;    /* faces without area, and all but one of equal faces; of faces back to back, both */
  size_t turned;     /* faces */
  size_t holes;      /* closed holes */
  size_t largest;    /* edges of the largest hole */
} vs_repair_notes;
/* Repairs in place: welds points within a millionth of the extent, drops faces, turns faces to agree with their
 * neighbours, turns each shell outwards, and closes holes by triangles. A shell inside another that faces inwards is a
 * cavity, and is not turned. The result closes as a chain; it may still intersect itself. s: the store that may
 * interrupt the work, or NULL. Returns false when memory is out or the run is interrupted. */
bool vs_face_list_repair(vs_store *s, vs_face_list *l, vs_repair_notes *notes, vs_error *e);

#endif
