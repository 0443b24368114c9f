/* Cuts a drawing by a view's plane, by changing its nodes.
 *
 * A solid becomes a difference with a half-space that has no material. The faces of the cut therefore have the material
 * of the solid behind them. Where solids overlap, they have the material of the earlier solid. A drawing that contains
 * thin objects becomes a slice, which solids/resolve.c computes. */
#include "passes/cut_away.h"

vs_node *vs_node_cut(vs_ref ref, vs_vec3 point, vs_vec3 normal) {
  vs_store *store = ref.node->store;
  if (ref.node->class_ != VS_SOLID) {
    return vs_node_new(store, VS_SLICE, &(struct vs_slice){ .point = point, .normal = normal }, &ref, 1);
  }
  struct vs_half_space away = { .point = point, .normal = vs_v3_scale(normal, -1) };
  vs_node *space = vs_node_new(store, VS_HALF_SPACE, &away, NULL, 0);
  if (!space) return NULL;
  vs_ref pair[2] = { ref, { space, ref.origin } };
  vs_node *made = vs_node_new(store, VS_DIFFERENCE, &(struct vs_difference){ 0 }, pair, 2);
  vs_node_release(space);
  return made;
}

bool vs_scene_cut(vs_scene *scene, vs_vec3 point, vs_vec3 normal, vs_error *e) {
  for (size_t i = 0; i < scene->drawn_count; i++) {
    vs_node *made = vs_node_cut(scene->drawn[i], point, normal);
    if (!made) return vs_error_memory(e, scene->drawn[i].origin);
    vs_node_release(scene->drawn[i].node);
    scene->drawn[i].node = made;
  }
  return true;
}
