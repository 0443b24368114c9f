/* Writes OpenSCAD programs that people can read: booleans as operations, modules for repeated parts, polyhedra for all
 * other shapes.
 *
 * OpenSCAD's polyhedra are clockwise seen from outside. Objects of two and of three dimensions must not be mixed, so
 * only solids are written. In OpenSCAD the outermost color() determines the colour, but here the innermost material
 * does. Therefore color() is written around the largest subtrees that contain no other paint. A module that is painted
 * in part receives the colour for its other parts as $paint. */
#include <math.h>

#include "backends/lower.h"
#include "geometry/plane/outline.h"
#include "geometry/plane/planar_evaluation.h"
#include "backends/backend.h"
#include "backends/openscad/touching_corners.h"
#include "geometry/frame.h"
#include "geometry/plane/plane.h"
#include "geometry/profiles/revolve.h"
#include "model/walk.h"

static vs_emit_status scad_done(vs_emitter *e) { return e->out->failed ? VS_FAILED : VS_EMITTED; }
static void scad_point(vs_emitter *e, vs_vec3 p) { vs_put_triple(e->out, "[", p, ", ", "]"); }
static void scad_number(vs_emitter *e, const char *before, double x) {
  vs_puts(e->out, before);
  vs_put_number(e->out, x);
}

static void scad_translate(vs_emitter *e, vs_vec3 by) {
  if (by.x == 0 && by.y == 0 && by.z == 0) return;
  vs_puts(e->out, "translate(");
  scad_point(e, by);
  vs_puts(e->out, ") ");
}

static void scad_matrix(vs_emitter *e, const vs_affine *a, const char *after) {
  vs_puts(e->out, "multmatrix([");
  for (int row = 0; row < 3; row++)
    for (int column = 0; column < 4; column++)
      scad_number(e, column == 0 ? "[" : ", ", a->m[row][column]), vs_puts(e->out, column == 3 ? "], " : "");
  vs_puts(e->out, "[0, 0, 0, 1]])");
  vs_puts(e->out, after);
}

static void scad_place(vs_emitter *e, const vs_affine *a) {
  if (vs_affine_is_translation(a)) scad_translate(e, vs_v3(a->m[0][3], a->m[1][3], a->m[2][3]));
  else scad_matrix(e, a, " ");
}

static void scad_color(vs_emitter *e, const vs_material *m) {
  vs_puts(e->out, "[");
  vs_put_triple(e->out, "", vs_v3(m->red, m->green, m->blue), ", ", "");
  if (m->transparency > 0) scad_number(e, ", ", 1 - 0.8 * m->transparency);
  vs_puts(e->out, "]");
}

static bool scad_is_mixed(vs_emitter *e, const vs_node *n) { return vs_emit_is_painted(e, n) && vs_emit_is_bare(e, n); }

/* Begins a statement: writes the indentation, and color() if n is the top node of a subtree with a single colour. */
static void scad_open(vs_emitter *e, const vs_node *n) {
  vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40));
  bool covered = e->parent != NULL && e->parent->kind != VS_MATERIAL && !vs_emit_is_painted(e, e->parent);
  if (covered || vs_emit_is_painted(e, n)) return;
  if (e->material != NULL) {
    vs_puts(e->out, "color(");
    scad_color(e, e->material);
    vs_puts(e->out, ") ");
  } else if (e->body != NULL && scad_is_mixed(e, e->body)) {
    vs_puts(e->out, "color($paint) ");
  }
}

/* Returns the thickness of points, curves and surfaces, which OpenSCAD can show only as thin solids. */
static double scad_thin(const vs_emitter *e) { return 0.0012 * vs_v3_length(vs_v3_sub(e->bounds.max, e->bounds.min)); }

/* ---- primitives ---- */

static vs_emit_status scad_box(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_box *b = VS_AS(box, ref->node);
  scad_open(e, ref->node);
  scad_translate(e, b->p);
  vs_puts(e->out, "cube(");
  scad_point(e, vs_v3_sub(b->q, b->p));
  vs_puts(e->out, ");\n");
  return scad_done(e);
}

