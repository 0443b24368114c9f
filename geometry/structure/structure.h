/* Declares structures: nodes, and straight members between them that carry forces. Units are metre, newton, pascal.
 *
 * A node has six ways to move: along x, y and z, and turns about them. A member's own axes are: x from its first node
 * to its second; y horizontal; z upwards as far as the member allows. A vertical member has the global y for its own.
 * The roll turns y and z about x. */
#ifndef VS_GEOMETRY_STRUCTURE_STRUCTURE_H
#define VS_GEOMETRY_STRUCTURE_STRUCTURE_H

#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/model_error.h"
#include "model/vec.h"

enum { VS_WAYS = 6, VS_MEMBER_WAYS = 12 }; /* ways to move of a node, and of both ends of a member */

typedef struct {
  uint32_t from, to;       /* indices of nodes */
  double area;             /* m2, above 0 */
  double bend_y, bend_z;   /* second moments of area about the own y and z, in m4; 0: the member carries no moments */
  double twist;            /* torsion constant, in m4 */
  double modulus, shear;   /* moduli of elasticity and of shear, in Pa; modulus is above 0 */
  double roll;             /* radians */
  bool hinged[2];          /* whether an end carries no bending moments; a member with two hinges carries no torsion */
} vs_structure_member;

typedef struct {
  const vs_vec3 *at;
  size_t count;
  const vs_structure_member *members; /* their nodes are below count, and their lengths above 0 */
  size_t member_count;
  const bool *held;    /* VS_WAYS a node: whether a support holds it */
  size_t cases;        /* number of load cases */
  const double *loads; /* VS_WAYS a node, for each case: forces in N and moments in Nm */
  const double *lines; /* three numbers a member, for each case: load along the member in N/m, on global axes */
} vs_structure;

/* The state under each case, in arrays that the caller has made. */
typedef struct {
  double *moved;     /* VS_WAYS a node, for each case: m and radians, on global axes */
  double *ends;      /* VS_MEMBER_WAYS a member, for each case: forces and moments of the nodes on its ends, on its own
                      * axes */
  double *reactions; /* VS_WAYS a node, for each case: forces and moments of the supports */
  bool *loose;       /* a node: true if nothing held it in some direction, in which nothing loads it either */
} vs_structure_state;

typedef enum {
  VS_STRUCTURE_DONE,
  VS_STRUCTURE_MOVES,   /* the structure is a mechanism: node `where` moves by `motion` without resistance */
  VS_STRUCTURE_STOPPED, /* the caller has interrupted */
  VS_STRUCTURE_FAILED   /* memory is out or a library is missing; the error is set */
} vs_structure_outcome;

typedef struct {
  size_t where;
  double motion[VS_WAYS];
} vs_structure_report;

/* Computes the state of the structure, which is linear: displacements are small. */
vs_structure_outcome vs_structure_solve(const vs_structure *s, vs_structure_state *out, vs_long_work work,
                                        vs_structure_report *report, vs_error *e);

#endif
