/* Declares the interface of a primitive solid: the functions that each kind of role SHAPE (model/prims.def) provides
 * for its nodes.
 *
 * A kind has one file here, NAME.c, which ends with VS_SHAPE(NAME, ...). The macro gathers the functions NAME_bounds,
 * NAME_triangles, NAME_measure, NAME_holds and NAME_moved: a missing one does not compile. The optional entries are
 * always written; NULL means that the shape has none. Every function gets a node of its own kind, in the node's own
 * coordinates. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_H

#include "geometry/measure/measure.h"
#include "geometry/primitives/shape_map.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  /* Adds the bounds of n under a to b, exactly. Returns false on failure. */
  bool (*bounds)(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e);
  /* Appends the triangles, closed and facing outwards. Returns false on failure. */
  bool (*triangles)(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
  /* Sets volume, area and centroid of a measure whose `known` is true; clears `known` if there is no formula. area
   * false: the area is not needed and may be 0. Returns false on failure. */
  bool (*measure)(const vs_node *n, bool area, vs_measure *m, vs_error *e);
  /* Returns true if p, which lies in the bounds, is inside or on the surface. q: p in the axis's frame, whose top is at
   * z = height; p itself if there is no axis. */
  bool (*holds)(const vs_node *n, vs_vec3 p, vs_vec3 q, double height);
  /* Returns n under a as a node of n's kind in store s. NULL with *fits false: there is no such node; else NULL: out of
   * memory. */
  vs_node *(*moved)(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits);
  /* Sets the two ends of the axis. NULL: the kind has no axis. */
  void (*axis)(const vs_node *n, vs_vec3 *base, vs_vec3 *top);
  /* Returns n with its faces moved outwards by about `by`; NULL: out of memory. An entry of NULL: there is no such
   * formula. */
  vs_node *(*grown)(vs_store *s, const vs_node *n, double by);
  /* Returns n as a union of simpler shapes, for formats that write sets and lack this kind; the parts have no such
   * entry. NULL with *fits false: triangles suit n better; else NULL: out of memory. An entry of NULL: triangles suit
   * all of the kind. */
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

const vs_shape *vs_shape_of(const vs_node *n); /* NULL: the kind has another role */

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