static vs_emit_status scad_sphere(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_sphere *s = VS_AS(sphere, ref->node);
  if (s->segments > 0) return VS_LOWER; /* OpenSCAD does not place a sphere's facets as VisualScheme does, so a sphere
                                         * with a given number of facets becomes a mesh */
  scad_open(e, ref->node);
  scad_translate(e, s->center);
  scad_number(e, "sphere(r = ", s->radius);
  vs_putf(e->out, ", $fn = %d);\n", vs_fineness_turn(&e->facets, s->radius, s->segments));
  return scad_done(e);
}

/* A solid of revolution, or a solid with a regular polygon as its base. Its axis is the segment from the centre of the
 * base to the centre of the top. */
typedef struct {
  vs_vec3 base, top;
  double base_radius, top_radius; /* radii of base and top; for a regular polygon, the distances of its corners from the
                                   * axis */
  int facets;                     /* number of facets in a full turn */
} scad_frustum;

static vs_emit_status scad_turned(vs_emitter *e, const vs_node *n, const scad_frustum *f) {
  vs_vec3 axis = vs_v3_sub(f->top, f->base);
  vs_affine place = vs_frame_on_axis(f->base, axis);
  scad_open(e, n);
  scad_place(e, &place);
  scad_number(e, "cylinder(h = ", vs_v3_length(axis));
  if (f->base_radius == f->top_radius) {
    scad_number(e, ", r = ", f->base_radius);
  } else {
    scad_number(e, ", r1 = ", f->base_radius);
    scad_number(e, ", r2 = ", f->top_radius);
  }
  vs_putf(e->out, ", $fn = %d);\n", f->facets);
  return scad_done(e);
}

static vs_emit_status scad_cylinder(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cylinder *c = VS_AS(cylinder, ref->node);
  int facets = vs_fineness_turn(&e->facets, c->radius, c->segments);
  return scad_turned(e, ref->node, &(scad_frustum){ c->base, c->top, c->radius, c->radius, facets });
}

static vs_emit_status scad_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cone *c = VS_AS(cone, ref->node);
  int facets = vs_fineness_turn(&e->facets, c->radius, c->segments);
  return scad_turned(e, ref->node, &(scad_frustum){ c->base, c->apex, c->radius, 0, facets });
}

static vs_emit_status scad_cut_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_cut_cone *c = VS_AS(cut_cone, ref->node);
  int facets = vs_fineness_turn(&e->facets, fmax(c->base_radius, c->top_radius), c->segments);
  return scad_turned(e, ref->node, &(scad_frustum){ c->base, c->top, c->base_radius, c->top_radius, facets });
}

static vs_emit_status scad_e_cone(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_e_cone *c = VS_AS(e_cone, ref->node);
  double wide = c->base_across / c->base_radius;
  vs_vec3 axis = vs_v3_sub(c->top, c->base);
  vs_affine place = vs_frame_on_axis(c->base, axis);
  scad_open(e, ref->node);
  scad_place(e, &place);
  scad_number(e, "scale([1, ", wide);
  scad_number(e, ", 1]) cylinder(h = ", vs_v3_length(axis));
  scad_number(e, ", r1 = ", c->base_radius);
  scad_number(e, ", r2 = ", c->top_radius);
  vs_putf(e->out, ", $fn = %d);\n",
          vs_fineness_turn(&e->facets, fmax(1, wide) * fmax(c->base_radius, c->top_radius), c->segments));
  return scad_done(e);
}

static vs_emit_status scad_pyramid(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_pyramid *p = VS_AS(pyramid, ref->node);
  return scad_turned(e, ref->node,
                     &(scad_frustum){ p->base, p->top, p->base_radius, p->top_radius, (int)p->sides });
}

/* Writes a half-space as a cube that lies on its plane and contains everything that the half-space can cut. */
static vs_emit_status scad_half_space(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_half_space *h = VS_AS(half_space, ref->node);
  vs_vec3 n = vs_v3_unit(h->normal), middle = vs_v3_scale(vs_v3_add(e->reach.min, e->reach.max), 0.5);
  double height = vs_v3_dot(n, vs_v3_sub(middle, h->point)), half = vs_bounds_diagonal(&e->reach) * 0.5625;
  if (height < -half) height = -half; /* moves a plane outside e->reach to its border */
  if (height > half) height = half;
  vs_affine place = vs_frame_on_axis(vs_v3_sub(middle, vs_v3_scale(n, height)), n);
  /* A face perpendicular to a coordinate axis gets exactly the coordinate of the half-space's point. */
  if (fabs(height) < half)
    for (int i = 0; i < 3; i++)
      if (fabs(place.m[i][2]) == 1) place.m[i][3] = (&h->point.x)[i];
  scad_open(e, ref->node);
  scad_place(e, &place);
  scad_translate(e, vs_v3(-half, -half, 0));
  scad_number(e, "cube(", 2 * half);
  vs_puts(e->out, ");\n");
  return scad_done(e);
}

