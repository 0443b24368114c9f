/* Defines the input of the kernel, which consists of leaves and terms, and its result as copies of meshes. */
#ifndef VS_KERNEL_PROBLEM_H
#define VS_KERNEL_PROBLEM_H

#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  const vs_mesh *mesh;  /* closed mesh, counter-clockwise as seen from outside; several leaves may use the same mesh. It
                         * may intersect itself; places where it overlaps itself are inside */
  vs_affine placement;
  uint32_t tag;         /* tag that the result's triangles get; the kernel merges coplanar faces whose tags or paints
                         * are equal */
  bool bare;            /* true: if the leaf is subtracted from a solid, its faces in the result get the tag of that
                         * solid */
} vs_kernel_leaf;

typedef enum {
  VS_TERM_LEAF,
  VS_TERM_UNION,
  VS_TERM_INTERSECTION,
  VS_TERM_DIFFERENCE /* value: the first operand minus all other operands */
} vs_term_kind;
typedef struct {
  vs_term_kind kind;
  uint32_t first;       /* for a LEAF: number of the leaf; for other kinds: index of the first operand in `operands` */
  uint32_t count;       /* Number of operands. Each operand is the number of an earlier term. If there is no operand,
                         * the term is the empty solid */
} vs_kernel_term;

typedef struct {
  const vs_kernel_leaf *leaves;
  const vs_kernel_term *terms;
  const uint32_t *operands;
  uint32_t leaf_count, term_count, operand_count;
  const uint32_t *paints; /* paint of each tag; NULL: the tags are the paints. A face that was merged from several tags
                           * has one of them */
  const uint64_t *identities; /* identity of each leaf's mesh. Meshes with equal identities are equal, in all problems.
                               * 0: the identity is unknown. NULL: all identities are unknown */
  const vs_bounds *within;  /* for each leaf, the bounds within which it matters; the kernel combines it with other
                             * leaves only in these bounds. The mesh of an endless solid extends beyond them. NULL: no
                             * bounds */
} vs_kernel_problem;

/* A result in which clusters that are copies of each other share one mesh. Each copy has the index of a mesh and a
 * placement. Copies are in the order of their first leaves. */
typedef struct { uint32_t mesh; vs_affine place; } vs_kernel_copy;
typedef struct {
  vs_mesh *meshes;
  vs_kernel_copy *copies;
  size_t mesh_count, mesh_room, copy_count, copy_room;
} vs_kernel_copies;

#endif
