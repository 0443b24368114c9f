/* Owns, for fold (carry.c), the primitives: what each becomes under a map.
 *
 * A kind is closed under some maps only: a box under those that keep axes, a round solid under those that keep circles, polyhedra and polylines
 * under all. Where the modeller gave the facets (segments) a turn would move their corners: then only shifts and even scales fold. */
#include <math.h>

#include "passes/rewrite.h"

typedef struct {
  bool even;    /* a similarity: every length times scale */
  bool upright; /* even, and no turn or mirror at all */
  bool axes;    /* a signed permutation of the axes, with any scales */
  bool plain;   /* axes kept each in its place and sense */
  bool level;   /* even, and Z stays vertical */
  bool about_z; /* level, right-handed, and Z up */
  double scale;
} vs_fold_map;

static vs_fold_map fold_look(const vs_affine *a) {
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
  f.about_z = f.level && a->m[2][2] > 0 && vs_affine_determinant(a) > 0;
  if (!(fabs(vs_affine_determinant(a)) > 0)) f = (vs_fold_map){ 0 };
  return f;
}

bool vs_fold_is_upright(const vs_affine *a) { return fold_look(a).upright; }

static vs_node *fold_points(vs_rewrite *w, const vs_affine *a, const vs_points *old, vs_points **new) {
  *new = vs_points_new(w->store, old->at, old->count);
  for (uint32_t i = 0; *new && i < old->count; i++) {
    vs_vec3 p = vs_affine_point(a, old->at[i]);
    (*new)->at[i] = vs_v3(p.x + 0.0, p.y + 0.0, p.z + 0.0);
  }
  return NULL;
}

static vs_node *fold_polyface(vs_rewrite *w, const vs_affine *a, const struct vs_polyface_mesh *old) {
  struct vs_polyface_mesh new = *old;
  vs_points *points;
  vs_faces *faces = NULL;
  vs_node *n = NULL;
  fold_points(w, a, old->points, &points);
  if (points && vs_affine_determinant(a) < 0) {
    faces = vs_faces_turned(w->store, old->faces);
    new.faces = faces;
  }
  new.points = points;
  if (points && new.faces) n = vs_node_new(w->store, VS_POLYFACE_MESH, &new, NULL, 0);
  vs_points_release(w->store, points);
  vs_faces_release(w->store, faces);
  return n;
}

/* Does a keep discs across the axis discs across its image? *k: by how much it makes them larger. */
static bool fold_discs(const vs_affine *a, vs_vec3 axis, double *k) {
  vs_vec3 u = vs_v3_unit(axis), p = vs_v3_unit(vs_v3_cross(u, fabs(u.x) < 0.7 ? vs_v3(1, 0, 0) : vs_v3(0, 1, 0))), q = vs_v3_cross(u, p);
  vs_vec3 au = vs_affine_vector(a, u), ap = vs_affine_vector(a, p), aq = vs_affine_vector(a, q);
  double square = vs_v3_dot(ap, ap), slack = 1e-13 * square, along = 1e-13 * sqrt(square) * vs_v3_length(au);
  *k = sqrt(square);
  if (fabs(*k - 1) < 1e-14) *k = 1;
  return square > 0 && vs_v3_dot(au, au) > 0 && fabs(vs_v3_dot(aq, aq) - square) <= slack && fabs(vs_v3_dot(ap, aq)) <= slack && fabs(vs_v3_dot(ap, au)) <= along &&
         fabs(vs_v3_dot(aq, au)) <= along;
}

vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits) {
  vs_fold_map f = fold_look(a);
  double k = f.scale; /* of discs */
  *fits = false;
#define VS_FOLD(lower, condition)                       \
  struct vs_##lower d = *VS_AS(lower, n);               \
  if (!(condition)) return NULL;                        \
  *fits = true
  switch ((vs_kind)n->kind) {
    case VS_LINE: {
      VS_FOLD(line, f.scale > 0);
      vs_points *points;
      fold_points(w, a, d.points, &points);
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
      VS_FOLD(arc, d.segments ? f.upright : f.upright || f.about_z);
      double turn = f.upright ? 0 : atan2(a->m[1][0], a->m[0][0]);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      d.start += turn;
      d.end += turn;
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
      VS_FOLD(cylinder, d.segments ? f.upright : f.even || fold_discs(a, vs_v3_sub(d.top, d.base), &k));
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.radius *= k;
      return vs_node_new(w->store, VS_CYLINDER, &d, NULL, 0);
    }
    case VS_CONE: {
      VS_FOLD(cone, d.segments ? f.upright : f.even || fold_discs(a, vs_v3_sub(d.apex, d.base), &k));
      d.base = vs_affine_point(a, d.base);
      d.apex = vs_affine_point(a, d.apex);
      d.radius *= k;
      return vs_node_new(w->store, VS_CONE, &d, NULL, 0);
    }
    case VS_CUT_CONE: {
      VS_FOLD(cut_cone, d.segments ? f.upright : f.even || fold_discs(a, vs_v3_sub(d.top, d.base), &k));
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.base_radius *= k;
      d.top_radius *= k;
      return vs_node_new(w->store, VS_CUT_CONE, &d, NULL, 0);
    }
    case VS_E_CONE: {
      struct vs_e_cone d = *VS_AS(e_cone, n);
      bool stands = d.top.x == d.base.x && d.top.y == d.base.y && d.top.z > d.base.z; /* its ellipse lies along X and Y */
      *fits = f.upright || (f.plain && stands);
      if (!*fits) return NULL;
      d.base = vs_affine_point(a, d.base);
      d.top = vs_affine_point(a, d.top);
      d.base_radius *= a->m[0][0];
      d.base_across *= a->m[1][1];
      d.top_radius *= a->m[0][0];
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
      return fold_polyface(w, a, VS_AS(polyface_mesh, n));
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
    case VS_SPLINE: { /* its parameter is the length of chords: similar points, similar curve */
      VS_FOLD(spline, f.even);
      vs_points *points;
      fold_points(w, a, d.points, &points);
      d.points = points;
      d.start_tangent = vs_affine_vector(a, d.start_tangent);
      d.end_tangent = vs_affine_vector(a, d.end_tangent);
      vs_node *spline = points ? vs_node_new(w->store, VS_SPLINE, &d, NULL, 0) : NULL;
      vs_points_release(w->store, points);
      return spline;
    }
    case VS_SUPERELLIPSOID: { /* it knows no other place than the origin */
      VS_FOLD(superellipsoid, f.upright && a->m[0][3] == 0 && a->m[1][3] == 0 && a->m[2][3] == 0);
      d.size *= f.scale;
      return vs_node_new(w->store, VS_SUPERELLIPSOID, &d, NULL, 0);
    }
    case VS_HEIGHT_FIELD: {
      VS_FOLD(height_field, f.plain);
      vs_points *points;
      fold_points(w, a, d.points, &points);
      d.points = points;
      d.low = a->m[2][2] * d.low + a->m[2][3];
      vs_node *field = points ? vs_node_new(w->store, VS_HEIGHT_FIELD, &d, NULL, 0) : NULL;
      vs_points_release(w->store, points);
      return field;
    }
    case VS_EMPTY:
      *fits = true;
      return vs_node_new(w->store, VS_EMPTY, NULL, NULL, 0);
    case VS_JOIN: case VS_OFFSET: case VS_SECTION: case VS_PROJECT: case VS_EDGES:
    case VS_REVOLVE: case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: case VS_GRID_MESH: case VS_GRID_SURFACE:
    case VS_SLICE: case VS_DEFORM: case VS_HULL:
    case VS_REGION: case VS_TEXT: case VS_EXTRUDE: case VS_SWEEP: case VS_THICKEN: case VS_TRANSFORM: case VS_MATERIAL: case VS_LAYER:
    case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE: case VS_KIND_COUNT:
    case VS_NATIVE: case VS_CUSTOM: case VS_HIGHLIGHT: case VS_GHOST: case VS_ONLY: break;
  }
#undef VS_FOLD
  return NULL;
}
