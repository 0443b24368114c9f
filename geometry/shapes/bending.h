/* Declares the bending of shapes by a map of space: leaves of objects as meshes, whose edges are halved until they
 * follow the map, and which become objects again. solids/deformed.h takes objects apart. The caller computes images of
 * points; this room knows no map. */
#ifndef VS_GEOMETRY_SHAPES_BENDING_H
#define VS_GEOMETRY_SHAPES_BENDING_H

#include "model/mesh.h"
#include "model/node.h"

enum { VS_BEND_LOOKS = 2 }; /* the innermost material and the innermost layer, which apply */

typedef struct {
  vs_mesh mesh; /* a curve has only points */
  bool curve, closed;
  vs_node *looks[VS_BEND_LOOKS]; /* retained */
  int look_count;
  const vs_origin *origin; /* the origin of the leaf */
} vs_bend_leaf;
typedef struct {
  vs_bend_leaf *at;
  size_t count, room;
} vs_bend_leaves;

void vs_bend_drop(vs_bend_leaves *leaves);
/* Returns the leaf's object, with its appearance, with the corners of `mesh` instead of its own. NULL: out of
 * memory. */
vs_node *vs_bend_node(vs_store *s, const vs_bend_leaf *leaf, const vs_mesh *mesh);

/* A leaf while it is bent. */
typedef struct vs_bending vs_bending;

/* Edges are cut if the image of the midpoint is farther from the chord than the tolerance, or they are longer than
 * `longest`, at most `rounds` times. NULL: out of memory. */
vs_bending *vs_bending_new(const vs_bend_leaf *leaf, double tolerance, double longest, int rounds);
void vs_bending_free(vs_bending *b); /* NULL is allowed */
/* Returns the points whose images are needed now; *count 0: none, the work is done. */
const vs_vec3 *vs_bending_wanted(const vs_bending *b, size_t *count);
/* Supplies the images of the wanted points, which exist. */
bool vs_bending_give(vs_bending *b, const vs_vec3 *images); /* false: out of memory */
/* Returns the leaf's mesh, cut and bent, which b owns. */
vs_mesh *vs_bending_mesh(vs_bending *b);

#endif
