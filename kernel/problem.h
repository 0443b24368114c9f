/* Owns the form of a problem for the kernel, and of its result: leaves, terms, and copies of meshes. */
#ifndef VS_KERNEL_PROBLEM_H
#define VS_KERNEL_PROBLEM_H

#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  const vs_mesh *mesh;  /* closed, counter-clockwise seen from outside; several leaves may share it; may intersect
                         * itself (overlaps count as inside) */
  vs_affine placement;
  uint32_t tag;         /* tag of the result's triangles; the kernel merges coplanar faces of equal tag or equal
                         * paint */
  bool bare;            /* if the leaf is subtracted from a solid, the faces that it makes have the tag of that solid */
} vs_kernel_leaf;

typedef enum {
  VS_TERM_LEAF,
  VS_TERM_UNION,
  VS_TERM_INTERSECTION,
  VS_TERM_DIFFERENCE /* the first operand less all others */
} vs_term_kind;
typedef struct {
  vs_term_kind kind;
  uint32_t first;       /* LEAF: the leaf; else the index of its first operand */
  uint32_t count;       /* number of operands (term numbers smaller than this term's); 0 is the empty solid */
} vs_kernel_term;

typedef struct {
  const vs_kernel_leaf *leaves;
  const vs_kernel_term *terms;
  const uint32_t *operands;
  uint32_t leaf_count, term_count, operand_count;
  const uint32_t *paints; /* paint of each tag, or NULL: every tag is a paint. A face merged from several tags has one
                           * of them */
  const uint64_t *identities; /* of each leaf's mesh: numbers that are equal for equal meshes only, at any time; 0: the
                               * mesh has none. NULL: no mesh has one */
  const vs_bounds *within;  /* of each leaf, or NULL: the bounds in which the leaf matters. The kernel joins it to other
                             * leaves only there. A leaf for an endless solid is larger than its bounds */
} vs_kernel_problem;

/* A result that contains clusters which are copies of each other once: mesh and placement of each, in the order of
 * their first leaves. */
typedef struct { uint32_t mesh; vs_affine place; } vs_kernel_copy;
typedef struct {
  vs_mesh *meshes;
  vs_kernel_copy *copies;
  size_t mesh_count, mesh_room, copy_count, copy_room;
} vs_kernel_copies;

#endif
