/* Tests whether a point is inside a solid. The test uses formulas and the sections of sweeps, but no mesh of the
 * kernel.
 *
 * The model is prepared once, and each distinct node only once: its bounds, the inverses of placements, and the
 * sections of swept solids. A test walks the tree with an explicit stack, and maps the point into the coordinates of
 * each placement. It skips nodes by their bounds, and stops at the first part that decides the answer. In a drawing of
 * disjoint parts it takes one test of a box for each part.
 *
 * Between the sections S_0 and S_1 of a sweep, a point p lies in the section t with g(t) = (X_t x Y_t) . (p - O_t) = 0.
 * This is a cubic equation; its roots in [0, 1] give the coordinates (u, v) of p in the profile's plane. Polyface
 * meshes, lofts and thickened surfaces are tested by their facets. */
#include "geometry/measure/inside.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/measure/ray_crossings.h"
#include "geometry/tessellate.h"
#include "geometry/frame.h"
#include "geometry/measure/bounds.h"
#include "geometry/plane/areas.h"
#include "geometry/plane/planar_evaluation.h"
#include "geometry/primitives/shape.h"
#include "geometry/profiles/revolve.h"
#include "geometry/profiles/swept.h"
#include "model/store/array.h"
#include "model/walk.h"

typedef struct {
  const vs_node *node;
  vs_bounds bounds;
  vs_affine inverse;  /* map into the child's coordinates if the node is a placement; for a solid with an axis, map into
                       * a frame whose Z axis is that axis */
  double height;      /* for a solid with an axis: length of this axis */
  size_t *children;   /* children[i]: index of the part that was prepared for child i */
  vs_swept *plan;
  vs_revolve *turned;
  vs_bounds *between; /* between[i]: bounds of the space that the sweep fills between sections i and i + 1 */
  vs_facet_index *facets;
} vs_inside_part;

typedef struct { size_t part; uint32_t next; vs_vec3 p; } vs_inside_level;

struct vs_inside {
  vs_node *root;
  vs_inside_part *parts;
  size_t count, room, first;
  vs_inside_level *stack;
  size_t cost; /* approximate memory of this prepared node, in bytes */
};

/* ---- formulas ---- */

static double cubic_at(const double c[4], double t) { return ((c[3] * t + c[2]) * t + c[1]) * t + c[0]; }

/* Finds the roots in [0, 1] of the cubic with the coefficients c, by bisection between the places where its slope
 * changes sign. Returns their number. */
static int cubic_roots(const double c[4], double roots[4]) {
  double ends[4] = { 0 }, a = 3 * c[3], b = 2 * c[2], d = b * b - 4 * a * c[1];
  int n = 1, found = 0;
  if (d >= 0) {
    double q = -0.5 * (b + (b < 0 ? -sqrt(d) : sqrt(d))), r[2] = { a != 0 ? q / a : -1, q != 0 ? c[1] / q : -1 };
    if (r[0] > r[1]) {
      double swap = r[0];
      r[0] = r[1];
      r[1] = swap;
    }
    for (int i = 0; i < 2; i++)
      if (r[i] > 0 && r[i] < 1) ends[n++] = r[i];
  }
  ends[n++] = 1;
  for (int i = 0; i + 1 < n; i++) {
    double low = ends[i], high = ends[i + 1], at_low = cubic_at(c, low), at_high = cubic_at(c, high);
    if (at_low == 0) roots[found++] = low;
    else if ((at_low < 0) != (at_high < 0)) {
      for (int k = 0; k < 60; k++) {
        double middle = (low + high) / 2, value = cubic_at(c, middle);
        if ((value < 0) == (at_low < 0)) low = middle;
        else high = middle;
      }
      roots[found++] = (low + high) / 2;
    } else if (i + 2 == n && at_high == 0) roots[found++] = high;
  }
  return found;
}

