/* Declares the equilibrium of points under cables and forces: dynamic relaxation. */
#ifndef VS_GEOMETRY_NETS_RELAXATION_H
#define VS_GEOMETRY_NETS_RELAXATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* A cable of a fixed length, which keeps it when taut and may be slack; or a force density: a pull of `density` times
 * the distance of its ends. */
typedef struct {
  uint32_t a, b;
  double length;  /* of a cable; 0: a force density */
  double density; /* of a force density */
  double force;   /* the result: the force in equilibrium, positive for tension */
} vs_net_member;

typedef struct {
  vs_vec3 *at; /* positions, which are moved to equilibrium */
  size_t count;
  const bool *fixed;
  const vs_vec3 *load; /* a force for each point */
  vs_net_member *members;
  size_t member_count;
  vs_vec3 weight;   /* force per unit of a member's length, half of it at either end */
  double stiffness; /* of the cables: force per unit of strain; 0: they keep their lengths */
} vs_net;

typedef enum {
  VS_RELAX_DONE,
  VS_RELAX_LOOSE,   /* point `where` is loaded, and no members connect it to a fixed point */
  VS_RELAX_SHORT,   /* the fixed points keep cable `where` longer than its length */
  VS_RELAX_FAR,     /* no equilibrium after VS_RELAX_STEPS; `residual` remains */
  VS_RELAX_STOPPED, /* the caller interrupted */
  VS_RELAX_MEMORY
} vs_relax_outcome;

enum { VS_RELAX_STEPS = 400000 };

typedef struct {
  double residual; /* the greatest unbalanced force at a free point, as a share of the greatest in a member */
  size_t steps, where;
} vs_relax_report;

/* Moves the free points of the net until forces are balanced to the share `tolerance` > 0. */
vs_relax_outcome vs_net_relax(vs_net *n, double tolerance, vs_long_work work, vs_relax_report *out);

#endif
