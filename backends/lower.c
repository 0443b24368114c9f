/* Implements lowering, the replacement of nodes that a format cannot express: curves by polylines, all other objects by
 * triangles.
 *
 * All formats use the triangles that this file computes: geometry/ computes those of shapes with a formula, kernel/
 * those of booleans. */
#include <stdlib.h>
#include <string.h>

#include "backends/lower.h"
#include "geometry/plane/planar_evaluation.h"
#include "backends/backend.h"
#include "backends/format_numbers.h"
#include "geometry/plane/plane.h"
#include "geometry/shapes/simple_nodes.h"
#include "solids/primitive_meshes.h"
#include "geometry/primitives/half_space.h"
#include "geometry/primitives/shape.h"
#include "model/job.h"
#include "model/store/array.h"

static vs_node *lower_polyline(vs_emitter *e, const vs_ref *ref) {
  vs_polyline p = { .count = 0 };
  vs_node *made = NULL;
  if (vs_curve_sample(ref->node, &e->facets, &p, e->error) && (made = vs_node_of_polyline(e->scene->store, &p)) == NULL)
    vs_emit_no_memory(e);
  vs_polyline_free(&p);
  return made;
}

static vs_node *lower_polyface(vs_emitter *e, const vs_mesh *m, bool closed) {
  vs_node *made = vs_node_of_mesh(e->scene->store, m, closed);
  if (made == NULL) vs_emit_no_memory(e);
  return made;
}

/* Returns a region with polyline boundaries that equals a union, intersection or difference of regions. The operation
 * has a single material and layer, which a node around it sets (passes/looks.h). */
static vs_node *lower_region(vs_emitter *e, const vs_ref *ref) {
  vs_store *store = e->scene->store;
  vs_outline o = { .count = 0 };
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  if (!vs_region_outline(ref->node, &e->facets, &o, &why)) {
    *e->error = why;
    if (why.origin == NULL && why.kind == VS_ERROR_MODEL) e->error->origin = ref->origin;
    return NULL;
  }
  vs_node *made = vs_node_of_outline(store, &o, ref->origin);
  if (!made) vs_emit_no_memory(e);
  vs_outline_free(&o);
  return made;
}

static bool lower_is_area_set(const vs_node *n) {
  return n->class_ == VS_REGION_CLASS && vs_node_is_set(n);
}

bool vs_lower_as_area(const vs_emitter *e, const vs_node *n) {
  vs_shape_plane plane, other;
  if (!lower_is_area_set(n)) return false;
  if (n->kind != VS_UNION) return true;
  if (vs_emit_looks(e, n) & (VS_LOOKS_PAINTED | VS_LOOKS_LAYERED)) return false;
  if (vs_node_plane(n, &plane) != VS_PLANE_ONE) return false;
  for (size_t i = 0; i < n->child_count; i++)
    if (n->children[i].node->class_ != VS_NOTHING &&
        (vs_node_plane(n->children[i].node, &other) != VS_PLANE_ONE || !vs_plane_same(&plane, &other)))
      return false;
  return true;
}

/* Returns a solid that is the part of a half-space within the bounds of the drawing. */
static vs_node *lower_half_space(vs_emitter *e, const vs_ref *ref) {
  const struct vs_half_space *h = VS_AS(half_space, ref->node);
  vs_mesh m = { 0 };
  vs_node *made = NULL;
  if (!vs_half_space_triangles(&m, h->point, h->normal, &e->reach)) vs_emit_no_memory(e);
  else made = lower_polyface(e, &m, true);
  vs_mesh_free(&m);
  return made;
}

/* Returns a node of simpler solids whose union is the shape, for a format that writes set operations. Returns NULL and
 * sets *fits to false if triangles are better. Returns NULL with *fits true if memory is out. */
