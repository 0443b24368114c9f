/* Owns fold: nested placements multiply, a moved primitive becomes a primitive elsewhere.
 *
 * A kind is closed under some maps only: a box under those that keep axes, a round solid under those that keep circles, polyhedra and polylines
 * under all. Where the modeller gave the facets (segments) a turn would move their corners: then only shifts and even scales fold. */
#include <math.h>

#include "model/passes/rewrite.h"

typedef struct {
  bool even;    /* a similarity: every length times scale */
  bool upright; /* even, and no turn or mirror at all */
  bool axes;    /* a signed permutation of the axes, with any scales */
  bool plain;   /* axes kept each in its place and sense */
  bool level;   /* even, and Z stays vertical */
  double scale;
} vs_fold_map;

static vs_fold_map vs_fold_look(const vs_affine *a) {
  vs_fold_map f = { .even = true, .axes = true, .plain = true };
  vs_vec3 c[3];
  for (int j = 0; j < 3; j++) c[j] = vs_v3(a->m[0][j], a->m[1][j], a->m[2][j]);
  f.scale = vs_v3_length(c[0]);
  if (fabs(f.scale - 1) < 1e-14) f.scale = 1;
  double slack = 1e-13 * f.scale * f.scale;
  for (int j = 0; j < 3; j++) {
    if (fabs(vs_v3_dot(c[j], c[j]) - f.scale * f.scale) > slack || fabs(vs_v3_dot(c[j], c[(j + 1) % 3])) > slack) f.even = false;
    int used = (c[j].x != 0) + (c[j].y != 0) + (c[j].z != 0);
    if (used != 1) f.axes = false;
    if (used != 1 || !(a->m[j][j] > 0)) f.plain = false;
  }
  f.upright = f.even && f.plain;
  f.level = f.even && a->m[0][2] == 0 && a->m[1][2] == 0;
  if (!(fabs(vs_affine_determinant(a)) > 0)) f = (vs_fold_map){ 0 };
  return f;
}

static vs_node *vs_fold_points(vs_rewrite *w, const vs_affine *a, const vs_points *old, vs_points **new) {
  *new = vs_points_new(w->store, old->at, old->count);
  for (uint32_t i = 0; *new && i < old->count; i++) {
    vs_vec3 p = vs_affine_point(a, old->at[i]);
    (*new)->at[i] = vs_v3(p.x + 0.0, p.y + 0.0, p.z + 0.0);
  }
  return NULL;
}

static vs_node *vs_fold_polyface(vs_rewrite *w, const vs_affine *a, const struct vs_polyface_mesh *old) {
  struct vs_polyface_mesh new = *old;
  vs_points *points;
  vs_faces *faces = NULL;
  vs_node *n = NULL;
  vs_fold_points(w, a, old->points, &points);
  if (points && vs_affine_determinant(a) < 0) {
    faces = vs_faces_new(w->store, vs_faces_starts(old->faces), old->faces->count, vs_faces_corners(old->faces), old->faces->corner_count);
    for (uint32_t f = 0; faces && f < faces->count; f++) {
      uint32_t *corners = faces->data + faces->count + 1;
      for (uint32_t i = faces->data[f], j = faces->data[f + 1]; i + 1 < j; i++) {
        uint32_t swap = corners[i];
        corners[i] = corners[--j];
        corners[j] = swap;
      }
    }
    new.faces = faces;
  }
  new.points = points;
  if (points && new.faces) n = vs_node_new(w->store, VS_POLYFACE_MESH, &new, NULL, 0);
  vs_points_release(w->store, points);
  vs_faces_release(w->store, faces);
  return n;
}