static vs_emit_status scad_torus(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_torus *t = VS_AS(torus, ref->node);
  if (t->tube_radius >= t->radius) return VS_LOWER; /* rotate_extrude refuses a profile that crosses the axis */
  scad_open(e, ref->node);
  scad_translate(e, t->center);
  vs_putf(e->out, "rotate_extrude($fn = %d) ", vs_fineness_turn(&e->facets, t->radius + t->tube_radius, t->segments));
  scad_number(e, "translate([", t->radius);
  scad_number(e, ", 0]) circle(r = ", t->tube_radius);
  vs_putf(e->out, ", $fn = %d);\n", vs_fineness_turn(&e->facets, t->tube_radius, t->segments));
  return scad_done(e);
}

/* ---- polyhedra and prisms ---- */

static void scad_wrap(vs_emitter *e, size_t item, size_t per_line) {
  if (item > 0) vs_puts(e->out, ",");
  if (item > 0 && item % per_line == 0) {
    vs_puts(e->out, "\n");
    vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40) + 4);
  } else if (item > 0) {
    vs_puts(e->out, " ");
  }
}

static vs_emit_status scad_slab(vs_emitter *e, const vs_ref *ref);

static vs_emit_status scad_polyface(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_polyface_mesh *p = VS_AS(polyface_mesh, ref->node);
  if (!p->closed) return scad_slab(e, ref);
  vs_apart apart = { 0 };
  if (p->closed && !vs_apart_make(p, &apart)) return vs_emit_no_memory(e), VS_FAILED;
  const uint32_t *starts = vs_faces_starts(p->faces),
                 *corners = apart.corners ? apart.corners : vs_faces_corners(p->faces);
  const vs_vec3 *points = apart.points ? apart.points : p->points->at;
  size_t count = apart.points ? apart.count : p->points->count;
  if (!vs_emit_triangles(e, p->faces->corner_count - 2 * (size_t)p->faces->count))
    return vs_apart_free(&apart), VS_FAILED;
  scad_open(e, ref->node);
  vs_puts(e->out, "polyhedron(points = [");
  for (size_t i = 0; i < count; i++) {
    scad_wrap(e, i, 6);
    scad_point(e, points[i]);
  }
  vs_puts(e->out, "],\n");
  vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40) + 2);
  vs_puts(e->out, "faces = [");
  for (size_t i = 0; i < p->faces->count; i++) {
    scad_wrap(e, i, 10);
    for (uint32_t k = starts[i + 1]; k > starts[i]; k--) {
      vs_puts(e->out, k == starts[i + 1] ? "[" : ", ");
      vs_put_u32(e->out, corners[k - 1]);
    }
    vs_puts(e->out, "]");
  }
  vs_puts(e->out, "], convexity = 10);\n");
  vs_apart_free(&apart);
  return scad_done(e);
}

/* Writes an open surface as a thickened solid. Omits, with a warning, a part that cannot be thickened to a solid. */
static vs_emit_status scad_slab(vs_emitter *e, const vs_ref *ref) {
  struct vs_thicken thick = { .width = scad_thin(e) };
  vs_store *store = e->scene->store;
  vs_node *slab = vs_node_new(store, VS_THICKEN, &thick, ref, 1), *made = NULL;
  if (slab == NULL) return vs_emit_no_memory(e), VS_FAILED;
  vs_emit_status status = VS_FAILED;
  vs_ref whole = { slab, ref->origin };
  made = vs_lower(e, &whole);
  if (made == NULL && e->error->kind == VS_ERROR_MODEL) {
    e->error->kind = VS_ERROR_NONE;
    if (vs_emit_warn_once(
            e, ref, "OpenSCAD programs hold solids: open surfaces that cannot be thickened to solids are omitted"))
      status = VS_EMITTED;
  } else if (made != NULL && made->kind != VS_POLYFACE_MESH) {
    status = VS_EMITTED;
  } else if (made != NULL && vs_emit_warn_once(e, ref,
      "OpenSCAD programs hold solids: open surfaces are drawn as thin slabs")) {
    status = scad_polyface(e, &(vs_ref){ made, ref->origin }, VS_PHASE_LEAF);
  }
  vs_node_release(made);
  vs_node_release(slab);
  return status;
}

