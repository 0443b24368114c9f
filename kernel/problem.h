/* Defines the input of the kernel, leaves (placed meshes) and terms (operations on them), and its result as copies of
 * meshes. */
#ifndef VS_KERNEL_PROBLEM_H
#define VS_KERNEL_PROBLEM_H

#include "model/mesh.h"
#include "model/node.h"

typedef struct {
  const vs_mesh *mesh;  /* Closed mesh, counter-clockwise as seen from outside; several leaves may have one mesh. It may
                         * intersect itself; places where it overlaps itself are inside. */
  vs_affine placement;
  uint32_t tag;         /* tag that the leaf's triangles get in the result; the kernel merges coplanar faces whose tags
                         * or paints are equal */
  bool bare;            /* if true, faces that this leaf cuts into another solid get the tag of that solid instead of
                         * this leaf's tag */
} vs_kernel_leaf;

typedef enum {
  VS_TERM_LEAF,
  VS_TERM_UNION,
  VS_TERM_INTERSECTION,
  VS_TERM_DIFFERENCE /* value of the term: the first operand minus all other operands */
} vs_term_kind;
typedef struct {
  vs_term_kind kind;
  uint32_t first;       /* for VS_TERM_LEAF: number of the leaf; for other kinds of terms: index, in the problem's
                         * `operands`, of the first operand */
  uint32_t count;       /* Number of operands. Each operand is the number of an earlier term. A term without operands is
                         * the empty solid. */
} vs_kernel_term;

typedef struct {
  const vs_kernel_leaf *leaves;
  const vs_kernel_term *terms;
  const uint32_t *operands;
  uint32_t leaf_count, term_count, operand_count;
  const uint32_t *paints; /* paints[i]: number of the paint of tag i; NULL: each tag is its own paint. A face that was
                           * merged from faces with several tags gets one of these tags. */
  const uint64_t *identities; /* identities[i]: serial number of leaf i's mesh, or 0 if unknown. Meshes with equal
                               * serial numbers are equal, even in different problems. NULL: all are unknown. */
  const vs_bounds *within;  /* within[i]: bounds outside of which leaf i cannot influence the result, so that the kernel
                             * may ignore the leaf there; used for endless solids; NULL: there are none */
} vs_kernel_problem;

/* A copy of a mesh in a result: the index of the mesh, and its placement. Clusters that are copies of each other share
 * one mesh. Copies are in the order of their first leaves. */
typedef struct { uint32_t mesh; vs_affine place; } vs_kernel_copy;
typedef struct {
  vs_mesh *meshes;
  vs_kernel_copy *copies;
  size_t mesh_count, mesh_room, copy_count, copy_room;
} vs_kernel_copies;

#endif
