/* Computes bounds: of leaves under an affine map exactly, of sets from the bounds of their parts. */
#include "geometry/measure/bounds.h"

#include <stdlib.h>

#include "geometry/plane/curve.h"
#include "geometry/plane/offset.h"
#include "geometry/tessellate.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/measure/reach.h"
#include "geometry/primitives/half_space.h"
#include "geometry/primitives/shape.h"
#include "geometry/profiles/revolve.h"
#include "geometry/plane/areas.h"
#include "geometry/profiles/swept.h"
#include "geometry/text/typeset.h"

static void bounds_add_arc(vs_bounds *b, const vs_affine *a, const struct vs_arc *arc) {
  double low = fmin(arc->start, arc->end), high = fmax(arc->start, arc->end), pi = 3.14159265358979323846;
  double angles[8] = { low, high };
  int n = 2;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 2; k++) {
      double angle = atan2(a->m[i][1], a->m[i][0]) + k * pi;
      angle += 2 * pi * ceil((low - angle) / (2 * pi));
      if (angle <= high) angles[n++] = angle;
    }
  for (int i = 0; i < n; i++) {
    double s, c;
    vs_sincos(angles[i], &s, &c);
    vs_bounds_add(
        b, vs_affine_point(a, vs_v3(arc->center.x + arc->radius * c, arc->center.y + arc->radius * s, arc->center.z)));
  }
}

/* Returns the tolerance with which a shape is sampled for its exact bounds. b: its approximate bounds. */
static double bounds_fineness(const vs_bounds *b) {
  double d = vs_bounds_diagonal(b);
  return d > 0 && isfinite(d) ? d / 65536 : 1e-6;
}

/* ---- sampled shapes ---- */

/* Enlarges b by the bounds of samples of node n mapped by a. tolerance: greatest distance of the samples' chords from
 * the shape, in the coordinates of n. Returns false on failure. */
typedef bool bounds_sampler(const vs_node *n, const vs_affine *a, double tolerance, vs_bounds *b, vs_error *e);

/* How a kind of node is sampled. coarse: tolerance as a multiple of bounds_fineness; thinnest: least fraction of this
 * tolerance, for a thin shape. */
typedef struct { bounds_sampler *sample; double coarse, thinnest; } bounds_sampling;

/* Returns the tolerance for sampling a thin shape: at most 8 * `tolerance` times the ratio of its shortest side to its
 * diagonal, measured before the map a. b: bounds of the mapped shape. */
static double bounds_side_tolerance(const vs_bounds *b, const vs_affine *a, double tolerance, double diagonal) {
  double side[3] = { b->max.x - b->min.x, b->max.y - b->min.y, b->max.z - b->min.z }, least = tolerance;
  for (int k = 0; k < 3; k++) {
    double before = side[k] / vs_v3_length(vs_reach_row(a, k));
    if (before > 1e-9 * diagonal && isfinite(before)) least = fmin(least, 8 * tolerance * before / diagonal);
  }
  return least;
}

/* Enlarges b by the bounds of node n mapped by a. children: bounds of the points or nodes from which n is made. Samples
 * a thin shape more finely. Returns false on failure. */
static bool bounds_add_samples(vs_bounds *b, const bounds_sampling *how, const vs_node *n, const vs_affine *a,
                               const vs_bounds *children, vs_error *e) {
  double tolerance = how->coarse * bounds_fineness(children), diagonal = vs_bounds_diagonal(children);
  vs_bounds here = vs_bounds_empty();
  if (!how->sample(n, a, tolerance, &here, e)) return false;
  double finer = diagonal > 0 && !vs_bounds_is_empty(&here) ? bounds_side_tolerance(&here, a, tolerance, diagonal)
                                                            : tolerance;
  if (finer < tolerance) {
    here = vs_bounds_empty();
    if (!how->sample(n, a, fmax(finer, how->thinnest * tolerance), &here, e)) return false;
  }
  vs_bounds_unite(b, &here);
  return true;
}

static bool bounds_sample_facets(const vs_node *n, const vs_affine *a, double tolerance, vs_bounds *b, vs_error *e) {
  vs_fineness f = { tolerance, 0 };
  vs_mesh m = { 0 };
  bool ok = vs_tessellate(n, &f, &m, e);
  if (ok) vs_reach_points(b, a, m.vertices, m.vertex_count);
  vs_mesh_free(&m);
  return ok;
}