/* Writes the loops of an outline as polygon(points, paths). Holes are inner paths, by the even-odd rule. */
static void scad_polygon(vs_emitter *e, const vs_outline *o, const vs_affine *back) {
  size_t shown = 0;
  vs_puts(e->out, "polygon([");
  for (size_t i = 0; i < o->count; i++)
    for (size_t k = 0; k < o->loops[i].count; k++) {
      vs_vec3 p = vs_affine_point(back, o->loops[i].at[k]);
      scad_wrap(e, shown++, 8);
      scad_number(e, "[", p.x);
      scad_number(e, ", ", p.y);
      vs_puts(e->out, "]");
    }
  vs_puts(e->out, "]");
  if (o->count > 1) {
    vs_puts(e->out, ", [");
    size_t at = 0;
    for (size_t i = 0; i < o->count; i++) {
      vs_puts(e->out, i == 0 ? "[" : ", [");
      for (size_t k = 0; k < o->loops[i].count; k++) {
        if (k > 0) vs_puts(e->out, ", ");
        vs_put_u32(e->out, (uint32_t)at++);
      }
      vs_puts(e->out, "]");
    }
    vs_puts(e->out, "]");
  }
  vs_puts(e->out, ");\n");
}

/* Writes the loops of a revolution's profile. A point has its distance from the axis as x and its height as y. */
static void scad_profile(vs_emitter *e, const vs_revolve *r) {
  vs_puts(e->out, "polygon([");
  for (size_t i = 0; i < r->count; i++) {
    scad_wrap(e, i, 8);
    scad_number(e, "[", r->profile[i].x);
    scad_number(e, ", ", r->profile[i].y);
    vs_puts(e->out, "]");
  }
  vs_puts(e->out, "]");
  for (size_t l = 0, at = 0; r->loop_count > 1 && l < r->loop_count; l++) {
    vs_puts(e->out, l == 0 ? ", [[" : "], [");
    for (size_t k = 0; k < r->sizes[l]; k++) {
      if (k > 0) vs_puts(e->out, ", ");
      vs_put_u32(e->out, (uint32_t)at++);
    }
  }
  vs_puts(e->out, r->loop_count > 1 ? "]]);\n" : ");\n");
}

/* Returns true if the profile touches the axis only at a corner. The revolved solid then touches itself at that point,
 * which OpenSCAD refuses in a boolean. */
static bool scad_pinches(const vs_revolve *r) {
  for (size_t l = 0, first = 0; l < r->loop_count; first += r->sizes[l++])
    for (size_t i = 0, n = r->sizes[l]; i < n; i++)
      if (r->profile[first + i].x == 0 && r->profile[first + (i + 1) % n].x != 0 &&
          r->profile[first + (i + n - 1) % n].x != 0)
        return true;
  return false;
}

/* rotate_extrude rotates from +X, but begins a full turn at -X. For a part of a turn, it makes floor($fn angle/360)
 * facets. */
static vs_emit_status scad_revolve(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_revolve r;
  if (ref->node->class_ != VS_SOLID) return VS_LOWER;
  if (!vs_revolve_plan(ref->node, &e->facets, &r, e->error)) return VS_FAILED;
  size_t steps = vs_revolve_steps(&r, &e->facets, VS_AS(revolve, ref->node)->segments);
  bool odd = r.full && (steps % 2 != 0 || r.start != 0 || scad_pinches(&r));
  if (r.count > 0 && !odd) {
    double degrees = fabs(r.angle) * (180 / 3.14159265358979323846), from = r.angle < 0 ? r.start + r.angle : r.start,
           sine, cosine;
    vs_sincos(r.full ? 0 : from, &sine, &cosine);
    vs_affine place = { { { 0 } } };
    const double axis[] = { r.axis.x, r.axis.y, r.axis.z }, out[] = { r.out.x, r.out.y, r.out.z },
                 side[] = { r.side.x, r.side.y, r.side.z }, at[] = { r.at.x, r.at.y, r.at.z };
    for (int i = 0; i < 3; i++) {
      place.m[i][0] = out[i] * cosine + side[i] * sine;
      place.m[i][1] = side[i] * cosine - out[i] * sine;
      place.m[i][2] = axis[i];
      place.m[i][3] = at[i];
    }
    scad_open(e, ref->node);
    scad_place(e, &place);
    vs_puts(e->out, "rotate_extrude(");
    if (!r.full) scad_number(e, "angle = ", degrees);
    vs_putf(e->out, "%s$fn = %.0f) ", r.full ? "" : ", ",
            r.full ? (double)steps : ceil((double)steps * 360 / degrees + 1e-6));
    scad_profile(e, &r);
  }
  bool nothing = r.count == 0;
  vs_revolve_free(&r);
  return nothing || !odd ? scad_done(e) : VS_LOWER;
}

