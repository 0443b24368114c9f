/* Declares structures: nodes, and straight members and flat triangles between them that carry forces. Units are metre,
 * newton, pascal.
 *
 * A node has six degrees of freedom (`ways` in the code): displacements along x, y and z, and rotations about them. A
 * member's own axes are: x from its first end to its second; y horizontal; z upwards as far as the member allows. The
 * own y of a vertical member is the global y. The roll turns y and z about x. */
#ifndef VS_GEOMETRY_STRUCTURE_STRUCTURE_H
#define VS_GEOMETRY_STRUCTURE_STRUCTURE_H

#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/model_error.h"
#include "model/vec.h"

enum { VS_WAYS = 6, VS_MEMBER_WAYS = 12 }; /* number of degrees of freedom of a node (displacements along x, y, z, then
                                            * rotations about them), and of both ends of a member */

typedef struct {
  uint32_t from, to;       /* indices of the nodes at the member's two ends */
  double area;             /* area of the member's cross-section, in m2, above 0 */
  double bend_y, bend_z;   /* second moments of area about the member's own y and z axes, in m4; 0: the member carries
                            * no moments */
  double twist;            /* torsion constant of the cross-section, in m4 */
  double modulus, shear;   /* moduli of elasticity and of shear, in Pa; the modulus of elasticity is above 0 */
  double roll;             /* angle by which the own y and z axes are turned about x, in radians */
  bool hinged[2];          /* hinged[i]: true if end i of the member carries no bending moments; a member with two
                            * hinges carries no torsion */
  vs_vec3 offset[2];       /* offset[i]: rigid arm in m, in global axes, from the node to end i of the member */
} vs_structure_member;

/* A triangle of a shell. */
typedef struct {
  uint32_t node[3]; /* indices of the nodes at its corners, which are not on a line */
  double thickness, modulus, poisson; /* thickness in m; modulus of elasticity in Pa; Poisson's ratio, from -1 to below
                                       * 0.5 */
} vs_structure_plate;

typedef struct {
  const vs_vec3 *at;
  size_t count;
  const vs_structure_member *members; /* the members; their nodes are indices below `count`, and their lengths between
                                       * their ends are above 0 */
  size_t member_count;
  const vs_structure_plate *plates;
  size_t plate_count;
  const bool *held;    /* held[VS_WAYS * n + i]: true if a support holds degree of freedom i of node n */
  size_t cases;        /* number of load cases */
  const double *loads; /* loads on nodes: VS_WAYS numbers for each node, for each load case; forces in N, then moments
                        * in Nm */
  const double *lines; /* distributed loads on members, in N/m of the member's length, in global axes: three numbers for
                        * each member, for each load case */
} vs_structure;

/* The results for each load case. The caller owns the arrays. */
typedef struct {
  double *moved;     /* movements of nodes, in global axes: VS_WAYS numbers for each node, for each load case;
                      * displacements in m, then rotations in radians */
  double *ends;      /* forces in N and moments in Nm that nodes exert on members, in the member's own axes:
                      * VS_MEMBER_WAYS numbers for each member, for each load case */
  double *reactions; /* forces in N and moments in Nm by the supports: VS_WAYS numbers for each node, for each load
                      * case */
  double *plates;    /* forces in the plates, in their own axes (plate_matrices.h): six numbers for each plate, for
                      * each load case */
  bool *loose;       /* loose[n]: true if nothing holds node n in some direction; the result is valid because no load
                      * acts in that direction */
} vs_structure_state;

typedef enum {
  VS_STRUCTURE_DONE,
  VS_STRUCTURE_MOVES,   /* the structure is a mechanism: node `where` can move in the direction `motion` without
                         * resistance */
  VS_STRUCTURE_STOPPED, /* the caller has interrupted */
  VS_STRUCTURE_FAILED   /* memory is out or a library is missing; the error is set */
} vs_structure_outcome;

typedef struct {
  size_t where;
  double motion[VS_WAYS];
} vs_structure_report;

/* Computes the movements and forces of the structure for all load cases, by linear theory: displacements are assumed to
 * be small. */
vs_structure_outcome vs_structure_solve(const vs_structure *s, vs_structure_state *out, vs_long_work work,
                                        vs_structure_report *report, vs_error *e);

#endif
