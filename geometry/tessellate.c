/* Makes the triangles of a node: follows placements down to the leaf, makes the leaf's mesh, and maps it by the
 * placements. */
#include "geometry/plane/planar_evaluation.h"
#include "geometry/tessellate.h"

#include "geometry/profiles/loft.h"
#include "geometry/profiles/loft_mesh.h"
#include "geometry/profiles/revolve.h"
#include "geometry/primitives/solid_triangles.h"
#include "geometry/primitives/shape.h"
#include "geometry/profiles/surface.h"
#include "geometry/profiles/swept_mesh.h"
#include "geometry/profiles/thicken.h"
#include "geometry/profiles/taper.h"
#include "model/store/array.h"

#include <stdlib.h>

/* Returns the child of n if n is a placement, material or layer, and multiplies *placed by the placement. Returns NULL
 * for any other node. */
static const vs_ref *tessellate_below(const vs_node *n, vs_affine *placed) {
  switch (vs_node_role(n)) {
    case VS_ROLE_PLACED: *placed = vs_affine_multiply(placed, &VS_AS(transform, n)->matrix); return &n->children[0];
    case VS_ROLE_WRAPPER: return n->child_count ? &n->children[0] : NULL;
    case VS_ROLE_SET: return n->child_count == 1 ? &n->children[0] : NULL;
    case VS_ROLE_SHAPE: case VS_ROLE_LEAF: case VS_ROLE_MADE: break;
  }
  return NULL;
}

static bool tessellate_leaf(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  bool ok = false;
  if (n->class_ == VS_NOTHING) return true;
  switch ((vs_kind)n->kind) {
    case VS_EMPTY: case VS_GHOST: return true;
    case VS_CUSTOM:
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "%s has no drawing function: (register-drawing-function %s? ...) gives it one",
                          VS_AS(custom, n)->name, VS_AS(custom, n)->name);
#include "model/cases/shape_cases.def"
      return vs_shape_of(n)->triangles(n, f, out, e);
    case VS_POLYFACE_MESH:
      ok = vs_solid_polyface(out, VS_AS(polyface_mesh, n)->points, VS_AS(polyface_mesh, n)->faces);
      break;
    case VS_HULL:
      if (n->class_ == VS_SOLID) {
        vs_cloud cloud = { 0 };
        bool gathered = vs_hull_points(n, f, &cloud, e);
        ok = gathered && vs_cloud_hull(&cloud, out);
        vs_cloud_free(&cloud);
        if (!gathered) return false;
        break;
      } /* fall through */
    case VS_OFFSET:
      if (n->class_ == VS_CURVE) return vs_error_set(e, VS_ERROR_MODEL, NULL, "an offset curve has no faces");
      /* fall through */
    case VS_REGION: case VS_TEXT: {
      vs_outline o;
      if (!vs_region_outline(n, f, &o, e)) return false;
      ok = !o.count || vs_outline_mesh(&o, out);
      vs_outline_free(&o);
      break;
    }
    case VS_SLICE: case VS_DEFORM:
      return vs_error_set(e, VS_ERROR_MODEL, NULL, "a %s is made by solids/resolve.c before",
                          vs_kind_get((vs_kind)n->kind)->name);
    case VS_THICKEN:
      if (n->children[0].node->class_ == VS_SURFACE) {
        vs_mesh surface = { 0 };
        /* This recursion is only one level deep: the child is a surface, and never itself a thickening. */
        if (!vs_tessellate(n->children[0].node, f, &surface, e)) return vs_mesh_free(&surface), false;
        double half = VS_AS(thicken, n)->width / 2;
        ok = vs_thicken_surface(&surface, half, half, out, NULL, NULL);
        vs_mesh_free(&surface);
        break;
      } /* fall through */
    case VS_EXTRUDE: case VS_SWEEP: {
      if (n->kind == VS_EXTRUDE && VS_AS(extrude, n)->taper != 0) return vs_taper_mesh(n, f, out, e);
      vs_swept plan;
      if (!vs_swept_plan(n, f, &plan, e)) return false;
      ok = vs_swept_mesh(&plan, out);
      vs_swept_free(&plan);
      break;
    }
    case VS_REVOLVE: {
      vs_revolve plan;
      if (!vs_revolve_plan(n, f, &plan, e)) return false;
      ok = vs_revolve_mesh(&plan, vs_revolve_steps(&plan, f, VS_AS(revolve, n)->segments), out);
      vs_revolve_free(&plan);
      break;
    }
    case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: return vs_loft_mesh(n, f, out, e);
    case VS_GRID_MESH: case VS_GRID_SURFACE: ok = vs_surface_mesh(n, out); break;
    case VS_SECTION: case VS_PROJECT: /* not reached, because solids/resolve.c has replaced sections and projections by
                                       * regions */
    case VS_JOIN: case VS_XLINE: case VS_RAY: case VS_EDGES:
    case VS_LINE:
    case VS_ARC:
    case VS_CIRCLE:
    case VS_SPLINE:
      return vs_error_set(e, VS_ERROR_MODEL, NULL, "a %s has no faces", vs_kind_get((vs_kind)n->kind)->name);
#include "model/cases/passed_cases.def"
      return vs_error_set(e, VS_ERROR_MODEL, NULL, "%s is not one solid: its parts are to be meshed apart",
                          vs_kind_get((vs_kind)n->kind)->name);
  }
  return ok || vs_error_memory(e, NULL);
}

