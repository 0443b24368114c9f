/* Owns the form of a primitive solid: the questions that each kind of role SHAPE (model/prims.def) answers about its
 * nodes.
 *
 * A kind has one file here, NAME.c, which ends with VS_SHAPE(NAME, ...). The macro gathers the functions NAME_bounds,
 * NAME_triangles, NAME_measure, NAME_holds and NAME_moved: a missing one does not compile. The entries that not every
 * shape has are given in full; NULL there says that the shape has none. Every function gets a node of its own kind, in
 * the node's own coordinates. */
#ifndef VS_GEOMETRY_PRIMITIVES_SHAPE_H
#define VS_GEOMETRY_PRIMITIVES_SHAPE_H

#include "geometry/measure/measure.h"
#include "geometry/primitives/shape_map.h"
#include "geometry/tolerance.h"
#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  /* Adds the bounds of n under a to b, exactly. False: failed. */
  bool (*bounds)(const vs_node *n, const vs_affine *a, vs_bounds *b, vs_error *e);
  /* Appends the triangles, closed and facing outwards. False: failed. */
  bool (*triangles)(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e);
  /* Computes volume, area and centroid of a measure that says they are known; clears `known` where there is no formula.
   * area false: nobody asks for the area, and 0 will do. False: failed. */
  bool (*measure)(const vs_node *n, bool area, vs_measure *m, vs_error *e);
  /* Is p, which lies in the bounds, inside or on the surface? q: p in the frame on the axis, whose top is at z =
   * height; p itself where there is no axis. */
  bool (*holds)(const vs_node *n, vs_vec3 p, vs_vec3 q, double height);
  /* Returns the node that n is under a, of n's kind and in store s. NULL: with *fits false where a makes no such node
   * of it, else out of memory. */
  vs_node *(*moved)(vs_store *s, const vs_node *n, const vs_affine *a, const vs_shape_map *map, bool *fits);
  /* Answers the two ends of the axis. NULL: stands on none. */
  void (*axis)(const vs_node *n, vs_vec3 *base, vs_vec3 *top);
  /* Returns n with its faces moved outwards by about `by`, NULL when out of memory. NULL: it has no such formula. */
  vs_node *(*grown)(vs_store *s, const vs_node *n, double by);
  /* Returns the union of simpler shapes that n is, for formats that write sets and not this kind; the parts have no
   * such entry. NULL: with *fits false n is better as triangles, else out of memory. NULL: all of the kind are. */
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

const vs_shape *vs_shape_of(const vs_node *n); /* NULL: its role is another */

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
