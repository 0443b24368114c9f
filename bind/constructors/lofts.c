/* Implements revolutions, lofts and surfaces, which are made from profiles and grids of points. Each object is meshed
 * coarsely when it is created, so that an error in it is reported at the constructor's call. */

#include <stdio.h>

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/precision.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/call/take.h"
#include "bind/constructors/operations.h"
#include "bind/objects.h"
#include "bind/origins.h"
#include "bind/print.h"
#include "bind/records.h"
#include "geometry/measure/bounds.h"
#include "geometry/parts.h"
#include "geometry/profiles/revolve.h"
#include "geometry/profiles/surface.h"
#include "geometry/tessellate.h"
#include "vm/machine/fail.h"

#define REAL(i) (f->arg[i].real)
#define NODE(i) (f->arg[i].ref.node)
#define TURN 6.283185307179586

/* Computes a coarse mesh of the node. If that fails, sets the error. */
static vs_status tried(vs_args *f, vs_node *n) {
  vs_bounds b = vs_bounds_empty(), child;
  vs_error e = { 0 };
  vs_mesh m = { 0 };
  for (uint32_t i = 0; i < n->child_count; i++) {
    if (!vs_node_bounds(n->children[i].node, &child, &e)) return vs_bind_error(f->vm, &e);
    vs_bounds_unite(&b, &child);
  }
  vs_fineness coarse = { fmax(vs_bounds_diagonal(&b) / 64, 1e-300), 0 };
  bool ok = vs_tessellate(n, &coarse, &m, &e);
  double size = vs_bounds_diagonal(&b);
  bool thin = ok && !(vs_mesh_area(&m) > 1e-12 * size * size),
       flat = ok && n->class_ == VS_SOLID && !(fabs(vs_mesh_volume(&m)) > 1e-12 * size * size * size);
  vs_mesh_free(&m);
  if (!ok) return vs_bind_error(f->vm, &e);
  if (thin) return vs_fail(f->vm, f->vm->sym.range, "sections must not lie in one line");
  return flat ? vs_fail(f->vm, f->vm->sym.range, "sections must not all lie in one plane") : VS_OK;
}

/* ---- revolutions ---- */

vs_status vs_p_do_revolve(vs_args *f, vs_value *out) {
  struct vs_revolve d = { .at = f->arg[1].line.at, .direction = vs_v3_unit(f->arg[1].line.direction), .end = TURN };
  vs_revolve plan;
  vs_error e = { 0 };
  vs_bounds b;
  d.segments = f->key[0].given ? (int32_t)f->key[0].integer : vs_bind_segments(f->vm);
  if (f->arg[2].given) d.start = REAL(2);
  if (f->arg[3].given) d.end = REAL(3);
  if (vs_node_is_empty(NODE(0))) return vs_bind_empty(f, "the profile is empty", out);
  if (d.start == d.end) return vs_bind_empty(f, "start and end are the same", out);
  if (vs_is_several(NODE(0)) && !(NODE(0)->flags & VS_NODE_CLOSED)) return vs_bind_each_part(f, vs_p_do_revolve, out);
  if (!vs_bind_uncrossed(f, f->arg[0].ref, "s")) return VS_ERROR;
  vs_node *n = vs_node_new(f->store, VS_REVOLVE, &d, &f->arg[0].ref, 1);
  if (!vs_bind_keep(f, n)) return VS_ERROR;
  if (!vs_node_bounds(NODE(0), &b, &e)) return vs_bind_error(f->vm, &e);
  vs_fineness coarse = { fmax(vs_bounds_diagonal(&b) / 64, 1e-300), 0 };
  if (!vs_revolve_plan(n, &coarse, &plan, &e)) return vs_bind_error(f->vm, &e);
  bool nothing = plan.count == 0;
  vs_revolve_free(&plan);
  if (nothing) return vs_bind_empty(f, "the profile is empty", out);
  return vs_bind_give_node(f, vs_node_retain(n), out);
}

/* ---- lofts ---- */

/* Removes empty sections from the loft's sections in `all`. If fewer than two remain, sets *count to 0 and *out to the
 * empty object. */
