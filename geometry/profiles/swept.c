/* Implements the common part of extrude, sweep and thicken: a planar profile is moved through sections. swept_mesh.c
 * makes the triangles between the sections.
 *
 * A section is an affine map of the profile's plane. At a corner of a path, it lies in the mitre plane with the normal
 * m = a + b, where a is the arriving direction and b the leaving direction. A vector d of the profile across b becomes
 * d - b (d.m)/(b.m), so that both arms of the corner keep the true width of the profile. On smooth paths, a = b, and
 * sections are perpendicular to the path. A section with scale 0 is an apex. Corners sharper than about 174 degrees are
 * not mitred, because the mitre would be longer than twenty profiles. There, a piece ends perpendicular to the path,
 * and another piece begins. An extrusion whose curve turns back is also divided into pieces, which are separate solids
 * that overlap. */
#include "geometry/profiles/swept.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdlib.h>

#include "geometry/plane/curve.h"
#include "geometry/profiles/overturn.h"
#include "geometry/profiles/revolve.h"
#include "geometry/profiles/swept_mesh.h"
#include "geometry/profiles/swept_path.h"
#include "geometry/profiles/swept_steps.h"
#include "model/store/array.h"

static const double full_turn = 6.28318530717958647693;

void vs_swept_free(vs_swept *s) {
  free(s->profile);
  free(s->sizes);
  free(s->hole);
  free(s->sections);
  free(s->seam);
  free(s->stride);
  *s = (vs_swept){ 0 };
}

static bool swept_add(vs_swept *s, vs_section section) {
  if (!VS_GROW(s->sections, s->section_room, s->section_count + 1)) return false;
  s->sections[s->section_count++] = section;
  return true;
}

vs_section vs_section_between(const vs_section *a, const vs_section *b, double t) {
  double k = 1 - t;
  return (vs_section){ vs_v3_add(vs_v3_scale(a->x, k), vs_v3_scale(b->x, t)),
                       vs_v3_add(vs_v3_scale(a->y, k), vs_v3_scale(b->y, t)),
                       vs_v3_add(vs_v3_scale(a->at, k), vs_v3_scale(b->at, t)), false };
}

/* ---- profiles ---- */

typedef struct {
  vs_vec3 x, y, normal, origin;
  vs_vec2 base;
  double reach; /* greatest distance of the profile's points from `base`, the point of the profile that moves on the
                 * path */
} vs_profile_plane;

static vs_vec2 profile_flat(const vs_profile_plane *p, vs_vec3 at) {
  vs_vec3 d = vs_v3_sub(at, p->origin);
  return (vs_vec2){ vs_v3_dot(d, p->x), vs_v3_dot(d, p->y) };
}

static bool swept_room(vs_swept *s, size_t points, size_t loops) {
  s->profile = malloc((points ? points : 1) * sizeof *s->profile); /* at least one element, even for an empty region,
                                                                    * because an allocation of 0 bytes might return
                                                                    * NULL */
  s->sizes = malloc((loops ? loops : 1) * sizeof *s->sizes);
  s->hole = malloc((loops ? loops : 1) * sizeof *s->hole);
  return s->profile && s->sizes && s->hole;
}

static bool swept_profile(vs_swept *s, const vs_node *profile, const vs_fineness *f, const vs_vec3 *base,
                          vs_profile_plane *plane, vs_error *e) {
  vs_outline o;
  if (!vs_region_outline(profile, f, &o, e)) return false;
  size_t points = 0;
  for (size_t l = 0; l < o.count; l++) points += o.loops[l].count;
  bool ok = swept_room(s, points, o.count) || vs_error_memory(e, NULL);
  if (ok) {
    vs_vec3 centroid;
    vs_outline_measure(&o, &centroid);
    double (*m)[4] = o.frame.m;
    *plane = (vs_profile_plane){
      { m[0][0], m[1][0], m[2][0] }, { m[0][1], m[1][1], m[2][1] }, o.normal, { m[0][3], m[1][3], m[2][3] }, { 0, 0 }, 0
    };
    plane->base = profile_flat(plane, base ? *base : centroid);
    s->filled = !o.count || o.loops[0].closed;
    for (size_t l = 0; l < o.count; l++) {
      s->sizes[l] = o.loops[l].count;
      s->hole[l] = o.hole[l];
      for (size_t i = 0; i < o.loops[l].count; i++) {
        vs_vec2 p = profile_flat(plane, o.loops[l].at[i]);
        s->profile[s->profile_count++] = p;
        plane->reach = fmax(plane->reach, hypot(p.x - plane->base.x, p.y - plane->base.y));
      }
    }
    s->loop_count = o.count;
  }
  vs_outline_free(&o);
  return ok;
}