/* ---- operations on horizontal regions, written as OpenSCAD's two-dimensional objects ---- */


/* Returns true if root is an operation on regions that is parallel to XY, even after its placements, and small enough
 * to be readable. Sets *z to its height. */
static bool scad_is_level(vs_emitter *e, const vs_ref *root, double *z) {
  enum { MOST = 2000, DEEPEST = 60 };
  vs_shape_plane plane;
  const vs_node *n = root->node, *set = n;
  while (set->kind == VS_TRANSFORM || set->kind == VS_LAYER || set->kind == VS_MATERIAL) set = set->children[0].node;
  if (!vs_node_is_set(set) || n->class_ != VS_REGION_CLASS || n->depth > DEEPEST || vs_emit_is_painted(e, n) ||
      !vs_lower_as_area(e, set))
    return false;
  if (vs_node_plane(n, &plane) != VS_PLANE_ONE || plane.normal.z < 1 - 1e-12) return false;
  *z = plane.point.z;
  vs_walk *w = vs_walk_new(n->store, *root);
  vs_ref at;
  size_t count = 0;
  bool level = w != NULL;
  for (vs_walk_event ev; level && (ev = vs_walk_next(w, &at, NULL)) != VS_WALK_DONE;) {
    if (ev != VS_WALK_ENTER) level = ev == VS_WALK_LEAVE;
    else if (at.node->kind == VS_TRANSFORM) {
      const vs_affine *m = &VS_AS(transform, at.node)->matrix;
      level = m->m[0][2] == 0 && m->m[1][2] == 0 && m->m[2][0] == 0 && m->m[2][1] == 0;
    } else if (!vs_node_is_set(at.node) && at.node->kind != VS_LAYER && at.node->kind != VS_MATERIAL) vs_walk_skip(w);
    level = level && ++count < MOST;
  }
  vs_walk_free(w);
  return level;
}

/* Writes a region as a two-dimensional object in its own coordinates, without z. */
static bool scad_flat_leaf(vs_emitter *e, const vs_node *n) {
  const vs_node *only = n->kind == VS_REGION && n->child_count == 1 ? n->children[0].node : NULL;
  vs_affine back = vs_affine_identity();
  vs_outline o = { .count = 0 };
  if (only != NULL && only->kind == VS_CIRCLE) {
    const struct vs_circle *c = VS_AS(circle, only);
    scad_translate(e, vs_v3(c->center.x, c->center.y, 0));
    scad_number(e, "circle(r = ", c->radius);
    return vs_putf(e->out, ", $fn = %d);\n", vs_fineness_turn(&e->facets, c->radius, c->segments));
  }
  if (!vs_region_outline(n, &e->facets, &o, e->error)) return false;
  if (o.count > 0) scad_polygon(e, &o, &back);
  else vs_puts(e->out, "square(0);\n");
  vs_outline_free(&o);
  return !e->out->failed;
}

/* Writes the operation as two-dimensional objects on the current line. It walks the operation itself, because templates
 * are defined as solids. */
