/* Declares the equations of a structure: which degrees of freedom of its nodes can move, and the factored stiffness
 * matrix for these. */
#ifndef VS_GEOMETRY_STRUCTURE_STRUCTURE_SYSTEM_H
#define VS_GEOMETRY_STRUCTURE_STRUCTURE_SYSTEM_H

#include "geometry/structure/loose_ways.h"
#include "geometry/structure/member_matrices.h"
#include "geometry/structure/plate_matrices.h"
#include "geometry/structure/sparse_system.h"
#include "geometry/structure/structure.h"

#define VS_HELD UINT32_MAX /* value in `row` for a degree of freedom that cannot move, and so has no row in the
                            * equations */

/* A node whose rotation about an axis is held by a stiffness that belongs to no member. */
typedef struct {
  size_t node;
  vs_vec3 axis;     /* unit vector along the axis of the rotation */
  double stiffness; /* stiffness against the rotation, in Nm for each radian */
} vs_structure_spin;

/* The equations of a structure. Before vs_structure_system_make, the caller sets s, loose, spins and spin_count, and
 * all further members to 0. */
typedef struct {
  const vs_structure *s;
  bool *loose; /* loose[n]: receives the member `loose` of vs_structure_state for node n */
  const vs_structure_spin *spins;
  size_t spin_count;
  vs_node_stiffness *own; /* own[n]: stiffness that holds node n in directions in which nothing else holds it */
  uint32_t *row;          /* row[VS_WAYS * n + i]: row in the equations of degree of freedom i of node n, or VS_HELD */
  size_t rows;
  vs_sparse *equations;   /* the factored stiffness matrix; NULL if no degree of freedom can move */
} vs_structure_system;

/* Makes and factors the equations. loads: VS_WAYS numbers for each node and load case, including the loads of members.
 * The structure is a mechanism if a load acts in a direction in which nothing holds a node. The caller frees the
 * system, even after a failure. */
vs_structure_outcome vs_structure_system_make(vs_structure_system *w, const double *loads, vs_structure_report *report,
                                              vs_error *e);
void vs_structure_system_free(vs_structure_system *w);

/* Returns the index, among the degrees of freedom of all nodes, of degree of freedom i of a member's ends; i is 0 to
 * VS_MEMBER_WAYS - 1. */
static inline size_t vs_structure_way(const vs_structure_member *m, int i) {
  return (size_t)(i < VS_WAYS ? m->from : m->to) * VS_WAYS + (size_t)(i % VS_WAYS);
}
/* Sets axes to the member's own axes. Returns its length between its ends. */
static inline double vs_structure_axes(const vs_structure *s, const vs_structure_member *m, vs_vec3 axes[3]) {
  return vs_member_axes(vs_v3_add(s->at[m->from], m->offset[0]), vs_v3_add(s->at[m->to], m->offset[1]), m->roll, axes);
}
/* Returns the index, among the degrees of freedom of all nodes, of degree of freedom i of a plate's corners; i is 0 to
 * VS_PLATE_WAYS - 1. */
static inline size_t vs_structure_plate_way(const vs_structure_plate *p, int i) {
  return (size_t)p->node[i / VS_WAYS] * VS_WAYS + (size_t)(i % VS_WAYS);
}
/* Sets at to the positions of a plate's three corners. */
static inline void vs_structure_corners(const vs_structure *s, const vs_structure_plate *p, vs_vec3 at[3]) {
  for (int i = 0; i < 3; i++) at[i] = s->at[p->node[i]];
}

#endif