/* Returns the radius of the circle that the swept solid n moves; 0 if its profile is no circle, or a circle with a
 * given number of segments. */
static double bounds_swept_circle(const vs_node *n) {
  const vs_node *profile = n->children[0].node;
  if (n->kind == VS_THICKEN && profile->class_ == VS_CURVE)
    return VS_AS(thicken, n)->segments > 0 ? 0 : VS_AS(thicken, n)->width / 2;
  double radius = vs_profile_circle(profile);
  while (profile->child_count == 1) profile = profile->children[0].node;
  return profile->kind == VS_CIRCLE && VS_AS(circle, profile)->segments <= 0 ? radius : 0;
}

/* Enlarges b by the cross-sections of a swept solid, mapped by a. radius: radius of its profile if this is a circle, or
 * 0. */
static void bounds_add_sections(vs_bounds *b, const vs_affine *a, const vs_swept *plan, double radius) {
  vs_vec2 middle = { 0, 0 };
  for (size_t k = 0; k < plan->profile_count; k++) {
    middle.x += plan->profile[k].x / (double)plan->profile_count;
    middle.y += plan->profile[k].y / (double)plan->profile_count;
  }
  for (size_t i = 0; i < plan->section_count; i++) {
    const vs_section *s = &plan->sections[i];
    const vs_affine frame = { { { s->x.x, s->y.x, 0, s->at.x }, { s->x.y, s->y.y, 0, s->at.y },
                                { s->x.z, s->y.z, 0, s->at.z } } };
    if (radius > 0) {
      vs_reach_oval(b, a, &frame, vs_affine_point(&frame, vs_v3(middle.x, middle.y, 0)), radius, radius);
      continue;
    }
    for (size_t k = 0; k < plan->profile_count; k++)
      vs_bounds_add(b, vs_affine_point(a, vs_affine_point(&frame, vs_v3(plan->profile[k].x, plan->profile[k].y, 0))));
  }
}

/* Enlarges b by a swept solid. The bounds of an upright extrusion follow exactly from its profile; other solids are
 * sampled. */
static bool bounds_sample_swept(const vs_node *n, const vs_affine *a, double tolerance, vs_bounds *b, vs_error *e) {
  vs_fineness f = { tolerance, 0 };
  vs_swept plan;
  if (!vs_swept_plan(n, &f, &plan, e)) return false;
  vs_bounds straight = vs_bounds_empty();
  bounds_add_sections(&straight, a, &plan, plan.profile_count ? bounds_swept_circle(n) : 0);
  vs_swept_free(&plan);
  /* An extrusion with walls that lean inwards gets the bounds of the extrusion with vertical walls, which contains
   * it. */
  if (n->kind == VS_EXTRUDE && VS_AS(extrude, n)->taper != 0) {
    vs_bounds leaning = vs_bounds_empty();
    if (!bounds_sample_facets(n, a, tolerance, &leaning, e)) return false;
    if (VS_AS(extrude, n)->taper > 0) vs_bounds_meet(&straight, &leaning);
    else straight = leaning;
  }
  vs_bounds_unite(b, &straight);
  return true;
}

static bool bounds_sample_revolve(const vs_node *n, const vs_affine *a, double tolerance, vs_bounds *b, vs_error *e) {
  vs_fineness f = { tolerance, 0 };
  vs_revolve plan;
  if (!vs_revolve_plan(n, &f, &plan, e)) return false;
  vs_revolve_bounds(&plan, a, b);
  vs_revolve_free(&plan);
  return true;
}

static bool bounds_sample_curve(const vs_node *n, const vs_affine *a, double tolerance, vs_bounds *b, vs_error *e) {
  vs_fineness f = { tolerance, 0 };
  vs_polyline line = { 0 };
  bool ok = vs_curve_sample(n, &f, &line, e);
  if (ok) vs_reach_points(b, a, line.at, line.count);
  vs_polyline_free(&line);
  return ok;
}

