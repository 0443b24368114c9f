/* Owns the drawing that a back-end is handed: its defaults and what it holds on to. */
#include "model/scene.h"

void vs_scene_init(vs_scene *scene, vs_store *store) {
  *scene = (vs_scene){ .store = vs_store_retain(store), .title = "model", .view = VS_VIEW_EXTENTS, .lens = 35, .units = "m" };
}

bool vs_scene_draw(vs_scene *scene, vs_ref ref) {
  if (scene->drawn_count == scene->drawn_room) {
    size_t room = scene->drawn_room ? scene->drawn_room * 2 : 16;
    vs_ref *grown = vs_store_realloc(scene->store, scene->drawn, scene->drawn_room * sizeof *grown, room * sizeof *grown);
    if (!grown) return false;
    scene->drawn = grown;
    scene->drawn_room = room;
  }
  vs_node_retain(ref.node);
  scene->drawn[scene->drawn_count++] = ref;
  return true;
}

void vs_scene_free(vs_scene *scene) {
  if (!scene->store) return;
  for (size_t i = 0; i < scene->drawn_count; i++) vs_node_release(scene->drawn[i].node);
  vs_store_realloc(scene->store, scene->drawn, scene->drawn_room * sizeof *scene->drawn, 0);
  vs_store_release(scene->store);
  *scene = (vs_scene){ 0 };
}
