/* Computes the image of a primitive under an affine map, for the pass fold (fold.c).
 *
 * For some maps, the image is a primitive of the same kind. Such maps keep the axes for a box, and keep circles for a
 * round solid. Polyhedra and polylines allow all maps. If the program set the number of facets (segments), a rotation
 * would move their corners. In this case only translations and uniform scales are folded. */
#include "passes/moved_primitives.h"

#include <math.h>

#include "geometry/primitives/shape.h"
#include "passes/rewrite.h"

bool vs_fold_is_upright(const vs_affine *a) { return vs_shape_map_of(a).upright; }

static vs_node *fold_polyface(vs_rewrite *w, const vs_affine *a, const struct vs_polyface_mesh *old) {
  struct vs_polyface_mesh new = *old;
  vs_points *points = vs_shape_map_points(w->store, a, old->points);
  vs_faces *faces = NULL;
  vs_node *n = NULL;
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

vs_node *vs_fold_primitive(vs_rewrite *w, const vs_affine *a, const vs_node *n, bool *fits) {
  vs_shape_map f = vs_shape_map_of(a);
  *fits = false;
  switch ((vs_kind)n->kind) {
    case VS_LINE: {
      VS_MOVED(line, f.scale > 0);
      vs_points *points = vs_shape_map_points(w->store, a, d.points);
      d.points = points;
      vs_node *line = points ? vs_node_new(w->store, VS_LINE, &d, NULL, 0) : NULL;
      vs_points_release(w->store, points);
      return line;
    }
    case VS_CIRCLE: {
      VS_MOVED(circle, f.upright);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      return vs_node_new(w->store, VS_CIRCLE, &d, NULL, 0);
    }
    case VS_ARC: {
      VS_MOVED(arc, d.segments ? f.upright : f.upright || f.about_z);
      double turn = f.upright ? 0 : atan2(a->m[1][0], a->m[0][0]);
      d.center = vs_affine_point(a, d.center);
      d.radius *= f.scale;
      d.start += turn;
      d.end += turn;
      return vs_node_new(w->store, VS_ARC, &d, NULL, 0);
    }
#include "model/cases/shape_cases.def"
      return vs_shape_of(n)->moved(w->store, n, a, &f, fits);
    case VS_POLYFACE_MESH:
      if (!(fabs(vs_affine_determinant(a)) > 0)) return NULL;
      *fits = true;
      return fold_polyface(w, a, VS_AS(polyface_mesh, n));
    case VS_XLINE: {
      VS_MOVED(xline, f.scale > 0);
      d.p = vs_affine_point(a, d.p);
      d.q = vs_affine_point(a, d.q);
      return vs_node_new(w->store, VS_XLINE, &d, NULL, 0);
    }
    case VS_RAY: {
      VS_MOVED(ray, f.scale > 0);
      d.p = vs_affine_point(a, d.p);
      d.v = vs_affine_vector(a, d.v);
      return vs_node_new(w->store, VS_RAY, &d, NULL, 0);
    }
    case VS_SPLINE: { /* The parameter of a spline is the length of the chords between its points. Therefore points
                       * mapped by a similarity give the mapped curve. */
      VS_MOVED(spline, f.even);
      vs_points *points = vs_shape_map_points(w->store, a, d.points);
      d.points = points;
      d.start_tangent = vs_affine_vector(a, d.start_tangent);
      d.end_tangent = vs_affine_vector(a, d.end_tangent);
      vs_node *spline = points ? vs_node_new(w->store, VS_SPLINE, &d, NULL, 0) : NULL;
      vs_points_release(w->store, points);
      return spline;
    }
    case VS_EMPTY:
      *fits = true;
      return vs_node_new(w->store, VS_EMPTY, NULL, NULL, 0);
    case VS_JOIN: case VS_OFFSET: case VS_SECTION: case VS_PROJECT: case VS_EDGES:
    case VS_REVOLVE: case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: case VS_GRID_MESH: case VS_GRID_SURFACE:
    case VS_SLICE: case VS_DEFORM: case VS_HULL:
    case VS_REGION:
    case VS_TEXT:
    case VS_EXTRUDE:
    case VS_SWEEP:
    case VS_THICKEN:
    case VS_TRANSFORM:
    case VS_MATERIAL:
    case VS_LAYER:
    case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE: case VS_KIND_COUNT:
    case VS_NATIVE: case VS_CUSTOM: case VS_PART: case VS_HIGHLIGHT: case VS_GHOST: case VS_ONLY: break;
  }
  return NULL;
}