static bool swept_disc(vs_swept *s, double radius, int n) {
  if (!swept_room(s, (size_t)n, 1)) return false;
  for (int i = 0; i < n; i++) {
    double sine, cosine;
    vs_turn_sincos(i, n, &sine, &cosine);
    s->profile[i] = (vs_vec2){ radius * cosine, radius * sine };
  }
  s->profile_count = s->sizes[0] = (size_t)n;
  s->hole[0] = false;
  s->loop_count = 1;
  s->filled = true;
  return true;
}

/* ---- sections along a path ---- */

/* Returns the number of steps, at least 1, for a part of the path that is the fraction `share` of its length. */
static size_t swept_share(size_t steps, double share) {
  double n = ceil((double)steps * share - 1e-9);
  return n < 1 ? 1 : (size_t)n;
}

static bool swept_turns_back(const vs_path_point *p) { return 1 + vs_v3_dot(p->arriving, p->leaving) <= 0.005; }

/* Returns the vector (lean) by which a section at a corner of the path is inclined. way: one of the two directions at
 * the corner. Each point of the profile moves backwards along `way` by its component along the lean. */
static vs_vec3 swept_lean(const vs_path_point *p, vs_vec3 way) {
  vs_vec3 m = vs_v3_add(p->arriving, p->leaving);
  if (vs_v3_equal(p->arriving, p->leaving) || swept_turns_back(p)) return vs_v3(0, 0, 0);
  return vs_v3_sub(vs_v3_scale(m, 1 / vs_v3_dot(way, m)), way);
}

/* The leans (inclination vectors) between two points of a path: a at its beginning, b at its end. They decrease to 0
 * within the shares `from` and `to` of the distance. Thus sections near a corner do not pass the mitre on its inner
 * side. */
typedef struct { vs_vec3 a, b; double length, from, to; } swept_leans;

static swept_leans swept_leans_of(const vs_path_point *p, const vs_path_point *q, double reach) {
  double length = vs_v3_length(vs_v3_sub(q->at, p->at));
  swept_leans l = { swept_lean(p, p->leaving), swept_lean(q, q->arriving), length, 0, 0 };
  l.from = 2 * reach * vs_v3_length(l.a) / l.length;
  l.to = 2 * reach * vs_v3_length(l.b) / l.length;
  if (l.from + l.to > 1) l.from = l.to = 1;
  return l;
}

/* Returns the lean of the section at the fraction t, 0 < t < 1. */
static vs_vec3 swept_lean_at(const swept_leans *l, double t) {
  return vs_v3_add(vs_v3_scale(l->a, t < l->from ? 1 - t / l->from : 0),
                   vs_v3_scale(l->b, 1 - t < l->to ? 1 - (1 - t) / l->to : 0));
}

/* Returns the section at point p of the path. `x`: first direction of the profile before it is turned by `angle` and
 * inclined by `lean`; its second direction is perpendicular to x and to the path. */
static vs_section swept_section(const vs_path_point *p, vs_vec3 lean, vs_vec3 x, double angle, double scale,
                                vs_vec2 base) {
  double sine, cosine;
  vs_sincos(angle, &sine, &cosine);
  vs_vec3 b = p->leaving, y = vs_v3_cross(b, x);
  vs_vec3 u = vs_v3_scale(vs_v3_add(vs_v3_scale(x, cosine), vs_v3_scale(y, sine)), scale);
  vs_vec3 v = vs_v3_scale(vs_v3_add(vs_v3_scale(y, cosine), vs_v3_scale(x, -sine)), scale);
  u = vs_v3_sub(u, vs_v3_scale(b, vs_v3_dot(u, lean)));
  v = vs_v3_sub(v, vs_v3_scale(b, vs_v3_dot(v, lean)));
  vs_vec3 at = vs_v3_sub(p->at, vs_v3_add(vs_v3_scale(u, base.x), vs_v3_scale(v, base.y)));
  return (vs_section){ u, v, at, false };
}

/* Tests whether the profile coincides with itself if it is turned by `angle` about base, as a square does after a
 * quarter turn. If so, sets s->seam[i] to the point to which point i moves. Returns false when memory is out. */
static bool swept_seam(vs_swept *s, vs_vec2 base, double angle, double reach) {
  size_t *seam = malloc(s->profile_count * sizeof *seam);
  double sine, cosine, near = 1e-9 * reach;
  bool whole = seam != NULL;
  vs_sincos(angle, &sine, &cosine);
  for (size_t l = 0, first = 0; whole && l < s->loop_count; first += s->sizes[l], l++) {
    bool found = false;
    for (size_t k = 0, other = 0; !found && k < s->loop_count; other += s->sizes[k], k++) {
      if (s->sizes[k] != s->sizes[l] || s->hole[k] != s->hole[l]) continue;
      for (size_t shift = 0; !found && shift < s->sizes[l]; shift++) {
        found = true;
        for (size_t i = 0; found && i < s->sizes[l]; i++) {
          vs_vec2 p = s->profile[first + i], q = s->profile[other + (i + shift) % s->sizes[l]];
          double x = p.x - base.x, y = p.y - base.y;
          found = hypot(base.x + x * cosine - y * sine - q.x, base.y + x * sine + y * cosine - q.y) <= near;
          if (found) seam[first + i] = other + (i + shift) % s->sizes[l];
        }
      }
    }
    whole = found;
  }
  bool ok = seam != NULL;
  if (whole) s->seam = seam;
  else free(seam);
  return ok;
}

