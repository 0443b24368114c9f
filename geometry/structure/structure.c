/* Implements the displacement method: the members' stiffnesses add up to the equations of the nodes (structure.h). */
#include "geometry/structure/structure.h"

#include <math.h>
#include <string.h>

#include "geometry/structure/structure_system.h"
#include "model/store/array.h"

/* In load case c, adds the distributed loads of all members to the loads of their nodes. loads: the case's loads of all
 * nodes. */
static void add_lines(const vs_structure *s, size_t c, double *loads) {
  for (size_t i = 0; i < s->member_count; i++) {
    const vs_structure_member *m = &s->members[i];
    const double *q = &s->lines[(c * s->member_count + i) * 3];
    if (q[0] == 0 && q[1] == 0 && q[2] == 0) continue;
    vs_vec3 axes[3], line = vs_v3(q[0], q[1], q[2]);
    vs_member_matrix k;
    double f[VS_MEMBER_WAYS], turned[VS_MEMBER_WAYS];
    double length = vs_structure_axes(s, m, axes);
    line = vs_v3(vs_v3_dot(line, axes[0]), vs_v3_dot(line, axes[1]), vs_v3_dot(line, axes[2]));
    vs_member_stiffness(m, length, line, k, f);
    vs_member_to_nodes(m, axes, f, turned);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) loads[vs_structure_way(m, a)] += turned[a];
  }
}

/* ---- results ---- */

typedef struct { vs_structure_system system; vs_structure_state *out; } solved;

/* For load case c, computes the forces in all plates, and adds the plates' forces on nodes to the reactions. */
static void find_plate_forces(const solved *w, size_t c, double *reactions) {
  const vs_structure *s = w->system.s;
  const double *moved = &w->out->moved[c * s->count * VS_WAYS];
  for (size_t i = 0; i < s->plate_count; i++) {
    const vs_structure_plate *p = &s->plates[i];
    vs_plate_matrix k;
    vs_vec3 at[3];
    double u[VS_PLATE_WAYS];
    vs_structure_corners(s, p, at);
    vs_plate_stiffness(p, at, k);
    for (int a = 0; a < VS_PLATE_WAYS; a++) u[a] = moved[vs_structure_plate_way(p, a)];
    for (int a = 0; a < VS_PLATE_WAYS; a++)
      for (int b = 0; b < VS_PLATE_WAYS; b++) reactions[vs_structure_plate_way(p, a)] += k[a][b] * u[b];
    vs_plate_forces(p, at, u, &w->out->plates[(c * s->plate_count + i) * VS_PLATE_FORCES]);
  }
}

/* For load case c, computes the forces on the ends of all members, and the reactions of the supports. loads: the case's
 * loads on nodes, without those on members. */
static void find_forces(const solved *w, size_t c, const double *loads) {
  const vs_structure *s = w->system.s;
  const double *moved = &w->out->moved[c * s->count * VS_WAYS];
  double *reactions = &w->out->reactions[c * s->count * VS_WAYS];
  for (size_t i = 0; i < s->count * VS_WAYS; i++) reactions[i] = -loads[i];
  for (size_t i = 0; i < s->member_count; i++) {
    const vs_structure_member *m = &s->members[i];
    const double *q = &s->lines[(c * s->member_count + i) * 3];
    double *end = &w->out->ends[(c * s->member_count + i) * VS_MEMBER_WAYS];
    double f[VS_MEMBER_WAYS], global[VS_MEMBER_WAYS], u[VS_MEMBER_WAYS];
    vs_member_matrix k;
    vs_vec3 axes[3], line = vs_v3(q[0], q[1], q[2]);
    double length = vs_structure_axes(s, m, axes);
    line = vs_v3(vs_v3_dot(line, axes[0]), vs_v3_dot(line, axes[1]), vs_v3_dot(line, axes[2]));
    vs_member_stiffness(m, length, line, k, f);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) global[a] = moved[vs_structure_way(m, a)];
    vs_member_from_nodes(m, axes, global, u);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) {
      end[a] = -f[a];
      for (int b = 0; b < VS_MEMBER_WAYS; b++) end[a] += k[a][b] * u[b];
    }
    vs_member_to_nodes(m, axes, end, global);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) reactions[vs_structure_way(m, a)] += global[a];
  }
  find_plate_forces(w, c, reactions);
  for (size_t i = 0; i < s->count * VS_WAYS; i++)
    if (!s->held[i]) reactions[i] = 0;
}

