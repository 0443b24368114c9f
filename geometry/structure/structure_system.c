/* Implements the equations of a structure (structure_system.h). */
#include "geometry/structure/structure_system.h"

#include <math.h>
#include <string.h>

#include "model/store/array.h"

#define SINGULAR 1e-12 /* pivot of the scaled matrix below which the structure counts as a mechanism, because the pivot
                        * may be a rounding error */

static void member_global(const vs_structure *s, size_t i, vs_member_matrix k, vs_vec3 axes[3]) {
  const vs_structure_member *m = &s->members[i];
  double f[VS_MEMBER_WAYS];
  double length = vs_structure_axes(s, m, axes);
  vs_member_stiffness(m, length, vs_v3(0, 0, 0), k, f);
  vs_member_matrix_to_nodes(m, axes, k);
}

static void add_own_stiffness(vs_structure_system *w) {
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

static const vs_structure_plate *plate_global(const vs_structure *s, size_t i, vs_plate_matrix k) {
  vs_vec3 at[3];
  vs_structure_corners(s, &s->plates[i], at);
  vs_plate_stiffness(&s->plates[i], at, k);
  return &s->plates[i];
}

static void add_plates_stiffness(vs_structure_system *w) {
  for (size_t i = 0; i < w->s->plate_count; i++) {
    vs_plate_matrix k;
    const vs_structure_plate *p = plate_global(w->s, i, k);
    for (int a = 0; a < VS_PLATE_WAYS; a++)
      for (int b = a / VS_WAYS * VS_WAYS; b < a / VS_WAYS * VS_WAYS + VS_WAYS; b++)
        w->own[p->node[a / VS_WAYS]][a % VS_WAYS][b % VS_WAYS] += k[a][b];
  }
}

/* ---- nodes that nothing holds ---- */

/* Returns true if a load acts on node n in the direction `motion` in some load case. loads: loads of all nodes, for
 * each load case. */
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

/* Numbers the degrees of freedom of node n that can move. Holds directions in which neither members nor supports hold
 * the node. Returns false, and reports the motion, if a load acts in such a direction. */
static bool number_node(vs_structure_system *w, size_t n, const double *loads, vs_structure_report *report) {
  const bool *held = &w->s->held[n * VS_WAYS];
  double motion[VS_WAYS][VS_WAYS];
  bool unturned[VS_WAYS];
  int loose = vs_loose_ways(w->own[n], held, motion, unturned);
  w->loose[n] = false;
  for (int i = 0; i < VS_WAYS; i++) {
    const double turn[VS_WAYS] = { i == 0, i == 1, i == 2, i == 3, i == 4, i == 5 };
    if (unturned[i] && is_loaded(w->s, loads, n, turn)) return moves(report, n, turn);
    w->row[n * VS_WAYS + (size_t)i] = held[i] || unturned[i] ? VS_HELD : (uint32_t)w->rows++;
  }
  for (int k = 0; k < loose; k++) {
    const double *d = motion[k];
    if (is_loaded(w->s, loads, n, d)) return moves(report, n, d);
    double path = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], turn = d[3] * d[3] + d[4] * d[4] + d[5] * d[5];
    if (path > 1e-6 * turn) w->loose[n] = true;
  }
  return true;
}

/* ---- equations ---- */

static void assemble_plates(vs_structure_system *w) {
  for (size_t i = 0; i < w->s->plate_count; i++) {
    vs_plate_matrix k;
    const vs_structure_plate *plate = plate_global(w->s, i, k);
    for (int a = 0; a < VS_PLATE_WAYS; a++)
      for (int b = a; b < VS_PLATE_WAYS; b++) {
        uint32_t p = w->row[vs_structure_plate_way(plate, a)], q = w->row[vs_structure_plate_way(plate, b)];
        if (p != VS_HELD && q != VS_HELD) vs_sparse_add(w->equations, p, q, k[a][b]);
      }
  }
}