/* How a profile is kept upright along a path. up: the upward direction in space; side: unit vector in the profile's
 * coordinates that is to point upwards as far as the path allows. */
typedef struct {
  vs_vec3 up;
  vs_vec2 side;
} vs_upright;

/* Returns how the profile is kept upright. Its upper side is where `up` points in the profile's plane, as the profile
 * is drawn; if `up` is perpendicular to this plane, it is the plane's Y direction. */
static vs_upright swept_upright(const vs_profile_plane *plane, vs_vec3 up) {
  up = vs_v3_unit(up);
  bool flat = fabs(vs_v3_dot(up, plane->normal)) > 1 - 1e-9;
  vs_vec3 d = !flat ? up : fabs(plane->normal.y) < 1 - 1e-9 ? vs_v3(0, 1, 0) : vs_v3(1, 0, 0);
  double x = vs_v3_dot(d, plane->x), y = vs_v3_dot(d, plane->y), length = hypot(x, y);
  return (vs_upright){ up, { x / length, y / length } };
}

/* Returns the first direction of the upright profile where the path has the direction `way`; the zero vector if `way`
 * is parallel to `up`. */
static vs_vec3 swept_stood(const vs_upright *u, vs_vec3 way) {
  vs_vec3 up = vs_v3_sub(u->up, vs_v3_scale(way, vs_v3_dot(u->up, way)));
  if (vs_v3_length(up) < 1e-6) return vs_v3(0, 0, 0);
  up = vs_v3_unit(up);
  return vs_v3_add(vs_v3_scale(up, u->side.x), vs_v3_scale(vs_v3_cross(up, way), u->side.y));
}

/* Sets x[i] to the first direction of the upright profile at point i of the path. Returns false if the path is parallel
 * to `up` at some point; e then states this point. */
static bool swept_stand(const vs_upright *u, const vs_path *path, vs_vec3 *x, vs_error *e) {
  for (size_t i = 0; i < path->count; i++) {
    vs_vec3 at = path->at[i].at;
    x[i] = swept_stood(u, path->at[i].leaving);
    if (vs_v3_equal(x[i], vs_v3(0, 0, 0)))
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "do-sweep: the path runs along #:up at (xyz %.6g %.6g %.6g); choose another #:up",
                          at.x, at.y, at.z);
  }
  return true;
}

/* Returns the angle in radians by which an upright profile must turn before a corner of the path, because the mitre
 * plane of the corner mirrors the profile. */
static double swept_spin(const vs_upright *u, const vs_path_point *corner) {
  if (vs_v3_equal(corner->arriving, corner->leaving) || swept_turns_back(corner)) return 0;
  vs_vec3 a = corner->arriving, m = vs_v3_add(a, corner->leaving), before = swept_stood(u, a),
          x = swept_stood(u, corner->leaving);
  x = vs_v3_sub(x, vs_v3_scale(m, 2 * vs_v3_dot(x, m) / vs_v3_dot(m, m)));
  return atan2(vs_v3_dot(a, vs_v3_cross(before, x)), vs_v3_dot(before, x));
}

/* How the profile is placed at a point of the path, relative to the moving frame. The inclination of its section is
 * `lean`, the angle in radians by which it is turned is `spin`. It arrives at the next point with `next_spin`. */
typedef struct { vs_vec3 lean; double spin, next_spin; } swept_stance;

/* How a profile moves along a path. */
typedef struct {
  vs_vec3 x;                 /* first direction (X) of the profile at the start of the path, a unit vector in space; not
                              * used if `upright` is set */
  const vs_upright *upright; /* if not NULL: the profile is kept upright along the entire path, in this way */
  double twist, scale;       /* twist: rotation of the profile at the end of the path, in radians; scale: its scale
                              * there */
  vs_vec2 base;              /* point of the profile that moves on the path, in the profile's coordinates */
  double reach;              /* greatest distance of the profile's points from `base` */
} swept_way;

/* A stretch, which is the part of a path between two of its points: the number of its coarse steps, and the angle by
 * which an upright profile turns until the corner at its end. */
typedef struct { size_t steps; double spin; } swept_stretch;