static bool scad_flat(vs_emitter *e, const vs_ref *root) {
  vs_walk *w = vs_walk_new(root->node->store, *root);
  vs_ref at;
  size_t depth = 0, base = e->depth;
  bool ok = w != NULL || vs_emit_no_memory(e);
  for (vs_walk_event ev; ok && (ev = vs_walk_next(w, &at, NULL)) != VS_WALK_DONE;) {
    const vs_node *n = at.node;
    if (ev == VS_WALK_FAILED) ok = vs_emit_no_memory(e);
    else if (ev == VS_WALK_LEAVE) {
      if (!vs_node_is_set(n)) continue;
      depth--;
      vs_put_spaces(e->out, 2 * (base + depth < 40 ? base + depth : 40));
      vs_puts(e->out, "}\n");
    } else {
      bool through = n->kind == VS_LAYER || n->kind == VS_MATERIAL || n->kind == VS_TRANSFORM;
      bool begun = depth == 0 || e->child_index == SIZE_MAX; /* true if the line already contains text */
      if (!begun && n->class_ != VS_NOTHING) vs_put_spaces(e->out, 2 * (base + depth < 40 ? base + depth : 40));
      e->child_index = 0;
      e->depth = base + depth;
      if (n->class_ == VS_NOTHING) {
        vs_walk_skip(w);
      } else if (through) {
        if (n->kind == VS_TRANSFORM) scad_place(e, &VS_AS(transform, n)->matrix);
        e->child_index = SIZE_MAX;
      } else if (vs_node_is_set(n)) {
        vs_puts(e->out, n->kind == VS_UNION          ? "union() {\n"
                        : n->kind == VS_INTERSECTION ? "intersection() {\n"
                                                     : "difference() {\n");
        depth++;
      } else {
        vs_walk_skip(w);
        ok = scad_flat_leaf(e, n);
      }
    }
  }
  e->depth = base;
  vs_walk_free(w);
  return ok && !e->out->failed;
}

static vs_emit_status scad_extrude(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const vs_node *n = ref->node, *profile = n->children[0].node;
  const struct vs_extrude *x = VS_AS(extrude, n);
  if (n->child_count != 1 || x->taper != 0 || x->twist != 0 || x->scale != 1) return VS_LOWER;
  vs_vec3 start = x->center ? vs_v3_scale(x->along, -0.5) : vs_v3(0, 0, 0);
  bool upright = x->along.x == 0 && x->along.y == 0 && x->along.z > 0;
  if (profile->kind == VS_REGION && profile->child_count == 1) profile = profile->children[0].node;
  if (upright && profile->kind == VS_CIRCLE) {
    const struct vs_circle *c = VS_AS(circle, profile);
    scad_open(e, n);
    scad_translate(e, vs_v3_add(c->center, start));
    scad_number(e, "linear_extrude(height = ", x->along.z);
    scad_number(e, ") circle(r = ", c->radius);
    vs_putf(e->out, ", $fn = %d);\n", vs_fineness_turn(&e->facets, c->radius, c->segments));
    return scad_done(e);
  }
  double z;
  if (upright && scad_is_level(e, &n->children[0], &z)) {
    scad_open(e, n);
    scad_translate(e, vs_v3_add(vs_v3(0, 0, z), start));
    scad_number(e, "linear_extrude(height = ", x->along.z);
    vs_puts(e->out, ") ");
    return scad_flat(e, &n->children[0]) ? VS_EMITTED : VS_FAILED;
  }
  vs_outline o = { .count = 0 };
  if (!vs_region_outline(n->children[0].node, &e->facets, &o, e->error)) return VS_FAILED;
  /* The profile's plane has +Z on the side of the extrusion. A plane parallel to XY keeps the coordinates x and y. */
  bool flat = o.normal.x == 0 && o.normal.y == 0;
  vs_vec3 normal = vs_v3_dot(o.normal, x->along) < 0 ? vs_v3_scale(o.normal, -1) : o.normal;
  vs_affine plane = flat && normal.z > 0 ? vs_affine_translation(vs_v3(0, 0, o.point.z))
                                         : vs_frame_on_axis(o.point, normal),
            back;
  if (o.count > 0 && vs_affine_invert(&plane, &back)) {
    scad_open(e, n);
    if (flat && upright) {
      scad_translate(e, vs_v3_add(vs_v3(0, 0, o.point.z), start));
      scad_number(e, "linear_extrude(height = ", x->along.z);
      vs_puts(e->out, ") ");
    } else {
      const double along[] = { x->along.x, x->along.y, x->along.z }, from[] = { start.x, start.y, start.z };
      vs_affine place = plane;
      for (int row = 0; row < 3; row++) {
        place.m[row][2] = along[row];
        place.m[row][3] += from[row];
      }
      scad_matrix(e, &place, " ");
      vs_puts(e->out, "linear_extrude(height = 1) ");
    }
    scad_polygon(e, &o, &back);
  }
  vs_outline_free(&o);
  return scad_done(e);
}