static vs_status sections(vs_args *f, vs_ref *all, size_t *count, vs_value *out) {
  size_t given = *count, n = 0;
  const vs_origin *origin = vs_bind_origin(f->bind);
  *count = 0;
  if (given < 2)
    return vs_bind_refuse(f, "sections", "two sections or more",
                          f->arg[0].value == VS_UNSPECIFIC ? VS_NIL : f->arg[0].value);
  for (size_t i = 0; i < given; i++)
    if (!vs_node_is_empty(all[i].node)) {
      char what[40];
      snprintf(what, sizeof what, "section %zu", i + 1);
      if (!vs_bind_uncrossed(f, all[i], what)) return VS_ERROR;
      all[n] = all[i];
      if (!all[n++].origin) all[n - 1].origin = origin;
    }
  *count = n < 2 ? 0 : n;
  return n < 2 ? vs_bind_empty(f, "at most one section is not empty", out) : VS_OK;
}

static vs_status loft(vs_args *f, vs_kind kind, const void *data, const vs_ref *children, size_t count,
                      vs_value *out) {
  vs_node *n = vs_node_new(f->store, kind, data, children, count);
  if (!vs_bind_keep(f, n) || !tried(f, n)) return VS_ERROR;
  return vs_bind_give_node(f, vs_node_retain(n), out);
}

vs_status vs_p_do_loft(vs_args *f, vs_value *out) {
  struct vs_loft d = { .start_angle = f->arg[1].given ? REAL(1) : 0, .start_hold = f->arg[2].given ? REAL(2) : 0,
                       .end_angle = f->arg[3].given ? REAL(3) : 0, .end_hold = f->arg[4].given ? REAL(4) : 0 };
  size_t n = f->arg[0].refs.count;
  if (d.start_hold == 0) d.start_angle = 0; /* start_hold is the length along which the loft follows start_angle; if it
                                             * is 0, the angle has no effect */
  if (d.end_hold == 0) d.end_angle = 0;
  if (!sections(f, f->arg[0].refs.at, &n, out)) return VS_ERROR;
  return n ? loft(f, VS_LOFT, &d, f->arg[0].refs.at, n, out) : VS_OK;
}

vs_status vs_p_loft_objects(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].refs.count;
  if (!sections(f, f->arg[0].refs.at, &n, out)) return VS_ERROR;
  return n ? loft(f, VS_LOFT, &(struct vs_loft){ 0 }, f->arg[0].refs.at, n, out) : VS_OK;
}

vs_status vs_p_do_ruled_loft(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].refs.count;
  if (!sections(f, f->arg[0].refs.at, &n, out)) return VS_ERROR;
  return n ? loft(f, VS_RULED_LOFT, &(struct vs_ruled_loft){ 0 }, f->arg[0].refs.at, n, out) : VS_OK;
}

vs_status vs_p_do_guided_loft(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].refs.count, guides = f->arg[1].refs.count;
  bool path = vs_bind_take_ref(f->arg[1].value).node != NULL;
  if (!sections(f, f->arg[0].refs.at, &n, out)) return VS_ERROR;
  if (!n) return VS_OK;
  if (!guides) return vs_bind_refuse(f, "guides", "a curve (the path) or a list of curves", f->arg[1].value);
  vs_ref *all = vs_bind_scratch(f, (n + guides) * sizeof *all);
  if (!all) return VS_ERROR;
  memcpy(all, f->arg[0].refs.at, n * sizeof *all);
  for (size_t i = 0; i < guides; i++) {
    all[n + i] = f->arg[1].refs.at[i];
    if (vs_node_is_empty(all[n + i].node))
      return vs_bind_empty(f, path ? "the path is empty" : "a guide is empty", out);
  }
  struct vs_guided_loft d = { .section_count = (int32_t)n, .path = path };
  return loft(f, VS_GUIDED_LOFT, &d, all, n + guides, out);
}

/* ---- grids of points ---- */

typedef struct { vs_vec3 *at; size_t rows, columns; vs_value bad; size_t bad_row, bad_column; bool bad_point; } grid;

/* Reads rows of points. On failure returns VS_ERROR, with the error set, unless an element is no point. Then
 * g->bad_point is true, and g contains the element and its position. */