static bool bounds_sample_region(const vs_node *n, const vs_affine *a, double tolerance, vs_bounds *b, vs_error *e) {
  vs_fineness f = { tolerance, 0 };
  vs_outline o;
  if (!vs_region_outline(n, &f, &o, e)) return false;
  for (size_t l = 0; l < o.count; l++) vs_reach_points(b, a, o.loops[l].at, o.loops[l].count);
  vs_outline_free(&o);
  return true;
}

/* A swept solid with a twist costs much time to sample, so its tolerance is coarser. */
static const bounds_sampling swept_sampling = { bounds_sample_swept, 4, 0x1p-10 },
                             layer_sampling = { bounds_sample_facets, 1, 0x1p-4 },
                             facets_sampling = { bounds_sample_facets, 8, 0x1p-6 },
                             revolve_sampling = { bounds_sample_revolve, 1, 0x1p-10 },
                             curve_sampling = { bounds_sample_curve, 1, 0x1p-10 },
                             region_sampling = { bounds_sample_region, 1, 0x1p-10 };

static bool bounds_add_offset(vs_bounds *b, const vs_affine *a, const vs_node *n, const vs_bounds *children,
                              vs_error *e) {
  vs_offset_exact exact;
  vs_affine place;
  if (!vs_offset_round(n, &place, &exact))
    return bounds_add_samples(b, n->class_ == VS_CURVE ? &curve_sampling : &region_sampling, n, a, children, e);
  place = vs_affine_multiply(a, &place);
  if (exact.circle) vs_reach_disc(b, &place, exact.arc.center, vs_v3(0, 0, 1), exact.arc.radius);
  else bounds_add_arc(b, &place, &exact.arc);
  return true;
}

/* A spline with a given number of segments is drawn as a polyline; its samples are exact. */
static bool bounds_add_spline(vs_bounds *b, const vs_affine *a, const vs_node *n, vs_error *e) {
  vs_bounds knots = vs_bounds_empty();
  if (VS_AS(spline, n)->segments <= 0) return vs_spline_bounds(VS_AS(spline, n), a, b) || vs_error_memory(e, NULL);
  const vs_affine here = vs_affine_identity();
  vs_reach_points(&knots, &here, VS_AS(spline, n)->points->at, VS_AS(spline, n)->points->count);
  return bounds_add_samples(b, &curve_sampling, n, a, &knots, e);
}

/* Enlarges b by the bounds of a leaf n mapped by a. children: bounds of its children, needed for swept solids. *leaf:
 * false if n is no leaf. Returns false on failure. */
static bool bounds_leaf(const vs_node *n, const vs_affine *a, const vs_bounds *children, vs_bounds *b, bool *leaf,
                        vs_error *e) {
  *leaf = true;
  switch ((vs_kind)n->kind) {
    case VS_EMPTY: case VS_GHOST: return true;
    case VS_CUSTOM:
      if (n->child_count) break;
      return vs_error_set(e, VS_ERROR_MODEL, NULL,
                          "%s has no drawing function: (register-drawing-function %s? ...) gives it one",
                          VS_AS(custom, n)->name, VS_AS(custom, n)->name);
    case VS_LINE: vs_reach_points(b, a, VS_AS(line, n)->points->at, VS_AS(line, n)->points->count); return true;
    case VS_ARC: bounds_add_arc(b, a, VS_AS(arc, n)); return true;
    case VS_CIRCLE:
      vs_reach_disc(b, a, VS_AS(circle, n)->center, vs_v3(0, 0, 1), VS_AS(circle, n)->radius);
      return true;
    case VS_SPLINE: return bounds_add_spline(b, a, n, e);
    case VS_TEXT: return vs_text_bounds(n, a, b, e);
#include "model/cases/shape_cases.def"
      return vs_shape_of(n)->bounds(n, a, b, e);
    case VS_POLYFACE_MESH:
      vs_reach_points(b, a, VS_AS(polyface_mesh, n)->points->at, VS_AS(polyface_mesh, n)->points->count);
      return true;
    case VS_XLINE: case VS_RAY: return true; /* infinite lines are drawn as far as the other objects extend, so they do
                                              * not enlarge the bounds */
    case VS_OFFSET: return n->class_ == VS_NOTHING || bounds_add_offset(b, a, n, children, e);
    case VS_EXTRUDE: case VS_SWEEP: case VS_THICKEN: {
      bool layer = n->kind == VS_THICKEN && n->children[0].node->class_ == VS_SURFACE;
      return n->class_ == VS_NOTHING ||
             bounds_add_samples(b, layer ? &layer_sampling : &swept_sampling, n, a, children, e);
    }
    case VS_REVOLVE: return n->class_ == VS_NOTHING || bounds_add_samples(b, &revolve_sampling, n, a, children, e);
    case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT:
      return bounds_add_samples(b, &facets_sampling, n, a, children, e);
    case VS_GRID_MESH:
      vs_reach_points(b, a, VS_AS(grid_mesh, n)->points->at, VS_AS(grid_mesh, n)->points->count);
      return true;
    case VS_GRID_SURFACE:
      vs_reach_points(b, a, VS_AS(grid_surface, n)->points->at, VS_AS(grid_surface, n)->points->count);
      return true;
    case VS_JOIN: case VS_SECTION: case VS_PROJECT: case VS_EDGES:
    case VS_SLICE:
    case VS_DEFORM:
    case VS_REGION:
#include "model/cases/passed_cases.def"
      break;
    case VS_HULL: /* adds the hull's own points; the bounds of its children are added elsewhere */
      if (n->child_count) break;
      vs_reach_points(b, a, VS_AS(hull, n)->points->at, VS_AS(hull, n)->points->count);
      return true;
  }
  *leaf = false;
  return true;
}

