/* Replaces sections, shadows and feature edges in a tree of nodes: children first, each distinct node once, without
 * recursion. */
#include "solids/resolve.h"
#include "geometry/tessellate.h"
#include "geometry/plane/planar_evaluation.h"

#include <stdlib.h>

#include "geometry/frame.h"
#include "geometry/measure/node_measures.h"
#include "geometry/parts.h"
#include "geometry/plane/slice.h"
#include "solids/deformed.h"
#include "solids/feature_edges.h"
#include "solids/sections.h"
#include "model/store/array.h"
#include "model/walk.h"

typedef struct {
  vs_store *store;
  const vs_fineness *facets;
  const vs_kernel_options *options;
  vs_error *error;
  vs_deformer *deformer; /* deformer for nodes of kind VS_DEFORM; NULL before the first such node */
  vs_nodemap known;    /* maps an old node to its replacement, to which `made` holds a reference */
  vs_node **made;
  size_t made_count, made_room;
} resolver;

static bool is_unresolved(const vs_node *n) { return n->flags & VS_NODE_UNRESOLVED; }

/* Returns the node that replaces n, or n itself if no node does. Adds no reference. */
static vs_node *now(const resolver *r, vs_node *n) {
  const uint64_t *place = is_unresolved(n) ? vs_nodemap_get(&r->known, n) : NULL;
  return place ? r->made[*place] : n;
}

/* Records that the node `new` replaces the node `old`. Takes over the caller's reference to `new`. Returns false if
 * memory is out. */
static bool remember(resolver *r, const vs_node *old, vs_node *new) {
  if (!new) return vs_error_memory(r->error, NULL);
  if (!VS_GROW(r->made, r->made_room, r->made_count + 1)) return vs_node_release(new), vs_error_memory(r->error, NULL);
  r->made[r->made_count++] = new;
  uint64_t *place = vs_nodemap_put(&r->known, old, NULL);
  if (!place) return vs_error_memory(r->error, NULL);
  *place = r->made_count - 1;
  return true;
}

/* ---- from polylines to nodes; each function returns NULL if memory is out ---- */

static vs_node *nothing(vs_store *s) { return vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0); }

static vs_node *line(vs_store *s, const vs_polyline *p) {
  vs_points *points = vs_points_new(s, p->at, p->count);
  vs_node *n =
      points ? vs_node_new(s, VS_LINE, &(struct vs_line){ .points = points, .closed = p->closed }, NULL, 0) : NULL;
  vs_points_release(s, points);
  return n;
}

/* Makes a node of the given kind with the children refs. Takes over the references to them. alone: if true and there is
 * only one child, returns this child itself. */
static vs_node *of_children(vs_store *s, vs_kind kind, vs_ref *refs, size_t count, bool alone) {
  bool ok = true;
  static const unsigned char none[8];
  for (size_t i = 0; i < count; i++) ok = ok && refs[i].node;
  vs_node *n = !ok                   ? NULL
               : !count              ? nothing(s)
               : count == 1 && alone ? vs_node_retain(refs[0].node)
                                     : vs_node_new(s, kind, none, refs, count);
  for (size_t i = 0; i < count; i++) vs_node_release(refs[i].node);
  return n;
}

static vs_node *of_lines(vs_store *s, vs_kind kind, const vs_polyline *lines, size_t count, const vs_origin *origin,
                         bool alone) {
  vs_ref *refs = vs_fresh(count + 1, sizeof *refs);
  if (!refs) return NULL;
  for (size_t i = 0; i < count; i++) refs[i] = (vs_ref){ line(s, &lines[i]), origin };
  vs_node *n = of_children(s, kind, refs, count, alone);
  free(refs);
  return n;
}

/* ---- meshes ---- */

static bool facets_for(const resolver *r, const vs_node *n, vs_fineness *f) {
  vs_bounds b;
  *f = *r->facets;
  if (f->tolerance > 0) return true;
  if (!vs_node_bounds(n, &b, r->error)) return false;
  f->tolerance = vs_fineness_tolerance(&b);
  return true;
}

