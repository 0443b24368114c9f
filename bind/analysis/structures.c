/* Implements the natives for frames (structures of bars), which library/visualscheme/analysis/ calls. The arguments are
 * vectors of numbers. */
#include "geometry/structure/plate_matrices.h"
#include "geometry/structure/structure_modes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bind/analysis/number_vectors.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"

enum { MEMBER_NUMBERS = 17 }; /* numbers for each bar: from, to, area, bend_y, bend_z, twist, modulus, shear, roll, two
                               * hinges, two offsets */

static bool take_members(vs_args *f, size_t nodes, vs_structure *s) {
  vs_scheme *vm = vs_call_vm(f);
  s->member_count = vs_bind_vector_length(vs_arg_value(f, 1)) / MEMBER_NUMBERS;
  const double *n = vs_bind_numbers(f, 1, s->member_count * MEMBER_NUMBERS);
  vs_structure_member *m = vs_bind_scratch(f, (s->member_count + 1) * sizeof *m);
  if (!n || !m) return false;
  for (size_t i = 0; i < s->member_count; i++, n += MEMBER_NUMBERS) {
    bool ok = n[0] >= 0 && n[0] < (double)nodes && n[1] >= 0 && n[1] < (double)nodes && n[2] > 0 && n[6] > 0;
    if (!ok) return vs_fail(vm, vm->sym.range, "member %zu is none", i + 1), false;
    m[i] = (vs_structure_member){ .from = (uint32_t)n[0], .to = (uint32_t)n[1], .area = n[2], .bend_y = n[3],
                                  .bend_z = n[4], .twist = n[5], .modulus = n[6], .shear = n[7], .roll = n[8],
                                  .hinged = { n[9] > 0, n[10] > 0 },
                                  .offset = { vs_v3(n[11], n[12], n[13]), vs_v3(n[14], n[15], n[16]) } };
    if (vs_v3_equal(vs_v3_add(s->at[m[i].from], m[i].offset[0]), vs_v3_add(s->at[m[i].to], m[i].offset[1])))
      return vs_fail(vm, vm->sym.range, "member %zu has no length", i + 1), false;
  }
  s->members = m;
  return true;
}

/* Sets the points, bars and supports of *s from the first three arguments. */
static bool take_net(vs_args *f, vs_structure *s) {
  *s = (vs_structure){ .at = vs_arg_points(f, 0).at, .count = vs_arg_points(f, 0).count };
  size_t ways = s->count * VS_WAYS;
  if (!take_members(f, s->count, s)) return false;
  const double *held = vs_bind_numbers(f, 2, ways);
  bool *holds = vs_bind_scratch(f, ways + 1);
  if (!held || !holds) return false;
  for (size_t i = 0; i < ways; i++) holds[i] = held[i] > 0;
  s->held = holds;
  return true;
}

/* Sets the plates of *s from a vector of six numbers for each: three nodes, thickness, modulus and Poisson's ratio. */
static bool take_plates(vs_args *f, int argument, vs_structure *s) {
  enum { NUMBERS = 6 };
  vs_scheme *vm = vs_call_vm(f);
  s->plate_count = vs_bind_vector_length(vs_arg_value(f, argument)) / NUMBERS;
  const double *n = vs_bind_numbers(f, argument, s->plate_count * NUMBERS);
  vs_structure_plate *p = vs_bind_scratch(f, (s->plate_count + 1) * sizeof *p);
  if (!n || !p) return false;
  for (size_t i = 0; i < s->plate_count; i++, n += NUMBERS) {
    bool ok = n[3] > 0 && n[4] > 0 && n[5] > -1 && n[5] < 0.5;
    for (int k = 0; k < 3; k++) ok = ok && n[k] >= 0 && n[k] < (double)s->count;
    if (!ok) return vs_fail(vm, vm->sym.range, "shell %zu is none", i + 1), false;
    p[i] = (vs_structure_plate){ { (uint32_t)n[0], (uint32_t)n[1], (uint32_t)n[2] }, n[3], n[4], n[5] };
    vs_vec3 axes[3], at[3] = { s->at[p[i].node[0]], s->at[p[i].node[1]], s->at[p[i].node[2]] };
    if (!(vs_plate_axes(at, axes) > 0)) return vs_fail(vm, vm->sym.range, "shell %zu has no area", i + 1), false;
  }
  s->plates = p;
  return true;
}

/* Sets *s from the arguments of (%frame-solve points members held loads lines cases plates). */
static bool take_structure(vs_args *f, vs_structure *s) {
  if (!take_net(f, s) || !take_plates(f, 6, s)) return false;
  size_t ways = s->count * VS_WAYS;
  s->cases = (size_t)vs_arg_integer(f, 5);
  s->loads = vs_bind_numbers(f, 3, ways * s->cases);
  s->lines = s->loads ? vs_bind_numbers(f, 4, s->member_count * 3 * s->cases) : NULL;
  return s->lines;
}