static vs_node *lower_parts(vs_emitter *e, const vs_ref *ref, bool *fits) {
  const vs_shape *shape = vs_shape_of(ref->node);
  *fits = shape != NULL && shape->parts != NULL && e->backend->emit[VS_DIFFERENCE].fn != NULL;
  vs_node *made = *fits ? shape->parts(e->scene->store, ref->node, ref->origin, fits) : NULL;
  if (*fits && made == NULL) vs_emit_no_memory(e);
  return made;
}

static vs_node *lower_node(vs_emitter *e, const vs_ref *ref) {
  if (lower_is_area_set(ref->node) || (ref->node->kind == VS_HULL && ref->node->class_ == VS_REGION_CLASS))
    return lower_region(e, ref);
  bool parts;
  vs_node *together = lower_parts(e, ref, &parts);
  if (parts) return together;
  switch ((vs_kind)ref->node->kind) {
  case VS_OFFSET:
    if (ref->node->class_ == VS_REGION_CLASS) return lower_region(e, ref); /* fall through */
  case VS_ARC: case VS_CIRCLE: case VS_SPLINE: case VS_JOIN:
    return lower_polyline(e, ref);
#include "model/cases/shape_cases.def"
    if (ref->node->kind == VS_HALF_SPACE) return lower_half_space(e, ref);
    /* fall through */
  case VS_HULL:
#include "model/cases/body_cases.def"
  case VS_REGION:
  case VS_TEXT:
  case VS_UNION:
  case VS_INTERSECTION:
  case VS_DIFFERENCE: {
    vs_solid m = { .part_count = 0 };
    vs_node *made = vs_lower_mesh(e, ref, &m) ? lower_polyface(e, &m.mesh, ref->node->class_ == VS_SOLID) : NULL;
    vs_solid_free(&m);
    return made;
  }
  case VS_SLICE: case VS_DEFORM:
  /* The passes replace all nodes of these kinds before the drawing is written. */
  case VS_XLINE: case VS_RAY: case VS_SECTION: case VS_PROJECT: case VS_EDGES:
  case VS_EMPTY:
  case VS_LINE:
  case VS_POLYFACE_MESH:
  case VS_TRANSFORM:
  case VS_MATERIAL:
  case VS_LAYER:
  case VS_KIND_COUNT:
  case VS_NATIVE: case VS_PART: case VS_HIGHLIGHT: case VS_GHOST: case VS_ONLY:
    break;
  case VS_CUSTOM:
    vs_error_set(e->error, VS_ERROR_MODEL, ref->origin,
                 "%s has no drawing function for this format: (register-drawing-function %s? ...) gives it one",
                 VS_AS(custom, ref->node)->name, VS_AS(custom, ref->node)->name);
    return NULL;
  }
  vs_error_set(e->error, VS_ERROR_MODEL, ref->origin, "%s cannot be written in this format",
               vs_kind_get((vs_kind)ref->node->kind)->name);
  return NULL;
}

vs_node *vs_lower(vs_emitter *e, const vs_ref *ref) {
  vs_tally *tally = vs_store_tally(e->scene->store);
  vs_work_phase was = vs_tally_enter(tally, VS_WORK_MESH);
  vs_node *made = lower_node(e, ref);
  vs_tally_enter(tally, was);
  return made;
}

bool vs_lower_is_round(const vs_node *n) { return vs_node_has(n, VS_IS_ROUND); }

static vs_kernel_options lower_options(vs_emitter *e, vs_bends bends) {
  return (vs_kernel_options){ .job = e->job,
                              .warns = bends != VS_BENT_AGAIN,
                              .straight = bends == VS_STRAIGHT,
                              .max_bytes = e->job->limits.mesh_bytes,
                              .max_triangles = e->job->limits.mesh_triangles };
}

bool vs_lower_solids(vs_emitter *e, const vs_ref *refs, size_t count, vs_bends bends, vs_solid *out) {
  vs_kernel_options options = lower_options(e, bends);
  return vs_solid_evaluate(refs, count, &e->facets, &options, out, e->error);
}

