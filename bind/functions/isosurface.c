/* Implements make-isosurface, which creates solids from functions. */
#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/call/raise.h"
#include "bind/call/refuse.h"
#include "bind/functions/function_values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bind/call/context.h"
#include "bind/measures.h"
#include "bind/print.h"
#include "bind/warnings.h"
#include "geometry/files/polyface.h"
#include "geometry/functions/contour.h"
#include "kernel/kernel_options.h"
#include "model/store/array.h"

enum { FIRST_CELLS = 24 };

static vs_status refuse(vs_args *f, vs_contour_outcome outcome, const vs_contour *c) {
  char x[32], y[32], z[32];
  vs_bind_number_text(x, c->at.x), vs_bind_number_text(y, c->at.y), vs_bind_number_text(z, c->at.z);
  switch (outcome) {
  case VS_CONTOUR_NO_NUMBER:
    return vs_fail(f->vm, f->vm->sym.range, "f has no value at (xyz %s %s %s), which lies in the box", x, y, z);
  case VS_CONTOUR_POLE:
    return vs_fail(f->vm, f->vm->sym.range, "f has a pole near (xyz %s %s %s): it changes its sign through infinity", x,
                   y, z);
  case VS_CONTOUR_EMPTY:
    return vs_fail(f->vm, f->vm->sym.range,
                   "f is nowhere below the level in the box, or only in parts smaller than a cell");
  case VS_CONTOUR_STOPPED: return VS_ERROR; /* vm->condition is already set */
  case VS_CONTOUR_MANY:
    return vs_fail(f->vm, f->vm->sym.limit, VS_SHAPES_OVER, c->most, VS_ON_THE_WAY, vs_bind_most_triangles(f->vm));
  case VS_CONTOUR_MEMORY:
  case VS_CONTOUR_DONE: break;
  }
  return vs_fail_memory(f->vm);
}

/* Computes the surface with smaller and smaller cells, until the centres of its triangles are within the tolerance of
 * the true surface. */
static vs_contour_outcome refined(vs_args *f, const vs_tape *t, double tolerance, vs_contour *c) {
  int cells = FIRST_CELLS;
  for (;;) {
    c->most = vs_bind_most_triangles(f->vm) * VS_ON_THE_WAY;
    vs_contour_grid grid = { f->arg[1].point, f->arg[2].point, cells, tolerance };
    vs_contour_outcome outcome = vs_contour_make(t, &grid, (vs_long_work){ vs_bind_keep_going, f->vm }, c);
    bool missed = outcome == VS_CONTOUR_EMPTY; /* missed: whether no surface was found, although smaller cells may find
                                                * one */
    if ((outcome != VS_CONTOUR_DONE && !missed) || (!missed && c->deviation <= tolerance)) return outcome;
    if (cells == VS_CONTOUR_CELLS || (missed && cells >= 128)) {
      if (!missed)
        vs_bind_warn(f->bind, "tolerance", "make-isosurface: the tolerance is not reached: %d cells are %.3g off",
                     cells, c->deviation);
      return outcome;
    }
    double more =
        missed ? 2 : sqrt(c->deviation / tolerance) * 1.1; /* the deviation is proportional to the square of the size of
                                                            * a cell */
    cells = (int)fmin(VS_CONTOUR_CELLS, ceil(cells * fmin(4, fmax(1.3, more))));
    vs_contour_free(c);
  }
}

/* (%make-isosurface tape p q #:cells #:tolerance): creates the solid. */
vs_status vs_p_make_isosurface(vs_args *f, vs_value *out) {
  const vs_tape *t = vs_foreign_get(f->arg[0].value, &vs_tape_type);
  vs_vec3 p = f->arg[1].point, q = f->arg[2].point;
  static const char *const expected = "a corner beyond p along each axis";
  if (!t) return vs_bind_refuse(f, "f", "a function", f->arg[0].value);
  if (!(p.x < q.x && p.y < q.y && p.z < q.z)) return vs_bind_refuse(f, "q", expected, f->arg[2].value);
  if (f->key[0].given && (f->key[0].integer < 2 || f->key[0].integer > VS_CONTOUR_CELLS)) {
    char text[64];
    snprintf(text, sizeof text, "from 2 to %d", VS_CONTOUR_CELLS);
    return vs_bind_refuse(f, "cells", text, f->key[0].value);
  }
  vs_contour c = { .most = vs_bind_most_triangles(f->vm) * VS_ON_THE_WAY };
  vs_contour_grid grid = { p, q, f->key[0].given ? (int)f->key[0].integer : 64, 0 };
  vs_long_work work = { vs_bind_keep_going, f->vm };
  vs_contour_outcome outcome =
      f->key[1].given ? refined(f, t, f->key[1].real, &c) : vs_contour_make(t, &grid, work, &c);
  vs_status status = outcome == VS_CONTOUR_DONE ? VS_OK : refuse(f, outcome, &c);
  uint32_t *starts = NULL;
  size_t room = 0;
  vs_node *node = NULL;
  if (status && !VS_GROW(starts, room, c.triangle_count + 1)) status = vs_fail_memory(f->vm);
  if (status) {
    for (size_t i = 0; i <= c.triangle_count; i++) starts[i] = (uint32_t)(3 * i);
    vs_error e = { 0 };
    vs_polygons faces = { c.points, c.point_count, starts, &c.triangles[0][0], c.triangle_count };
    node = vs_polyface_make(f->store, &faces, &e);
    if (!node) status = vs_bind_error(f->vm, &e);
  }
  if (status && c.capped)
    vs_bind_warn(f->bind, "capped", "make-isosurface: the box cuts the solid of f; its sides close it");
  free(starts);
  vs_contour_free(&c);
  return status ? vs_bind_give_node(f, node, out) : VS_ERROR;
}
