/* Owns the questions which of many points, some of them switched off, lie in a triangle or in a box. */
#ifndef VS_GEOMETRY_PLANE_POINT_TREE_H
#define VS_GEOMETRY_PLANE_POINT_TREE_H

#include "geometry/plane/ear_clipping.h"

/* Points in the order of a curve that fills the plane, in leaves of POINT_TREE_LEAF, under a binary tree of boxes that
 * know how many points below them are on. Building is n log n; switching costs the height; asking visits the boxes on
 * that the triangle reaches into. */
typedef struct { double min_x, min_y, max_x, max_y; size_t on; } vs_point_box;
typedef struct {
  const vs_vec2 *at;   /* the caller's; items have places at[point[item]] */
  size_t count, leaves;
  size_t *order, *rank; /* items by the curve, and where each one is in there */
  const size_t *point;
  bool *is_on;          /* by rank */
  vs_point_box *boxes;  /* node 1 is the root, 2 i and 2 i + 1 below i; leaves from `leaves` on, a power of two */
} vs_point_tree;

/* All points off. point[i] is the place of item i and must live as long as the tree. False: out of memory. */
bool vs_point_tree_make(vs_point_tree *t, const vs_vec2 *at, const size_t *point, size_t count);
void vs_point_tree_free(vs_point_tree *t);
/* Switches an item of the tree on or off. */
void vs_point_tree_switch(vs_point_tree *t, size_t item, bool on);
/* An item that is on and for which twice the area of the triangles (a, b, p), (b, c, p) and (c, a, p) is -flat or more,
 * and that is at none of the places a, b, c; SIZE_MAX: there is none. `flat` is 0 or more. */
size_t vs_point_tree_in(const vs_point_tree *t, vs_vec2 a, vs_vec2 b, vs_vec2 c, double flat);

/* Calls found for each item that is on and lies in the box, borders included. */
void vs_point_tree_each(const vs_point_tree *t, const vs_point_box *box, void (*found)(void *context, size_t item),
                        void *context);

/* twice the signed area */
static inline double vs_vec2_turn(vs_vec2 p, vs_vec2 q, vs_vec2 s) {
  return (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
}

#endif