/* ---- objects without thickness: shown as thin solids, with a warning ---- */

static vs_emit_status scad_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  const struct vs_line *l = VS_AS(line, ref->node);
  double radius = scad_thin(e);
  uint32_t count = l->points->count, pieces = l->closed ? count : count - 1;
  if (!(radius > 0) || count == 0) return VS_EMITTED;
  scad_open(e, ref->node);
  vs_puts(e->out, "union() {\n");
  for (uint32_t i = 0; i < count; i++) {
    vs_vec3 a = l->points->at[i], axis = vs_v3_sub(l->points->at[(i + 1) % count], a);
    double length = vs_v3_length(axis);
    vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40) + 2);
    scad_translate(e, a);
    scad_number(e, "sphere(r = ", radius);
    vs_puts(e->out, ", $fn = 8);\n");
    if (i >= pieces || !(length > 1e-6 * radius)) continue;
    vs_affine place = vs_frame_on_axis(a, axis);
    vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40) + 2);
    scad_place(e, &place);
    scad_number(e, "cylinder(h = ", length);
    scad_number(e, ", r = ", radius);
    vs_puts(e->out, ", $fn = 8);\n");
  }
  vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40));
  vs_puts(e->out, "}\n");
  return scad_done(e);
}

static vs_emit_status scad_region(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_outline o = { .count = 0 };
  if (!vs_region_outline(ref->node, &e->facets, &o, e->error)) return VS_FAILED;
  vs_affine plane = o.normal.x == 0 && o.normal.y == 0 ? vs_affine_translation(vs_v3(0, 0, o.point.z))
                                                       : vs_frame_on_axis(o.point, o.normal),
            back;
  if (o.count > 0 && vs_affine_invert(&plane, &back)) {
    scad_open(e, ref->node);
    scad_place(e, &plane);
    scad_number(e, "linear_extrude(height = ", scad_thin(e));
    vs_puts(e->out, ", center = true) ");
    scad_polygon(e, &o, &back);
  }
  vs_outline_free(&o);
  return scad_done(e);
}

/* ---- operations ---- */

static vs_emit_status scad_transform(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase == VS_PHASE_LEAVE) return VS_EMITTED;
  const vs_affine *a = &VS_AS(transform, ref->node)->matrix;
  scad_open(e, ref->node);
  if (vs_affine_is_translation(a)) {
    vs_puts(e->out, "translate(");
    scad_point(e, vs_v3(a->m[0][3], a->m[1][3], a->m[2][3]));
    vs_puts(e->out, ")\n");
  } else {
    scad_matrix(e, a, "\n");
  }
  return scad_done(e);
}

/* Writes nothing for a material or layer: scad_open writes the colour before the node's children, and OpenSCAD has no
 * layers. The children have the node's indentation. */
static vs_emit_status scad_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)ref;
  e->depth += phase == VS_PHASE_ENTER ? SIZE_MAX : 1;
  return scad_done(e);
}

/* The modifiers # and % apply to a single statement. Braces make the child a single statement. */
static vs_emit_status scad_mark(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40));
  vs_puts(e->out, phase == VS_PHASE_LEAVE ? "}\n" : ref->node->kind == VS_GHOST ? "% union() {\n" : "# union() {\n");
  return scad_done(e);
}

static vs_emit_status scad_native(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase != VS_PHASE_ENTER) return scad_done(e);
  scad_open(e, ref->node);
  vs_puts(e->out, "union() {\n");
  vs_puts(e->out, VS_AS(native, ref->node)->code);
  vs_puts(e->out, "\n");
  vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40));
  vs_puts(e->out, "}\n");
  return e->out->failed ? VS_FAILED : VS_WHOLE;
}

static vs_emit_status scad_csg(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase == VS_PHASE_LEAVE) {
    vs_put_spaces(e->out, 2 * (e->depth < 40 ? e->depth : 40));
    vs_puts(e->out, "}\n");
    return scad_done(e);
  }
  if (vs_lower_as_area(e, ref->node)) {
    double z;
    if (!scad_is_level(e, ref, &z)) return VS_LOWER;
    if (!vs_emit_warn_once(e, ref, vs_backend_openscad.emit[VS_REGION].lossy)) return VS_FAILED;
    scad_open(e, ref->node);
    scad_translate(e, vs_v3(0, 0, z));
    scad_number(e, "linear_extrude(height = ", scad_thin(e));
    vs_puts(e->out, ", center = true) ");
    return scad_flat(e, ref) ? VS_WHOLE : VS_FAILED;
  }
  scad_open(e, ref->node);
  vs_puts(e->out, ref->node->kind == VS_UNION          ? "union() {\n"
                  : ref->node->kind == VS_INTERSECTION ? "intersection() {\n"
                                                       : "difference() {\n");
  return scad_done(e);
}