/* Returns the leaf below the placements of n. *placed: map from the leaf's coordinates to those outside of n; *inner:
 * the fineness f, converted to the leaf's coordinates. */
static const vs_node *tessellate_bottom(const vs_node *n, const vs_fineness *f, vs_affine *placed, vs_fineness *inner,
                                        const vs_origin **origin) {
  *placed = vs_affine_identity();
  *origin = NULL;
  for (const vs_ref *below; (below = tessellate_below(n, placed)) != NULL; n = below->node) *origin = below->origin;
  *inner = vs_fineness_placed(f, placed);
  return n;
}

bool vs_tessellate(const vs_node *n, const vs_fineness *f, vs_mesh *out, vs_error *e) {
  vs_affine placed;
  vs_fineness inner;
  const vs_origin *origin;
  size_t first_vertex = out->vertex_count, first_triangle = out->triangle_count;
  n = tessellate_bottom(n, f, &placed, &inner, &origin);
  if (!tessellate_leaf(n, &inner, out, e)) {
    out->vertex_count = first_vertex;
    out->triangle_count = first_triangle;
    if (e && !e->origin) e->origin = origin;
    return false;
  }
  vs_mesh_transform_from(out, &placed, first_vertex, first_triangle);
  return true;
}

struct vs_bends {
  vs_swept plan;
  vs_affine placed; /* map from the coordinates of the planned sections to the coordinates outside of all placements
                     * around the sweep */
  double scale;     /* factor that converts a tolerance from the coordinates outside of the placements to the
                     * coordinates of the sweep */
};

vs_bends *vs_bends_new(const vs_node *n, const vs_fineness *f, vs_error *e) {
  vs_bends *b = vs_zeros(1, sizeof *b);
  vs_fineness inner;
  const vs_origin *origin;
  if (!b) return vs_error_memory(e, NULL), NULL;
  n = tessellate_bottom(n, f, &b->placed, &inner, &origin);
  b->scale = inner.tolerance / f->tolerance;
  if (vs_swept_plan(n, &inner, &b->plan, e)) return b;
  if (e && !e->origin) e->origin = origin;
  free(b);
  return NULL;
}

void vs_bends_free(vs_bends *b) {
  if (b) vs_swept_free(&b->plan);
  free(b);
}

size_t vs_bends_steps(const vs_bends *b) { return b->plan.section_count; }

bool vs_bends_refine(vs_bends *b, const bool *marked, double tolerance) {
  return vs_overturn_refine(&b->plan, marked, b->scale * tolerance);
}

bool vs_bends_turn(const vs_bends *b, bool *turns) { return vs_swept_turns(&b->plan, turns); }

bool vs_bends_mesh(const vs_bends *b, vs_mesh *out) {
  size_t first_vertex = out->vertex_count, first_triangle = out->triangle_count;
  if (!vs_swept_mesh(&b->plan, out)) return false;
  vs_mesh_transform_from(out, &b->placed, first_vertex, first_triangle);
  return true;
}

bool vs_bends_runs(const vs_bends *b, size_t steps, vs_mesh **runs, size_t *count) {
  if (!vs_swept_runs(&b->plan, steps, runs, count)) return false;
  for (size_t i = 0; i < *count; i++) vs_mesh_transform(&(*runs)[i], &b->placed);
  return true;
}

bool vs_bends_samples(const vs_bends *b, vs_step_point *out, size_t most, size_t *count) {
  if (!vs_swept_samples(&b->plan, out, most, count)) return false;
  for (size_t i = 0; i < *count; i++) out[i].at = vs_affine_point(&b->placed, out[i].at);
  return true;
}

void vs_bends_tightest(const vs_bends *b, const vs_vec3 *near, vs_bend *out) {
  vs_affine back;
  vs_vec3 place;
  *out = (vs_bend){ .fits = 1 };
  bool finds = near && vs_affine_invert(&b->placed, &back);
  if (finds) place = vs_affine_point(&back, *near);
  vs_overturn_tightest(&b->plan, finds ? &place : NULL, &out->at, &out->fits);
  out->at = vs_affine_point(&b->placed, out->at);
}

static bool hull_corners(const vs_node *n, const vs_affine *placed, const vs_fineness *f, vs_cloud *out, vs_error *e) {
  if (n->class_ == VS_CURVE || n->class_ == VS_REGION_CLASS) return vs_planar_corners(n, placed, f, out, e);
  if (n->kind == VS_INTERSECTION || n->kind == VS_DIFFERENCE)
    return vs_error_set(e, VS_ERROR_MODEL, NULL, "the hull of an intersection or a difference needs its mesh");
  if (n->class_ != VS_SOLID && n->class_ != VS_SURFACE) return true;
  vs_mesh m = { 0 };
  bool ok = vs_tessellate(n, f, &m, e) && vs_cloud_add_all(out, placed, m.vertices, m.vertex_count, e);
  vs_mesh_free(&m);
  return ok;
}

bool vs_hull_points(const vs_node *hull, const vs_fineness *f, vs_cloud *out, vs_error *e) {
  return vs_hull_cloud(hull, hull_corners, f, out, e);
}
