/* Implements the displacement method: the members' stiffnesses add up to the equations of the nodes (structure.h). */
#include "geometry/structure/structure.h"

#include <math.h>
#include <string.h>

#include "geometry/structure/loose_ways.h"
#include "geometry/structure/member_matrices.h"
#include "geometry/structure/sparse_system.h"
#include "model/store/array.h"

#define SINGULAR 1e-12 /* a smaller pivot is rounding: the structure is a mechanism */
#define HELD UINT32_MAX /* row of a way that does not move */

typedef struct {
  const vs_structure *s;
  vs_structure_state *out;
  vs_node_stiffness *own; /* of each node: its stiffness against its own movement */
  uint32_t *row;          /* of each way of each node: its row in the equations, or HELD */
  size_t rows;
  vs_sparse *equations;
} solving;

static void member_global(const vs_structure *s, size_t i, vs_member_matrix k, vs_vec3 axes[3]) {
  const vs_structure_member *m = &s->members[i];
  double f[VS_MEMBER_WAYS];
  double length = vs_member_axes(s->at[m->from], s->at[m->to], m->roll, axes);
  vs_member_stiffness(m, length, vs_v3(0, 0, 0), k, f);
  vs_member_matrix_to_global(axes, k);
}

/* Returns the place of way i of a member's ends among the ways of all nodes. */
static size_t way_of(const vs_structure_member *m, int i) {
  return (size_t)(i < VS_WAYS ? m->from : m->to) * VS_WAYS + (size_t)(i % VS_WAYS);
}

static void add_own_stiffness(solving *w) {
  for (size_t i = 0; i < w->s->member_count; i++) {
    const vs_structure_member *m = &w->s->members[i];
    vs_member_matrix k;
    vs_vec3 axes[3];
    VS_ASSERT(m->from < w->s->count && m->to < w->s->count);
    member_global(w->s, i, k, axes);
    for (int a = 0; a < VS_MEMBER_WAYS; a++)
      for (int b = a / VS_WAYS * VS_WAYS; b < a / VS_WAYS * VS_WAYS + VS_WAYS; b++)
        w->own[a < VS_WAYS ? m->from : m->to][a % VS_WAYS][b % VS_WAYS] += k[a][b];
  }
}

/* Adds the loads of all members in a case to the loads of the nodes. */
static void add_lines(const vs_structure *s, size_t c, double *loads) {
  for (size_t i = 0; i < s->member_count; i++) {
    const vs_structure_member *m = &s->members[i];
    const double *q = &s->lines[(c * s->member_count + i) * 3];
    if (q[0] == 0 && q[1] == 0 && q[2] == 0) continue;
    vs_vec3 axes[3], line = vs_v3(q[0], q[1], q[2]);
    vs_member_matrix k;
    double f[VS_MEMBER_WAYS], turned[VS_MEMBER_WAYS];
    double length = vs_member_axes(s->at[m->from], s->at[m->to], m->roll, axes);
    line = vs_v3(vs_v3_dot(line, axes[0]), vs_v3_dot(line, axes[1]), vs_v3_dot(line, axes[2]));
    vs_member_stiffness(m, length, line, k, f);
    vs_member_to_global(axes, f, turned);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) loads[way_of(m, a)] += turned[a];
  }
}

/* ---- nodes that nothing holds ---- */

/* Returns true if a case loads node n in the direction `motion`. loads: of all nodes, for each case. */
static bool is_loaded(const vs_structure *s, const double *loads, size_t n, const double motion[VS_WAYS]) {
  for (size_t c = 0; c < s->cases; c++) {
    const double *f = &loads[(c * s->count + n) * VS_WAYS];
    double work = 0, size = 0;
    for (int i = 0; i < VS_WAYS; i++) work += f[i] * motion[i], size += fabs(f[i] * motion[i]);
    double force = 0, length = 0;
    for (int i = 0; i < VS_WAYS; i++) force += f[i] * f[i], length += motion[i] * motion[i];
    if (fabs(work) > 1e-9 * size && fabs(work) > 1e-9 * sqrt(force * length)) return true;
  }
  return false;
}