/* ---- the memo, which stores the bounds of nodes; the bounds of children are computed before those of parents ---- */

void vs_bounds_memo_free(vs_bounds_memo *m) {
  vs_store *s = m->places.store;
  if (m->at) vs_store_realloc(s, m->at, m->room * sizeof *m->at, 0);
  vs_nodemap_free(&m->places);
  *m = (vs_bounds_memo){ .places = { .store = s } };
}

static bool bounds_memo_put(vs_bounds_memo *m, const vs_node *n, const vs_reach *b) {
  if (m->count == m->room) {
    size_t room = m->room ? m->room * 2 : 64;
    vs_reach *grown = vs_store_realloc(m->places.store, m->at, m->room * sizeof *grown, room * sizeof *grown);
    if (!grown) return false;
    m->at = grown;
    m->room = room;
  }
  uint64_t *place = vs_nodemap_put(&m->places, n, NULL);
  if (!place) return false;
  *place = m->count;
  m->at[m->count++] = *b;
  return true;
}

static const vs_reach *bounds_memo_known(const vs_bounds_memo *m, const vs_node *n) {
  const uint64_t *place = vs_nodemap_get(&m->places, n);
  return place ? &m->at[*place] : NULL;
}

/* n is a section or projection, and b contains the bounds of its children. Reduces b to the bounds of n: the box
 * projected onto the plane, or the part of the plane in the box. */
static void bounds_on_plane(vs_bounds *b, const vs_node *n) {
  vs_bounds solid = *b, shadow = vs_bounds_empty();
  vs_vec3 at = n->kind == VS_SECTION ? VS_AS(section, n)->point : VS_AS(project, n)->point;
  vs_vec3 normal = vs_v3_unit(n->kind == VS_SECTION ? VS_AS(section, n)->normal : VS_AS(project, n)->normal);
  if (vs_bounds_is_empty(b)) return;
  for (int i = 0; i < 8; i++) {
    vs_vec3 p = { i & 1 ? solid.max.x : solid.min.x, i & 2 ? solid.max.y : solid.min.y,
                  i & 4 ? solid.max.z : solid.min.z };
    vs_bounds_add(&shadow, vs_v3_sub(p, vs_v3_scale(normal, vs_v3_dot(normal, vs_v3_sub(p, at)))));
  }
  *b = shadow;
  if (n->kind == VS_SECTION) vs_bounds_meet(b, &solid);
}

/* Returns true for a leaf with a single parent. Its bounds are computed when the parent needs them, because this is
 * faster than storing them. */
static bool bounds_is_lone_leaf(const vs_node *n) { return n->child_count == 0 && n->refs == 1; }

