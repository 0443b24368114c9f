/* Owns what can be done for points and faces that do not close, and saying where they do not. */
#ifndef VS_GEOMETRY_FILES_REPAIR_H
#define VS_GEOMETRY_FILES_REPAIR_H

#include "geometry/files/meshfile.h"

/* Equal points become one, points of no face go. False: out of memory. */
bool vs_face_list_compact(vs_face_list *l);

typedef struct {
  size_t count;      /* edges that are not met as often one way as the other; equal points are one */
  size_t face;       /* of the first: its face, zero-based */
  vs_vec3 from, to;
} vs_open_edges;
/* false: out of memory or interrupted; s may be NULL */
bool vs_face_list_open(vs_store *s, const vs_face_list *l, vs_open_edges *out, vs_error *e);

typedef struct {
  size_t welded;     /* points that went into one nearby */
  size_t dropped;    /* faces without area, and all but one of several alike; faces back to back go both */
  size_t turned;     /* faces */
  size_t holes;      /* closed */
  size_t largest;    /* edges of the greatest of them */
} vs_repair_notes;
/* In place: welds points within a millionth of the extent, drops faces, turns them to agree with their neighbours and
 * each shell outwards (unless it lies in another, and looks inwards: a cavity), closes what is open by triangles. The
 * result closes as a chain; it may still cross itself. s: whose owner may stop it, or NULL. False: out of memory or
 * interrupted. */
bool vs_face_list_repair(vs_store *s, vs_face_list *l, vs_repair_notes *notes, vs_error *e);

#endif
