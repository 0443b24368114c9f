/* Declares the bending of shapes by a map of space. Leaves of objects (found by solids/deformed.h) become meshes, whose
 * edges are halved until they follow the map; then the meshes become objects again. The caller computes the map for
 * given points. */
#ifndef VS_GEOMETRY_SHAPES_BENDING_H
#define VS_GEOMETRY_SHAPES_BENDING_H

#include "model/mesh.h"
#include "model/node.h"

enum { VS_BEND_LOOKS = 2 }; /* number of nodes around a leaf that its bent mesh gets, too: the innermost material and
                             * the innermost layer */

typedef struct {
  vs_mesh mesh; /* mesh of the leaf before the bending; for a curve, it has only vertices */
  bool curve, closed;
  vs_node *looks[VS_BEND_LOOKS]; /* material and layer of the leaf; the leaf owns these references */
  int look_count;
  const vs_origin *origin; /* place in the source where the leaf was made */
} vs_bend_leaf;
typedef struct {
  vs_bend_leaf *at;
  size_t count, room;
} vs_bend_leaves;

void vs_bend_drop(vs_bend_leaves *leaves);
/* Returns an object like the leaf, with its material and layer, but with the vertices of `mesh`. Returns NULL when
 * memory is out. */
vs_node *vs_bend_node(vs_store *s, const vs_bend_leaf *leaf, const vs_mesh *mesh);

/* The state of the bending of one leaf. */
typedef struct vs_bending vs_bending;

/* Starts the bending of a leaf. An edge is cut in half if it is longer than `longest`, or if the mapped midpoint is
 * farther than `tolerance` from the chord between the mapped ends. Edges are cut at most `rounds` times. Returns NULL
 * when memory is out. */
vs_bending *vs_bending_new(const vs_bend_leaf *leaf, double tolerance, double longest, int rounds);
void vs_bending_free(vs_bending *b); /* frees the state b, which may be NULL */
/* Returns the points for which the caller is to compute the map next. *count: number of points; 0: the bending is
 * complete. */
const vs_vec3 *vs_bending_wanted(const vs_bending *b, size_t *count);
/* Receives the mapped points: images[i] is the image of point i in the array that vs_bending_wanted returned. */
bool vs_bending_give(vs_bending *b, const vs_vec3 *images); /* returns false when memory is out */
/* Returns the mesh after the bending, which belongs to b. */
vs_mesh *vs_bending_mesh(vs_bending *b);

#endif