static bool inside_between(const vs_swept *s, const vs_section *a, const vs_section *b, vs_vec3 p) {
  vs_vec3 dx = vs_v3_sub(b->x, a->x), dy = vs_v3_sub(b->y, a->y), dat = vs_v3_sub(b->at, a->at),
          q = vs_v3_sub(p, a->at);
  vs_vec3 n0 = vs_v3_cross(a->x, a->y), n1 = vs_v3_add(vs_v3_cross(dx, a->y), vs_v3_cross(a->x, dy)),
          n2 = vs_v3_cross(dx, dy);
  double c[4] = { vs_v3_dot(n0, q), vs_v3_dot(n1, q) - vs_v3_dot(n0, dat), vs_v3_dot(n2, q) - vs_v3_dot(n1, dat),
                  -vs_v3_dot(n2, dat) },
         roots[4];
  int n = cubic_roots(c, roots);
  for (int i = 0; i < n; i++) {
    vs_section at = vs_section_between(a, b, roots[i]);
    vs_vec3 d = vs_v3_sub(p, at.at);
    double xx = vs_v3_dot(at.x, at.x), xy = vs_v3_dot(at.x, at.y), yy = vs_v3_dot(at.y, at.y), det = xx * yy - xy * xy;
    if (!(det > 1e-24 * (xx + yy) * (xx + yy))) continue; /* the section has shrunk to a point, the apex */
    double dx_ = vs_v3_dot(d, at.x), dy_ = vs_v3_dot(d, at.y);
    if (vs_loops_hold(s->profile, s->sizes, s->loop_count, (dx_ * yy - dy_ * xy) / det, (dy_ * xx - dx_ * xy) / det))
      return true;
  }
  return false;
}

static bool bounds_hold(const vs_bounds *b, vs_vec3 p) {
  return p.x >= b->min.x && p.x <= b->max.x && p.y >= b->min.y && p.y <= b->max.y && p.z >= b->min.z && p.z <= b->max.z;
}

static bool inside_swept(const vs_inside_part *part, vs_vec3 p) {
  const vs_swept *s = part->plan;
  size_t n = s->joined ? s->section_count : s->section_count - 1;
  for (size_t i = 0; i < n; i++)
    if (!s->sections[i].ends && bounds_hold(&part->between[i], p) &&
        inside_between(s, &s->sections[i], &s->sections[i + 1 == s->section_count ? 0 : i + 1], p))
      return true;
  return false;
}

static bool inside_leaf(const vs_inside_part *part, vs_vec3 p) {
  const vs_node *n = part->node;
  switch ((vs_kind)n->kind) {
#include "model/cases/shape_cases.def"
      return vs_shape_of(n)->holds(n, p, vs_affine_point(&part->inverse, p), part->height);
  case VS_EXTRUDE:
  case VS_SWEEP:
  case VS_THICKEN: return part->plan ? inside_swept(part, p) : part->facets && vs_facet_index_holds(part->facets, p);
  case VS_POLYFACE_MESH: return part->facets && vs_facet_index_holds(part->facets, p);
  case VS_HULL: return part->facets && vs_facet_index_holds(part->facets, p);
  case VS_REVOLVE: return part->turned && vs_revolve_holds(part->turned, p);
  case VS_LOFT:
  case VS_RULED_LOFT:
  case VS_GUIDED_LOFT:
  case VS_GRID_MESH:
  case VS_GRID_SURFACE: return part->facets && vs_facet_index_holds(part->facets, p);
  case VS_JOIN:
  case VS_XLINE:
  case VS_RAY:
  case VS_OFFSET:
  case VS_SECTION:
  case VS_PROJECT:
  case VS_EDGES:
  case VS_SLICE:
  case VS_DEFORM:
  case VS_CUSTOM:
  case VS_GHOST:
  case VS_EMPTY:
  case VS_LINE:
  case VS_ARC:
  case VS_CIRCLE:
  case VS_SPLINE:
  case VS_REGION:
  case VS_TEXT:
#include "model/cases/passed_cases.def"
    break;
  }
  return false;
}

/* ---- preparation ---- */

static bool inside_prepare_swept(vs_inside_part *part, double tolerance, vs_error *e) {
  vs_fineness f = { fmin(fmax(vs_bounds_diagonal(&part->bounds) / 16384, 1e-300), tolerance), 0 };
  part->plan = vs_zeros(1, sizeof *part->plan);
  if (!part->plan) return vs_error_memory(e, NULL);
  if (!vs_swept_plan(part->node, &f, part->plan, e)) return false;
  const vs_swept *s = part->plan;
  part->between = vs_fresh(s->section_count, sizeof *part->between);
  if (!part->between) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < s->section_count; i++) {
    part->between[i] = vs_bounds_empty();
    for (size_t k = i; k < i + 2; k++) {
      const vs_section *at = &s->sections[k == s->section_count ? 0 : k];
      for (size_t j = 0; j < s->profile_count; j++)
        vs_bounds_add(
            &part->between[i],
            vs_v3_add(vs_v3_add(vs_v3_scale(at->x, s->profile[j].x), vs_v3_scale(at->y, s->profile[j].y)), at->at));
    }
    vs_bounds_unite(&part->bounds, &part->between[i]);
  }
  return true;
}

