/* Owns objects that a map of space bends: taken apart into meshes, whose edges are cut in half until they follow the
 * map, and made objects again. Whose the map is does not matter: it is asked for the images of points. */
#ifndef VS_BIND_BENDING_H
#define VS_BIND_BENDING_H

#include "bind/bind.h"
#include "geometry/tessellate.h"

/* The fineness at which what is kept as triangles or points is sampled: the program's own, else the drawing rule at
 * the object's size. */
vs_facets vs_bend_facets(vs_bind *b, const vs_node *n);

enum { VS_BEND_LOOKS = 8 };

typedef struct {
  vs_mesh mesh; /* a curve has its points alone */
  bool curve, closed;
  vs_node *looks[VS_BEND_LOOKS]; /* outermost first; retained */
  int look_count;
} vs_bend_leaf;
typedef struct {
  vs_bend_leaf *at;
  size_t count, room;
} vs_bend_leaves;

/* Takes an object apart into leaves with their looks, each a mesh in the object's coordinates. no_regions: the error
 * that a region is, or NULL: regions are surfaces. False: the condition is set. */
bool vs_bend_take_apart(vs_bind *b, vs_ref object, const char *no_regions, vs_bend_leaves *out);
void vs_bend_drop(vs_bend_leaves *leaves);
/* The leaf's object, looks and all, with the corners of `mesh` in place of its own. NULL: out of memory. */
vs_node *vs_bend_node(vs_bind *b, const vs_bend_leaf *leaf, const vs_mesh *mesh);

/* One leaf on its way through a map. */
typedef struct vs_bending vs_bending;

/* Edges are cut where the image of the middle lies further from the chord than the tolerance, and where they are longer
 * than `longest`, at most `rounds` times. NULL: out of memory. */
vs_bending *vs_bending_new(const vs_bend_leaf *leaf, double tolerance, double longest, int rounds);
void vs_bending_free(vs_bending *b); /* NULL is fine */
/* The points whose images are wanted now; *count 0: none, it is done. */
const vs_vec3 *vs_bending_wanted(const vs_bending *b, size_t *count);
bool vs_bending_give(vs_bending *b, const vs_vec3 *images); /* false: out of memory */
/* The leaf's mesh, cut and bent; b's own. */
vs_mesh *vs_bending_mesh(vs_bending *b);

#endif
