/* Declares searches for points in a triangle or a box, among many points of which some are switched off. */
#ifndef VS_GEOMETRY_PLANE_POINT_TREE_H
#define VS_GEOMETRY_PLANE_POINT_TREE_H

#include "geometry/plane/ear_clipping.h"

/* Points in the order of a space-filling curve, in leaves of POINT_TREE_LEAF, under a binary tree of boxes. Each box
 * counts the points below it that are switched on. Building is n log n; switching takes the height; a search visits the
 * boxes with such points that the triangle intersects. */
typedef struct { double min_x, min_y, max_x, max_y; size_t on; } vs_point_box;
typedef struct {
  const vs_vec2 *at;   /* the caller's; item i has the position at[point[i]] */
  size_t count, leaves;
  size_t *order, *rank; /* items along the curve, and each item's index there */
  const size_t *point;
  bool *is_on;          /* by rank */
  vs_point_box *boxes;  /* node 1 is the root, 2 i and 2 i + 1 are below i; leaves begin at `leaves`, a power of two */
} vs_point_tree;

/* Makes the tree with all points off. point[i] is the index of item i's position; the arrays must live as long as the
 * tree. Returns false when memory is out. */
bool vs_point_tree_make(vs_point_tree *t, const vs_vec2 *at, const size_t *point, size_t count);
void vs_point_tree_free(vs_point_tree *t);
/* Switches an item of the tree on or off. */
void vs_point_tree_switch(vs_point_tree *t, size_t item, bool on);
/* Returns an item that is on, at none of the positions a, b, c, and in the triangle. It is in the triangle if twice the
 * areas of the triangles (a, b, p), (b, c, p) and (c, a, p) are -flat or more. SIZE_MAX: there is none. `flat` is 0 or
 * more. */
size_t vs_point_tree_in(const vs_point_tree *t, vs_vec2 a, vs_vec2 b, vs_vec2 c, double flat);

/* Calls found for each item that is on and lies in the box, borders included. */
void vs_point_tree_each(const vs_point_tree *t, const vs_point_box *box, void (*found)(void *context, size_t item),
                        void *context);

/* returns twice the signed area */
static inline double vs_vec2_turn(vs_vec2 p, vs_vec2 q, vs_vec2 s) {
  return (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
}

#endif