static bool inside_prepare_facets(vs_inside_part *part, double tolerance, vs_error *e) {
  vs_fineness f = { fmin(fmax(vs_bounds_diagonal(&part->bounds) / 16384, 1e-300), tolerance), 0 };
  part->facets = vs_zeros(1, sizeof *part->facets);
  if (!part->facets) return vs_error_memory(e, NULL);
  return vs_tessellate(part->node, &f, &part->facets->mesh, e) &&
         (vs_facet_index_make(part->facets) || vs_error_memory(e, NULL));
}

static bool inside_prepare_revolve(vs_inside_part *part, double tolerance, vs_error *e) {
  vs_fineness f = { fmin(fmax(vs_bounds_diagonal(&part->bounds) / 65536, 1e-300), tolerance), 0 };
  part->turned = vs_zeros(1, sizeof *part->turned);
  return part->turned ? vs_revolve_plan(part->node, &f, part->turned, e) : vs_error_memory(e, NULL);
}

static bool inside_prepare_axis(vs_inside_part *part) {
  const vs_shape *shape = vs_shape_of(part->node);
  vs_vec3 base, top;
  if (!shape->axis) return true;
  shape->axis(part->node, &base, &top);
  vs_vec3 axis = vs_v3_sub(top, base);
  vs_affine frame = vs_frame_on_axis(base, axis);
  part->height = vs_v3_length(axis);
  return vs_affine_invert(&frame, &part->inverse);
}

/* Prepares the test for node n. The parts of its children are already prepared. Returns false on failure. */
static bool inside_prepare(vs_inside_part *part, const vs_nodemap *places, double tolerance, vs_error *e) {
  const vs_node *n = part->node;
  part->inverse = vs_affine_identity();
  switch ((vs_kind)n->kind) {
    case VS_JOIN: case VS_XLINE: case VS_RAY: case VS_OFFSET: case VS_SECTION: case VS_PROJECT: case VS_EDGES:
    case VS_EMPTY: case VS_GHOST: case VS_SLICE: case VS_DEFORM: return true;
    /* A curve or region, which may be the profile of a solid, has no volume and contains no point. */
    case VS_LINE: case VS_ARC: case VS_CIRCLE: case VS_SPLINE: case VS_REGION: case VS_TEXT: return true;
#include "model/cases/shape_cases.def"
      return inside_prepare_axis(part);
    case VS_EXTRUDE: case VS_SWEEP:
      /* An extrusion with inclined walls has planar walls, so the test with its mesh is exact. */
      if (n->kind == VS_EXTRUDE && VS_AS(extrude, n)->taper != 0) return inside_prepare_facets(part, tolerance, e);
      return n->class_ != VS_SOLID || inside_prepare_swept(part, tolerance, e);
    case VS_THICKEN:
      if (n->class_ != VS_SOLID) return true;
      return n->children[0].node->class_ == VS_SURFACE ? inside_prepare_facets(part, tolerance, e)
                                                       : inside_prepare_swept(part, tolerance, e);
    case VS_POLYFACE_MESH: case VS_HULL: return n->class_ != VS_SOLID || inside_prepare_facets(part, tolerance, e);
    case VS_REVOLVE: return n->class_ != VS_SOLID || inside_prepare_revolve(part, tolerance, e);
    case VS_LOFT: case VS_RULED_LOFT: case VS_GUIDED_LOFT: case VS_GRID_MESH: case VS_GRID_SURFACE:
      return n->class_ != VS_SOLID || inside_prepare_facets(part, tolerance, e);
    case VS_TRANSFORM:
      /* A placement that flattens its child has no inverse. The flattened child contains no point, so its bounds are
       * empty. */
      if (!vs_affine_invert(&VS_AS(transform, n)->matrix, &part->inverse)) part->bounds = vs_bounds_empty();
      break;
    case VS_MATERIAL: case VS_LAYER: case VS_UNION: case VS_INTERSECTION: case VS_DIFFERENCE: case VS_KIND_COUNT:
    case VS_NATIVE: case VS_CUSTOM: case VS_PART: case VS_HIGHLIGHT: case VS_ONLY: break;
  }
  part->children = vs_fresh(n->child_count, sizeof *part->children);
  if (!part->children) return vs_error_memory(e, NULL);
  for (uint32_t i = 0; i < n->child_count; i++)
    part->children[i] = (size_t)*vs_nodemap_get(places, n->children[i].node);
  return true;
}

