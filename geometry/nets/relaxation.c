/* Implements dynamic relaxation (relaxation.h).
 *
 * The points are masses, which forces move in steps of one unit of time. When the kinetic energy has passed a maximum,
 * all points are stopped (M. Barnes, Form finding and analysis of tension structures by dynamic relaxation, 1999). The
 * mass of a point is the sum of the stiffnesses of its members, which keeps the steps stable. Cables of fixed length
 * are modelled as springs. Their unstrained lengths are reduced by their strain, repeatedly, until they have the
 * required lengths under load. */
#include "geometry/nets/relaxation.h"

#include <math.h>
#include <stdlib.h>

#include "model/store/array.h"

/* ROUNDS: greatest number of rounds in which cable lengths are adjusted. SOFT: number of rounds after which cables
 * become stiffer. POLL: number of steps between two calls of the caller. STIFFER: stiffness of a cable in units of its
 * greatest force. */
enum { ROUNDS = 24, SOFT = 8, POLL = 64, STIFFER = 10 };

typedef struct {
  vs_net *net;
  double *rest; /* rest[k]: length of member k when it carries no load */
  vs_vec3 *force, *speed;
  double *mass;
  size_t rest_room, force_room, speed_room, mass_room;
  double stiffness, greatest; /* stiffness: force in a cable per unit of strain; greatest: greatest force in a member at
                               * the last evaluation */
} relaxation;

/* ---- connection of points to fixed points ---- */