static bool moves(vs_structure_report *report, size_t n, const double motion[VS_WAYS]) {
  report->where = n;
  memcpy(report->motion, motion, VS_WAYS * sizeof *motion);
  return false;
}

/* Numbers the ways of node n that move. Holds loose directions that no case
 * loads. Returns false if a case loads one. */
static bool number_node(solving *w, size_t n, const double *loads, vs_structure_report *report) {
  const bool *held = &w->s->held[n * VS_WAYS];
  double motion[VS_WAYS][VS_WAYS];
  bool unturned[VS_WAYS];
  int loose = vs_loose_ways(w->own[n], held, motion, unturned);
  w->out->loose[n] = false;
  for (int i = 0; i < VS_WAYS; i++) {
    const double turn[VS_WAYS] = { i == 0, i == 1, i == 2, i == 3, i == 4, i == 5 };
    if (unturned[i] && is_loaded(w->s, loads, n, turn)) return moves(report, n, turn);
    w->row[n * VS_WAYS + (size_t)i] = held[i] || unturned[i] ? HELD : (uint32_t)w->rows++;
  }
  for (int k = 0; k < loose; k++) {
    const double *d = motion[k];
    if (is_loaded(w->s, loads, n, d)) return moves(report, n, d);
    double path = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], turn = d[3] * d[3] + d[4] * d[4] + d[5] * d[5];
    if (path > 1e-6 * turn) w->out->loose[n] = true;
  }
  return true;
}

/* ---- equations ---- */

static bool assemble(solving *w, vs_error *e) {
  const vs_structure *s = w->s;
  enum { MEMBER = VS_MEMBER_WAYS * (VS_MEMBER_WAYS + 1) / 2, NODE = VS_WAYS * (VS_WAYS + 1) / 2 };
  w->equations = vs_sparse_new(w->rows, s->member_count * MEMBER + s->count * NODE, "frame-solve", e);
  if (!w->equations) return false;
  for (size_t i = 0; i < s->member_count; i++) {
    vs_member_matrix k;
    vs_vec3 axes[3];
    member_global(s, i, k, axes);
    for (int a = 0; a < VS_MEMBER_WAYS; a++)
      for (int b = a; b < VS_MEMBER_WAYS; b++) {
        uint32_t p = w->row[way_of(&s->members[i], a)], q = w->row[way_of(&s->members[i], b)];
        if (p != HELD && q != HELD) vs_sparse_add(w->equations, p, q, k[a][b]);
      }
  }
  for (size_t n = 0; n < s->count; n++)
    for (int a = 0; a < VS_WAYS; a++)
      for (int b = a; b < VS_WAYS; b++) {
        uint32_t p = w->row[n * VS_WAYS + (size_t)a], q = w->row[n * VS_WAYS + (size_t)b];
        if (p != HELD && q != HELD && w->own[n][a][b] != 0) vs_sparse_add(w->equations, p, q, w->own[n][a][b]);
      }
  return vs_sparse_close(w->equations, true, e);
}

/* Reports the node that moves most in the motion v of all ways that move. */
static void report_motion(const solving *w, const double *v, vs_structure_report *report) {
  double most = 0;
  for (int first = 0; first < VS_WAYS && most <= 0; first += 3) /* turns count if no node moves */
    for (size_t n = 0; n < w->s->count; n++) {
      double motion[VS_WAYS], size = 0, all = 0;
      for (int i = 0; i < VS_WAYS; i++) {
        uint32_t row = w->row[n * VS_WAYS + (size_t)i];
        motion[i] = row == HELD ? 0 : v[row];
        all += motion[i] * motion[i];
        if (i / 3 == first / 3) size += motion[i] * motion[i];
      }
      if (size > most && size > 1e-8 * all) most = size, moves(report, n, motion);
    }
}

static bool find_motion(solving *w, size_t at, vs_structure_report *report, vs_error *e) {
  double *v;
  bool ok = VS_FRESH(v, w->rows) ? vs_sparse_softest(w->equations, at, v, e) : vs_error_memory(e, NULL);
  if (ok) report_motion(w, v, report);
  free(v);
  return ok;
}

/* ---- results ---- */

