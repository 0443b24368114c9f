/* Runs the passes over a drawing before it is written. */
#include "passes/optimise.h"

#include "geometry/measure/node_measures.h"
#include "passes/group.h"
#include "passes/rewrite.h"

/* Computes bounds for the passes. A failure must not end the drawing: a node without bounds counts as unbounded, and
 * the mesher reports its error. */
static bool optimise_bounds(void *context, const vs_node *n, vs_bounds *out, vs_error *e) {
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  if (vs_bounds_memo_get(context, n, out, &why)) return true;
  if (why.kind != VS_ERROR_MODEL) {
    if (e) *e = why;
    return false;
  }
  *out = (vs_bounds){ { -INFINITY, -INFINITY, -INFINITY }, { INFINITY, INFINITY, INFINITY } };
  return true;
}

bool vs_scene_optimise(vs_scene *scene, unsigned passes, vs_pass_stats *stats, const vs_pass_notes *notes,
                       vs_error *e) {
  vs_bounds_memo memo = { .places = { .store = scene->store } };
  vs_pass_options options = { passes, optimise_bounds, &memo, notes };
  bool ok = vs_passes_run(scene->store, scene->drawn, scene->drawn_count, &options, stats, e);
  vs_bounds_memo_free(&memo);
  return ok;
}

/* Computes bounds for the grouping of sets to trees of boxes. A node without bounds is not grouped; the mesher reports
 * its error. */
static bool group_bounds(void *context, const vs_node *n, vs_bounds *out, vs_error *e) {
  vs_error why = { VS_ERROR_NONE, NULL, "" };
  *out = vs_bounds_empty();
  if (n->flags & VS_NODE_ENDLESS || vs_bounds_memo_get(context, n, out, &why) || why.kind == VS_ERROR_MODEL)
    return true;
  if (e) *e = why;
  return false;
}

bool vs_scene_group(vs_scene *scene, vs_error *e) {
  vs_bounds_memo memo = { .places = { .store = scene->store } };
  vs_pass_options options = { 0, group_bounds, &memo, NULL };
  bool ok = vs_sets_group(scene->store, scene->drawn, scene->drawn_count, &options, e);
  vs_bounds_memo_free(&memo);
  return ok;
}