/* Returns stretch i of a path, from its point i to the next point, for a profile that turns by `twist` radians along
 * the whole path. *step: rotation in radians in each coarse step of the stretch. */
static swept_stretch swept_stretch_of(const vs_path *path, size_t i, const vs_upright *upright, double twist,
                                      const vs_fineness *f, double *step) {
  const vs_path_point *p = &path->at[i], *q = &path->at[i + 1 < path->count ? i + 1 : 0];
  double share = vs_v3_length(vs_v3_sub(q->at, p->at)) / path->length, spin = upright ? swept_spin(upright, q) : 0,
         angle = fabs(twist) * share + fabs(spin);
  size_t steps = swept_share(vs_twist_coarse(f, twist), share);
  if (spin != 0 && steps < vs_twist_coarse(f, angle)) steps = vs_twist_coarse(f, angle);
  *step = angle / (double)steps;
  return (swept_stretch){ steps, spin };
}

/* Returns the number of coarse steps in the first `stretches` stretches of a path. *step: greatest rotation in radians
 * in one of them, 0 without a stretch. */
static size_t swept_steps(const vs_path *path, size_t stretches, const vs_upright *upright, double twist,
                          const vs_fineness *f, double *step) {
  size_t count = 0;
  *step = 0;
  for (size_t i = 0; i < stretches; i++) {
    double angle;
    count += swept_stretch_of(path, i, upright, twist, f, &angle).steps;
    *step = fmax(*step, angle);
  }
  return count;
}

/* Returns vs_twist.lean for the first `stretches` stretches of a path. reach: as for swept_leans_of; twist: in
 * radians. */
static double swept_lean_change(const vs_path *path, size_t stretches, const swept_way *way, double twist, double reach,
                                const vs_fineness *f) {
  double most = 0;
  for (size_t i = 0; i < stretches; i++) {
    double angle;
    size_t steps = swept_stretch_of(path, i, way->upright, twist, f, &angle).steps;
    swept_leans l = swept_leans_of(&path->at[i], &path->at[i + 1 < path->count ? i + 1 : 0], reach);
    double a = vs_v3_length(l.a), b = vs_v3_length(l.b), step = 1 / (double)steps,
           change = l.from == 1 && l.to == 1 ? vs_v3_length(vs_v3_sub(l.a, l.b))
                                             : fmax(a / fmax(l.from, step), b / fmax(l.to, step));
    if (l.length > 0) most = fmax(most, (2 * change + fmax(a, b) * angle / step) / l.length);
  }
  return most;
}

/* Returns how often each of the `count` coarse steps must be halved for the tolerance; less often if there would be too
 * many points. */
static int swept_halvings(const vs_swept *s, const vs_twist *turning, size_t count, const vs_fineness *f) {
  int n = vs_twist_halvings(f, turning->step, vs_twist_reach(turning, turning->reach));
  while (n > 0 && ldexp((double)count * (double)s->profile_count, n) > VS_SWEPT_POINTS_MOST) n--;
  return n;
}

/* The points of a path with the positions of the profile there. */
typedef struct {
  const vs_path *path;
  const vs_vec3 *carried;      /* first direction of the profile at each point, where the path leaves it */
  const swept_stance *stance;
  const swept_way *way;
} swept_points;

/* Adds `count` sections between point i of the path and the next, at equal distances. They depend on these two points
 * alone. Returns false when memory is out. */
static bool swept_between(vs_swept *s, const swept_points *on, size_t i, size_t count) {
  if (!count) return true;
  size_t next = i + 1 < on->path->count ? i + 1 : 0;
  const vs_path_point *a = &on->path->at[i], *b = &on->path->at[next];
  const swept_way *way = on->way;
  bool corner = !vs_v3_equal(b->arriving, b->leaving), back = corner && swept_turns_back(b), ok = true;
  vs_affine turn = vs_frame_turn(b->leaving, b->arriving);
  vs_vec3 x = back ? on->carried[i] : corner ? vs_affine_vector(&turn, on->carried[next]) : on->carried[next],
          lean = corner ? swept_lean(b, b->arriving) : on->stance[next].lean;
  double from = a->along / on->path->length, to = next ? b->along / on->path->length : 1;
  for (size_t k = 1; ok && k <= count; k++) {
    double t = (double)k / (double)(count + 1), part = from + (to - from) * t,
           spin = on->stance[i].spin * (1 - t) + on->stance[i].next_spin * t;
    vs_vec3 d = vs_v3_unit(vs_v3_add(vs_v3_scale(a->leaving, 1 - t), vs_v3_scale(b->arriving, t))),
            across = vs_v3_add(vs_v3_scale(on->carried[i], 1 - t), vs_v3_scale(x, t));
    across = way->upright ? swept_stood(way->upright, d)
                          : vs_v3_unit(vs_v3_sub(across, vs_v3_scale(d, vs_v3_dot(across, d))));
    vs_path_point p = { vs_v3_add(vs_v3_scale(a->at, 1 - t), vs_v3_scale(b->at, t)), d, d, 0 };
    ok = swept_add(s, swept_section(&p, vs_v3_add(vs_v3_scale(on->stance[i].lean, 1 - t), vs_v3_scale(lean, t)), across,
                                    way->twist * part + spin, 1 + (way->scale - 1) * part, way->base));
  }
  return ok;
}