/* Sets *b to the bounds of node n in its own coordinates if n is one of the commonest primitives. Returns false for
 * other kinds. It is faster than bounds_leaf, because a drawing may contain a million such nodes. */
static bool bounds_plain(const vs_node *n, vs_bounds *b) {
  vs_vec3 at[2], reach[2];
  switch ((int)n->kind) {
    case VS_BOX:
      *b = (vs_bounds){ VS_AS(box, n)->p, VS_AS(box, n)->p };
      vs_bounds_add(b, VS_AS(box, n)->q);
      return true;
    case VS_SPHERE: {
      double r = VS_AS(sphere, n)->radius;
      at[0] = at[1] = VS_AS(sphere, n)->center;
      reach[0] = reach[1] = vs_v3(r, r, r);
      break;
    }
    case VS_CYLINDER: case VS_CONE: case VS_CUT_CONE: {
      bool cut = n->kind == VS_CUT_CONE, cone = n->kind == VS_CONE;
      at[0] = cut ? VS_AS(cut_cone, n)->base : cone ? VS_AS(cone, n)->base : VS_AS(cylinder, n)->base;
      at[1] = cut ? VS_AS(cut_cone, n)->top : cone ? VS_AS(cone, n)->apex : VS_AS(cylinder, n)->top;
      double r = cut ? VS_AS(cut_cone, n)->base_radius : cone ? VS_AS(cone, n)->radius : VS_AS(cylinder, n)->radius;
      double far = cut ? VS_AS(cut_cone, n)->top_radius : cone ? 0 : r;
      vs_vec3 d = vs_v3_sub(at[1], at[0]), across = vs_v3(1, 1, 0);
      if (d.x != 0 || d.y != 0) { /* the axis is inclined; an upright axis has a shorter formula with equal results */
        vs_vec3 u = vs_v3_unit(d);
        across = vs_v3(sqrt(u.z * u.z + u.y * u.y), sqrt(u.z * u.z + u.x * u.x), sqrt(u.y * u.y + u.x * u.x));
      }
      reach[0] = vs_v3_scale(across, r), reach[1] = vs_v3_scale(across, far);
      break;
    }
    default: return false; /* the function bounds_leaf handles all other kinds */
  }
  *b = vs_bounds_empty();
  for (int i = 0; i < 2; i++) {
    vs_bounds_add(b, vs_v3_sub(at[i], reach[i]));
    vs_bounds_add(b, vs_v3_add(at[i], reach[i]));
  }
  return true;
}

/* Sets *b to the bounds of node n: from the memo, or by a formula for a leaf with a single parent, which is not in the
 * memo. Returns false on failure. */
static bool bounds_child(const vs_bounds_memo *m, const vs_node *n, vs_reach *b, vs_error *e) {
  const vs_reach *known = bounds_is_lone_leaf(n) ? NULL : bounds_memo_known(m, n);
  vs_affine here = vs_affine_identity();
  vs_bounds none = vs_bounds_empty();
  bool leaf;
  if (known) {
    *b = *known;
    return true;
  }
  b->box = none;
  if (!(bounds_is_lone_leaf(n) && bounds_plain(n, &b->box)) && !bounds_leaf(n, &here, &none, &b->box, &leaf, e))
    return false;
  b->ball = vs_ball_of_box(&b->box);
  return true;
}

static bool bounds_is_axial(const vs_affine *a) { /* returns true if a maps axis-parallel boxes to axis-parallel
                                                   * boxes */
  for (int i = 0; i < 3; i++)
    if ((a->m[i][0] != 0) + (a->m[i][1] != 0) + (a->m[i][2] != 0) > 1) return false;
  return true;
}

static bool bounds_is_swept(const vs_node *n) { /* returns true if the bounds of n cost so much to compute that a
                                                 * placement of n uses its mapped box instead */
  if (n->kind == VS_EXTRUDE && n->child_count == 1) {
    const vs_node *profile = n->children[0].node;
    while (profile->kind == VS_REGION && profile->child_count == 1) profile = profile->children[0].node;
    return profile->kind != VS_LINE || VS_AS(extrude, n)->taper != 0;
  }
  return vs_node_has(n, VS_IS_SAMPLED);
}