bool vs_lower_objects(vs_emitter *e, const vs_refs *refs, int depth, vs_bends bends, vs_solid *out) {
  vs_kernel_options options = lower_options(e, bends);
  return vs_solid_of_objects(refs, depth, &e->facets, &options, out, e->error);
}

/* Pointers to the result for the drawing's solids: a single mesh (one), or a mesh for each group of equal parts (many).
 * Either pointer is NULL. */
typedef struct { vs_solid *one; vs_solid_copies *many; } lowered;

/* ---- drawings of parts (solids/named_parts.h): the solids of each part are united by themselves ---- */

/* The result for all parts, and the room of its array `parts`. */
typedef struct { lowered to; size_t room; } lower_sum;

/* Appends the sources of faces (the objects that the faces come from) to those of the result, with the name of their
 * part. */
static bool append_sources(vs_emitter *e, lower_sum *sum, const vs_solid_part *more, size_t count, const char *part) {
  vs_solid_part **all = sum->to.one ? &sum->to.one->parts : &sum->to.many->parts;
  size_t *used = sum->to.one ? &sum->to.one->part_count : &sum->to.many->part_count;
  if (!VS_GROW(*all, sum->room, *used + count)) return vs_emit_no_memory(e);
  for (size_t i = 0; i < count; i++) {
    (*all)[*used] = more[i];
    (*all)[(*used)++].part = part;
  }
  return true;
}

static void move_tags(vs_mesh *m, size_t by) {
  for (size_t i = 0; m->tags != NULL && i < m->triangle_count; i++) m->tags[i] += (uint32_t)by;
}

static bool append_mesh(vs_emitter *e, vs_mesh *to, const vs_mesh *from) {
  uint32_t base = (uint32_t)to->vertex_count;
  bool ok = from->tags == NULL || vs_mesh_want_tags(to);
  for (size_t i = 0; ok && i < from->vertex_count; i++) ok = vs_mesh_add_vertex(to, from->vertices[i], NULL);
  for (size_t i = 0; ok && i < from->triangle_count; i++) {
    const uint32_t *t = from->triangles[i];
    ok = vs_mesh_add_triangle(to, base + t[0], base + t[1], base + t[2]);
    if (ok && to->tags != NULL) to->tags[to->triangle_count - 1] = from->tags != NULL ? from->tags[i] : 0;
  }
  return ok || vs_emit_no_memory(e);
}

static bool append_solid(vs_emitter *e, lower_sum *sum, vs_solid *from, const char *part) {
  vs_solid *to = sum->to.one;
  move_tags(&from->mesh, to->part_count);
  to->straightened += from->straightened;
  return append_mesh(e, &to->mesh, &from->mesh) &&
         append_sources(e, sum, from->parts, from->part_count, part);
}

/* Moves the meshes of `from` to the result. */
static bool append_copies(vs_emitter *e, lower_sum *sum, vs_solid_copies *from, const char *part) {
  vs_solid_copies *to = sum->to.many;
  vs_kernel_copies *a = &to->meshes, *b = &from->meshes;
  size_t tags = to->part_count;
  if (!VS_GROW(a->meshes, a->mesh_room, a->mesh_count + b->mesh_count) ||
      !VS_GROW(a->copies, a->copy_room, a->copy_count + b->copy_count))
    return vs_emit_no_memory(e);
  if (!append_sources(e, sum, from->parts, from->part_count, part)) return false;
  uint32_t first = (uint32_t)a->mesh_count;
  for (size_t i = 0; i < b->mesh_count; i++) {
    if (b->meshes[i].tags == NULL && tags > 0 && !vs_mesh_want_tags(&b->meshes[i])) return vs_emit_no_memory(e);
    move_tags(&b->meshes[i], tags);
    a->meshes[a->mesh_count++] = b->meshes[i];
    b->meshes[i] = (vs_mesh){ .vertices = NULL };
  }
  for (size_t i = 0; i < b->copy_count; i++)
    a->copies[a->copy_count++] = (vs_kernel_copy){ first + b->copies[i].mesh, b->copies[i].place };
  to->straightened += from->straightened;
  return true;
}

