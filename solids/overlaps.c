/* Removes a mesh's overlaps with itself.
 *
 * The kernel arranges the mesh with itself, and keeps the volume that it winds around more than 0 times. The bends of
 * sweeps may be much tighter than their profile is wide. Sweeps therefore need two more steps:
 *
 *   crowds   Around such a bend all steps of the sweep overlap and intersect each other, though nearly all of this is
 *            hidden. If that is too much work, runs of some steps lose their overlaps one by one. They are united two
 *            by two, neighbours first, so that hidden parts vanish early. Needles that a union leaves are welded
 *            (weld.c), because the next union would cut them into a million more
 *   rounding Steps that differ by little intersect at small angles. Corners then come closer to other faces than the
 *            numbers of a format can distinguish. These corners move to a decimal grid, finer than anything visible
 *            and coarser than the numbers of any format. The kernel resolves new intersections there, until there are
 *            none */
#include "solids/overlaps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "geometry/tessellate.h"
#include "kernel/evaluate.h"
#include "kernel/mesh/crowd.h"
#include "kernel/mesh/inspect.h"
#include "kernel/mesh/shells.h"
#include "kernel/round/rounding.h"
#include "model/store/array.h"
#include "solids/astray.h"
#include "solids/weld.h"

/* Returns true if the mesh of node n may overlap itself. Placements around n do not matter. */
static bool may_overlap(const vs_node *n) {
  if (n->class_ != VS_SOLID) return false;
  while (vs_node_is_around(n)) n = n->children[0].node;
  if (n->kind == VS_EXTRUDE) return VS_AS(extrude, n)->taper != 0 || n->child_count > 1;
  return vs_node_has(n, VS_IS_OVERLAPPING);
}

static bool failed(const vs_kernel_error *why, vs_error *e) {
  switch (why->status) {
  case VS_KERNEL_OUT_OF_MEMORY: return vs_error_memory(e, NULL);
  case VS_KERNEL_INTERRUPTED: return vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
  case VS_KERNEL_FINE:
  case VS_KERNEL_OPEN:
  case VS_KERNEL_INSIDE_OUT:
  case VS_KERNEL_NOT_FINITE:
  case VS_KERNEL_LIMIT:
  case VS_KERNEL_INTERNAL: break;
  }
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "%s", why->message);
}

/* Removes shells (connected parts of the surface) that are only cracks or flakes: their mean thickness is less than
 * `thickness`. Where faces of the mesh lie on each other, rounding to the kernel's grid separates them by some grid
 * steps, and so makes such shells. Returns false if memory is out. */
static bool drop_flakes(vs_mesh *m, double thickness, vs_error *e) {
  vs_shells shells;
  bool ok = vs_shells_find(m, &shells);
  uint8_t *gone = ok ? vs_fresh(m->triangle_count, 1) : NULL;
  ok = gone || vs_error_memory(e, NULL);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    const vs_shell *s = &shells.at[shells.of[m->triangles[t][0]]];
    gone[t] = fabs(s->volume) <= thickness * s->area / 2;
  }
  if (ok) vs_mesh_squeeze(m, gone);
  vs_shells_free(&shells);
  free(gone);
  return ok && (vs_mesh_drop_lonely(m) || vs_error_memory(e, NULL));
}

/* A limit on the work: how many pairs of triangles may still be tested, and whether more would have been needed. */
typedef struct {
  const vs_kernel_options *options;
  size_t pairs;
  bool too_much;
  bool loose; /* true if the mesh may still overlap itself, because its solid would have too many triangles */
} work;

/* Replaces m by the solid of all space around which m winds more than 0 times. left: limit on the work; NULL: no limit.
 * If the limit is too small, sets left->too_much, leaves m unchanged and returns true. Returns false on failure. */
static bool resolve(vs_mesh *m, const vs_kernel_options *options, work *left, vs_error *e) {
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  vs_mesh whole = { 0 };
  size_t pairs;
  if (left) {
    if (!vs_mesh_pairs(m, left->pairs + 1, options, &pairs, &why)) return failed(&why, e);
    left->too_much = pairs > left->pairs;
    if (left->too_much) return true;
    left->pairs -= pairs;
  }
  if (!vs_kernel_resolve(m, 0, options, &whole, &why)) return vs_mesh_free(&whole), failed(&why, e);
  vs_mesh_free(m);
  *m = whole;
  return true;
}

