/* Declares the gap between two closed meshes: their distance, or the faces where they touch. */
#ifndef VS_GEOMETRY_MEASURE_MESH_GAP_H
#define VS_GEOMETRY_MEASURE_MESH_GAP_H

#include "model/mesh.h"
#include "model/model_error.h"
#include "model/store/store.h"

/* The triangles of a mesh in a tree of boxes. */
typedef struct vs_gap_tree vs_gap_tree;

typedef struct {
  double distance;   /* smallest distance between the meshes, in model units; 0 if the area is above 0 */
  vs_vec3 at[2];     /* points of the two meshes at the smallest distance; the centre of the touching area if there is
                      * one */
  double area;       /* Area in which faces of the two meshes lie on each other and look in opposite directions; 0 if
                      * the meshes touch only at edges or points. */
  vs_vec3 centre;    /* centroid of the touching area; undefined if `area` is 0 */
} vs_mesh_gap;

/* Prepares mesh m for the search for gaps. Moves its data into the tree, and leaves *m empty. Returns NULL and sets e
 * on failure. */
vs_gap_tree *vs_gap_tree_new(vs_mesh *m, vs_store *store, vs_error *e);
void vs_gap_tree_free(vs_gap_tree *t); /* frees t, which may be NULL */

/* Sets *out to the gap between two meshes that do not intersect each other. Faces at a distance of at most `touching`
 * count as touching. Returns false if the distance is above `limit`. */
bool vs_mesh_gap_find(const vs_gap_tree *a, const vs_gap_tree *b, double limit, double touching, vs_mesh_gap *out);
/* Returns true if a coordinate plane, or the plane of a face of one mesh, separates the two meshes; each may extend
 * beyond the plane by `slack`. Returns false without a search if the meshes have many triangles. */
bool vs_mesh_gap_separated(const vs_gap_tree *a, const vs_gap_tree *b, double slack);

#endif
