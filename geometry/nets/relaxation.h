/* Owns the equilibrium of points that cables and forces hold: dynamic relaxation. */
#ifndef VS_GEOMETRY_NETS_RELAXATION_H
#define VS_GEOMETRY_NETS_RELAXATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* A cable of a length, which it keeps where it is taut and which it may fall short of; or a force density: a pull that
 * is `density` times the distance of its ends. */
typedef struct {
  uint32_t a, b;
  double length;  /* of a cable; 0: a force density */
  double density; /* of a force density */
  double force;   /* in equilibrium, positive where it pulls: written here */
} vs_net_member;

typedef struct {
  vs_vec3 *at; /* moved to where they are in equilibrium */
  size_t count;
  const bool *fixed;
  const vs_vec3 *load; /* a force for each point */
  vs_net_member *members;
  size_t member_count;
  vs_vec3 weight;   /* force for each unit of a member's length, half of it at either end */
  double stiffness; /* of the cables: force for each unit of strain; 0: they keep their lengths */
} vs_net;

typedef enum {
  VS_RELAX_DONE,
  VS_RELAX_LOOSE,   /* point `where` is loaded and no members lead from it to a fixed one */
  VS_RELAX_SHORT,   /* cable `where` cannot be as short as it is to be between fixed points */
  VS_RELAX_FAR,     /* it has not come to rest after VS_RELAX_STEPS: `residual` is left */
  VS_RELAX_STOPPED, /* the caller said so */
  VS_RELAX_MEMORY
} vs_relax_outcome;

enum { VS_RELAX_STEPS = 400000 };

typedef struct {
  double residual; /* the greatest force that is not balanced at a free point, as a share of the greatest in a member */
  size_t steps, where;
} vs_relax_report;

/* Moves the free points of the net until forces are balanced to the share `tolerance`. The tolerance is above 0. */
vs_relax_outcome vs_net_relax(vs_net *n, double tolerance, vs_long_work work, vs_relax_report *out);

#endif