void vs_inside_free(vs_inside *v) {
  if (!v) return;
  for (size_t i = 0; i < v->count; i++) {
    vs_inside_part *p = &v->parts[i];
    if (p->plan) vs_swept_free(p->plan);
    if (p->facets) vs_facet_index_free(p->facets);
    if (p->turned) vs_revolve_free(p->turned);
    free(p->turned);
    free(p->plan);
    free(p->facets);
    free(p->between);
    free(p->children);
  }
  free(v->parts);
  free(v->stack);
  vs_node_release(v->root);
  free(v);
}

vs_inside *vs_inside_new(const vs_node *n, vs_error *e) { return vs_inside_within(n, INFINITY, e); }

vs_inside *vs_inside_within(const vs_node *n, double tolerance, vs_error *e) {
  vs_inside *v = vs_zeros(1, sizeof *v);
  vs_nodemap places = { .store = n->store };
  vs_bounds_memo bounds = { .places = { .store = n->store } };
  vs_walk *w = v ? vs_walk_new(n->store, (vs_ref){ (vs_node *)(uintptr_t)n, NULL }) : NULL;
  bool ok = w || vs_error_memory(e, NULL);
  vs_walk_event ev;
  vs_ref at;
  size_t deepest = 0, depth;
  if (w) v->root = vs_node_retain((vs_node *)(uintptr_t)n);
  while (ok && (ev = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE) {
    bool found = false;
    if (depth > deepest) deepest = depth;
    if (ev == VS_WALK_FAILED) ok = vs_error_memory(e, NULL);
    else if (vs_nodemap_get(&places, at.node)) {
      if (ev == VS_WALK_ENTER) vs_walk_skip(w);
    } else if (ev == VS_WALK_LEAVE) {
      ok = VS_GROW(v->parts, v->room, v->count + 1) || vs_error_memory(e, NULL);
      if (ok) {
        vs_inside_part *part = &v->parts[v->count++];
        *part = (vs_inside_part){ .node = at.node };
        uint64_t *place = vs_nodemap_put(&places, at.node, &found);
        ok = place || vs_error_memory(e, NULL);
        if (place) *place = v->count - 1;
        ok = ok && vs_bounds_memo_get(&bounds, at.node, &part->bounds, e) &&
             inside_prepare(part, &places, tolerance, e);
        v->cost += sizeof *part + at.node->child_count * sizeof(size_t);
        if (part->plan)
          v->cost += part->plan->section_count * (sizeof(vs_section) + sizeof(vs_bounds)) +
                     part->plan->profile_count * sizeof(vs_vec2);
        if (part->turned) v->cost += part->turned->count * sizeof(vs_vec2);
        if (part->facets) v->cost += vs_facet_index_bytes(part->facets);
        if (!ok && e && !e->origin) e->origin = at.origin;
      }
    }
  }
  vs_walk_free(w);
  vs_nodemap_free(&places);
  vs_bounds_memo_free(&bounds);
  if (ok) {
    v->first = v->count - 1;
    v->stack = vs_fresh(n->depth + (size_t)2, sizeof *v->stack);
    ok = v->stack || vs_error_memory(e, NULL);
  }
  if (ok) return v;
  vs_inside_free(v);
  return NULL;
}

/* ---- tests ---- */

static bool inside_is_set(const vs_node *n) {
  return vs_node_is_set(n) || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n);
}