/* Computes the solids of refs (a part, or all objects outside of parts), rounds them to the format's numbers, and
 * appends them to the result. Adds the changes by rounding to *rounded. */
static bool lower_part(vs_emitter *e, vs_refs refs, vs_bends bends, lower_sum *sum, vs_rounded *rounded) {
  const char *part = refs.at[0].node->kind == VS_PART ? VS_AS(part, refs.at[0].node)->name : NULL;
  vs_solid one = { .part_count = 0 };
  vs_solid_copies many = { .part_count = 0 };
  vs_kernel_options options = lower_options(e, bends);
  bool ok = sum->to.one ? vs_lower_solids(e, refs.at, refs.count, bends, &one) &&
                              vs_emit_round(e, &one.mesh, e->backend->numbers, rounded) &&
                              append_solid(e, sum, &one, part)
                        : vs_solid_evaluate_copies(refs.at, refs.count, &e->facets, &options, &many, e->error);
  for (size_t i = 0; ok && i < many.meshes.mesh_count; i++)
    ok = vs_emit_round(e, &many.meshes.meshes[i], e->backend->numbers, rounded);
  ok = ok && (sum->to.one || append_copies(e, sum, &many, part));
  vs_solid_free(&one);
  vs_solid_copies_free(&many);
  return ok;
}

/* Computes the solids of a drawing with parts: first those outside of parts, then each part. */
static bool lower_parted(vs_emitter *e, vs_bends bends, lowered to, vs_rounded *what) {
  const vs_scene *s = e->scene;
  lower_sum sum = { to, 0 };
  size_t count = 0;
  vs_ref *others = vs_store_realloc(s->store, NULL, 0, (s->drawn_count + 1) * sizeof *others);
  if (others == NULL) return vs_emit_no_memory(e);
  for (size_t i = 0; i < s->drawn_count; i++)
    if (s->drawn[i].node->kind != VS_PART) others[count++] = s->drawn[i];
  bool ok = count == 0 || lower_part(e, (vs_refs){ others, count }, bends, &sum, what);
  for (size_t i = 0; ok && i < s->drawn_count; i++)
    if (s->drawn[i].node->kind == VS_PART) ok = lower_part(e, (vs_refs){ &s->drawn[i], 1 }, bends, &sum, what);
  vs_store_realloc(s->store, others, (s->drawn_count + 1) * sizeof *others, 0);
  return ok;
}

static bool lower_has_parts(const vs_emitter *e) {
  bool any = false;
  for (size_t i = 0; i < e->scene->drawn_count; i++) any |= e->scene->drawn[i].node->kind == VS_PART;
  return any && !vs_backend_has(e->backend, VS_DRAWS);
}

/* Computes the meshes of the drawing's solids, and rounds them to the format's numbers. Adds the changes that rounding
 * makes to *what. */
static bool lower_once(vs_emitter *e, vs_bends bends, lowered to, vs_rounded *what) {
  const vs_scene *s = e->scene;
  const vs_refs drawn = { s->drawn, s->drawn_count };
  if (lower_has_parts(e)) return lower_parted(e, bends, to, what);
  if (to.one)
    return (e->backend->objects ? vs_lower_objects(e, &drawn, 0, bends, to.one)
                                : vs_lower_solids(e, s->drawn, s->drawn_count, bends, to.one)) &&
           vs_emit_round(e, &to.one->mesh, e->backend->numbers, what);
  vs_kernel_options options = lower_options(e, bends);
  bool ok = vs_solid_evaluate_copies(s->drawn, s->drawn_count, &e->facets, &options, to.many, e->error);
  for (size_t i = 0; ok && i < to.many->meshes.mesh_count; i++)
    ok = vs_emit_round(e, &to.many->meshes.meshes[i], e->backend->numbers, what);
  return ok;
}

