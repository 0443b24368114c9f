/* Makes nodes of the simplest kinds (simple_nodes.h), to which every other kind can be converted. */
#include "geometry/shapes/simple_nodes.h"
#include "model/store/array.h"

#include <stdlib.h>

vs_node *vs_node_of_polyline(vs_store *store, const vs_polyline *p) {
  vs_points *points = vs_points_new(store, p->at, p->count);
  vs_node *line =
      points ? vs_node_new(store, VS_LINE, &(struct vs_line){ .points = points, .closed = p->closed }, NULL, 0) : NULL;
  if (points) vs_points_release(store, points);
  return line;
}

vs_node *vs_node_of_outline(vs_store *store, const vs_outline *o, const vs_origin *origin) {
  vs_ref *loops = vs_zeros(o->count + 1, sizeof *loops);
  vs_node *made = NULL;
  size_t count = 0;
  while (loops && count < o->count &&
         (loops[count] = (vs_ref){ vs_node_of_polyline(store, &o->loops[count]), origin }).node)
    count++;
  if (loops && count == o->count) made = vs_node_new(store, count ? VS_REGION : VS_EMPTY, NULL, loops, count);
  for (size_t i = 0; i < count; i++) vs_node_release(loops[i].node);
  free(loops);
  return made;
}

bool vs_node_is_outline(const vs_node *n) {
  if (n->kind != VS_REGION) return false;
  for (uint32_t i = 0; i < n->child_count; i++)
    if (n->children[i].node->kind != VS_LINE) return false;
  return true;
}

vs_node *vs_node_of_mesh(vs_store *store, const vs_mesh *m, bool closed) {
  if (m->triangle_count == 0) return vs_node_new(store, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
  vs_node *made = NULL;
  uint32_t *starts = vs_fresh(m->triangle_count + 1, sizeof *starts);
  vs_points *points = vs_points_new(store, m->vertices, m->vertex_count);
  vs_faces *faces = NULL;
  if (starts && points) {
    for (size_t i = 0; i <= m->triangle_count; i++) starts[i] = (uint32_t)(3 * i);
    faces = vs_faces_new(store, starts, m->triangle_count, &m->triangles[0][0], 3 * m->triangle_count);
  }
  if (faces)
    made = vs_node_new(store, VS_POLYFACE_MESH,
                       &(struct vs_polyface_mesh){ .points = points, .faces = faces, .closed = closed }, NULL, 0);
  if (faces) vs_faces_release(store, faces);
  if (points) vs_points_release(store, points);
  free(starts);
  return made;
}
