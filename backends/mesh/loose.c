/* Collects the lines and open faces of a drawing in a walk. The walk skips solids, because the kernel computes their
 * union. */
#include <string.h>

#include "backends/mesh/loose.h"

bool vs_loose_begin(vs_emitter *e) {
  vs_loose *l = vs_store_realloc(e->scene->store, NULL, 0, sizeof *l);
  if (l == NULL) return vs_emit_no_memory(e);
  memset(l, 0, sizeof *l);
  e->state = l;
  return !e->out->failed;
}

void vs_loose_close(vs_emitter *e) {
  vs_loose *l = e->state;
  if (l == NULL) return;
  vs_emit_release(e, l->points, l->point_room, sizeof *l->points);
  vs_emit_release(e, l->corners, l->corner_room, sizeof *l->corners);
  vs_emit_release(e, l->runs, l->run_room, sizeof *l->runs);
  vs_emit_release(e, l, 1, sizeof *l);
  e->state = NULL;
}

/* Allocates memory for points and corners, and begins a run: a line, or a list of triangles. The caller must have
 * mapped the points by e->placement. */
static bool loose_add(vs_emitter *e, bool line, const vs_vec3 *points, size_t point_count, size_t corner_count) {
  vs_loose *l = e->state;
  if (l->point_count + point_count > UINT32_MAX)
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "more points than the file can hold");
  if (!vs_emit_grow(e, &l->points, &l->point_room, l->point_count + point_count, sizeof *l->points) ||
      !vs_emit_grow(e, &l->corners, &l->corner_room, l->corner_count + corner_count, sizeof *l->corners) ||
      !vs_emit_grow(e, &l->runs, &l->run_room, l->run_count + 1, sizeof *l->runs))
    return false;
  for (size_t i = 0; i < point_count; i++) l->points[l->point_count + i] = vs_affine_point(&e->placement, points[i]);
  l->runs[l->run_count++] = (vs_loose_run){ line, l->corner_count, corner_count, e->material, e->layer, e->part };
  return true;
}

vs_emit_status vs_loose_leaf(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_loose *l = e->state;
  if (ref->node->class_ == VS_SOLID) return VS_EMITTED;
  const vs_solid *m = vs_emit_mesh(e, ref);
  if (m == NULL) return VS_FAILED;
  const vs_mesh *mesh = &m->mesh;
  uint32_t base = (uint32_t)l->point_count;
  if (mesh->triangle_count == 0) return VS_EMITTED;
  if (!loose_add(e, false, mesh->vertices, mesh->vertex_count, 3 * mesh->triangle_count)) return VS_FAILED;
  bool mirrored = vs_affine_determinant(&e->placement) < 0;
  for (size_t i = 0; i < mesh->triangle_count; i++)
    for (size_t k = 0; k < 3; k++) l->corners[l->corner_count++] = base + mesh->triangles[i][mirrored ? 2 - k : k];
  l->point_count += mesh->vertex_count;
  return VS_EMITTED;
}

vs_emit_status vs_loose_line(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)phase;
  vs_loose *l = e->state;
  const struct vs_line *line = VS_AS(line, ref->node);
  size_t count = line->points->count, corners = count + (line->closed ? 1 : 0);
  uint32_t base = (uint32_t)l->point_count;
  if (count < 2) return VS_EMITTED;
  if (!loose_add(e, true, line->points->at, count, corners)) return VS_FAILED;
  for (size_t i = 0; i < corners; i++) l->corners[l->corner_count++] = base + (uint32_t)(i % count);
  l->point_count += count;
  return VS_EMITTED;
}

/* Returns VS_WHOLE for solids, so that the walk does not visit their children. */
vs_emit_status vs_loose_through(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)e;
  return phase == VS_PHASE_ENTER && ref->node->class_ == VS_SOLID ? VS_WHOLE : VS_EMITTED;
}

vs_emit_status vs_loose_boolean(vs_emitter *e, const vs_ref *ref, vs_phase phase) {
  (void)e, (void)ref;
  return phase == VS_PHASE_ENTER ? VS_WHOLE : VS_EMITTED; /* skips solids; unions and differences of regions were
                                                           * replaced by regions before */
}

size_t vs_loose_triangles(const vs_loose *l) {
  size_t corners = 0;
  for (size_t i = 0; i < l->run_count; i++) corners += l->runs[i].line ? 0 : l->runs[i].count;
  return corners / 3;
}

size_t vs_loose_pieces(const vs_loose *l) {
  size_t pieces = 0;
  for (size_t i = 0; i < l->run_count; i++) pieces += l->runs[i].line ? l->runs[i].count - 1 : 0;
  return pieces;
}