static bool assemble(vs_structure_system *w, vs_error *e) {
  const vs_structure *s = w->s;
  enum {
    MEMBER = VS_MEMBER_WAYS * (VS_MEMBER_WAYS + 1) / 2,
    NODE = VS_WAYS * (VS_WAYS + 1) / 2,
    PLATE = VS_PLATE_WAYS * (VS_PLATE_WAYS + 1) / 2
  };
  size_t entries = s->member_count * MEMBER + s->count * NODE + s->plate_count * PLATE;
  w->equations = vs_sparse_new(w->rows, entries, "frame-solve", e);
  if (!w->equations) return false;
  assemble_plates(w);
  for (size_t i = 0; i < s->member_count; i++) {
    vs_member_matrix k;
    vs_vec3 axes[3];
    member_global(s, i, k, axes);
    for (int a = 0; a < VS_MEMBER_WAYS; a++)
      for (int b = a; b < VS_MEMBER_WAYS; b++) {
        uint32_t p = w->row[vs_structure_way(&s->members[i], a)], q = w->row[vs_structure_way(&s->members[i], b)];
        if (p != VS_HELD && q != VS_HELD) vs_sparse_add(w->equations, p, q, k[a][b]);
      }
  }
  for (size_t n = 0; n < s->count; n++)
    for (int a = 0; a < VS_WAYS; a++)
      for (int b = a; b < VS_WAYS; b++) {
        uint32_t p = w->row[n * VS_WAYS + (size_t)a], q = w->row[n * VS_WAYS + (size_t)b];
        if (p != VS_HELD && q != VS_HELD && w->own[n][a][b] != 0) vs_sparse_add(w->equations, p, q, w->own[n][a][b]);
      }
  return vs_sparse_close(w->equations, true, e);
}

/* Reports the node that moves most in the motion v, which has a number for each row of the equations. */
static void report_motion(const vs_structure_system *w, const double *v, vs_structure_report *report) {
  double most = 0;
  for (int first = 0; first < VS_WAYS && most <= 0; first += 3) /* compares displacements of nodes first; compares
                                                                 * rotations only if no node is displaced */
    for (size_t n = 0; n < w->s->count; n++) {
      double motion[VS_WAYS], size = 0, all = 0;
      for (int i = 0; i < VS_WAYS; i++) {
        uint32_t row = w->row[n * VS_WAYS + (size_t)i];
        motion[i] = row == VS_HELD ? 0 : v[row];
        all += motion[i] * motion[i];
        if (i / 3 == first / 3) size += motion[i] * motion[i];
      }
      if (size > most && size > 1e-8 * all) most = size, moves(report, n, motion);
    }
}

static bool find_motion(vs_structure_system *w, size_t at, vs_structure_report *report, vs_error *e) {
  double *v;
  bool ok = VS_FRESH(v, w->rows) ? vs_sparse_softest(w->equations, at, v, e) : vs_error_memory(e, NULL);
  if (ok) report_motion(w, v, report);
  free(v);
  return ok;
}

/* Adds the stiffness against a rotation about an axis (spin) to the node that it holds. */
static void hold_spin(vs_structure_system *w, const vs_structure_spin *spin) {
  const double d[3] = { spin->axis.x, spin->axis.y, spin->axis.z };
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) w->own[spin->node][3 + i][3 + j] += spin->stiffness * d[i] * d[j];
}

vs_structure_outcome vs_structure_system_make(vs_structure_system *w, const double *loads, vs_structure_report *report,
                                              vs_error *e) {
  const vs_structure *s = w->s;
  double least = 1;
  size_t at = 0;
  VS_ASSERT(s->cases > 0 && s->count < VS_HELD / VS_WAYS);
  w->own = vs_zeros(s->count, sizeof *w->own);
  if (!w->own || !VS_FRESH(w->row, s->count * VS_WAYS)) return vs_error_memory(e, NULL), VS_STRUCTURE_FAILED;
  add_own_stiffness(w);
  add_plates_stiffness(w);
  for (size_t n = 0; n < s->count; n++)
    if (!number_node(w, n, loads, report)) return VS_STRUCTURE_MOVES;
  for (size_t i = 0; i < w->spin_count; i++) hold_spin(w, &w->spins[i]);
  if (!w->rows) return VS_STRUCTURE_DONE;
  if (!assemble(w, e) || !vs_sparse_factor(w->equations, &least, &at, e)) return VS_STRUCTURE_FAILED;
  if (least >= SINGULAR) return VS_STRUCTURE_DONE;
  return find_motion(w, at, report, e) ? VS_STRUCTURE_MOVES : VS_STRUCTURE_FAILED;
}

void vs_structure_system_free(vs_structure_system *w) {
  vs_sparse_free(w->equations);
  free(w->own), free(w->row);
}