/* Sets *closing to the angle, in radians, by which a profile must turn evenly along a closed path so that its end
 * coincides with its start. x: first direction of the profile at the start. Returns false when memory is out. */
static bool swept_closing(const vs_path *path, vs_vec3 x, double *closing) {
  vs_vec3 *carried = vs_fresh(path->count, sizeof *carried);
  if (carried) *closing = -vs_frame_transport(path->at, path->count, true, path->length, x, carried);
  free(carried);
  if (fabs(*closing) < 1e-9) *closing = 0; /* an angle below 1e-9 radians is only a rounding error */
  return carried != NULL;
}

/* Divides the walls between the sections as the tolerance requires; or only sets s->dense, if all points must become
 * vertices of all sections. bends: true if walls may be curved without a twist. Returns false when memory is out. */
static bool swept_walls(vs_swept *s, const vs_twist *turning, int halvings, bool bends, const vs_fineness *f) {
  bool shared = !s->dense && !s->seam, ok = true; /* shared: whether each wall depends on its edge alone */
  bool strides = shared && turning->scale > 0;
  if (shared && s->filled && (bends || turning->step > 0)) {
    ok = vs_swept_turns(s, &s->dense);
    if (s->dense) return ok;
  }
  for (size_t i = 0; strides && i < s->section_count; i++) strides = !s->sections[i].ends;
  if (ok && strides) ok = vs_twist_strides(s, turning, halvings, f);
  if (ok && bends) ok = shared ? vs_swept_flatten_edges(s, f) : vs_swept_flatten_steps(s, f);
  if (ok && strides) ok = vs_twist_strides(s, turning, halvings, f); /* repeated, because the edges may have been
                                                                      * divided, so that the profile has more points */
  return ok && (!s->filled || vs_overturn_refine(s, NULL, f->tolerance));
}

/* Makes the sections along a path; this function may change the path's points, and divides the path for a twist.
 * Returns false and sets e on failure. */
