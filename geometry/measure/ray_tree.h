/* Declares the functions for the search for the first triangle of a mesh that a ray hits, for many rays. */
#ifndef VS_GEOMETRY_MEASURE_RAY_TREE_H
#define VS_GEOMETRY_MEASURE_RAY_TREE_H

#include "model/mesh.h"
#include "model/node.h"

/* A bounding volume hierarchy: the two halves of a node's triangles follow it, down to a few triangles. */
typedef struct { vs_bounds box; uint32_t first,
    count; /* triangles of the order; count 0: the second half begins at node `first` */
} vs_ray_node;
typedef struct {
  const vs_mesh *mesh; /* the caller's, which must not change */
  vs_store *store;
  uint32_t *order;
  vs_ray_node *nodes;
  size_t node_count;
} vs_ray_tree;

bool vs_ray_tree_make(vs_ray_tree *t, vs_store *store, const vs_mesh *mesh, vs_error *e);
void vs_ray_tree_free(vs_ray_tree *t);
/* Finds the nearest triangle that the ray hits in front of `from`, up to `far` lengths of its direction; any: the first
 * one found. *at: the distance, in lengths of the direction. Returns the triangle's index, or the count of triangles if
 * there is none. */
size_t vs_ray_tree_meet(const vs_ray_tree *t, vs_vec3 from, vs_vec3 direction, double far, bool any, double *at);

/* Returns the distance at which the ray hits the triangle, or INFINITY (Moeller and Trumbore, 1997). A tiny margin
 * beyond the sides counts, so that no ray passes between two triangles. */
double vs_ray_meets_triangle(const vs_vec3 corners[3], vs_vec3 from, vs_vec3 direction);
/* Returns true if the ray hits the box before `far`. By slabs (Williams and others, 2005). */
bool vs_ray_meets_box(const vs_bounds *b, vs_vec3 from, vs_vec3 direction, double far);

#endif