/* Returns the number of triangles at which the repair of m stops. Where many faces nearly coincide, each removal of
 * overlaps doubles their number, and the repair would never end. */
static size_t most_triangles(const vs_mesh *m) { return m->triangle_count + m->triangle_count / 2 + 100; }

/* Replaces m as resolve does, but leaves it unchanged if the solid has `most` triangles or more. *done: true if m was
 * replaced. Returns false on failure. */
static bool resolve_within(vs_mesh *m, size_t most, work *left, bool *done, vs_error *e) {
  vs_mesh solid = { 0 };
  bool ok = (vs_mesh_copy(m, &solid) || vs_error_memory(e, NULL)) && resolve(&solid, left->options, left, e);
  *done = ok && !left->too_much && solid.triangle_count < most;
  left->loose = left->loose && !*done;
  if (!*done) return vs_mesh_free(&solid), ok;
  vs_mesh_free(m);
  *m = solid;
  return true;
}

/* Replaces m by the solid of all space around which m winds more than 0 times. *changed: true if m overlapped or
 * touched itself. Returns false on failure. */
static bool free_of_overlaps(vs_mesh *m, const vs_kernel_options *options, bool *changed, vs_error *e) {
  vs_mesh_flaws flaws;
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  *changed = false;
  if (!m->triangle_count) return true;
  if (!vs_kernel_inspect(m, options, &flaws, &why)) return failed(&why, e);
  *changed = flaws.wound_count > 0 || flaws.touches;
  if (!*changed) return true;
  if (!resolve(m, options, NULL, e)) return false;
  vs_bounds b = vs_mesh_bounds(m);
  return flaws.wound_count == 0 || drop_flakes(m, 1e-6 * vs_bounds_diagonal(&b), e);
}

bool vs_mesh_without_overlaps(vs_mesh *m, const vs_kernel_options *options, vs_error *e) {
  bool changed;
  return free_of_overlaps(m, options, &changed, e);
}

/* ---- sweeps with very many overlaps at their bends (crowds) ---- */

/* CROWD: a mesh with more intersecting pairs than this for each triangle is not handled in one step. MOST_PAIRS:
 * greatest number of intersecting pairs altogether. STEPS: number of a sweep's steps whose overlaps are removed
 * together first. */
enum { CROWD = 16, MOST_PAIRS = 60000000, STEPS = 8 };

/* Sets *crowd to true if m, the mesh of a sweep, has so many overlaps at its bends that groups of its steps must be
 * handled separately. Returns false on failure. */
static bool is_crowd(const vs_bends *bends, const vs_mesh *m, const vs_kernel_options *options, bool *crowd,
                     vs_error *e) {
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  size_t pairs, most = CROWD * m->triangle_count + 1;
  if (!vs_bends_turn(bends, crowd)) return vs_error_memory(e, NULL);
  if (!*crowd) return true;
  if (!vs_mesh_pairs(m, most, options, &pairs, &why)) return failed(&why, e);
  *crowd = pairs >= most;
  return true;
}

/* Appends the triangles of mesh b to mesh a, and empties b. */
static bool add_mesh(vs_mesh *a, vs_mesh *b) {
  uint32_t first = (uint32_t)a->vertex_count;
  bool ok = a->vertex_count + b->vertex_count < UINT32_MAX / 4;
  for (size_t v = 0; ok && v < b->vertex_count; v++) ok = vs_mesh_add_vertex(a, b->vertices[v], NULL);
  for (size_t t = 0; ok && t < b->triangle_count; t++)
    ok = vs_mesh_add_triangle(a, b->triangles[t][0] + first, b->triangles[t][1] + first, b->triangles[t][2] + first);
  vs_mesh_free(b);
  return ok;
}

/* Removes the overlaps of m with itself, and then details that are smaller than `step` (weld.h). left: limit on the
 * work. Returns false on failure. */
static bool unite(vs_mesh *m, double step, work *left, vs_error *e) {
  return resolve(m, left->options, left, e) && (left->too_much || vs_mesh_weld(m, step) || vs_error_memory(e, NULL));
}

