/* Owns what a map of space bends: leaves of objects as meshes, whose edges are cut in half until they follow the map,
 * and which are made objects again. solids/deformed.h takes objects apart. Whose the map is does not matter: images of
 * points are asked for. */
#ifndef VS_GEOMETRY_SHAPES_BENDING_H
#define VS_GEOMETRY_SHAPES_BENDING_H

#include "model/mesh.h"
#include "model/node.h"

enum { VS_BEND_LOOKS = 2 }; /* the innermost paint and the innermost layer: those win */

typedef struct {
  vs_mesh mesh; /* a curve has its points alone */
  bool curve, closed;
  vs_node *looks[VS_BEND_LOOKS]; /* retained */
  int look_count;
  const vs_origin *origin; /* whoever made the leaf */
} vs_bend_leaf;
typedef struct {
  vs_bend_leaf *at;
  size_t count, room;
} vs_bend_leaves;

void vs_bend_drop(vs_bend_leaves *leaves);
/* The leaf's object, looks and all, with the corners of `mesh` in place of its own. NULL: out of memory. */
vs_node *vs_bend_node(vs_store *s, const vs_bend_leaf *leaf, const vs_mesh *mesh);

/* A leaf on its way through a map. */
typedef struct vs_bending vs_bending;

/* Edges are cut where the image of the middle lies further from the chord than the tolerance, and where they are longer
 * than `longest`, at most `rounds` times. NULL: out of memory. */
vs_bending *vs_bending_new(const vs_bend_leaf *leaf, double tolerance, double longest, int rounds);
void vs_bending_free(vs_bending *b); /* NULL is fine */
/* The points whose images are wanted now; *count 0: none, it is done. */
const vs_vec3 *vs_bending_wanted(const vs_bending *b, size_t *count);
/* Points are wanted. */
bool vs_bending_give(vs_bending *b, const vs_vec3 *images); /* false: out of memory */
/* The leaf's mesh, cut and bent; b's own. */
vs_mesh *vs_bending_mesh(vs_bending *b);

#endif
