/* Declares the search for the first triangle of a mesh that a ray intersects, for many rays. */
#ifndef VS_GEOMETRY_MEASURE_RAY_TREE_H
#define VS_GEOMETRY_MEASURE_RAY_TREE_H

#include "model/mesh.h"
#include "model/node.h"

/* A node of a bounding volume hierarchy. Inner nodes are divided into two halves, whose nodes come later in the array;
 * a leaf has a few triangles. */
typedef struct { vs_bounds box; uint32_t first,
    count; /* number of triangles of a leaf, from index `first` on; 0: the node is no leaf, its first half is the next
            * node, and `first` is the index of its second half */
} vs_ray_node;
typedef struct {
  const vs_mesh *mesh; /* the mesh, which belongs to the caller and must not change */
  vs_store *store;
  uint32_t *order;
  vs_ray_node *nodes;
  size_t node_count;
} vs_ray_tree;

bool vs_ray_tree_make(vs_ray_tree *t, vs_store *store, const vs_mesh *mesh, vs_error *e);
void vs_ray_tree_free(vs_ray_tree *t);
/* Finds the nearest triangle that a ray intersects. The ray begins at `from` and ends after `far` times `direction`.
 * any: true if any triangle on the ray is sufficient. *at: distance as a multiple of `direction`. Returns the number of
 * triangles if none is found. */
size_t vs_ray_tree_meet(const vs_ray_tree *t, vs_vec3 from, vs_vec3 direction, double far, bool any, double *at);

/* Returns the distance at which the ray meets the triangle, as a multiple of the direction, or INFINITY. The triangle
 * is enlarged by a tiny margin, so that no ray passes between two triangles. */
double vs_ray_meets_triangle(const vs_vec3 corners[3], vs_vec3 from, vs_vec3 direction);
/* Returns true if the ray from `from` intersects the box b within `far` times `direction`, by the slab method (Williams
 * and others, 2005). */
bool vs_ray_meets_box(const vs_bounds *b, vs_vec3 from, vs_vec3 direction, double far);

#endif