/* Sets the ends of all members in case c, and the reactions; `loads` are those of the nodes alone. */
static void find_forces(solving *w, size_t c, const double *loads) {
  const vs_structure *s = w->s;
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
    double length = vs_member_axes(s->at[m->from], s->at[m->to], m->roll, axes);
    line = vs_v3(vs_v3_dot(line, axes[0]), vs_v3_dot(line, axes[1]), vs_v3_dot(line, axes[2]));
    vs_member_stiffness(m, length, line, k, f);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) global[a] = moved[way_of(m, a)];
    vs_member_to_own(axes, global, u);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) {
      end[a] = -f[a];
      for (int b = 0; b < VS_MEMBER_WAYS; b++) end[a] += k[a][b] * u[b];
    }
    vs_member_to_global(axes, end, global);
    for (int a = 0; a < VS_MEMBER_WAYS; a++) reactions[way_of(m, a)] += global[a];
  }
  for (size_t i = 0; i < s->count * VS_WAYS; i++)
    if (!s->held[i]) reactions[i] = 0;
}

/* loads: of nodes and members, for each case. */
static bool find_movements(solving *w, const double *loads, vs_error *e) {
  const vs_structure *s = w->s;
  size_t ways = s->count * VS_WAYS;
  double *x;
  if (!VS_FRESH(x, w->rows * s->cases)) return vs_error_memory(e, NULL);
  for (size_t c = 0; c < s->cases; c++)
    for (size_t i = 0; i < ways; i++)
      if (w->row[i] != HELD) x[c * w->rows + w->row[i]] = loads[c * ways + i];
  bool ok = !w->rows || vs_sparse_solve(w->equations, x, s->cases, e);
  for (size_t c = 0; ok && c < s->cases; c++)
    for (size_t i = 0; i < ways; i++) w->out->moved[c * ways + i] = w->row[i] == HELD ? 0 : x[c * w->rows + w->row[i]];
  free(x);
  return ok;
}

static vs_structure_outcome solve(solving *w, double *loads, vs_long_work work, vs_structure_report *report,
                                  vs_error *e) {
  const vs_structure *s = w->s;
  size_t ways = s->count * VS_WAYS, at = 0;
  double least = 1;
  memcpy(loads, s->loads, s->cases * ways * sizeof *loads);
  for (size_t c = 0; c < s->cases; c++) add_lines(s, c, &loads[c * ways]);
  add_own_stiffness(w);
  for (size_t n = 0; n < s->count; n++)
    if (!number_node(w, n, loads, report)) return VS_STRUCTURE_MOVES;
  if (w->rows > 0) {
    if (!assemble(w, e)) return VS_STRUCTURE_FAILED;
    if (work.going && !work.going(work.context, 0.3)) return VS_STRUCTURE_STOPPED;
    if (!vs_sparse_factor(w->equations, &least, &at, e)) return VS_STRUCTURE_FAILED;
    if (least < SINGULAR) return find_motion(w, at, report, e) ? VS_STRUCTURE_MOVES : VS_STRUCTURE_FAILED;
    if (work.going && !work.going(work.context, 0.8)) return VS_STRUCTURE_STOPPED;
  }
  if (!find_movements(w, loads, e)) return VS_STRUCTURE_FAILED;
  for (size_t c = 0; c < s->cases; c++) find_forces(w, c, &s->loads[c * ways]);
  return VS_STRUCTURE_DONE;
}

vs_structure_outcome vs_structure_solve(const vs_structure *s, vs_structure_state *out, vs_long_work work,
                                        vs_structure_report *report, vs_error *e) {
  solving w = { .s = s, .out = out };
  double *loads;
  vs_structure_outcome outcome = VS_STRUCTURE_FAILED;
  VS_ASSERT(s->cases > 0 && s->count < HELD / VS_WAYS);
  w.own = vs_zeros(s->count, sizeof *w.own);
  if (VS_FRESH(loads, s->cases * s->count * VS_WAYS) && VS_FRESH(w.row, s->count * VS_WAYS) && w.own)
    outcome = solve(&w, loads, work, report, e);
  else
    vs_error_memory(e, NULL);
  vs_sparse_free(w.equations);
  free(loads), free(w.own), free(w.row);
  return outcome;
}
