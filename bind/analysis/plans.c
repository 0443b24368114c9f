/* Implements the natives for floor plans, which library/visualscheme/analysis/ calls: shortest ways to exits, and
 * visible areas. A plan consists of three arguments: a list of the corners of all loops (outlines), a vector of the
 * loops' numbers of corners, and a vector of their rooms' numbers. */
#include "geometry/nets/plan_ways.h"

#include <math.h>
#include <stdlib.h>

#include "bind/analysis/number_vectors.h"
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/scratch.h"
#include "bind/measures.h"
#include "vm/machine/fail.h"
#include "vm/values/gc.h"

enum { PLACE_NUMBERS = 4 }; /* numbers for each place in a plan: x, y, length of the way to an exit or -1, index of the
                             * next place on this way or -1 */

/* Returns the x and y of the points in an argument. */
static vs_vec2 *flat(vs_args *f, int argument) {
  size_t n = vs_arg_points(f, argument).count;
  vs_vec2 *at = vs_bind_scratch(f, (n + 1) * sizeof *at);
  for (size_t i = 0; at && i < n; i++)
    at[i] = (vs_vec2){ vs_arg_points(f, argument).at[i].x, vs_arg_points(f, argument).at[i].y };
  return at;
}

/* Sets *p to the plan in the first three arguments. */
static bool take_plan(vs_args *f, vs_plan *p) {
  vs_scheme *vm = vs_call_vm(f);
  size_t loops = vs_bind_vector_length(vs_arg_value(f, 1)), all = 0;
  const double *sizes = vs_bind_numbers(f, 1, loops), *rooms = sizes ? vs_bind_numbers(f, 2, loops) : NULL;
  size_t *size = vs_bind_scratch(f, (loops + 1) * sizeof *size), *room = vs_bind_scratch(f, (loops + 1) * sizeof *room);
  *p = (vs_plan){ .at = flat(f, 0), .count = vs_arg_points(f, 0).count, .size = size, .room = room, .loops = loops };
  if (!rooms || !size || !room || !p->at) return false;
  for (size_t i = 0; i < loops; i++) {
    if (!(sizes[i] >= 3 && sizes[i] <= (double)p->count && rooms[i] >= 0 && rooms[i] < (double)loops)) break;
    size[i] = (size_t)sizes[i], room[i] = (size_t)rooms[i], all += size[i];
    if (room[i] >= p->rooms) p->rooms = room[i] + 1;
  }
  return all == p->count || (vs_fail(vm, vm->sym.range, "the loops of the plan do not fit"), false);
}

/* (%plan-ways points sizes rooms exits doors): returns a vector with PLACE_NUMBERS numbers for each place of the ways
 * to the exits. */
vs_status vs_p_plan_ways(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_plan p;
  if (!take_plan(f, &p)) return VS_ERROR;
  const vs_vec2 *exits = flat(f, 3), *doors = flat(f, 4);
  if (!exits || !doors) return VS_ERROR;
  vs_plan_place *places;
  size_t count;
  vs_plan_outcome outcome = vs_plan_ways(&p, exits, vs_arg_points(f, 3).count, doors, vs_arg_points(f, 4).count,
                                         (vs_long_work){ vs_bind_keep_going, vm }, &places, &count);
  double *numbers = outcome == VS_PLAN_DONE ? vs_bind_scratch(f, (count * PLACE_NUMBERS + 1) * sizeof *numbers) : NULL;
  for (size_t i = 0; numbers && i < count; i++) {
    double *n = &numbers[i * PLACE_NUMBERS];
    n[0] = places[i].at.x, n[1] = places[i].at.y;
    n[2] = places[i].far < INFINITY ? places[i].far : -1;
    n[3] = places[i].next == VS_NO_PLACE ? -1.0 : (double)places[i].next;
  }
  free(places);
  if (outcome == VS_PLAN_MEMORY) return vs_fail_memory(vm);
  return numbers && vs_bind_give_numbers(f, numbers, count * PLACE_NUMBERS, out) ? VS_OK : VS_ERROR;
}

/* (%plan-way points sizes rooms places p): returns a list of the length of the shortest way from p to an exit, and of
 * the index of the first place on it. Returns #f if p is in no room, or no way leads to an exit. */
vs_status vs_p_plan_way(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_plan p;
  if (!take_plan(f, &p)) return VS_ERROR;
  size_t count = vs_bind_vector_length(vs_arg_value(f, 3)) / PLACE_NUMBERS;
  const double *n = vs_bind_numbers(f, 3, count * PLACE_NUMBERS);
  vs_plan_place *places = vs_bind_scratch(f, (count + 1) * sizeof *places);
  if (!n || !places) return VS_ERROR;
  for (size_t i = 0; i < count; i++, n += PLACE_NUMBERS)
    places[i] = (vs_plan_place){ { n[0], n[1] }, n[2] < 0 ? INFINITY : n[2], VS_NO_PLACE };
  vs_vec2 from = { vs_arg_point(f, 4).x, vs_arg_point(f, 4).y };
  double far;
  uint32_t first;
  *out = VS_FALSE;
  if (!vs_plan_contains(&p, from)) return VS_OK;
  if (!vs_plan_way(&p, places, count, from, &far, &first)) return vs_fail_memory(vm);
  if (first == VS_NO_PLACE) return VS_OK;
  VS_ROOTS(vm, r, 1);
  return vs_cons(vm, vs_fix(first), VS_NIL, &r[0]) && vs_cons(vm, vs_flonum(far), r[0], out) ? VS_OK : VS_ERROR;
}

/* (%plan-view points sizes rooms p): returns the list of the corners of the area that is visible from p. */
vs_status vs_p_plan_view(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_plan p;
  if (!take_plan(f, &p)) return VS_ERROR;
  vs_vec2 *at;
  size_t count;
  vs_vec3 eye = vs_arg_point(f, 3);
  if (!vs_plan_view(&p, (vs_vec2){ eye.x, eye.y }, &at, &count)) return vs_fail_memory(vm);
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  bool ok = true;
  for (size_t i = count; ok && i-- > 0;)
    ok = vs_bind_give_point(f, vs_v3(at[i].x, at[i].y, eye.z), &r[1]) && vs_cons(vm, r[1], r[0], &r[0]);
  free(at);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}
