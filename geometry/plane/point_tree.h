/* Declares searches for points in a triangle or a box. Each point can be switched on and off; searches ignore points
 * that are off. */
#ifndef VS_GEOMETRY_PLANE_POINT_TREE_H
#define VS_GEOMETRY_PLANE_POINT_TREE_H

#include "geometry/plane/ear_clipping.h"

/* A node of a binary tree of boxes. The points are sorted along a space-filling curve and divided into leaves of
 * POINT_TREE_LEAF points. `on`: number of switched-on points in the box. */
typedef struct { double min_x, min_y, max_x, max_y; size_t on; } vs_point_box;
typedef struct {
  const vs_vec2 *at;   /* positions, an array of the caller; point[i] is the index of item i's position in it */
  size_t count, leaves;
  size_t *order, *rank; /* order: items along the space-filling curve; rank[i]: index of item i in `order` */
  const size_t *point;
  bool *is_on;          /* is_on[r]: true if the item with the index r in `order` is switched on */
  vs_point_box *boxes;  /* nodes of the tree: node 1 is the root, and node i has the children 2 i and 2 i + 1; the
                         * leaves begin at index `leaves`, a power of two */
} vs_point_tree;

/* Makes the tree with all items off. point[i]: index in `at` of item i's position. Both arrays must live as long as the
 * tree. Returns false when memory is out. */
bool vs_point_tree_make(vs_point_tree *t, const vs_vec2 *at, const size_t *point, size_t count);
void vs_point_tree_free(vs_point_tree *t);
/* Switches an item of the tree on or off; searches find only switched-on items. */
void vs_point_tree_switch(vs_point_tree *t, size_t item, bool on);
/* Returns an item that is switched on and lies in the triangle, at another position than a, b and c; SIZE_MAX if there
 * is none. A point p is inside if twice the area of each of (a, b, p), (b, c, p) and (c, a, p) is at least -flat. */
size_t vs_point_tree_in(const vs_point_tree *t, vs_vec2 a, vs_vec2 b, vs_vec2 c, double flat);

/* Calls `found` for each item that is switched on and lies in the box or on its border. */
void vs_point_tree_each(const vs_point_tree *t, const vs_point_box *box, void (*found)(void *context, size_t item),
                        void *context);

/* returns twice the signed area of the triangle p, q, s */
static inline double vs_vec2_turn(vs_vec2 p, vs_vec2 q, vs_vec2 s) {
  return (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
}

#endif