bool vs_inside_test(vs_inside *v, vs_vec3 p) {
  size_t depth = 0, part = v->first;
  bool answer;
  for (;;) {
    const vs_inside_part *x = &v->parts[part];
    if (!bounds_hold(&x->bounds, p)) answer = false;
    else if (!inside_is_set(x->node)) answer = inside_leaf(x, p);
    else if (!x->node->child_count) answer = false;
    else {
      v->stack[depth++] = (vs_inside_level){ part, 1, p };
      p = vs_affine_point(&x->inverse, p);
      part = x->children[0];
      continue;
    }
    for (;;) { /* passes the answer up from a node to its parent, until a parent needs the answer of another child */
      if (!depth) return answer;
      vs_inside_level *top = &v->stack[depth - 1];
      const vs_inside_part *above = &v->parts[top->part];
      bool first = top->next == 1, decided;
      vs_kind kind = (vs_kind)above->node->kind;
      if (kind == VS_UNION) decided = answer;
      else if (kind == VS_INTERSECTION) decided = !answer;
      else if (kind == VS_DIFFERENCE) {
        decided = first ? !answer : answer;
        if (!first) answer = !answer; /* the child is subtracted, so a point inside it is outside the difference */
      } else decided = true; /* a node with one child contains the point if its child does */
      if (decided || top->next == above->node->child_count) {
        depth--;
        continue;
      }
      p = top->p;
      part = above->children[top->next++];
      break;
    }
  }
}

bool vs_node_contains(const vs_node *n, vs_vec3 p, bool *inside, vs_error *e) {
  vs_inside *v = vs_inside_new(n, e);
  if (!v) return false;
  *inside = vs_inside_test(v, p);
  vs_inside_free(v);
  return true;
}

/* ---- a cache, for tests of several nodes in any order ---- */

enum { CACHE_SLOTS = 8192, CACHE_BYTES = 50 << 20 };
struct vs_inside_cache { size_t bytes; vs_inside *at[CACHE_SLOTS]; };

static void inside_cache_clear(vs_inside_cache *c) {
  for (size_t i = 0; i < CACHE_SLOTS; i++) {
    vs_inside_free(c->at[i]);
    c->at[i] = NULL;
  }
  c->bytes = 0;
}

void vs_inside_cache_free(vs_inside_cache *c) {
  if (c) inside_cache_clear(c);
  free(c);
}

bool vs_inside_cached(vs_inside_cache **cache, const vs_node *n, vs_vec3 p, bool *inside, vs_error *e) {
  if (!*cache && !(*cache = vs_zeros(1, sizeof **cache))) return vs_error_memory(e, NULL);
  vs_inside_cache *c = *cache;
  /* Equal nodes have equal shapes. Therefore data prepared for a node are also used for equal nodes. */
  vs_inside **slot = &c->at[(n->hash ^ n->hash >> 32) % CACHE_SLOTS];
  if (!*slot || ((*slot)->root != n && !((*slot)->root->hash == n->hash && vs_node_equal((*slot)->root, n, NULL)))) {
    vs_inside *new = vs_inside_new(n, e);
    if (!new) return false;
    if (c->bytes + new->cost > CACHE_BYTES) inside_cache_clear(c);
    if (*slot) c->bytes -= (*slot)->cost;
    vs_inside_free(*slot);
    *slot = new;
    c->bytes += new->cost;
  }
  *inside = vs_inside_test(*slot, p);
  return true;
}

bool vs_region_contains(const vs_node *n, vs_vec3 p, bool *inside, vs_error *e) {
  vs_bounds b;
  vs_outline o;
  vs_area a = { 0 };
  *inside = false;
  if (!vs_node_bounds(n, &b, e)) return false;
  vs_fineness f = { fmax(vs_bounds_diagonal(&b) * 1e-7, 1e-300), 0 };
  if (!vs_region_outline(n, &f, &o, e)) return false;
  bool ok = vs_area_of_outline(&o, &o.frame, &a) || vs_error_memory(e, NULL);
  vs_vec3 x = { o.frame.m[0][0], o.frame.m[1][0], o.frame.m[2][0] },
          y = { o.frame.m[0][1], o.frame.m[1][1], o.frame.m[2][1] };
  vs_vec3 d = vs_v3_sub(p, vs_v3(o.frame.m[0][3], o.frame.m[1][3], o.frame.m[2][3]));
  if (ok && fabs(vs_v3_dot(d, o.normal)) <= 1e-9 * vs_bounds_diagonal(&b))
    *inside = vs_area_holds(&a, vs_v3_dot(d, x), vs_v3_dot(d, y));
  vs_area_free(&a);
  vs_outline_free(&o);
  return ok;
}
