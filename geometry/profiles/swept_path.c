/* Computes the stations of a sweep: the points of its path at which it has sections.
 *
 * A stretch between two stations that turns by the angle d deviates from its chord by 1 - cos(d/2) times the radius. On
 * the outer side of a bend this radius is that of the path plus the extent of the profile. The path is sampled at half
 * the tolerance, which is fine enough for each profile whose extent is at most the radius of the bend. Two sweeps along
 * one path thus have equal stations. For a larger profile, a stretch is divided into 2, 4, 8 ... parts. The new points
 * lie on the cubic curve with the stretch's ends and directions. */
#include "geometry/profiles/swept_path.h"

#include <math.h>

#include "model/walk.h"

static vs_vec3 between(vs_vec3 a, vs_vec3 b, double t) {
  return vs_v3_add(vs_v3_scale(a, 1 - t), vs_v3_scale(b, t));
}

static double angle_of(vs_vec3 a, vs_vec3 b) { return atan2(vs_v3_length(vs_v3_cross(a, b)), vs_v3_dot(a, b)); }

/* Returns the direction at the fraction t of an even rotation from direction a to direction b. d: angle between a and
 * b, in radians. */
static vs_vec3 turned(vs_vec3 a, vs_vec3 b, double d, double t) {
  if (d < 1e-6) return vs_v3_unit(between(a, b, t));
  return vs_v3_unit(vs_v3_add(vs_v3_scale(a, sin((1 - t) * d)), vs_v3_scale(b, sin(t * d))));
}

/* Returns the number of parts, a power of two, into which the path between the samples p and q is divided. reach:
 * greatest distance of the profile from the path. */
static size_t parts_of(const vs_path_point *p, const vs_path_point *q, double tolerance, double reach) {
  enum { MOST = 256 };
  double d = angle_of(p->leaving, q->arriving), chord = vs_v3_length(vs_v3_sub(q->at, p->at)),
         radius = reach + (d > 1e-9 ? chord / 2 / sin(d / 2) : 0);
  size_t n = 1;
  while (n < MOST && radius * (1 - cos(d / 2 / (double)n)) > 1.01 * tolerance) n *= 2;
  return n;
}

/* Adds the points between p and q that divide the path into n parts. The cubic curve on which they lie differs from the
 * arc of a circle by at most a millionth of the arc's radius. */
static bool cut(const vs_path_point *p, const vs_path_point *q, size_t n, vs_path *out) {
  double d = angle_of(p->leaving, q->arriving), half = cos(d / 4),
         handle = vs_v3_length(vs_v3_sub(q->at, p->at)) / (3 * half * half);
  vs_vec3 b = vs_v3_add(p->at, vs_v3_scale(p->leaving, handle)),
          c = vs_v3_sub(q->at, vs_v3_scale(q->arriving, handle));
  bool ok = true;
  for (size_t k = 1; ok && k < n; k++) {
    double t = (double)k / (double)n;
    vs_vec3 pb = between(p->at, b, t), bc = between(b, c, t), cq = between(c, q->at, t),
            way = turned(p->leaving, q->arriving, d, t);
    ok = vs_path_add(out, between(between(pb, bc, t), between(bc, cq, t), t), way, way);
  }
  return ok;
}

/* Sets *chosen to true if some part of the curve sets its own number of segments. Returns false when memory is out. */
static bool has_segments(const vs_node *curve, bool *chosen) {
  vs_walk *w = vs_walk_new(curve->store, (vs_ref){ (vs_node *)(uintptr_t)curve, NULL });
  vs_walk_event event = w ? VS_WALK_ENTER : VS_WALK_FAILED;
  vs_ref at;
  size_t depth;
  *chosen = false;
  while (!*chosen && event != VS_WALK_FAILED && (event = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE) {
    if (event != VS_WALK_ENTER) continue;
    const vs_node *n = at.node;
    *chosen = (n->kind == VS_ARC && VS_AS(arc, n)->segments > 0) ||
              (n->kind == VS_CIRCLE && VS_AS(circle, n)->segments > 0) ||
              (n->kind == VS_SPLINE && VS_AS(spline, n)->segments > 0) ||
              (n->kind == VS_OFFSET && VS_AS(offset, n)->segments > 0);
  }
  vs_walk_free(w);
  return event != VS_WALK_FAILED;
}

bool vs_swept_path(const vs_node *curve, const vs_fineness *f, double reach, vs_path *path, vs_error *e) {
  vs_affine identity = vs_affine_identity();
  vs_fineness half = { f->tolerance / 2, f->segments };
  vs_path fine = { 0 };
  if (!vs_curve_path(curve, &identity, &half, path, e)) return false;
  bool chosen = f->segments > 0, ok = chosen || has_segments(curve, &chosen);
  if (ok && chosen) return true;
  for (size_t i = 0; ok && i < path->count; i++) {
    const vs_path_point *p = &path->at[i], *q = &path->at[i + 1 < path->count ? i + 1 : 0];
    ok = vs_path_add(&fine, p->at, p->arriving, p->leaving);
    if (ok && (path->closed || i + 1 < path->count)) ok = cut(p, q, parts_of(p, q, f->tolerance, reach), &fine);
  }
  fine.closed = path->closed;
  vs_path_measure(&fine);
  vs_path_free(path);
  *path = fine;
  return ok || vs_error_memory(e, NULL);
}
