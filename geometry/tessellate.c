/* Makes the triangles of a node: follows placements down to the leaf, meshes the leaf, and places the mesh. */
#include "geometry/plane/planar_evaluation.h"
#include "geometry/tessellate.h"

#include "geometry/profiles/loft.h"
#include "geometry/profiles/loft_mesh.h"
#include "geometry/profiles/overturn.h"
#include "geometry/profiles/revolve.h"
#include "geometry/primitives/solid_triangles.h"
#include "geometry/primitives/shape.h"
#include "geometry/profiles/surface.h"
#include "geometry/profiles/swept_mesh.h"
#include "geometry/profiles/thicken.h"
#include "geometry/profiles/taper.h"

/* Returns the child of a placement or an appearance, and adds the placement to *placed. Returns NULL for any other
 * node. An appearance does not change the shape. */
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
        /* The recursion is only one level deep, because a surface is no thickening. */
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
    case VS_SECTION: case VS_PROJECT: /* cannot occur, because solids/resolve.c has replaced sections and projections by
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

/* Returns the leaf below the placements of n. *placed: the map from the leaf's coordinates to those above n; *inner:
 * the fineness in the leaf's coordinates. */
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

/* Makes the plan of the sections of a sweep or a pipe. Sets *is to true if n is a sweep or a pipe; other solids have no
 * plan. Returns false on an error. */
static bool sweep_plan(const vs_node *n, const vs_fineness *f, vs_swept *plan, vs_affine *placed, bool *is,
                       vs_error *e) {
  vs_fineness inner;
  const vs_origin *origin;
  n = tessellate_bottom(n, f, placed, &inner, &origin);
  *plan = (vs_swept){ 0 };
  *is = n->kind == VS_SWEEP || (n->kind == VS_THICKEN && n->children[0].node->class_ == VS_CURVE);
  if (!*is || vs_swept_plan(n, &inner, plan, e)) return true;
  if (e && !e->origin) e->origin = origin;
  return false;
}

bool vs_sweep_turns(const vs_node *n, const vs_fineness *f, bool *turns, vs_error *e) {
  vs_swept plan;
  vs_affine placed;
  *turns = false;
  if (!sweep_plan(n, f, &plan, &placed, turns, e)) return false;
  bool ok = !*turns || vs_swept_turns(&plan, turns) || vs_error_memory(e, NULL);
  vs_swept_free(&plan);
  return ok;
}

bool vs_sweep_runs(const vs_node *n, const vs_fineness *f, size_t steps, vs_mesh **runs, size_t *count, vs_error *e) {
  vs_swept plan;
  vs_affine placed;
  bool is;
  *runs = NULL;
  *count = 0;
  if (!sweep_plan(n, f, &plan, &placed, &is, e)) return false;
  bool ok = !is || vs_swept_runs(&plan, steps, runs, count) || vs_error_memory(e, NULL);
  for (size_t i = 0; i < *count; i++) vs_mesh_transform(&(*runs)[i], &placed);
  vs_swept_free(&plan);
  return ok;
}

bool vs_sweep_tightest(const vs_node *n, const vs_fineness *f, const vs_vec3 *near, vs_sweep_bend *out, vs_error *e) {
  vs_swept plan;
  vs_affine placed, back;
  bool is;
  *out = (vs_sweep_bend){ .fits = 1 };
  if (!sweep_plan(n, f, &plan, &placed, &is, e)) return false;
  vs_vec3 place;
  bool finds = near && vs_affine_invert(&placed, &back);
  if (finds) place = vs_affine_point(&back, *near);
  if (is) vs_overturn_tightest(&plan, finds ? &place : NULL, &out->at, &out->fits);
  out->at = vs_affine_point(&placed, out->at);
  vs_swept_free(&plan);
  return true;
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
