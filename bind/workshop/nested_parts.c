/* Implements the native of pack-parts, which cutting_sheets.scm calls with checked arguments. */

#include <math.h>

#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/call/raise.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/measures.h"
#include "geometry/frame.h"
#include "geometry/measure/node_measures.h"
#include "geometry/nets/nesting.h"
#include "geometry/plane/offset.h"
#include "geometry/plane/planar_evaluation.h"
#include "vm/machine/fail.h"

/* The parts to pack, as areas. Each has the map that moves the part into the plane XY. */
typedef struct {
  vs_args *f;
  size_t count;
  vs_area *areas;
  vs_affine *flat;
} parts;

static void parts_free(parts *p) {
  for (size_t i = 0; p->areas && i < p->count; i++) vs_area_free(&p->areas[i]);
}

/* Computes the map that moves a part's outline into the plane XY, and its area there. Horizontal parts keep their X and
 * Y. */
static bool lay_flat(const vs_outline *o, vs_affine *flat, vs_area *area) {
  vs_affine frame = o->frame;
  if (fabs(o->normal.x) < 1e-12 && fabs(o->normal.y) < 1e-12) {
    frame = vs_affine_identity();
    frame.m[2][3] = o->point.z;
  }
  vs_affine_invert(&frame, flat); /* the frame is a rotation and a move, so it has an inverse */
  return vs_area_of_outline(o, &frame, area);
}

/* Computes the area that part i covers. If the part has arcs, its area is enlarged by the greatest distance from an arc
 * to its chord. */
static bool part_area(parts *p, size_t i) {
  const vs_node *n = vs_arg_refs(p->f, 0).at[i].node;
  vs_outline coarse = { 0 }, fine = { 0 };
  vs_bounds b;
  vs_error e = { 0 };
  vs_area area = { 0 };
  if (!vs_node_bounds(n, &b, &e)) return vs_bind_error(vs_call_vm(p->f), &e);
  vs_fineness facets = { .tolerance = fmax(vs_bounds_diagonal(&b) / 16384, 1e-300) },
              finer = { .tolerance = facets.tolerance / 4 };
  bool ok = (vs_region_outline(n, &facets, &coarse, &e) && vs_region_outline(n, &finer, &fine, &e)) ||
            vs_bind_error(vs_call_vm(p->f), &e);
  bool round = ok && coarse.count != fine.count;
  for (size_t l = 0; ok && !round && l < coarse.count; l++) round = coarse.loops[l].count != fine.loops[l].count;
  ok = ok && (lay_flat(&coarse, &p->flat[i], round ? &area : &p->areas[i]) || vs_fail_memory(vs_call_vm(p->f)));
  vs_offset_rule rule = { .distance = facets.tolerance, .corners = VS_OFFSET_MITRE, .fineness = &facets };
  if (ok && round) ok = vs_area_offset(&area, &rule, &p->areas[i], &e) || vs_bind_error(vs_call_vm(p->f), &e);
  vs_outline_free(&coarse), vs_outline_free(&fine);
  vs_area_free(&area);
  return ok;
}

/* Reads at most `most` numbers from the list l, which cutting_sheets.scm has checked. Returns how many. */
static size_t read_numbers(vs_args *f, vs_value l, double *out, size_t most) {
  size_t n = 0;
  for (; vs_is_pair(l) && n < most; l = vs_cdr(l), n++) vs_bind_take_number(vs_call_vm(f), vs_car(l), &out[n]);
  return n;
}

/* Sets *out to a list with a pair for each part: the number of its sheet from 0, and its matrix. */
static bool give_places(parts *p, const vs_nest_place *places, vs_value *out) {
  vs_args *f = p->f;
  VS_ROOTS(vs_call_vm(f), r, 2);
  r[0] = VS_NIL;
  for (size_t i = p->count; i-- > 0;) {
    double s, c;
    vs_sincos(places[i].angle, &s, &c);
    vs_affine turn = vs_affine_identity();
    turn.m[0][0] = turn.m[1][1] = c, turn.m[0][1] = -s, turn.m[1][0] = s;
    turn.m[0][3] = places[i].move.x, turn.m[1][3] = places[i].move.y;
    vs_affine whole = vs_affine_multiply(&turn, &p->flat[i]);
    if (!vs_bind_give_matrix(f, &whole, &r[1]) || !vs_cons(vs_call_vm(f), vs_fix(places[i].sheet), r[1], &r[1]) ||
        !vs_cons(vs_call_vm(f), r[1], r[0], &r[0]))
      return false;
  }
  *out = r[0];
  return true;
}

/* (%pack-parts regions (width height gap margin effort) angles): returns a list of pairs (sheet . matrix), one for each
 * region. If a region is larger than the sheet, returns the region's index instead. */
vs_status vs_p_pack_parts(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  double numbers[5] = { 0 }, *angles = vs_bind_scratch(f, 360 * sizeof *angles);
  size_t n = vs_arg_refs(f, 0).count, sheets, unfit;
  parts p = { .f = f, .count = n };
  bool stopped = false;
  if (!angles || read_numbers(f, vs_arg_value(f, 1), numbers, 5) < 5) return VS_ERROR;
  p.areas = vs_bind_scratch(f, (n + 1) * sizeof *p.areas), p.flat = vs_bind_scratch(f, (n + 1) * sizeof *p.flat);
  vs_nest_place *places = vs_bind_scratch(f, (n + 1) * sizeof *places);
  if (!p.areas || !p.flat || !places) return VS_ERROR;
  for (size_t i = 0; i < n; i++) p.areas[i] = (vs_area){ 0 };
  bool ok = true;
  for (size_t i = 0; ok && i < n; i++) ok = part_area(&p, i) && vs_poll(vm, 64);
  vs_nest_rule rule = { numbers[0], numbers[1], numbers[2], numbers[3], angles,
                        read_numbers(f, vs_arg_value(f, 2), angles, 360), numbers[4] };
  vs_long_work work = { vs_bind_keep_going, vm };
  if (ok && !vs_areas_nest(p.areas, n, &rule, work, places, &sheets, &unfit, &stopped))
    ok = stopped ? false : vs_fail_memory(vm);
  if (ok && unfit < n) *out = vs_fix((int64_t)unfit);
  else ok = ok && give_places(&p, places, out);
  parts_free(&p);
  return ok ? VS_OK : VS_ERROR;
}