static bool unite_runs(const vs_bends *bends, double step, work *left, vs_mesh *m, vs_error *e) {
  vs_mesh *runs;
  size_t count;
  if (!vs_bends_runs(bends, STEPS, &runs, &count)) return vs_error_memory(e, NULL);
  bool ok = true, done;
  for (size_t i = 0; ok && i < count && !left->too_much; i++) ok = unite(&runs[i], step, left, e);
  for (size_t apart = 1; apart < count; apart *= 2)
    for (size_t i = 0; ok && i + apart < count && !left->too_much; i += 2 * apart)
      ok = (add_mesh(&runs[i], &runs[i + apart]) || vs_error_memory(e, NULL)) && unite(&runs[i], step, left, e);
  if (ok && count && !left->too_much) {
    vs_mesh_free(m);
    *m = runs[0];
    runs[0] = (vs_mesh){ 0 };
  }
  for (size_t i = 0; i < count; i++) vs_mesh_free(&runs[i]);
  free(runs);
  left->loose = true;
  return ok && (left->too_much ||
                (resolve_within(m, most_triangles(m), left, &done, e) && (!done || drop_flakes(m, step, e))));
}

/* ---- rounding ---- */

/* Sets *met to true if triangles of m would intersect after rounding to the numbers of .off or .stl files. *at: the
 * first place where they would. Returns false on failure. */
static bool find_met(const vs_mesh *m, const vs_kernel_options *options, bool *met, vs_vec3 *at, vs_error *e) {
  static const vs_numbers numbers[] = { VS_NUMBERS_DIGITS, VS_NUMBERS_LOOSE };
  bool ok = true;
  *met = false;
  for (int i = 0; ok && !*met && i < 2; i++) {
    vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
    vs_mesh copy = { 0 };
    vs_rounded what;
    ok = vs_mesh_copy(m, &copy) || vs_error_memory(e, NULL);
    ok = ok && (vs_mesh_round(&copy, numbers[i], options, &what, &why) || failed(&why, e));
    *met = ok && what.met > 0;
    if (*met) *at = what.at;
    vs_mesh_free(&copy);
  }
  return ok;
}

/* Repairs m on a grid with `per` steps per unit. Maps coordinates to numbers between 2^23 and 2^24, which in single
 * precision are whole numbers, and repairs m like a mesh for an .stl file. Every edge then still has as many triangles
 * in one direction as in the other. Returns false on failure. */
static bool mend(vs_mesh *m, double per, const vs_kernel_options *options, vs_error *e) {
  const double middle = 0x1.8p23;
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  vs_rounded what;
  for (size_t v = 0; v < m->vertex_count; v++) {
    vs_vec3 *p = &m->vertices[v];
    *p = vs_v3(p->x * per + middle, p->y * per + middle, p->z * per + middle);
  }
  if (!vs_mesh_round(m, VS_NUMBERS_LOOSE, options, &what, &why)) return failed(&why, e);
  for (size_t v = 0; v < m->vertex_count; v++) {
    vs_vec3 *p = &m->vertices[v];
    *p = vs_v3(((float)p->x - middle) / per, ((float)p->y - middle) / per, ((float)p->z - middle) / per);
  }
  return true;
}

/* Sets *met to true if triangles of m would intersect after rounding (find_met). If so, removes the overlaps of m once
 * more and searches again; leaves m unchanged if it would then have `most` triangles or more. Returns false on
 * failure. */
static bool try_out(vs_mesh *m, size_t most, work *left, bool *met, vs_vec3 *at, vs_error *e) {
  bool done;
  if (!find_met(m, left->options, met, at, e)) return false;
  if (!*met) return true;
  return resolve_within(m, most, left, &done, e) && (!done || find_met(m, left->options, met, at, e));
}

/* Several times, repairs m on a grid of `per` steps per unit and removes the resulting intersections. Stops if the
 * number of triangles grows too much. *met: true if triangles still intersect. Returns false on failure. */
static bool settle_on(vs_mesh *m, double per, work *left, bool *met, vs_vec3 *at, vs_error *e) {
  enum { ROUNDS = 4 };
  vs_bounds b = vs_mesh_bounds(m);
  size_t most = most_triangles(m);
  bool ok = true;
  *met = true;
  for (int round = 0; ok && *met && round < ROUNDS; round++) {
    ok = mend(m, per, left->options, e) && resolve(m, left->options, left, e);
    if (!ok || left->too_much || m->triangle_count >= most) break;
    ok = drop_flakes(m, 1e-6 * vs_bounds_diagonal(&b), e) && try_out(m, most, left, met, at, e);
    if (left->too_much) break;
  }
  return ok;
}