/* Collects the surfaces below `root`, including members of unions, into one mesh. Returns false on failure. */
static bool surfaces(const resolver *r, vs_ref root, const vs_fineness *f, vs_mesh *out) {
  typedef struct { vs_affine placed; } level;
  vs_walk *w = vs_walk_new(root.node->store, root);
  level *levels = NULL;
  size_t room = 0, depth;
  vs_ref at;
  bool ok = w || vs_error_memory(r->error, root.origin);
  for (vs_walk_event ev; ok && (ev = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE;) {
    if (ev == VS_WALK_LEAVE) continue;
    if (ev == VS_WALK_FAILED || !VS_GROW(levels, room, depth + 1)) {
      ok = vs_error_memory(r->error, root.origin);
      break;
    }
    levels[depth].placed = depth ? levels[depth - 1].placed : vs_affine_identity();
    if (at.node->kind == VS_TRANSFORM)
      levels[depth].placed = vs_affine_multiply(&levels[depth].placed, &VS_AS(transform, at.node)->matrix);
    if (vs_node_is_around(at.node) ||
        at.node->kind == VS_UNION)
      continue;
    vs_walk_skip(w);
    if (at.node->class_ != VS_SURFACE) continue;
    size_t vertex = out->vertex_count, triangle = out->triangle_count;
    ok = vs_tessellate(at.node, f, out, r->error);
    if (ok) vs_mesh_transform_from(out, &levels[depth].placed, vertex, triangle);
  }
  vs_walk_free(w);
  free(levels);
  return ok;
}

static bool mesh_of(const resolver *r, vs_ref ref, vs_solid *out) {
  vs_fineness f;
  *out = (vs_solid){ .part_count = 0 };
  if (!facets_for(r, ref.node, &f)) return false;
  if (ref.node->class_ == VS_SURFACE) return surfaces(r, ref, &f, &out->mesh);
  return vs_solid_evaluate(&ref, 1, &f, r->options, out, r->error);
}

/* ---- the kinds ---- */

static vs_node *flat_of(const resolver *r, const vs_ref *ref) {
  const vs_node *n = ref->node;
  vs_ref child = { now(r, n->children[0].node), n->children[0].origin };
  vs_solid solid = { .part_count = 0 };
  vs_outline o = { 0 };
  vs_node *made = NULL;
  if (child.node->class_ == VS_NOTHING) return nothing(r->store);
  bool ok = mesh_of(r, child, &solid);
  if (ok && n->kind == VS_SECTION)
    ok = vs_mesh_section(&solid.mesh, VS_AS(section, n)->point, VS_AS(section, n)->normal, &o, r->error);
  else if (ok) ok = vs_mesh_shadow(&solid.mesh, VS_AS(project, n)->point, VS_AS(project, n)->normal, &o, r->error);
  if (ok && !(made = of_lines(r->store, VS_REGION, o.loops, o.count, ref->origin, false)))
    vs_error_memory(r->error, ref->origin);
  vs_outline_free(&o);
  vs_solid_free(&solid);
  return made;
}

/* Makes the edges of shape n as exact circles, if there is a formula for them. Otherwise sets *known to false; the
 * caller then uses the mesh. Returns NULL on failure, or if *known is false. */
static vs_node *round_edges(const resolver *r, const vs_node *n, const vs_origin *origin, bool *known) {
  vs_affine placed = vs_affine_identity();
  vs_vec3 at[2];
  double radius[2];
  int segments;
  *known = true;
  while (vs_node_is_around(n) ||
         (n->kind == VS_UNION && n->child_count == 1)) {
    if (n->kind == VS_TRANSFORM) placed = vs_affine_multiply(&placed, &VS_AS(transform, n)->matrix);
    n = n->children[0].node;
  }
  if (n->kind == VS_CYLINDER) {
    const struct vs_cylinder *c = VS_AS(cylinder, n);
    at[0] = c->base, at[1] = c->top, radius[0] = radius[1] = c->radius, segments = c->segments;
  } else if (n->kind == VS_CONE) {
    const struct vs_cone *c = VS_AS(cone, n);
    at[0] = c->base, at[1] = c->apex, radius[0] = c->radius, radius[1] = 0, segments = c->segments;
  } else if (n->kind == VS_CUT_CONE) {
    const struct vs_cut_cone *c = VS_AS(cut_cone, n);
    at[0] = c->base, at[1] = c->top, radius[0] = c->base_radius, radius[1] = c->top_radius, segments = c->segments;
  } else if ((n->kind == VS_SPHERE && !VS_AS(sphere, n)->segments) ||
             (n->kind == VS_TORUS && !VS_AS(torus, n)->segments)) {
    return nothing(r->store);
  } else {
    *known = false;
    return NULL;
  }
  *known = segments == 0 && r->facets->segments <= 0; /* if the number of facets is set, the edges are those of the
                                                       * facets, not circles */
  if (!*known) return NULL;
  vs_ref circles[2];
  size_t count = 0;
  for (int i = 0; i < 2; i++) {
    if (!(radius[i] > 0)) continue;
    vs_affine frame = vs_frame_on_axis(at[i], vs_v3_sub(at[1], at[0])), place = vs_affine_multiply(&placed, &frame);
    vs_ref circle = { vs_node_new(r->store, VS_CIRCLE, &(struct vs_circle){ .radius = radius[i] }, NULL, 0), origin };
    circles[count++] = (vs_ref){
      circle.node ? vs_node_new(r->store, VS_TRANSFORM, &(struct vs_transform){ .matrix = place }, &circle, 1) : NULL,
      origin
    };
    vs_node_release(circle.node);
  }
  return of_children(r->store, VS_UNION, circles, count, true);
}

static vs_node *edges_of(const resolver *r, const vs_ref *ref) {
  vs_ref child = { now(r, ref->node->children[0].node), ref->node->children[0].origin };
  bool known;
  vs_node *made = round_edges(r, child.node, ref->origin, &known);
  if (known && !made) vs_error_memory(r->error, ref->origin);
  if (known) return made;
  if (child.node->class_ == VS_NOTHING) return nothing(r->store);
  vs_solid solid = { .part_count = 0 };
  vs_polylines lines = { 0 };
  bool ok = mesh_of(r, child, &solid) && vs_mesh_edges(&solid.mesh, &lines, r->error);
  if (ok && !(made = of_lines(r->store, VS_UNION, lines.at, lines.count, ref->origin, true)))
    vs_error_memory(r->error, ref->origin);
  vs_polylines_free(&lines);
  vs_solid_free(&solid);
  return made;
}

static vs_node *polyface(vs_store *s, const vs_mesh *m, bool closed) {
  if (!m->triangle_count) return nothing(s);
  uint32_t *starts = vs_fresh(m->triangle_count + 1, sizeof *starts);
  vs_points *points = starts ? vs_points_new(s, m->vertices, m->vertex_count) : NULL;
  for (size_t i = 0; starts && i <= m->triangle_count; i++) starts[i] = (uint32_t)(3 * i);
  vs_faces *faces =
      points ? vs_faces_new(s, starts, m->triangle_count, &m->triangles[0][0], 3 * m->triangle_count) : NULL;
  vs_node *n =
      faces ? vs_node_new(s, VS_POLYFACE_MESH,
                          &(struct vs_polyface_mesh){ .points = points, .faces = faces, .closed = closed }, NULL, 0)
            : NULL;
  vs_faces_release(s, faces);
  vs_points_release(s, points);
  free(starts);
  return n;
}

/* Makes the hull of surfaces that all lie in one plane, from the corners of their triangles. Returns NULL on
 * failure. */
static vs_node *flat_hull_of(const resolver *r, const vs_ref *ref) {
  struct vs_hull d = *VS_AS(hull, ref->node);
  vs_fineness f;
  vs_cloud cloud = { 0 };
  vs_node *made = NULL;
  if (facets_for(r, ref->node, &f) && vs_hull_points(ref->node, &f, &cloud, r->error)) {
    vs_points *corners = vs_points_new(r->store, cloud.at, cloud.count);
    d.points = corners;
    made = corners ? vs_node_new(r->store, VS_HULL, &d, NULL, 0) : NULL;
    vs_points_release(r->store, corners);
    if (!made) vs_error_memory(r->error, ref->origin);
  }
  vs_cloud_free(&cloud);
  return made;
}

/* Makes the hull of the node's children; children that are booleans become meshes first. Returns NULL on failure. */
static vs_node *hull_of(const resolver *r, const vs_ref *ref) {
  const vs_node *n = ref->node;
  vs_ref *kids = vs_zeros(n->child_count + (size_t)1, sizeof *kids);
  bool ok = kids != NULL || vs_error_memory(r->error, ref->origin);
  for (uint32_t i = 0; ok && i < n->child_count; i++) {
    vs_solid solid = { .part_count = 0 };
    vs_ref child = { now(r, n->children[i].node), n->children[i].origin };
    kids[i].origin = child.origin;
    if (!(child.node->flags & VS_NODE_CARVED)) kids[i].node = vs_node_retain(child.node);
    else
      ok = mesh_of(r, child, &solid) &&
           ((kids[i].node = polyface(r->store, &solid.mesh, true)) || vs_error_memory(r->error, child.origin));
    vs_solid_free(&solid);
  }
  vs_node *made = ok ? vs_node_new(r->store, VS_HULL, vs_node_data(n), kids, n->child_count) : NULL;
  if (ok && !made) vs_error_memory(r->error, ref->origin);
  if (made && made->flags & VS_NODE_UNRESOLVED) {
    vs_node *flat = flat_hull_of(r, &(vs_ref){ made, ref->origin });
    vs_node_release(made);
    made = flat;
  }
  for (uint32_t i = 0; kids && i < n->child_count; i++) vs_node_release(kids[i].node);
  free(kids);
  return made;
}

/* ---- slices of curves, regions and surfaces ---- */

typedef struct {
  const resolver *r;
  const struct vs_slice *plane;
  const vs_origin *origin;
  const vs_node *const *looks; /* materials and layers around the part that is being sliced, the innermost last */
  size_t look_count;
  vs_ref *at;                  /* references to the pieces that remain after the slice */
  size_t count, room;
} pieces;

static bool keep_piece(pieces *p, vs_node *n) { /* adds a piece that remains after the slice, and takes over the
                                                 * reference to n */
  vs_store *s = p->r->store;
  for (size_t i = p->look_count; n && i-- > 0;) {
    vs_node *bare = n;
    n = vs_node_new(s, (vs_kind)p->looks[i]->kind, vs_node_data(p->looks[i]), &(vs_ref){ bare, p->origin }, 1);
    vs_node_release(bare);
  }
  if (n && !VS_GROW(p->at, p->room, p->count + 1)) vs_node_release(n), n = NULL;
  if (!n) return vs_error_memory(p->r->error, p->origin);
  p->at[p->count++] = (vs_ref){ n, p->origin };
  return true;
}

static bool keep_line(void *context, const vs_polyline *piece) {
  pieces *p = context;
  return keep_piece(p, line(p->r->store, piece));
}

/* Slices a part that is a curve, region, surface or solid as a whole, and adds the remaining pieces. placed: map from
 * the part's coordinates to those of the slice. Returns false on failure. */
static bool slice_part(pieces *p, vs_ref part, const vs_affine *placed) {
  const vs_node *n = part.node;
  vs_store *s = p->r->store;
  vs_fineness f;
  if (n->class_ == VS_NOTHING) return true;
  vs_ref whole = { vs_node_new(s, VS_TRANSFORM, &(struct vs_transform){ .matrix = *placed }, &part, 1), part.origin };
  if (!whole.node) return vs_error_memory(p->r->error, part.origin);
  bool ok = facets_for(p->r, whole.node, &f);
  if (ok && n->class_ == VS_CURVE) {
    vs_polyline q = { 0 };
    ok = vs_curve_sample(whole.node, &f, &q, p->r->error) &&
         (vs_slice_polyline(&q, p->plane->point, p->plane->normal, keep_line, p) ||
          vs_error_memory(p->r->error, part.origin));
    vs_polyline_free(&q);
  } else if (ok && n->class_ == VS_SURFACE) {
    vs_mesh m = { 0 }, cut = { 0 };
    ok = vs_tessellate(whole.node, &f, &m, p->r->error) &&
         (vs_slice_mesh(&m, p->plane->point, p->plane->normal, &cut) || vs_error_memory(p->r->error, part.origin));
    ok = ok && (!cut.triangle_count || keep_piece(p, polyface(s, &cut, false)));
    vs_mesh_free(&m);
    vs_mesh_free(&cut);
  } else if (ok && n->class_ == VS_REGION_CLASS) {
    vs_outline o;
    vs_bounds b;
    ok = vs_region_outline(whole.node, &f, &o, p->r->error);
    if (ok) {
      vs_shape_plane flat = { .point = o.point, .normal = o.normal };
      ok = vs_node_bounds(whole.node, &b, p->r->error) &&
           (!o.count || keep_piece(p, vs_slice_region(whole, &flat, &b, p->plane->point, p->plane->normal)));
      vs_outline_free(&o);
    }
  } else if (ok && n->class_ == VS_SOLID) {
    vs_ref pair[2] = { whole,
                       { vs_node_new(s, VS_HALF_SPACE,
                                     &(struct vs_half_space){ .point = p->plane->point, .normal = p->plane->normal },
                                     NULL, 0),
                         part.origin } };
    ok = keep_piece(p, pair[1].node ? vs_node_new(s, VS_INTERSECTION, &(struct vs_intersection){ 0 }, pair, 2) : NULL);
    vs_node_release(pair[1].node);
  }
  vs_node_release(whole.node);
  return ok;
}

static vs_node *slice_of(const resolver *r, const vs_ref *ref) {
  typedef struct { vs_affine placed; size_t looks; } level; /* A level of the walk's stack. placed: map from its
                                                             * coordinates to the slice's; looks: number of materials
                                                             * and layers around it. */
  vs_ref child = { now(r, ref->node->children[0].node), ref->node->children[0].origin }, at;
  pieces p = { .r = r, .plane = VS_AS(slice, ref->node), .origin = ref->origin };
  vs_walk *w = vs_walk_new(r->store, child);
  level *levels = NULL;
  const vs_node **looks = NULL;
  size_t room = 0, look_room = 0, depth;
  bool ok = w || vs_error_memory(r->error, ref->origin);
  for (vs_walk_event ev; ok && (ev = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE;) {
    if (ev == VS_WALK_LEAVE) continue;
    if (ev == VS_WALK_FAILED || !VS_GROW(levels, room, depth + 1) || !VS_GROW(looks, look_room, depth + 1)) {
      ok = vs_error_memory(r->error, ref->origin);
      break;
    }
    levels[depth] = depth ? levels[depth - 1] : (level){ vs_affine_identity(), 0 };
    const vs_node *n = at.node;
    bool solid = n->class_ == VS_SOLID || n->class_ == VS_NOTHING;
    if (!solid && (vs_node_is_around(n) || n->kind == VS_UNION)) {
      if (n->kind == VS_TRANSFORM)
        levels[depth].placed = vs_affine_multiply(&levels[depth].placed, &VS_AS(transform, n)->matrix);
      if (vs_node_is_look(n)) looks[levels[depth].looks++] = n;
      continue;
    }
    vs_walk_skip(w);
    p.looks = looks, p.look_count = levels[depth].looks;
    p.origin = at.origin;
    ok = slice_part(&p, at, &levels[depth].placed);
  }
  vs_walk_free(w);
  free(levels);
  free(looks);
  vs_node *made = NULL;
  if (ok && !(made = of_children(r->store, VS_UNION, p.at, p.count, true))) vs_error_memory(r->error, ref->origin);
  for (size_t i = 0; !ok && i < p.count; i++) vs_node_release(p.at[i].node);
  free(p.at);
  return made;
}

/* Returns the node of thickened curves, which has a bar around each curve; NULL on failure. */
static vs_node *thickened(const resolver *r, const vs_node *n, vs_ref whole) {
  vs_ref *parts;
  size_t count;
  if (!vs_several_parts(whole, &parts, &count)) return NULL;
  for (size_t i = 0; i < count; i++) {
    vs_node *curve = parts[i].node;
    parts[i].node = vs_node_new(r->store, VS_THICKEN, vs_node_data(n), &parts[i], 1);
    vs_node_release(curve);
  }
  vs_node *made = of_children(r->store, VS_UNION, parts, count, true);
  free(parts);
  return made;
}

static vs_node *rebuilt(const resolver *r, const vs_node *n) {
  vs_ref *kids = vs_fresh(n->child_count + (size_t)1, sizeof *kids);
  if (!kids) return NULL;
  bool gone = false;
  for (uint32_t i = 0; i < n->child_count; i++) {
    kids[i] = (vs_ref){ now(r, n->children[i].node), n->children[i].origin };
    gone = gone || (i == 0 && kids[i].node->kind == VS_EMPTY);
  }
  bool profile = vs_node_role(n) == VS_ROLE_MADE && vs_node_has(n, VS_IS_OF_FIRST);
  vs_node *made = profile && gone ? nothing(r->store)
                  : n->kind == VS_THICKEN && vs_is_several(kids[0].node)
                      ? thickened(r, n, kids[0])
                      : vs_node_new(r->store, (vs_kind)n->kind, vs_node_data(n), kids, n->child_count);
  free(kids);
  return made;
}

static vs_node *deformed(resolver *r, const vs_ref *ref) {
  vs_ref child = { now(r, ref->node->children[0].node), ref->node->children[0].origin };
  if (!r->deformer && !(r->deformer = vs_deformer_new(r->store, r->facets, r->options)))
    return vs_error_memory(r->error, ref->origin), NULL;
  return vs_deformer_apply(r->deformer, VS_AS(deform, ref->node), child, r->error);
}

static bool resolve_one(resolver *r, const vs_ref *ref) {
  const vs_node *n = ref->node;
  vs_node *made;
  if (n->kind == VS_HULL || (vs_node_has(n, VS_IS_UNRESOLVED) && n->child_count)) {
    made = n->kind == VS_DEFORM  ? deformed(r, ref)
           : n->kind == VS_EDGES ? edges_of(r, ref)
           : n->kind == VS_SLICE ? slice_of(r, ref)
           : n->kind == VS_HULL  ? hull_of(r, ref)
                                 : flat_of(r, ref);
    if (!made) {
      if (r->error && !r->error->origin) r->error->origin = ref->origin;
      return false;
    }
    bool warns = r->options && r->options->warns;
    if (n->kind == VS_EDGES && made->kind == VS_EMPTY && warns)
      vs_job_warn(r->options->job, ref->origin,
                  "do-edges: no faces meet at an angle: nothing is made (the empty object)");
    if (n->kind == VS_DEFORM && made->class_ == VS_NOTHING && n->children[0].node->class_ == VS_SOLID && warns)
      vs_job_warn(r->options->job, ref->origin,
                  "the hexahedron is flat or inside out: nothing is left of the solid in the hexahedron");
  } else {
    made = vs_node_has(n, VS_IS_UNRESOLVED) ? nothing(r->store) : rebuilt(r, n); /* a line without end is replaced by
                                                                                  * the empty node here;
                                                                                  * vs_scene_resolve draws it as a
                                                                                  * finite line */
  }
  return remember(r, n, made);
}

bool vs_resolve(vs_ref *refs, size_t count, const vs_fineness *facets, const vs_kernel_options *options, vs_error *e) {
  bool ok = true;
  resolver r = { .facets = facets, .options = options, .error = e };
  for (size_t i = 0; ok && i < count; i++) {
    if (!is_unresolved(refs[i].node)) continue;
    r.store = r.known.store = refs[i].node->store;
    vs_walk *w = vs_walk_new(r.store, refs[i]);
    vs_ref at;
    ok = w || vs_error_memory(e, refs[i].origin);
    for (vs_walk_event ev; ok && (ev = vs_walk_next(w, &at, NULL)) != VS_WALK_DONE;) {
      if (ev == VS_WALK_FAILED) ok = vs_error_memory(e, refs[i].origin);
      else if (ev == VS_WALK_ENTER && (!is_unresolved(at.node) || vs_nodemap_get(&r.known, at.node))) vs_walk_skip(w);
      else if (ev == VS_WALK_LEAVE && is_unresolved(at.node) && !vs_nodemap_get(&r.known, at.node))
        ok = resolve_one(&r, &at);
    }
    vs_walk_free(w);
    if (!ok) break;
    vs_node *new = vs_node_retain(now(&r, refs[i].node));
    vs_node_release(refs[i].node);
    refs[i].node = new;
  }
  vs_deformer_free(r.deformer);
  vs_nodemap_free(&r.known);
  for (size_t i = 0; i < r.made_count; i++) vs_node_release(r.made[i]);
  free(r.made);
  return ok;
}