static bool swept_along(vs_swept *s, vs_path *path, const swept_way *way, const vs_fineness *f, vs_error *e) {
  const vs_upright *upright = way->upright;
  double twist = way->twist, scale = way->scale, reach = way->reach;
  vs_vec2 base = way->base;
  vs_path fine = { 0 };
  vs_vec3 *carried = NULL;
  swept_stance *stance = NULL; /* stance[i]: how the profile is placed at point i of the path `fine` */
  size_t stances = 0;
  bool ok = true;
  double zone = vs_twist_lean_reach(path->length, reach * fmax(1, fabs(scale))), closing = 0,
         rest = twist - full_turn * nearbyint(twist / full_turn);
  bool meets = path->closed && scale == 1, joins = meets && fabs(rest) < 1e-9;
  if (meets && !upright) ok = swept_closing(path, way->x, &closing);
  size_t stretches = path->closed ? path->count : path->count - 1;
  vs_twist turning = { .scale = scale, .base = base, .reach = reach, .turn = fabs(twist + closing) };
  size_t count = swept_steps(path, ok ? stretches : 0, upright, twist + closing, f, &turning.step);
  if (ok && turning.step > 0) turning.lean = swept_lean_change(path, stretches, way, twist + closing, zone, f);
  int halvings = ok ? swept_halvings(s, &turning, count, f) : 0;
  size_t parts = (size_t)1 << halvings;
  if (s->dense) vs_twist_rows(s, &turning, f);
  if (s->dense) parts = vs_twist_parts(&turning, count, f);
  ok = ok && vs_twist_divide(s, &turning, f);
  for (size_t i = 0; i < path->count; i++) meets = meets && !swept_turns_back(&path->at[i]);
  if (ok && meets && !joins && s->filled) ok = swept_seam(s, base, rest, reach);
  bool seam = s->seam != NULL; /* true if start and end of the sweep can be joined, because the turned profile coincides
                                * with itself, as a square does after a quarter turn */
  if (!path->closed) { /* the first and the last section of an open path are perpendicular to it */
    path->at[0].arriving = path->at[0].leaving;
    path->at[path->count - 1].leaving = path->at[path->count - 1].arriving;
  }
  for (size_t i = 0; ok && i < stretches; i++) {
    const vs_path_point *p = &path->at[i], *q = &path->at[i + 1 < path->count ? i + 1 : 0];
    vs_vec3 step = vs_v3_sub(q->at, p->at);
    double angle;
    swept_stretch stretch = swept_stretch_of(path, i, upright, twist + closing, f, &angle);
    size_t steps = stretch.steps;
    double spin = stretch.spin;
    ok = vs_path_add(&fine, p->at, p->arriving, p->leaving) && VS_GROW(stance, stances, fine.count + steps);
    if (ok) stance[fine.count - 1] = (swept_stance){ swept_lean(p, p->leaving), 0, spin / (double)steps };
    swept_leans leans = swept_leans_of(p, q, zone);
    for (size_t k = 1; ok && k < steps; k++) {
      double t = (double)k / (double)steps;
      vs_vec3 d = vs_v3_unit(vs_v3_add(vs_v3_scale(p->leaving, 1 - t), vs_v3_scale(q->arriving, t)));
      ok = vs_path_add(&fine, vs_v3_add(p->at, vs_v3_scale(step, t)), d, d);
      if (ok) stance[fine.count - 1] =
        (swept_stance){ swept_lean_at(&leans, t), spin * t, spin * (double)(k + 1) / (double)steps };
    }
  }
  const vs_path_point *last = path->closed ? &path->at[0] : &path->at[path->count - 1];
  bool ends = !joins; /* true if the start and end of a closed path cannot be joined; the first point of the path is
                       * then repeated as the last */
  if (ends) {
    ok = ok && vs_path_add(&fine, last->at, last->arriving, last->leaving);
    if (ok) stance[fine.count - 1] = (swept_stance){ swept_lean(last, last->leaving), 0, 0 };
  }
  fine.closed = joins;
  if (ok) vs_path_measure(&fine);
  carried = ok ? malloc(fine.count * sizeof *carried) : NULL;
  ok = ok && carried;
  bool stands = !ok || !upright || swept_stand(upright, &fine, carried, e);
  if (ok && !upright) vs_frame_transport(fine.at, fine.count - seam, joins || seam, fine.length, way->x, carried);
  if (ok && seam) carried[fine.count - 1] = carried[0];
  bool broken = false;
  const swept_points on = { &fine, carried, stance, way };
  for (size_t i = 0; ok && stands && i < fine.count + broken; i++) {
    bool round = i == fine.count; /* true for the last piece of a closed path, which ends where the first piece
                                   * begins */
    vs_path_point p = fine.at[round ? 0 : i];
    double t = round ? 1 : fine.length > 0 ? fine.at[i].along / fine.length : 0;
    if (joins && i == 0) for (size_t k = 0; k < fine.count; k++) broken = broken || swept_turns_back(&fine.at[k]);
    if (swept_turns_back(&p) && (i > 0 || ends)) {
      vs_path_point end = { p.at, p.arriving, p.arriving, p.along };
      vs_vec3 across = carried[i ? i - 1 : 0];
      across = vs_v3_unit(vs_v3_sub(across, vs_v3_scale(p.arriving, vs_v3_dot(across, p.arriving))));
      ok = swept_add(s, swept_section(&end, vs_v3(0, 0, 0), across, twist * t, 1 + (scale - 1) * t, base));
      if (ok) s->sections[s->section_count - 1].ends = true;
      if (round || (ends && i + 1 == fine.count)) break;
    }
    size_t at = round ? 0 : i;
    ok = ok && swept_add(s, swept_section(&p, stance[at].lean, carried[at], twist * t + stance[at].spin,
                                          1 + (scale - 1) * t, base));
    if (ok && !round && (i + 1 < fine.count || joins)) ok = swept_between(s, &on, i, parts - 1);
  }
  s->joined = joins && !broken;
  s->across = true;
  s->base = base;
  if (ok && stands && f->segments <= 0) ok = swept_walls(s, &turning, halvings, upright || scale != 1, f);
  vs_path_free(&fine);
  free(carried);
  free(stance);
  return stands && (ok || vs_error_memory(e, NULL));
}

/* ---- the three kinds: extrude, sweep and thicken ---- */

/* Divides a solid extrusion along a path into pieces, each of which moves to one side of the profile's plane. The
 * profile does not turn. Returns false and sets e if the profile moves within its plane, where it fills no volume. */