static vs_emit_status scad_hull(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  if (phase == VS_PHASE_LEAF) return VS_LOWER; /* the child is a point, curve or region, which has no two-dimensional
                                                * form here */
  if (phase == VS_PHASE_LEAVE) return scad_csg(e, ref, phase);
  scad_open(e, ref->node);
  vs_puts(e->out, "hull() {\n");
  return scad_done(e);
}

static bool scad_define(vs_emitter *e, uint32_t id, const vs_ref *ref, bool open) {
  if (open && e->state == NULL && scad_is_mixed(e, ref->node)) {
    e->state = e; /* any value other than NULL: the modifier was written */
    vs_puts(e->out, "$paint = [0.86, 0.85, 0.83]; // for objects without a colour\n\n");
  }
  return open ? vs_putf(e->out, "module part%lu() {\n", (unsigned long)id) : vs_puts(e->out, "}\n\n");
}

static bool scad_use(vs_emitter *e, uint32_t id, const vs_ref *ref) {
  scad_open(e, ref->node);
  vs_puts(e->out, "part");
  vs_emit_put_template_number(e, id);
  vs_puts(e->out, "(");
  if (e->material != NULL && scad_is_mixed(e, ref->node)) {
    vs_puts(e->out, "$paint = ");
    scad_color(e, e->material);
  }
  return vs_puts(e->out, ");\n");
}

static bool scad_begin(vs_emitter *e) {
  vs_puts(e->out, "// ");
  vs_put_spelled(e->out, vs_spell_line, e->scene->title); /* escapes line breaks, which would end the comment */
  return vs_puts(e->out, ": a program for OpenSCAD, made by VisualScheme\n\n");
}

static bool scad_end(vs_emitter *e) { return !e->out->failed; }

const vs_backend vs_backend_openscad = {
  .highlights = VS_MARKS_KEEP, .ghosts = VS_MARKS_KEEP, .native = "openscad",
  .begin = scad_begin, .end = scad_end, .define = scad_define, .use = scad_use,
  .traits = VS_SHOWS_HULLS | VS_AREA_SETS | VS_KEEPS_TEXT,
  .emit = {
    [VS_LINE] = { scad_line, "OpenSCAD programs hold solids: curves are drawn as thin rods" },
    [VS_TEXT] = { scad_region, "OpenSCAD programs hold solids: flat regions are drawn as thin slabs" },
    [VS_REGION] = { scad_region, "OpenSCAD programs hold solids: flat regions are drawn as thin slabs" },
    [VS_BOX] = { scad_box, NULL }, [VS_SPHERE] = { scad_sphere, NULL }, [VS_CYLINDER] = { scad_cylinder, NULL },
    [VS_CONE] = { scad_cone, NULL },
    [VS_HALF_SPACE] = { scad_half_space, NULL }, [VS_HULL] = { scad_hull, NULL },
    [VS_E_CONE] = { scad_e_cone, NULL },
    [VS_CUT_CONE] = { scad_cut_cone, NULL }, [VS_PYRAMID] = { scad_pyramid, NULL },
    [VS_TORUS] = { scad_torus, NULL }, [VS_REVOLVE] = { scad_revolve, NULL },
    [VS_POLYFACE_MESH] = { scad_polyface, NULL }, [VS_EXTRUDE] = { scad_extrude, NULL },
    [VS_TRANSFORM] = { scad_transform, NULL },
    [VS_MATERIAL] = { scad_through, NULL }, [VS_LAYER] = { scad_through, NULL }, [VS_NATIVE] = { scad_native, NULL },
    [VS_HIGHLIGHT] = { scad_mark, NULL }, [VS_GHOST] = { scad_mark, NULL }, [VS_UNION] = { scad_csg, NULL },
    [VS_INTERSECTION] = { scad_csg, NULL }, [VS_DIFFERENCE] = { scad_csg, NULL },
  },
};