/* Returns true if the bounds of n follow from those of its children: a set, a region or joined curves. */
static bool bounds_is_set(const vs_node *n) {
  return vs_node_is_set(n) || n->kind == VS_REGION || n->kind == VS_JOIN;
}

/* Limits for computing the bounds of a rotated set part by part. TURNED_DEEP: depth of sets; TURNED_EACH: steps for one
 * set; TURNED_MOST: steps for all sets of a memo. *done: false if a limit is exceeded. */
enum { TURNED_DEEP = 32, TURNED_EACH = 2048, TURNED_MOST = 1 << 20 };
static bool bounds_turned(vs_bounds_memo *m, const vs_node *n, const vs_affine *map, vs_bounds *out, bool *done,
                          vs_error *e) {
  struct { const vs_node *node; vs_affine map; uint32_t next; vs_bounds all; } level[TURNED_DEEP];
  size_t depth = 1, steps = 0;
  vs_bounds b = vs_bounds_empty();
  vs_reach child;
  bool leaf;
  level[0].node = n, level[0].map = *map, level[0].next = 0, level[0].all = b;
  while (depth) {
    *done = depth < TURNED_DEEP && ++steps < TURNED_EACH && m->turned + steps < TURNED_MOST;
    if (!*done) break;
    size_t top = depth - 1;
    const vs_node *at = level[top].node;
    bool down = bounds_is_set(at) && level[top].next < at->child_count &&
                !(at->kind == VS_DIFFERENCE && level[top].next > 0);
    if (bounds_is_set(at) && level[top].next) { /* adds the bounds of the set's previous member, which are in b */
      if (at->kind == VS_INTERSECTION && level[top].next > 1) vs_bounds_meet(&level[top].all, &b);
      else vs_bounds_unite(&level[top].all, &b);
    }
    if (at->kind == VS_TRANSFORM) {
      level[top].map = vs_affine_multiply(&level[top].map, &VS_AS(transform, at)->matrix);
      level[top].node = at->children[0].node;
    } else if (vs_node_is_wrapper(at)) {
      level[top].node = at->children[0].node;
    } else if (down) {
      level[depth].node = at->children[level[top].next++].node;
      level[depth].map = level[top].map;
      level[depth].next = 0;
      level[depth++].all = vs_bounds_empty();
    } else if (bounds_is_set(at)) {
      b = level[--depth].all;
    } else {
      b = vs_bounds_empty();
      if (!bounds_child(m, at, &child, e) ||
          (!bounds_is_swept(at) && !bounds_leaf(at, &level[top].map, &child.box, &b, &leaf, e)))
        return false;
      if (bounds_is_swept(at) || !leaf) b = vs_bounds_transform(&child.box, &level[top].map);
      depth--;
    }
  }
  m->turned += steps;
  *out = b;
  return true;
}

/* Sets *b to the bounds of the placement n. children: those of its child. A placed primitive has a formula. Only a few
 * nested placements are followed, because a long sequence would take quadratic time. Returns false on failure. */
static bool bounds_of_placement(vs_bounds_memo *m, const vs_node *n, const vs_reach *children, vs_reach *b,
                                vs_error *e) {
  vs_affine placed = vs_affine_identity();
  const vs_node *below = n;
  for (int steps = 0; steps < 16 && (below->kind == VS_TRANSFORM || vs_node_is_wrapper(below)); steps++) {
    if (below->kind == VS_TRANSFORM) placed = vs_affine_multiply(&placed, &VS_AS(transform, below)->matrix);
    below = below->children[0].node;
  }
  bool swept = bounds_is_swept(below), done = false, leaf = false;
  if (bounds_is_set(below) && !(below->flags & VS_NODE_ENDLESS) && !bounds_is_axial(&placed) &&
      !bounds_turned(m, below, &placed, &b->box, &done, e))
    return false;
  b->ball = vs_ball_mapped(&children->ball, &VS_AS(transform, n)->matrix);
  if (done) return true;
  b->box = vs_bounds_empty();
  if (!swept && !bounds_leaf(below, &placed, &children->box, &b->box, &leaf, e)) return false;
  if (leaf) return true;
  b->box = vs_bounds_transform(&children->box, &VS_AS(transform, n)->matrix);
  vs_ball_limit(&b->ball, &b->box);
  return true;
}

