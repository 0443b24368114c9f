/* Owns the form of a problem for the kernel, and of its result: leaves, terms, and copies of meshes. */
#ifndef VS_KERNEL_PROBLEM_H
#define VS_KERNEL_PROBLEM_H

#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  const vs_mesh *mesh;  /* closed, counter-clockwise seen from outside; may be shared by leaves; may cross itself
                         * (overlaps count as inside) */
  vs_affine placement;
  uint32_t tag;         /* the result's triangles carry it; coplanar faces of equal tag, or equal paint, are merged */
  bool bare;            /* where it is taken off something, the faces it makes have that thing's tag instead of its
                         * own */
} vs_kernel_leaf;

typedef enum {
  VS_TERM_LEAF,
  VS_TERM_UNION,
  VS_TERM_INTERSECTION,
  VS_TERM_DIFFERENCE /* the first less all others */
} vs_term_kind;
typedef struct {
  vs_term_kind kind;
  uint32_t first;       /* LEAF: the leaf; else the first of its operands */
  uint32_t count;       /* of operands (term numbers, smaller than this term's own); 0 is the empty solid */
} vs_kernel_term;

typedef struct {
  const vs_kernel_leaf *leaves;
  const vs_kernel_term *terms;
  const uint32_t *operands;
  uint32_t leaf_count, term_count, operand_count;
  const uint32_t *paints; /* of each tag, or NULL: each its own; where faces of several tags become one, that has one of
                           * them */
  const uint64_t *identities; /* of each leaf's mesh: numbers that are equal for equal meshes alone, ever; 0 where it
                               * has none. NULL: none has */
  const vs_bounds *within;  /* of each leaf, or NULL: where it makes a difference at all; what has no part in that is
                             * not joined to it. Leaves are larger than they need be where they stand for something
                             * endless */
} vs_kernel_problem;

/* A result in which clusters that are copies of each other stand once: mesh and placement of each, in the order of
 * their first leaves. */
typedef struct { uint32_t mesh; vs_affine place; } vs_kernel_copy;
typedef struct {
  vs_mesh *meshes;
  vs_kernel_copy *copies;
  size_t mesh_count, mesh_room, copy_count, copy_room;
} vs_kernel_copies;

#endif