static bool swept_pieces(vs_swept *s, const vs_profile_plane *plane, const vs_path *path, vs_error *e) {
  double side = 0;
  size_t stretches = path->closed ? path->count : path->count - 1;
  bool ok = true;
  for (size_t i = 0; ok && i < stretches; i++) {
    vs_vec3 from = vs_v3_sub(path->at[i].at, path->at[0].at),
            to = vs_v3_sub(path->at[i + 1 < path->count ? i + 1 : 0].at, path->at[0].at);
    double rise = vs_v3_dot(vs_v3_sub(to, from), plane->normal), now = fabs(rise) <= 1e-9 * path->length ? 0
                                                                       : rise < 0                        ? -1
                                                                                                         : 1;
    if (now != side && s->section_count) s->sections[s->section_count - 1].ends = true;
    if (now != side && now != 0)
      ok = swept_add(s, (vs_section){ plane->x, plane->y, vs_v3_add(plane->origin, from), false });
    if (now != 0) ok = ok && swept_add(s, (vs_section){ plane->x, plane->y, vs_v3_add(plane->origin, to), false });
    side = now;
  }
  if (!ok) return vs_error_memory(e, NULL);
  return s->section_count ||
         vs_error_set(e, VS_ERROR_MODEL, NULL,
                      "the amount lies in the profile's own plane, whose normal is (vxyz %.6g %.6g %.6g)",
                      plane->normal.x, plane->normal.y, plane->normal.z);
}

/* Makes the sections of an extrusion along a vector, or along a path on which the profile does not turn. */
static bool swept_extrude(vs_swept *s, const vs_node *n, const vs_fineness *f, vs_error *e) {
  const struct vs_extrude *x = VS_AS(extrude, n);
  vs_profile_plane plane = { 0 };
  vs_path path = { 0 };
  vs_affine identity = vs_affine_identity();
  vs_vec3 none = { 0, 0, 0 };
  bool curve = n->child_count > 1, ok = true, turns = x->twist != 0 || x->scale != 1;
  ok = swept_profile(s, n->children[0].node, f, NULL, &plane, e);
  if (ok && curve) ok = vs_curve_path(n->children[1].node, &identity, f, &path, e);
  else if (ok)
    ok = (vs_path_add(&path, none, none, none) && vs_path_add(&path, x->along, none, none)) || vs_error_memory(e, NULL);
  if (ok && path.count < 2) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "do-extrude: the curve to follow is a point");
  if (ok) vs_path_measure(&path);
  if (ok && curve && s->filled && !turns) {
    ok = swept_pieces(s, &plane, &path, e);
    vs_path_free(&path);
    return ok;
  }
  vs_vec3 middle =
      vs_v3_add(plane.origin, vs_v3_add(vs_v3_scale(plane.x, plane.base.x), vs_v3_scale(plane.y, plane.base.y)));
  vs_vec3 way = ok ? vs_v3_sub(path.at[path.count - 1].at, path.at[0].at) : none;
  /* hand: 1, or -1 if the profile moves against its normal; a twist turns about the direction of the movement */
  double rises = vs_v3_dot(vs_v3_unit(way), plane.normal), hand = rises < 0 ? -1 : 1;
  if (ok && !curve && s->filled && fabs(rises) < 1e-9)
    ok = vs_error_set(e, VS_ERROR_MODEL, NULL,
                      "do-extrude: the amount lies in the profile's own plane, whose normal is (vxyz %.6g %.6g %.6g)",
                      plane.normal.x, plane.normal.y, plane.normal.z);
  s->joined = ok && path.closed && !turns;
  vs_twist turning = { .scale = x->scale, .base = plane.base, .reach = plane.reach, .turn = fabs(x->twist) };
  size_t stretches = !ok || x->twist == 0 || !(path.length > 0) ? 0
                     : path.closed                              ? path.count
                                                                : path.count - 1,
         count = swept_steps(&path, stretches, NULL, x->twist, f, &turning.step);
  int halvings = ok ? swept_halvings(s, &turning, count, f) : 0;
  if (ok && !vs_twist_divide(s, &turning, f)) ok = vs_error_memory(e, NULL);
  for (size_t i = 0; ok && i < path.count + (path.closed && turns); i++) {
    bool round = i == path.count;
    vs_vec3 p = path.at[round ? 0 : i].at;
    double until = round ? path.length : path.at[i].along, from = i ? path.at[i - 1].along : 0;
    vs_vec3 before = i ? path.at[i - 1].at : p;
    size_t steps = 1;
    double angle;
    if (i && stretches) steps = swept_stretch_of(&path, i - 1, NULL, x->twist, f, &angle).steps << halvings;
    for (size_t k = 1; ok && k <= steps; k++) {
      double part = (double)k / (double)steps, t = path.length > 0 ? (from + (until - from) * part) / path.length : 0,
             sine, cosine;
      vs_vec3 at = k == steps ? p : vs_v3_add(before, vs_v3_scale(vs_v3_sub(p, before), part));
      vs_vec3 shift = vs_v3_sub(at, path.at[0].at);
      if (x->center && !curve) shift = vs_v3_sub(shift, vs_v3_scale(x->along, 0.5));
      vs_section section = { plane.x, plane.y, vs_v3_add(plane.origin, shift), false };
      if (turns) {
        double scale = 1 + (x->scale - 1) * t;
        vs_sincos(hand * x->twist * t, &sine, &cosine);
        section.x = vs_v3_scale(vs_v3_add(vs_v3_scale(plane.x, cosine), vs_v3_scale(plane.y, sine)), scale);
        section.y = vs_v3_scale(vs_v3_add(vs_v3_scale(plane.y, cosine), vs_v3_scale(plane.x, -sine)), scale);
        vs_vec3 off = vs_v3_add(vs_v3_scale(section.x, plane.base.x), vs_v3_scale(section.y, plane.base.y));
        if (t > 0) section.at = vs_v3_add(shift, vs_v3_sub(middle, off));
      }
      ok = swept_add(s, section) || vs_error_memory(e, NULL);
    }
  }
  if (ok && x->scale > 0)
    ok = vs_twist_strides(s, &turning, halvings, f) || vs_error_memory(e, NULL);
  vs_path_free(&path);
  return ok;
}