/* Reduces *b, the bounds of all children of n together, to those of n: a difference lies in its first operand, and an
 * intersection in each. Returns false on failure. */
static bool bounds_of_operands(const vs_bounds_memo *m, const vs_node *n, vs_reach *b, vs_error *e) {
  uint32_t within = n->kind == VS_INTERSECTION ? n->child_count : n->kind == VS_DIFFERENCE && n->child_count;
  for (uint32_t i = 0; i < within; i++) {
    vs_reach child;
    if (!bounds_child(m, n->children[i].node, &child, e)) return false;
    if (i == 0 && n->kind == VS_DIFFERENCE) b->box = child.box;
    else vs_bounds_meet(&b->box, &child.box);
    if (i == 0 || child.ball.radius < b->ball.radius) b->ball = child.ball;
  }
  return true;
}

/* Sets *b to the box of node n, which is no placement. children: box of all its children together. Returns false on
 * failure. */
static bool bounds_of_other(const vs_node *n, vs_bounds children, vs_bounds *b, vs_error *e) {
  vs_affine placed = vs_affine_identity();
  bool leaf;
  *b = vs_bounds_empty();
  if (!bounds_leaf(n, &placed, &children, b, &leaf, e)) return false;
  if (leaf) return true;
  *b = children;
  if (n->kind == VS_HULL) vs_reach_points(b, &placed, VS_AS(hull, n)->points->at, VS_AS(hull, n)->points->count);
  if (n->kind == VS_SLICE) {
    vs_bounds kept;
    vs_half_space_bounds(&kept, &placed, VS_AS(slice, n)->point, VS_AS(slice, n)->normal);
    vs_bounds_meet(b, &kept);
  }
  if (n->kind == VS_SECTION || n->kind == VS_PROJECT) bounds_on_plane(b, n);
  if (n->kind == VS_DEFORM && !vs_bounds_is_empty(b)) { /* each point of a deformed solid is a weighted mean of the
                                                         * control points, so their bounds contain it */
    const struct vs_deform *d = VS_AS(deform, n);
    const vs_vec3 corner[8] = { d->c000, d->c100, d->c010, d->c110, d->c001, d->c101, d->c011, d->c111 };
    *b = vs_bounds_empty();
    for (int i = 0; i < 8; i++) vs_bounds_add(b, corner[i]);
  }
  return true;
}

/* Sets *b to the bounds of node n, whose children's bounds are known. children: bounds of all its children together.
 * Returns false on failure. */
static bool bounds_of(vs_bounds_memo *m, const vs_node *n, const vs_reach *children, vs_reach *b, vs_error *e) {
  b->box = vs_bounds_empty();
  b->ball = children->ball;
  if (n->kind == VS_TRANSFORM ? !bounds_of_placement(m, n, children, b, e)
                              : !bounds_of_other(n, children->box, &b->box, e) || !bounds_of_operands(m, n, b, e))
    return false;
  vs_ball around = vs_ball_of_box(&b->box);
  bool inside = n->kind == VS_TRANSFORM || vs_node_is_set(n) || vs_node_is_wrapper(n); /* in the ball of its children */
  if (!inside || around.radius < b->ball.radius) b->ball = around;
  return true;
}

/* children: bounds of the first `next` children of ref together */
typedef struct { vs_ref ref; uint32_t next; vs_reach children; } vs_bounds_step;

enum { CHILD_WORK = 64 }; /* work for the bounds of a child, in the units of vs_store_going */