/* Repairs m on decimal grids, from fine to coarse, until no triangles intersect in the numbers of any format. coarsest:
 * largest step of a grid. *met: true if all grids have failed; *at: position of an intersection. Returns false on
 * failure. */
static bool settle(vs_mesh *m, double coarsest, work *left, bool *met, vs_vec3 *at, vs_error *e) {
  vs_bounds b = vs_mesh_bounds(m);
  double size = vs_bounds_diagonal(&b);
  int digits = -(int)floor(log10(fmax(coarsest, size * 0x1p-20)));
  if (m->vertex_count) *at = m->vertices[0];
  bool ok = try_out(m, most_triangles(m), left, met, at, e);
  *met = *met || left->loose;
  for (int finer = 1; ok && *met && finer >= 0 && !left->too_much; finer--) {
    double per = pow(10, digits + finer);
    vs_mesh tried = { 0 };
    if (size * per > 0x1p22) continue;
    ok = vs_mesh_copy(m, &tried) || vs_error_memory(e, NULL);
    ok = ok && settle_on(&tried, per, left, met, at, e);
    if (ok && !*met) {
      vs_mesh_free(m);
      *m = tried;
    } else vs_mesh_free(&tried);
  }
  return ok;
}

/* ---- sweeps ---- */

static bool is_sweep(const vs_node *n) {
  while (vs_node_is_around(n)) n = n->children[0].node;
  return n->kind == VS_SWEEP || (n->kind == VS_THICKEN && n->children[0].node->class_ == VS_CURVE);
}

bool vs_primitive_tessellated(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *m,
                              vs_error *e) {
  size_t limit = options ? options->max_triangles : 0;
  m->most = limit * VS_ON_THE_WAY;
  bool ok = vs_tessellate(n, f, m, e);
  if (!ok && m->over) vs_error_set(e, VS_ERROR_LIMIT, NULL, VS_SHAPES_OVER, m->most, VS_ON_THE_WAY, limit);
  m->most = 0;
  return ok;
}

bool vs_primitive_overlaps(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, bool *overlaps,
                           vs_error *e) {
  vs_mesh m = { 0 };
  vs_mesh_flaws flaws = { 0 };
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  bool crowd = false, ok = vs_tessellate(n, f, &m, e);
  vs_bends *bends = ok && is_sweep(n) ? vs_bends_new(n, f, e) : NULL;
  ok = ok && (!is_sweep(n) || bends) && (!bends || is_crowd(bends, &m, options, &crowd, e));
  ok = ok && (crowd || !m.triangle_count || vs_kernel_inspect(&m, options, &flaws, &why) || failed(&why, e));
  *overlaps = crowd || flaws.wound_count > 0;
  vs_bends_free(bends);
  vs_mesh_free(&m);
  return ok;
}

/* A sweep whose overlaps are removed. outcome: how this has ended; at: position of the fault; marked[i]: true if the
 * mesh differs from the exact sections in step i. */
typedef struct {
  const vs_node *node;
  const vs_fineness *fineness;
  const vs_kernel_options *options;
  vs_bends *bends;
  enum { FREED, TOO_MUCH, MEETS, STRAYS } outcome;
  vs_vec3 at;
  bool *marked;
} sweep;

/* Removes the overlaps of m, the mesh of the sweep s->bends. Sets s->outcome to the result. Returns false on
 * failure. */
static bool free_sweep(sweep *s, vs_mesh *m, vs_error *e) {
  vs_bounds b = vs_mesh_bounds(m);
  double tolerance = s->fineness->tolerance, step = fmax(tolerance / 16, vs_bounds_diagonal(&b) * 0x1p-20);
  work left = { s->options, MOST_PAIRS, false, false };
  bool crowd, changed = true, met = false, turns;
  s->outcome = FREED;
  if (!is_crowd(s->bends, m, s->options, &crowd, e)) return false;
  if (!(crowd ? unite_runs(s->bends, step, &left, m, e) : free_of_overlaps(m, s->options, &changed, e))) return false;
  if (!left.too_much && !settle(m, tolerance / 8, &left, &met, &s->at, e)) return false;
  if (left.too_much || met) return s->outcome = left.too_much ? TOO_MUCH : MEETS, true;
  if (!vs_bends_turn(s->bends, &turns)) return vs_error_memory(e, NULL);
  /* If the user has set the number of facets, the sections stay as coarse as this number requires. */
  if (!turns || s->fineness->segments > 0) return true;
  const vs_astray look = { s->node, s->bends, m, tolerance, s->options ? s->options->job : NULL };
  size_t astray;
  free(s->marked);
  s->marked = vs_zeros(vs_bends_steps(s->bends), sizeof *s->marked);
  if (!s->marked) return vs_error_memory(e, NULL);
  if (!vs_sweep_astray(&look, s->marked, &astray, &s->at, e)) return false;
  if (astray) s->outcome = STRAYS;
  return true;
}