static bool swept_sweep(vs_swept *s, const vs_node *n, const vs_fineness *f, vs_error *e) {
  const struct vs_sweep *w = VS_AS(sweep, n);
  vs_profile_plane plane = { 0 };
  vs_path path = { 0 };
  bool ok = swept_profile(s, n->children[0].node, f, w->has_base ? &w->base : NULL, &plane, e) &&
            vs_swept_path(n->children[1].node, f, plane.reach * fmax(1, w->scale), &path, e);
  if (ok && path.count < 2) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "do-sweep: the path is a point");
  if (ok) {
    vs_affine turn = vs_frame_turn(plane.normal, path.at[0].leaving);
    const vs_node *c = n->children[0].node;
    while (c->child_count == 1) c = c->children[0].node;
    /* round: true for a circle that is swept along a circle; a twist does not change the shape of this solid */
    bool round = path.closed && !w->has_base && vs_profile_circle(n->children[0].node) > 0 && c->kind == VS_CIRCLE &&
                 VS_AS(circle, c)->segments <= 0;
    vs_upright upright = { 0 };
    bool stands = vs_v3_length(w->up) > 0;
    if (stands) upright = swept_upright(&plane, w->up);
    const swept_way way = { vs_affine_vector(&turn, plane.x), stands ? &upright : NULL, round ? 0 : w->twist, w->scale,
                            plane.base, plane.reach };
    ok = swept_along(s, &path, &way, f, e);
  }
  vs_path_free(&path);
  return ok;
}

static bool swept_thicken(vs_swept *s, const vs_node *n, const vs_fineness *f, vs_error *e) {
  const struct vs_thicken *t = VS_AS(thicken, n);
  const vs_node *what = n->children[0].node;
  if (what->class_ != VS_CURVE) {
    vs_profile_plane plane = { 0 };
    if (!swept_profile(s, what, f, NULL, &plane, e)) return false;
    vs_vec3 half = vs_v3_scale(plane.normal, t->width / 2);
    return (swept_add(s, (vs_section){ plane.x, plane.y, vs_v3_sub(plane.origin, half), false }) &&
            swept_add(s, (vs_section){ plane.x, plane.y, vs_v3_add(plane.origin, half), false })) ||
           vs_error_memory(e, NULL);
  }
  vs_path path = { 0 };
  bool ok = vs_swept_path(what, f, t->width / 2, &path, e);
  if (ok && path.count < 2) ok = vs_error_set(e, VS_ERROR_MODEL, NULL, "do-thicken: the curve is a point");
  ok = ok && (swept_disc(s, t->width / 2, vs_fineness_turn(f, t->width / 2, t->segments)) || vs_error_memory(e, NULL));
  if (ok) {
    vs_affine square = vs_frame_on_axis(path.at[0].at, path.at[0].leaving);
    vs_vec3 x = { square.m[0][0], square.m[1][0], square.m[2][0] };
    ok = swept_along(s, &path, &(swept_way){ .x = x, .scale = 1, .reach = t->width / 2 }, f, e);
  }
  vs_path_free(&path);
  return ok;
}

static bool swept_kind(const vs_node *n, const vs_fineness *f, bool dense, vs_swept *out, vs_error *e) {
  *out = (vs_swept){ .dense = dense };
  bool ok = n->kind == VS_EXTRUDE ? swept_extrude(out, n, f, e)
            : n->kind == VS_SWEEP ? swept_sweep(out, n, f, e)
                                  : swept_thicken(out, n, f, e);
  if (!ok) vs_swept_free(out);
  return ok;
}

bool vs_swept_plan(const vs_node *n, const vs_fineness *f, vs_swept *out, vs_error *e) {
  if (!swept_kind(n, f, false, out, e)) return false;
  if (!out->dense) return true;
  vs_swept_free(out);
  return swept_kind(n, f, true, out, e);
}