static void lower_swap(lowered a, lowered b) {
  if (a.one) {
    vs_solid was = *a.one;
    *a.one = *b.one, *b.one = was;
  } else {
    vs_solid_copies was = *a.many;
    *a.many = *b.many, *b.many = was;
  }
}

/* Computes the meshes of the drawing's solids without the bends of cut edges that the kernel's grid causes. If
 * triangles of the result intersect, computes the meshes again with bends, and keeps the result with fewer
 * intersections. */
static bool lower_drawing(vs_emitter *e, lowered to) {
  vs_rounded what = { 0 }, bent_what = { 0 };
  vs_solid bent = { .part_count = 0 };
  vs_solid_copies bent_copies = { .part_count = 0 };
  lowered again = { to.one ? &bent : NULL, to.one ? NULL : &bent_copies };
  bool ok = lower_once(e, VS_STRAIGHT, to, &what);
  if (ok && what.met_before && (to.one ? to.one->straightened : to.many->straightened)) {
    ok = lower_once(e, VS_BENT_AGAIN, again, &bent_what);
    if (ok && bent_what.met < what.met) lower_swap(to, again), what = bent_what;
  }
  vs_solid_free(&bent);
  vs_solid_copies_free(&bent_copies);
  return ok && vs_emit_rounded(e, &what);
}

bool vs_lower_drawing(vs_emitter *e, vs_solid *out) { return lower_drawing(e, (lowered){ .one = out }); }
bool vs_lower_drawing_copies(vs_emitter *e, vs_solid_copies *out) {
  return lower_drawing(e, (lowered){ .many = out });
}

/* Converts a primitive to triangles. Stores the result in the cache for later outputs if computing it takes longer than
 * finding it in the cache. */
static bool lower_primitive(vs_emitter *e, vs_node *n, const vs_kernel_options *options, vs_mesh *out, vs_error *why) {
  vs_cache *cache = vs_store_cache(e->scene->store);
  vs_level level = vs_kind_get((vs_kind)n->kind)->level;
  if (!vs_cache_asks(cache) || (level != VS_LEVEL_SWEPT && n->class_ != VS_REGION_CLASS && n->kind != VS_HULL))
    return vs_primitive_mesh(n, &e->facets, options, out, why);
  const vs_cached *held;
  vs_mesh m = { 0 };
  if (!vs_primitive_shared(&(vs_kept_mesh){ cache, &m, &held }, n, &e->facets, options, why)) {
    vs_mesh_free(&m);
    return false;
  }
  if (held == NULL) {
    *out = m;
    return true;
  }
  bool ok = vs_mesh_reserve(out, m.vertex_count, m.triangle_count);
  if (ok && m.triangle_count > 0) {
    memcpy(out->vertices, m.vertices, m.vertex_count * sizeof *m.vertices);
    memcpy(out->triangles, m.triangles, m.triangle_count * sizeof *m.triangles);
    out->vertex_count = m.vertex_count;
    out->triangle_count = m.triangle_count;
  }
  vs_cache_let_go(cache, held);
  return ok || vs_error_memory(why, NULL);
}

bool vs_lower_mesh(vs_emitter *e, const vs_ref *ref, vs_solid *out) {
  if (vs_kind_get((vs_kind)ref->node->kind)->level == VS_LEVEL_OPERATION && ref->node->class_ != VS_REGION_CLASS)
    return vs_lower_solids(e, ref, 1, VS_BENT, out);
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  vs_kernel_options options = lower_options(e, VS_BENT);
  if (lower_primitive(e, ref->node, &options, &out->mesh, &why)) return true;
  *e->error = why;
  if (why.origin == NULL && why.kind == VS_ERROR_MODEL) e->error->origin = ref->origin;
  return false;
}
