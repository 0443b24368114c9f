/* Declares dynamic relaxation, which finds the equilibrium of points under cables and forces. */
#ifndef VS_GEOMETRY_NETS_RELAXATION_H
#define VS_GEOMETRY_NETS_RELAXATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/long_work.h"
#include "model/vec.h"

/* A member of the net, which connects two points: a cable, which keeps its length when taut, or a member that pulls
 * with `density` times the distance of its ends. */
typedef struct {
  uint32_t a, b;
  double length;  /* length of a cable in model units; 0: the member has a force density instead */
  double density; /* force density of a member: its force divided by its length */
  double force;   /* result: force in the member when all forces are balanced, positive for tension */
} vs_net_member;

typedef struct {
  vs_vec3 *at; /* positions of the points, which are moved to equilibrium */
  size_t count;
  const bool *fixed;
  const vs_vec3 *load; /* load[i]: force on point i of the net */
  vs_net_member *members;
  size_t member_count;
  vs_vec3 weight;   /* weight of a member per unit of its length; half of a member's weight acts at each of its ends */
  double stiffness; /* stiffness of all cables: force per unit of strain; 0: cables keep their lengths */
} vs_net;

typedef enum {
  VS_RELAX_DONE,
  VS_RELAX_LOOSE,   /* point number `where` has a load, and no members connect it to a fixed point */
  VS_RELAX_SHORT,   /* cable number `where` cannot become as short as required, because fixed points hold its ends
                     * apart */
  VS_RELAX_FAR,     /* the forces are not balanced after VS_RELAX_STEPS steps; `residual` is the remaining imbalance */
  VS_RELAX_STOPPED, /* the caller has interrupted the computation */
  VS_RELAX_MEMORY
} vs_relax_outcome;

enum { VS_RELAX_STEPS = 400000 };

typedef struct {
  double residual; /* remaining imbalance: the greatest unbalanced force at a free point, divided by the greatest force
                    * in a member */
  size_t steps, where;
} vs_relax_report;

/* Moves the free points of the net until the forces are balanced: the greatest unbalanced force, divided by the
 * greatest force in a member, is at most `tolerance` > 0. */
vs_relax_outcome vs_net_relax(vs_net *n, double tolerance, vs_long_work work, vs_relax_report *out);

#endif