/* Sets the error for a structure that can move without resistance (a mechanism); then returns false. */
static bool mechanism(vs_args *f, const vs_structure_report *report) {
  vs_scheme *vm = vs_call_vm(f);
  double largest = 0, squares[2] = { 0, 0 };
  for (int i = 0; i < VS_WAYS; i++) squares[i / 3] += report->motion[i] * report->motion[i];
  bool path = squares[0] > 1e-9 * squares[1];
  char text[3][32];
  const double *d = report->motion + (path ? 0 : 3);
  for (int i = 0; i < 3; i++)
    if (fabs(d[i]) > fabs(largest)) largest = d[i];
  for (int i = 0; i < 3; i++)
    vs_bind_number_text(text[i], largest == 0 ? 0 : (round(d[i] / largest * 1000) + 0.0) / 1000);
  vs_fail(vm, vm->sym.range,
          "the frame is a mechanism: node %zu %s (vxyz %s %s %s), and nothing resists; add a support, a member or a "
          "rigid joint",
          report->where + 1, path ? "moves along" : "turns about", text[0], text[1], text[2]);
  return false;
}

/* (%frame-solve points members held loads lines cases plates): returns a list of five values. They are the nodes'
 * movements, the forces at the bars' ends, the reactions of the supports, the list of the numbers of loose nodes,
 * counted from 1, and the forces in the plates. */
vs_status vs_p_frame_solve(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_structure s;
  vs_structure_report report = { 0 };
  vs_error e = { 0 };
  if (!take_structure(f, &s)) return VS_ERROR;
  size_t ways = s.count * VS_WAYS * s.cases, ends = s.member_count * VS_MEMBER_WAYS * s.cases;
  size_t plates = s.plate_count * VS_PLATE_FORCES * s.cases;
  vs_structure_state state = { vs_bind_scratch(f, (ways + 1) * sizeof(double)),
                               vs_bind_scratch(f, (ends + 1) * sizeof(double)),
                               vs_bind_scratch(f, (ways + 1) * sizeof(double)),
                               vs_bind_scratch(f, (plates + 1) * sizeof(double)), vs_bind_scratch(f, s.count + 1) };
  if (!state.moved || !state.ends || !state.reactions || !state.plates || !state.loose) return VS_ERROR;
  vs_long_work work = { vs_bind_keep_going, vm };
  switch (vs_structure_solve(&s, &state, work, &report, &e)) {
  case VS_STRUCTURE_MOVES: return mechanism(f, &report), VS_ERROR;
  case VS_STRUCTURE_STOPPED: return VS_ERROR; /* vm->condition is already set */
  case VS_STRUCTURE_FAILED: return vs_bind_error(vm, &e);
  case VS_STRUCTURE_DONE: break;
  }
  VS_ROOTS(vm, r, 3);
  r[0] = VS_NIL;
  bool ok = vs_bind_give_numbers(f, state.plates, plates, &r[2]) && vs_cons(vm, r[2], VS_NIL, &r[1]);
  for (size_t n = s.count; ok && n-- > 0;)
    if (state.loose[n]) ok = vs_cons(vm, vs_fix((int64_t)n + 1), r[0], &r[0]);
  ok = ok && vs_cons(vm, r[0], r[1], &r[1]) && vs_bind_give_numbers(f, state.reactions, ways, &r[0]) &&
       vs_cons(vm, r[0], r[1], &r[1]) && vs_bind_give_numbers(f, state.ends, ends, &r[0]) &&
       vs_cons(vm, r[0], r[1], &r[1]) && vs_bind_give_numbers(f, state.moved, ways, &r[0]) &&
       vs_cons(vm, r[0], r[1], out);
  return ok ? VS_OK : VS_ERROR;
}

/* (%buckling-modes points members held axial masses parts want), and %vibration-modes with the same arguments: masses
 * is empty for the former, axial for the latter. Returns a list of two vectors: load factors or frequencies, and the
 * shapes of the modes. */
vs_status vs_p_frame_modes(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_structure s;
  vs_structure_report report = { 0 };
  vs_error e = { 0 };
  if (!take_net(f, &s)) return VS_ERROR;
  vs_modes_problem p = { .s = &s, .parts = (size_t)vs_arg_integer(f, 5), .want = (size_t)vs_arg_integer(f, 6) };
  if (p.parts > 64 || p.want > 1000) return vs_fail(vm, vm->sym.range, "more modes or segments than allowed");
  if (vs_bind_vector_length(vs_arg_value(f, 3))) {
    if (!(p.axial = vs_bind_numbers(f, 3, 2 * s.member_count))) return VS_ERROR;
  } else {
    if (!(p.mass = vs_bind_numbers(f, 4, s.member_count + s.count))) return VS_ERROR;
    p.node_mass = p.mass + s.member_count;
  }
  size_t each = s.member_count * (p.parts + 1) * 3, found = 0;
  double *values = vs_bind_scratch(f, p.want * sizeof *values);
  double *shapes = vs_bind_scratch(f, (p.want * each + 1) * sizeof *shapes);
  if (!values || !shapes) return VS_ERROR;
  vs_long_work work = { vs_bind_keep_going, vm };
  switch (vs_structure_modes(&p, work, values, shapes, &found, &report, &e)) {
  case VS_STRUCTURE_MOVES: return mechanism(f, &report), VS_ERROR;
  case VS_STRUCTURE_STOPPED: return VS_ERROR; /* vm->condition is already set */
  case VS_STRUCTURE_FAILED: return vs_bind_error(vm, &e);
  case VS_STRUCTURE_DONE: break;
  }
  VS_ROOTS(vm, r, 2);
  bool ok = vs_bind_give_numbers(f, shapes, found * each, &r[0]) && vs_cons(vm, r[0], VS_NIL, &r[1]) &&
            vs_bind_give_numbers(f, values, found, &r[0]) && vs_cons(vm, r[0], r[1], out);
  return ok ? VS_OK : VS_ERROR;
}