bool vs_bounds_memo_get(vs_bounds_memo *m, const vs_node *n, vs_bounds *out, vs_error *e) {
  vs_store *s = m->places.store;
  if (n->child_count == 0 && bounds_plain(n, out)) return true; /* the formula of a common primitive is faster than a
                                                                 * search in the memo, so it is tried first */
  const vs_reach *known = bounds_memo_known(m, n);
  if (known) {
    *out = known->box;
    return true;
  }
  const vs_reach none = { vs_bounds_empty(), vs_ball_empty() };
  size_t depth = 1, room = 16;
  vs_bounds_step *steps = vs_store_realloc(s, NULL, 0, room * sizeof *steps);
  if (!steps) return vs_error_memory(e, NULL);
  steps[0] = (vs_bounds_step){ { (vs_node *)(uintptr_t)n, NULL }, 0, none };
  bool ok = true;
  while (ok && depth) {
    vs_bounds_step *top = &steps[depth - 1];
    const vs_node *at = top->ref.node;
    vs_reach b;
    for (; ok && top->next < at->child_count; top->next++) {
      const vs_node *child = vs_node_next_whole(at, top->next)->node;
      if (!bounds_is_lone_leaf(child) && !bounds_memo_known(m, child)) break;
      ok = bounds_child(m, child, &b, e);
      if (ok) vs_bounds_unite(&top->children.box, &b.box), vs_ball_unite(&top->children.ball, &b.ball);
      else if (e && !e->origin) e->origin = top->ref.origin;
      ok = ok && vs_store_going(s, CHILD_WORK, e);
    }
    if (!ok) break;
    if (top->next < at->child_count) {
      vs_ref below = at->children[top->next];
      if (depth == room) {
        vs_bounds_step *grown = vs_store_realloc(s, steps, room * sizeof *steps, 2 * room * sizeof *steps);
        ok = grown || vs_error_memory(e, NULL);
        if (!ok) break;
        steps = grown;
        room *= 2;
      }
      steps[depth++] = (vs_bounds_step){ below, 0, none };
      continue;
    }
    ok = bounds_of(m, at, &top->children, &b, e);
    if (!ok && e && !e->origin) e->origin = top->ref.origin;
    ok = ok && (bounds_memo_put(m, at, &b) || vs_error_memory(e, NULL));
    if (ok && at == n) *out = b.box;
    depth--;
  }
  vs_store_realloc(s, steps, room * sizeof *steps, 0);
  return ok;
}

/* n is an intersection or difference of regions, and *b contains the bounds of its operands. Reduces *b to the bounds
 * of n's outline. Returns false on failure. */
static bool bounds_of_set(const vs_node *n, vs_bounds *b, vs_error *e) {
  vs_fineness f = { bounds_fineness(b), 0 };
  vs_outline o;
  if (!vs_region_outline(n, &f, &o, e)) return false;
  *b = vs_bounds_empty();
  for (size_t l = 0; l < o.count; l++)
    for (size_t i = 0; i < o.loops[l].count; i++) vs_bounds_add(b, o.loops[l].at[i]);
  vs_outline_free(&o);
  return true;
}

bool vs_node_bounds(const vs_node *n, vs_bounds *out, vs_error *e) {
  vs_bounds_memo m = { .places = { .store = n->store } };
  bool ok = vs_bounds_memo_get(&m, n, out, e);
  vs_bounds_memo_free(&m);
  const vs_node *below = n;
  while (vs_node_is_around(below))
    below = below->children[0].node;
  bool set = below->class_ == VS_REGION_CLASS && (below->kind == VS_INTERSECTION || below->kind == VS_DIFFERENCE);
  return ok && (!set || vs_bounds_is_empty(out) || bounds_of_set(n, out, e));
}

bool vs_line_clip(vs_vec3 p, vs_vec3 d, bool ray, const vs_bounds *b, vs_vec3 *from, vs_vec3 *to) {
  double low = ray ? 0 : -INFINITY, high = INFINITY;
  double at[3] = { p.x, p.y, p.z }, way[3] = { d.x, d.y, d.z }, min[3] = { b->min.x, b->min.y, b->min.z },
         max[3] = { b->max.x, b->max.y, b->max.z };
  for (int i = 0; i < 3; i++) {
    if (way[i] == 0) {
      if (at[i] < min[i] || at[i] > max[i]) return false;
      continue;
    }
    double t = (min[i] - at[i]) / way[i], u = (max[i] - at[i]) / way[i];
    low = fmax(low, fmin(t, u));
    high = fmin(high, fmax(t, u));
  }
  if (!(low < high) || !isfinite(low) || !isfinite(high)) return false;
  *from = vs_v3_add(p, vs_v3_scale(d, low));
  *to = vs_v3_add(p, vs_v3_scale(d, high));
  return true;
}
