/* Replaces lines without end by finite lines, from side to side of the drawing's bounding box. If the drawing contains
 * only such lines, each is drawn ten units in both directions. */
#include "solids/endless_lines.h"

#include <stdlib.h>

#include "geometry/measure/node_measures.h"
#include "solids/resolve.h"
#include "model/store/array.h"
#include "model/walk.h"

typedef struct {
  vs_vec3 p, way;
  bool ray;
  const vs_material *material;
  const char *layer;
  const vs_origin *origin;
} endless;
typedef struct { endless *at; size_t count, room; } endless_list;
typedef struct { vs_affine placed; const vs_material *material; const char *layer; } endless_level;

/* Collects the lines without end below the node of `root`, with their positions in the drawing's coordinates. Returns
 * false on failure. */
static bool collect(vs_ref root, endless_list *out, vs_error *e) {
  vs_walk *w = vs_walk_new(root.node->store, root);
  endless_level *levels = NULL;
  size_t room = 0, depth;
  vs_ref at;
  bool ok = w || vs_error_memory(e, root.origin);
  for (vs_walk_event ev; ok && (ev = vs_walk_next(w, &at, &depth)) != VS_WALK_DONE;) {
    if (ev == VS_WALK_LEAVE) continue;
    if (ev == VS_WALK_ENTER && !(at.node->flags & VS_NODE_UNRESOLVED)) {
      vs_walk_skip(w);
      continue;
    }
    if (ev == VS_WALK_FAILED || !VS_GROW(levels, room, depth + 1)) {
      ok = vs_error_memory(e, root.origin);
      break;
    }
    levels[depth] = depth ? levels[depth - 1] : (endless_level){ vs_affine_identity(), NULL, NULL };
    endless_level *now = &levels[depth];
    if (at.node->kind == VS_TRANSFORM)
      now->placed = vs_affine_multiply(&now->placed, &VS_AS(transform, at.node)->matrix);
    if (at.node->kind == VS_MATERIAL) now->material = VS_AS(material, at.node)->material;
    if (at.node->kind == VS_LAYER) now->layer = VS_AS(layer, at.node)->name;
    if (at.node->kind != VS_XLINE && at.node->kind != VS_RAY) continue;
    if (!VS_GROW(out->at, out->room, out->count + 1)) {
      ok = vs_error_memory(e, root.origin);
      break;
    }
    bool ray = at.node->kind == VS_RAY;
    vs_vec3 p = ray ? VS_AS(ray, at.node)->p : VS_AS(xline, at.node)->p,
            way = ray ? VS_AS(ray, at.node)->v : vs_v3_sub(VS_AS(xline, at.node)->q, p);
    out->at[out->count++] = (endless){
      vs_affine_point(&now->placed, p), vs_affine_vector(&now->placed, way), ray, now->material, now->layer, at.origin
    };
  }
  vs_walk_free(w);
  free(levels);
  return ok;
}

/* Returns the part of the line inside the box b, with its material and layer. Returns the empty node if the line does
 * not intersect b, and NULL if memory is out. */
static vs_node *clipped(vs_store *s, const endless *l, const vs_bounds *b) {
  vs_vec3 ends[2];
  if (!vs_line_clip(l->p, vs_v3_unit(l->way), l->ray, b, &ends[0], &ends[1]))
    return vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
  vs_points *points = vs_points_new(s, ends, 2);
  vs_ref made = { points ? vs_node_new(s, VS_LINE, &(struct vs_line){ .points = points }, NULL, 0) : NULL, l->origin };
  vs_points_release(s, points);
  for (int i = 0; made.node && i < 2; i++) {
    struct { vs_field_material material; unsigned char end; } paint = { l->material, 0 };
    struct vs_layer layer = { .name = l->layer };
    if (i ? !l->layer : !l->material) continue;
    vs_node *round = vs_node_new(s, i ? VS_LAYER : VS_MATERIAL, i ? (const void *)&layer : &paint, &made, 1);
    vs_node_release(made.node);
    made.node = round;
  }
  return made.node;
}

static bool extent(const vs_scene *scene, vs_bounds *all, vs_error *e) {
  *all = vs_bounds_empty();
  for (size_t i = 0; i < scene->drawn_count; i++) {
    vs_bounds b;
    if (!vs_node_bounds(scene->drawn[i].node, &b, e)) return false;
    vs_bounds_unite(all, &b);
  }
  return true;
}

static void widen(vs_bounds *b, double by) {
  b->min = vs_v3_sub(b->min, vs_v3(by, by, by));
  b->max = vs_v3_add(b->max, vs_v3(by, by, by));
}

bool vs_scene_resolve(vs_scene *scene, const vs_kernel_options *options, vs_error *e) {
  bool needed = false, ok = true;
  vs_fineness facets = { scene->tolerance, scene->segments };
  endless_list lines = { 0 };
  vs_bounds all;
  for (size_t i = 0; i < scene->drawn_count; i++) needed = needed || scene->drawn[i].node->flags & VS_NODE_UNRESOLVED;
  if (!needed) return true;
  for (size_t i = 0; ok && i < scene->drawn_count; i++) ok = collect(scene->drawn[i], &lines, e);
  ok = ok && vs_resolve(scene->drawn, scene->drawn_count, &facets, options, e);
  if (ok && lines.count) {
    ok = extent(scene, &all, e);
    if (vs_bounds_is_empty(&all)) {
      for (size_t i = 0; i < lines.count; i++) vs_bounds_add(&all, lines.at[i].p);
      vs_bounds_add(&all, vs_v3(-10, -10, -10));
      vs_bounds_add(&all, vs_v3(10, 10, 10));
    } else widen(&all, 1e-9 * vs_bounds_diagonal(&all)); /* enlarges the box `all` a little, so that a line in the
                                                          * plane of a flat drawing counts as inside despite rounding
                                                          * errors */
  }
  for (size_t i = 0; ok && i < lines.count; i++) {
    vs_ref line = { clipped(scene->store, &lines.at[i], &all), lines.at[i].origin };
    if (options && options->warns && line.node && line.node->kind == VS_EMPTY)
      vs_job_warn(options->job, line.origin,
                  lines.at[i].ray ? "make-ray: the ray does not meet the drawing's bounding box, and is not shown"
                                  : "make-xline: the line does not meet the drawing's bounding box, and is not shown");
    ok = line.node ? vs_scene_draw(scene, line) || vs_error_memory(e, NULL) : vs_error_memory(e, NULL);
    vs_node_release(line.node);
  }
  free(lines.at);
  return ok;
}
