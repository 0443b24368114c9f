/* Declares the interface of a primitive solid: the functions that each kind of role SHAPE (model/prims.def) provides
 * for its nodes.
 *
 * Each kind has a file NAME.c in this folder, which ends with VS_SHAPE(NAME, ...). The macro collects the functions
 * NAME_bounds, NAME_triangles, NAME_measure, NAME_holds and NAME_moved. The compiler reports a missing function.
 * Optional functions must be written as NULL if the kind has none. Every function gets a node of its own kind, in the
 * node's own coordinates. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_H

#include "geometry/measure/measure.h"
#include "geometry/primitives/shape_map.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  /* Enlarges the box b by the exact bounds of n mapped by a. Returns false on failure. */
  bool (*bounds)(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e);
  /* Appends the triangles of n to out: a closed mesh that faces outwards. Returns false on failure. */
  bool (*triangles)(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
  /* Sets volume, area and centroid in m, where m->known is true at the call. Sets m->known to false if there is no
   * formula. If `area` is false, the area is not needed, and may be set to 0. Returns false on failure. */
  bool (*measure)(const vs_node *n, bool area, vs_measure *m, vs_error *e);
  /* Returns true if p, which lies in the bounds of n, is inside n or on its surface. `q`: p in a frame whose Z axis is
   * the shape's axis, from its base at 0 to its top at `height`; equal to p if the kind has no axis. */
  bool (*holds)(const vs_node *n, vs_vec3 p, vs_vec3 q, double height);
  /* Returns n mapped by a, as a node of the same kind in store s. Returns NULL and sets *fits to false if the mapped
   * shape is not of this kind. When memory is out, returns NULL, and *fits stays true. */
  vs_node *(*moved)(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits);
  /* Sets *base and *top to the two ends of the shape's axis. The function is NULL if the kind has no axis. */
  void (*axis)(const vs_node *n, vs_vec3 *base, vs_vec3 *top);
  /* Returns n with its faces moved outwards by about `by`, or NULL when memory is out. The function is NULL if the kind
   * has no formula for it. */
  vs_node *(*grown)(vs_store *s, const vs_node *n, double by);
  /* Returns n as a union of simpler shapes, for file formats without this kind. Returns NULL and sets *fits to false if
   * triangles are better for n; returns NULL with *fits true when memory is out. The member is NULL if triangles are
   * better for all nodes of the kind. */
  vs_node *(*parts)(vs_store *s, const vs_node *n, const vs_origin *origin, bool *fits);
} vs_shape;

#define VS_SHAPE(lower, axis_, grown_, parts_)                                                                         \
  const vs_shape vs_shape_##lower = { .bounds = lower##_bounds,                                                        \
                                      .triangles = lower##_triangles,                                                  \
                                      .measure = lower##_measure,                                                      \
                                      .holds = lower##_holds,                                                          \
                                      .moved = lower##_moved,                                                          \
                                      .axis = axis_,                                                                   \
                                      .grown = grown_,                                                                 \
                                      .parts = parts_ }

const vs_shape *vs_shape_of(const vs_node *n); /* returns the functions of the kind of n, or NULL if its role is not
                                                * VS_ROLE_SHAPE */

#define VS_SHAPE_SHAPE(lower) extern const vs_shape vs_shape_##lower;
#define VS_SHAPE_LEAF(lower)
#define VS_SHAPE_MADE(lower)
#define VS_SHAPE_PLACED(lower)
#define VS_SHAPE_WRAPPER(lower)
#define VS_SHAPE_SET(lower)
#define VS_KIND(upper, lower, name, class_, level, role, traits) VS_SHAPE_##role(lower)
#define VS_FIELD(type, member, argument)
#define VS_KIND_END(upper, lower)
#include "model/prims.def"
#undef VS_SHAPE_SHAPE
#undef VS_SHAPE_LEAF
#undef VS_SHAPE_MADE
#undef VS_SHAPE_PLACED
#undef VS_SHAPE_WRAPPER
#undef VS_SHAPE_SET

#endif
