/* Owns the question of what a ray meets first, put to the triangles of a mesh many times. */
#ifndef VS_GEOMETRY_MEASURE_RAY_TREE_H
#define VS_GEOMETRY_MEASURE_RAY_TREE_H

#include "model/mesh.h"
#include "model/node.h"

/* Boxes within boxes (a BVH): the two halves of a node's triangles follow it, down to a few. */
typedef struct { vs_bounds box; uint32_t first,
    count; /* of the order; count 0: the second half begins at node `first` */
} vs_ray_node;
typedef struct {
  const vs_mesh *mesh; /* the caller's, who leaves it as it is */
  vs_store *store;
  uint32_t *order;
  vs_ray_node *nodes;
  size_t node_count;
} vs_ray_tree;

bool vs_ray_tree_make(vs_ray_tree *t, vs_store *store, const vs_mesh *mesh, vs_error *e);
void vs_ray_tree_free(vs_ray_tree *t);
/* The nearest triangle that the ray meets in front of `from`, up to `far` lengths of its direction; any: whichever is
 * found first. *at: where, in lengths of the direction. Returns its number; the count of triangles: there is none. */
size_t vs_ray_tree_meet(const vs_ray_tree *t, vs_vec3 from, vs_vec3 direction, double far, bool any, double *at);

/* Where the ray meets the triangle, or INFINITY (Moeller and Trumbore, 1997). A hair beyond the sides counts, so that
 * no ray slips through between two triangles. */
double vs_ray_meets_triangle(const vs_vec3 corners[3], vs_vec3 from, vs_vec3 direction);
/* Does the ray meet the box before `far`? By slabs (Williams and others, 2005). */
bool vs_ray_meets_box(const vs_bounds *b, vs_vec3 from, vs_vec3 direction, double far);

#endif