/* Solves the equations for all load cases, and sets the movements of the nodes. loads: loads of nodes, including those
 * of members, for each case. Returns false on failure. */
static bool find_movements(const solved *w, const double *loads, vs_error *e) {
  const vs_structure *s = w->system.s;
  size_t ways = s->count * VS_WAYS;
  double *x;
  if (!VS_FRESH(x, w->system.rows * s->cases)) return vs_error_memory(e, NULL);
  for (size_t c = 0; c < s->cases; c++)
    for (size_t i = 0; i < ways; i++)
      if (w->system.row[i] != VS_HELD) x[c * w->system.rows + w->system.row[i]] = loads[c * ways + i];
  bool ok = !w->system.rows || vs_sparse_solve(w->system.equations, x, s->cases, e);
  for (size_t c = 0; ok && c < s->cases; c++)
    for (size_t i = 0; i < ways; i++) {
      uint32_t row = w->system.row[i];
      w->out->moved[c * ways + i] = row == VS_HELD ? 0 : x[c * w->system.rows + row];
    }
  free(x);
  return ok;
}

/* Returns true if all results are finite. Very great loads or very small stiffnesses make them infinite. */
static bool is_finite(const vs_structure *s, const vs_structure_state *out) {
  double sum = 0; /* 0 times a result is 0, or NaN if the result is infinite; so the sum shows whether all are finite */
  for (size_t i = 0; i < s->cases * s->count * VS_WAYS; i++) sum += 0 * out->moved[i] + 0 * out->reactions[i];
  for (size_t i = 0; i < s->cases * s->member_count * VS_MEMBER_WAYS; i++) sum += 0 * out->ends[i];
  for (size_t i = 0; i < s->cases * s->plate_count * VS_PLATE_FORCES; i++) sum += 0 * out->plates[i];
  return isfinite(sum);
}

vs_structure_outcome vs_structure_solve(const vs_structure *s, vs_structure_state *out, vs_long_work work,
                                        vs_structure_report *report, vs_error *e) {
  solved w = { .system = { .s = s, .loose = out->loose }, .out = out };
  size_t ways = s->count * VS_WAYS;
  double *loads;
  if (!VS_FRESH(loads, s->cases * ways)) return vs_error_memory(e, NULL), VS_STRUCTURE_FAILED;
  memcpy(loads, s->loads, s->cases * ways * sizeof *loads);
  for (size_t c = 0; c < s->cases; c++) add_lines(s, c, &loads[c * ways]);
  vs_structure_outcome outcome = vs_structure_system_make(&w.system, loads, report, e);
  if (outcome == VS_STRUCTURE_DONE && work.going && !work.going(work.context, 0.8)) outcome = VS_STRUCTURE_STOPPED;
  if (outcome == VS_STRUCTURE_DONE && !find_movements(&w, loads, e)) outcome = VS_STRUCTURE_FAILED;
  for (size_t c = 0; outcome == VS_STRUCTURE_DONE && c < s->cases; c++) find_forces(&w, c, &s->loads[c * ways]);
  if (outcome == VS_STRUCTURE_DONE && !is_finite(s, out)) {
    vs_error_set(e, VS_ERROR_MODEL, NULL, "the loads move the frame by more than any number: check their units");
    outcome = VS_STRUCTURE_FAILED;
  }
  vs_structure_system_free(&w.system);
  free(loads);
  return outcome;
}