static uint32_t root_of(uint32_t *parent, uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/* Checks that members connect each loaded point of the net to a fixed point. *where: a loaded point without such a
 * connection. */
static vs_relax_outcome held(const vs_net *n, size_t *where) {
  uint32_t *parent = NULL;
  bool *has = NULL;
  size_t parent_room = 0, has_room = 0;
  vs_relax_outcome outcome = VS_RELAX_DONE;
  if (VS_GROW(parent, parent_room, n->count + 1) && VS_GROW(has, has_room, n->count + 1)) {
    for (size_t i = 0; i < n->count; i++) parent[i] = (uint32_t)i, has[i] = false;
    for (size_t k = 0; k < n->member_count; k++)
      parent[root_of(parent, n->members[k].a)] = root_of(parent, n->members[k].b);
    for (size_t i = 0; i < n->count; i++)
      if (n->fixed[i]) has[root_of(parent, (uint32_t)i)] = true;
    bool weighs = vs_v3_length(n->weight) > 0;
    for (size_t i = n->count; i-- > 0;) {
      bool joined = parent[i] != i || root_of(parent, (uint32_t)i) != i;
      if (!has[root_of(parent, (uint32_t)i)] && (vs_v3_length(n->load[i]) > 0 || (weighs && joined)))
        *where = i, outcome = VS_RELAX_LOOSE;
    }
  } else {
    outcome = VS_RELAX_MEMORY;
  }
  free(parent), free(has);
  return outcome;
}

/* ---- forces ---- */

/* Computes, from the positions of the net's points, the force on each point, the mass of each point, and the force in
 * each member. */
static void look(relaxation *r) {
  vs_net *n = r->net;
  r->greatest = 0;
  for (size_t i = 0; i < n->count; i++) r->force[i] = n->load[i], r->mass[i] = 0;
  for (size_t k = 0; k < n->member_count; k++) {
    vs_net_member *m = &n->members[k];
    vs_vec3 way = vs_v3_sub(n->at[m->b], n->at[m->a]);
    double length = vs_v3_length(way), pull, stiff, weighs;
    if (m->length > 0) {
      double strain = length / r->rest[k] - 1;
      m->force = strain > 0 ? r->stiffness * strain : 0;
      pull = length > 0 ? m->force / length : 0;
      stiff = r->stiffness / r->rest[k] + pull, weighs = m->length;
    } else {
      m->force = m->density * length, pull = stiff = m->density, weighs = length;
    }
    vs_vec3 f = vs_v3_scale(way, pull), half = vs_v3_scale(n->weight, .5 * weighs);
    r->force[m->a] = vs_v3_add(vs_v3_add(r->force[m->a], f), half);
    r->force[m->b] = vs_v3_add(vs_v3_sub(r->force[m->b], f), half);
    r->mass[m->a] += fabs(stiff), r->mass[m->b] += fabs(stiff);
    if (m->force > r->greatest) r->greatest = m->force;
  }
}

/* Returns the greatest unbalanced force at a free point, divided by the greatest force in a member or the greatest
 * load. */
static double residual(const relaxation *r) {
  double worst = 0, scale = r->greatest;
  for (size_t i = 0; i < r->net->count; i++) {
    if (!r->net->fixed[i]) worst = fmax(worst, vs_v3_length(r->force[i]));
    scale = fmax(scale, vs_v3_length(r->net->load[i]));
  }
  return worst > 0 ? worst / scale : 0;
}

/* ---- steps in time ---- */

static void halt(relaxation *r) {
  for (size_t i = 0; i < r->net->count; i++) r->speed[i] = (vs_vec3){ 0, 0, 0 };
}

/* Moves the points of the net until the forces are balanced within `tolerance`. Adds the number of steps to *out. */
static vs_relax_outcome settle(relaxation *r, double tolerance, vs_long_work work, vs_relax_report *out) {
  vs_net *n = r->net;
  double before = 0;
  halt(r);
  for (;; out->steps++) {
    look(r);
    out->residual = residual(r);
    if (!(out->residual > tolerance)) return isfinite(out->residual) ? VS_RELAX_DONE : VS_RELAX_FAR;
    if (out->steps >= VS_RELAX_STEPS) return VS_RELAX_FAR;
    if (out->steps % POLL == 0 && !work.going(work.context, 0)) return VS_RELAX_STOPPED;
    double energy = 0;
    for (size_t i = 0; i < n->count; i++) {
      if (n->fixed[i] || !(r->mass[i] > 0)) continue;
      r->speed[i] = vs_v3_add(r->speed[i], vs_v3_scale(r->force[i], 1 / r->mass[i]));
      energy += r->mass[i] * vs_v3_dot(r->speed[i], r->speed[i]);
    }
    bool peak = energy < before;
    for (size_t i = 0; i < n->count; i++) {
      if (n->fixed[i] || !(r->mass[i] > 0)) continue;
      /* The kinetic energy had its maximum about half a step ago, so the points move back by half a step. */
      vs_vec3 back = vs_v3_scale(vs_v3_sub(vs_v3_scale(r->force[i], 1 / r->mass[i]), r->speed[i]), .5);
      n->at[i] = vs_v3_add(n->at[i], peak ? back : r->speed[i]);
    }
    before = peak ? 0 : energy;
    if (peak) halt(r);
  }
}

/* Returns true if all taut cables have their required lengths, with a relative error of at most `share`. Otherwise
 * adjusts the unloaded lengths of the cables for the next round. */
static bool lengths_hold(relaxation *r, double share) {
  bool hold = true;
  for (size_t k = 0; k < r->net->member_count; k++) {
    const vs_net_member *m = &r->net->members[k];
    if (!(m->length > 0)) continue;
    double length = vs_v3_length(vs_v3_sub(r->net->at[m->b], r->net->at[m->a]));
    if (m->force > 0 && fabs(length / m->length - 1) > share) hold = false;
    r->rest[k] = m->length / (1 + m->force / r->stiffness);
  }
  return hold;
}

/* Moves the points until the forces are balanced and each cable of fixed length has its length under load. Works in
 * rounds, each with other unloaded lengths of the cables. */
static vs_relax_outcome settle_lengths(relaxation *r, double tolerance, vs_long_work work, vs_relax_report *out) {
  double share = fmax(1e-9, 10 * tolerance), rough = 1e-2;
  for (int round = 0; round < ROUNDS; round++) {
    vs_relax_outcome outcome = settle(r, fmax(rough, tolerance), work, out);
    if (outcome != VS_RELAX_DONE || (lengths_hold(r, share) && rough <= tolerance)) return outcome;
    if (round == 0 && r->greatest > 0) r->stiffness = STIFFER * r->greatest, lengths_hold(r, share);
    if (round > SOFT && round % 2) r->stiffness *= 2, lengths_hold(r, share);
    rough *= .1;
  }
  double worst = 0;
  for (size_t k = 0; k < r->net->member_count; k++) {
    const vs_net_member *m = &r->net->members[k];
    double length = vs_v3_length(vs_v3_sub(r->net->at[m->b], r->net->at[m->a]));
    if (m->length > 0 && length / m->length > worst) worst = length / m->length, out->where = k;
  }
  return VS_RELAX_SHORT;
}

vs_relax_outcome vs_net_relax(vs_net *n, double tolerance, vs_long_work work, vs_relax_report *out) {
  relaxation r = { .net = n };
  VS_ASSERT(tolerance > 0);
  *out = (vs_relax_report){ 0 };
  vs_relax_outcome outcome = held(n, &out->where);
  if (outcome != VS_RELAX_DONE) return outcome;
  double loads = 0;
  bool cables = false;
  for (size_t i = 0; i < n->count; i++) loads += vs_v3_length(n->load[i]);
  for (size_t k = 0; k < n->member_count; k++) {
    const vs_net_member *m = &n->members[k];
    double length = m->length > 0 ? m->length : vs_v3_length(vs_v3_sub(n->at[m->b], n->at[m->a]));
    loads += length * vs_v3_length(n->weight);
    if (m->length > 0)
      cables = true;
    else
      loads += fabs(m->density) * length;
  }
  r.stiffness = n->stiffness > 0 ? n->stiffness : loads > 0 ? loads : 1;
  if (VS_GROW(r.rest, r.rest_room, n->member_count + 1) && VS_GROW(r.force, r.force_room, n->count + 1) &&
      VS_GROW(r.speed, r.speed_room, n->count + 1) && VS_GROW(r.mass, r.mass_room, n->count + 1)) {
    for (size_t k = 0; k < n->member_count; k++) r.rest[k] = n->members[k].length;
    outcome = cables && loads > 0 && !(n->stiffness > 0) ? settle_lengths(&r, tolerance, work, out)
                                                         : settle(&r, tolerance, work, out);
  } else {
    outcome = VS_RELAX_MEMORY;
  }
  free(r.rest), free(r.force), free(r.speed), free(r.mass);
  return outcome;
}
