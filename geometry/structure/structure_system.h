/* Declares the equations of a structure: which ways of its nodes move, and the factored stiffness of these. */
#ifndef VS_GEOMETRY_STRUCTURE_STRUCTURE_SYSTEM_H
#define VS_GEOMETRY_STRUCTURE_STRUCTURE_SYSTEM_H

#include "geometry/structure/loose_ways.h"
#include "geometry/structure/member_matrices.h"
#include "geometry/structure/sparse_system.h"
#include "geometry/structure/structure.h"

#define VS_HELD UINT32_MAX /* row of a way that does not move */

/* A node whose turns about an axis something beside the members holds. */
typedef struct {
  size_t node;
  vs_vec3 axis;     /* of length 1 */
  double stiffness; /* Nm */
} vs_structure_spin;

/* The caller sets the first members, and zeros the others. */
typedef struct {
  const vs_structure *s;
  bool *loose; /* of each node: a member of vs_structure_state */
  const vs_structure_spin *spins;
  size_t spin_count;
  vs_node_stiffness *own; /* of each node: stiffness that holds its loose directions */
  uint32_t *row;          /* of each way of each node: its row in the equations, or VS_HELD */
  size_t rows;
  vs_sparse *equations;   /* factored; NULL if no way moves */
} vs_structure_system;

/* Makes and factors the equations. loads: of nodes and members, VS_WAYS a node for each case; they decide whether a
 * loose direction is a mechanism. The caller frees the system, after a failure, too. */
vs_structure_outcome vs_structure_system_make(vs_structure_system *w, const double *loads, vs_structure_report *report,
                                              vs_error *e);
void vs_structure_system_free(vs_structure_system *w);

/* Returns the place of way i of a member's ends among the ways of all nodes. */
static inline size_t vs_structure_way(const vs_structure_member *m, int i) {
  return (size_t)(i < VS_WAYS ? m->from : m->to) * VS_WAYS + (size_t)(i % VS_WAYS);
}

#endif