/* The primitive n under a, or NULL with *fits false where that is no primitive of its kind. */
static vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits) {
  vs_fold_map f = vs_fold_look(a);
  *fits = false;
#define VS_FOLD(lower, condition)                       \
  struct vs_##lower d = *VS_AS(lower, n);               \
  if (!(condition)) return NULL;                        \
  *fits = true
  switch ((vs_kind)n->kind) {
    case VS_LINE: {
      VS_FOLD(line, f.scale > 0);
      vs_points *points;
      vs_fold_points(w, a, d.points, &points);
      d.points = points;
      vs_node *line = points ? vs_node_new(w->store, VS_LINE, &d, NULL, 0) : NULL;
      vs_points_release(w->store, points);
      return line;
    }
    case VS_CIRCLE: {
      VS_FOLD(circle, f.upright);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      return vs_node_new(w->store, VS_CIRCLE, &d, NULL, 0);
    }
    case VS_ARC: {
      VS_FOLD(arc, f.upright);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      return vs_node_new(w->store, VS_ARC, &d, NULL, 0);
    }
    case VS_BOX: {
      VS_FOLD(box, f.axes);
      vs_bounds b = vs_bounds_empty();
      vs_bounds_add(&b, vs_affine_point(a, d.p));
      vs_bounds_add(&b, vs_affine_point(a, d.q));
      d.p = b.min;
      d.q = b.max;
      return vs_node_new(w->store, VS_BOX, &d, NULL, 0);
    }
    case VS_WEDGE: {
      VS_FOLD(wedge, f.plain);
      d.p = vs_affine_point(a, d.p);
      d.q = vs_affine_point(a, d.q);
      return vs_node_new(w->store, VS_WEDGE, &d, NULL, 0);
    }
    case VS_SPHERE: {
      VS_FOLD(sphere, d.segments ? f.upright : f.even);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      return vs_node_new(w->store, VS_SPHERE, &d, NULL, 0);
    }
    case VS_CYLINDER: {
      VS_FOLD(cylinder, d.segments ? f.upright : f.even);
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.radius *= f.scale;
      return vs_node_new(w->store, VS_CYLINDER, &d, NULL, 0);
    }
    case VS_CONE: {
      VS_FOLD(cone, d.segments ? f.upright : f.even);
      d.base = vs_affine_point(a, d.base);
      d.apex = vs_affine_point(a, d.apex);
      d.radius *= f.scale;
      return vs_node_new(w->store, VS_CONE, &d, NULL, 0);
    }
    case VS_CUT_CONE: {
      VS_FOLD(cut_cone, d.segments ? f.upright : f.even);
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.base_radius *= f.scale;
      d.top_radius *= f.scale;
      return vs_node_new(w->store, VS_CUT_CONE, &d, NULL, 0);
    }
    case VS_E_CONE: {
      VS_FOLD(e_cone, f.upright);
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.base_radius *= f.scale;
      d.base_across *= f.scale;
      d.top_radius *= f.scale;
      return vs_node_new(w->store, VS_E_CONE, &d, NULL, 0);
    }
    case VS_PYRAMID: {
      VS_FOLD(pyramid, f.upright);
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.base_radius *= f.scale;
      d.top_radius *= f.scale;
      return vs_node_new(w->store, VS_PYRAMID, &d, NULL, 0);
    }
    case VS_TORUS: {
      VS_FOLD(torus, d.segments ? f.upright : f.level);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      d.tube_radius *= f.scale;
      return vs_node_new(w->store, VS_TORUS, &d, NULL, 0);
    }
    case VS_HALF_SPACE: {
      VS_FOLD(half_space, vs_affine_plane(a, &d.point, &d.normal));
      return vs_node_new(w->store, VS_HALF_SPACE, &d, NULL, 0);
    }
    case VS_POLYFACE_MESH:
      if (!(fabs(vs_affine_determinant(a)) > 0)) return NULL;
      *fits = true;
      return vs_fold_polyface(w, a, VS_AS(polyface_mesh, n));
    case VS_XLINE: {
      VS_FOLD(xline, f.scale > 0);
      d.p = vs_affine_point(a, d.p);
      d.q = vs_affine_point(a, d.q);
      return vs_node_new(w->store, VS_XLINE, &d, NULL, 0);
    }
    case VS_RAY: {
      VS_FOLD(ray, f.scale > 0);
      d.p = vs_affine_point(a, d.p);
      d.v = vs_affine_vector(a, d.v);
      return vs_node_new(w->store, VS_RAY, &d, NULL, 0);
    }
    case VS_EMPTY:
      *fits = true;
      return vs_node_new(w->store, VS_EMPTY, NULL, NULL, 0);
    case VS_JOIN: case VS_OFFSET: case VS_SECTION: case VS_PROJECT: case VS_EDGES:
    case VS_REVOLVE: case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: case VS_GRID_MESH: case VS_GRID_SURFACE:
    case VS_SUPERELLIPSOID: case VS_HEIGHT_FIELD: case VS_SLICE: case VS_HULL:
    case VS_SPLINE: case VS_REGION: case VS_TEXT: case VS_EXTRUDE: case VS_SWEEP: case VS_THICKEN: case VS_TRANSFORM: case VS_MATERIAL: case VS_LAYER:
    case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE: case VS_KIND_COUNT:
    case VS_NATIVE: case VS_CUSTOM: case VS_HIGHLIGHT: case VS_GHOST: case VS_ONLY: break;
  }
#undef VS_FOLD
  return NULL;
}

static bool vs_fold_is_identity(const vs_affine *a) {
  return vs_affine_is_translation(a) && a->m[0][3] == 0 && a->m[1][3] == 0 && a->m[2][3] == 0;
}

vs_node *vs_pass_fold(vs_rewrite *w, const vs_node *n, const vs_ref *kids, const vs_origin **origin) {
  if (n->kind != VS_TRANSFORM) return vs_rewrite_keep(w, n, kids);
  const vs_affine *a = &VS_AS(transform, n)->matrix;
  const vs_node *below = kids[0].node;
  bool lone = vs_rewrite_lone(w, n->children[0].node), fits = false;
  if (vs_fold_is_identity(a)) {
    w->changed++;
    *origin = kids[0].origin;
    return vs_node_retain(kids[0].node);
  }
  if (!lone) return vs_rewrite_keep(w, n, kids);
  if (below->kind == VS_TRANSFORM) {
    struct vs_transform both = { .matrix = vs_affine_multiply(a, &VS_AS(transform, below)->matrix) };
    w->changed++;
    if (vs_fold_is_identity(&both.matrix)) {
      *origin = below->children[0].origin;
      return vs_node_retain(below->children[0].node);
    }
    return vs_node_new(w->store, VS_TRANSFORM, &both, below->children, 1);
  }
  vs_node *folded = vs_fold_primitive(w, a, below, &fits);
  if (!fits) return vs_rewrite_keep(w, n, kids);
  w->changed++;
  *origin = kids[0].origin; /* messages speak of the call that made the primitive */
  return folded;
}