static vs_status read_rows(vs_args *f, vs_value v, grid *g) {
  int64_t rows = vs_list_length(v), columns = rows > 0 ? vs_list_length(vs_car(v)) : 0;
  *g = (grid){ 0 };
  if (rows < 0) return vs_bind_refuse(f, "rows", "a list of lists of points", v);
  if (rows < 2) return vs_bind_refuse(f, "rows", "two or more lists of points", v);
  if (columns < 0) return vs_bind_refuse(f, "rows", "a list of lists of points", vs_car(v));
  if (columns < 2) return vs_bind_refuse(f, "rows", "lists of two or more points", vs_car(v));
  if (columns > 50000000 / rows)
    return vs_fail(f->vm, f->vm->sym.range, "rows must hold at most 50 million points, got %.0f",
                   (double)rows * (double)columns);
  g->rows = (size_t)rows, g->columns = (size_t)columns;
  g->at = vs_bind_scratch(f, g->rows * g->columns * sizeof *g->at);
  if (!g->at) return VS_ERROR;
  size_t i = 0;
  for (vs_value r = v; r != VS_NIL; r = vs_cdr(r), i++) {
    int64_t n = vs_list_length(vs_car(r));
    if (n < 0) return vs_bind_refuse(f, "rows", "a list of lists of points", vs_car(r));
    if (n != columns)
      return vs_fail(f->vm, f->vm->sym.range,
                     "rows must be lists of equally many points: the first has %.0f, number %.0f has %.0f",
                     (double)columns, (double)i + 1, (double)n);
    size_t j = 0;
    for (vs_value p = vs_car(r); p != VS_NIL; p = vs_cdr(p), j++) {
      const double *d = vs_is_flat(vs_car(p), VS_FLAT_POINT) ? vs_as_flat(vs_car(p))->at : NULL;
      if (!d || !isfinite(d[0]) || !isfinite(d[1]) || !isfinite(d[2])) {
        g->bad = vs_car(p), g->bad_row = i, g->bad_column = j, g->bad_point = true;
        return VS_ERROR;
      }
      g->at[i * g->columns + j] = vs_v3(d[0], d[1], d[2]);
    }
  }
  return VS_OK;
}

static vs_status make_grid(vs_args *f, vs_kind kind, const grid *g, vs_value *out) {
  vs_error e = { 0 };
  vs_point_grid points = { g->at, g->rows, g->columns, f->key[0].given && f->key[0].boolean,
                           f->key[1].given && f->key[1].boolean };
  vs_node *n = vs_surface_make(f->store, kind, &points, &e);
  if (!n) return vs_bind_error(f->vm, &e);
  if (!vs_node_is_empty(n)) return vs_bind_give_node(f, n, out);
  vs_node_release(n);
  return vs_bind_empty(f, "all points lie on one line", out);
}

static vs_status bad_point(vs_args *f, const grid *g) {
  if (!g->bad_point) return VS_ERROR;
  char text[96];
  snprintf(text, sizeof text, "lists of points of finite coordinates; in row %zu, place %zu", g->bad_row + 1,
           g->bad_column + 1);
  return vs_bind_refuse(f, "rows", text, g->bad);
}

vs_status vs_p_make_mesh(vs_args *f, vs_value *out) {
  grid g;
  return read_rows(f, f->arg[0].value, &g) ? make_grid(f, VS_GRID_MESH, &g, out) : bad_point(f, &g);
}

/* (%make-surface rows u0 u1 v0 v1): creates a surface from rows of points. If the user's procedure has computed the
 * points, u0 to u1 and v0 to v1 are the ranges of its arguments; otherwise they are #f. */
vs_status vs_p_make_surface(vs_args *f, vs_value *out) {
  grid g;
  double range[4];
  if (read_rows(f, f->arg[0].value, &g)) return make_grid(f, VS_GRID_SURFACE, &g, out);
  if (!g.bad_point || f->arg[1].value == VS_FALSE) return bad_point(f, &g);
  for (int i = 0; i < 4; i++)
    if (!vs_bind_take_number(f->vm, f->arg[i + 1].value, &range[i])) return VS_ERROR;
  char u[32], v[32];
  vs_bind_number_text(u, range[0] + (range[1] - range[0]) * (double)g.bad_row / (double)(g.rows - 1));
  vs_bind_number_text(v, range[2] + (range[3] - range[2]) * (double)g.bad_column / (double)(g.columns - 1));
  VS_ROOTS(f->vm, r, 2);
  r[0] = g.bad;
  if (!vs_cons(f->vm, r[0], VS_NIL, &r[1])) return VS_ERROR;
  return vs_fail_with(f->vm, f->vm->sym.type, r[1],
                      "f must give points of finite coordinates; at (u, v) = (%s, %s) it gave", u, v);
}