/* Sets the error: position of the bend that is too tight, the size of a profile that would fit, and a remedy. Returns
 * false. */
static bool refuse(const sweep *s, vs_error *e) {
  vs_bend bend;
  char remedy[80] = "make the bend wider: no profile fits it";
  vs_bends_tightest(s->bends, s->outcome == TOO_MUCH ? NULL : &s->at, &bend);
  if (bend.fits == 1)
    return vs_error_set(e, VS_ERROR_MODEL, NULL,
                        "the sweep overlaps itself at (xyz %.4g %.4g %.4g) at too small an angle, and makes no solid: "
                        "move the path apart or through itself there",
                        s->at.x, s->at.y, s->at.z);
  if (bend.fits > 1e-3)
    snprintf(remedy, sizeof remedy, "make the bend wider, or the profile at most %.2g times as large", bend.fits * .99);
  return vs_error_set(e, VS_ERROR_MODEL, NULL,
                      "the bend at (xyz %.4g %.4g %.4g) is too tight: the profile overlaps itself there, and makes no "
                      "solid; %s",
                      bend.at.x, bend.at.y, bend.at.z, remedy);
}

/* Marks also the steps within `close` steps of a marked step, because few points are tested and a step without one may
 * be wrong, too. Returns false if memory is out. */
static bool mark_neighbours(sweep *s, size_t close) {
  size_t steps = vs_bends_steps(s->bends), since = close + 1;
  bool *wider = vs_zeros(steps, sizeof *wider);
  if (!wider) return false;
  for (size_t i = 0; i < steps; i++) {
    since = s->marked[i] ? 0 : since + 1;
    wider[i] = since <= close;
  }
  since = close + 1;
  for (size_t i = steps; i-- > 0;) {
    since = s->marked[i] ? 0 : since + 1;
    wider[i] = wider[i] || since <= close;
  }
  free(s->marked);
  s->marked = wider;
  return true;
}

enum { FINE = 16, FINEST = 1024 }; /* factors by which the tolerance of steps is reduced, from FINE in the first attempt
                                    * to FINEST in the last */

/* Divides the steps at tight bends, makes the sweep's mesh again, and removes its overlaps. If the mesh differs from
 * the exact sections in some steps, divides only these. finer: factor by which the tolerance of the steps is reduced.
 * Returns false on failure. */
static bool free_finer(sweep *s, double finer, vs_mesh *m, vs_error *e) {
  size_t limit = s->options ? s->options->max_triangles : 0;
  bool some = s->outcome == STRAYS;
  vs_mesh_free(m);
  m->most = limit * VS_ON_THE_WAY;
  bool ok = (!some || mark_neighbours(s, finer > FINE ? 1 : 3)) &&
            vs_bends_refine(s->bends, some ? s->marked : NULL, s->fineness->tolerance / finer) &&
            vs_bends_mesh(s->bends, m);
  if (!ok && m->over) return vs_error_set(e, VS_ERROR_LIMIT, NULL, VS_SHAPES_OVER, m->most, VS_ON_THE_WAY, limit);
  m->most = 0;
  return ok ? free_sweep(s, m, e) : vs_error_memory(e, NULL);
}

bool vs_primitive_freed(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *m,
                        vs_error *e) {
  bool changed;
  if (!may_overlap(n)) return true;
  if (!is_sweep(n)) return free_of_overlaps(m, options, &changed, e);
  sweep s = { .node = n, .fineness = f, .options = options, .bends = vs_bends_new(n, f, e) };
  bool ok = s.bends && free_sweep(&s, m, e);
  for (int finer = FINE; ok && finer <= FINEST; finer *= 4) {
    if (s.outcome != STRAYS && (s.outcome != MEETS || finer > FINE)) break;
    ok = free_finer(&s, finer, m, e);
  }
  ok = ok && (s.outcome == FREED || refuse(&s, e));
  m->settled = ok;
  free(s.marked);
  vs_bends_free(s.bends);
  return ok;
}
