/* Implements shapes that a format writes once and uses at many places (shared_shapes.h). */
#include "backends/shared_shapes.h"

#include <string.h>

#include "backends/shade.h"
#include "geometry/measure/node_measures.h"

void vs_shared_free(vs_emitter *e, vs_shared_shapes *s) {
  for (size_t i = 0; i < VS_UNIT_COUNT; i++)
    vs_emit_release(e, s->units[i].at, s->units[i].room, sizeof *s->units[i].at);
  vs_emit_release(e, s->made, s->made_room, sizeof *s->made);
  vs_nodemap_free_held(&s->nodes);
}

bool vs_shared_unit(vs_emitter *e, vs_shared_shapes *s, const vs_unit_copy *copy, vs_shared_write *write,
                    uint32_t *number) {
  size_t *room = &s->units[copy->unit].room, old = *room, turn = (size_t)copy->turn;
  if (!vs_emit_grow(e, &s->units[copy->unit].at, room, turn + 1, sizeof(uint32_t))) return false;
  uint32_t *at = s->units[copy->unit].at;
  if (*room > old) memset(at + old, 0, (*room - old) * sizeof *at);
  if (at[turn] == 0) {
    vs_solid form = { .mesh.most = e->job->limits.mesh_triangles };
    bool ok = (vs_unit_mesh(copy->unit, copy->turn, &form.mesh) ||
               (form.mesh.over ? vs_emit_triangles(e, form.mesh.most + 1) : vs_emit_no_memory(e))) &&
              write(e, &form, vs_shade_crease(copy->turn > 0), number);
    vs_solid_free(&form);
    if (!ok) return false;
    at[turn] = *number + 1;
  }
  *number = at[turn] - 1;
  return true;
}

bool vs_shared_find(vs_emitter *e, const vs_shared_shapes *s, const vs_node *n, bool shared, vs_shared_place *out) {
  const uint64_t *known = shared ? vs_nodemap_get(&s->nodes, n) : NULL;
  *out = (vs_shared_place){ .shared = shared, .written = known != NULL };
  if (known != NULL) {
    out->number = s->made[*known - 1].number, out->middle = s->made[*known - 1].middle;
  } else {
    vs_bounds b;
    if (!vs_node_bounds(n, &b, e->error)) return false;
    out->middle = vs_v3_scale(vs_v3_add(b.min, b.max), 0.5);
  }
  out->home = vs_affine_translation(vs_v3_scale(out->middle, -1));
  if (shared) {
    vs_affine middle = vs_affine_translation(out->middle);
    out->there = vs_affine_multiply(&e->placement, &middle);
  } else {
    vs_affine turned = e->placement;
    for (int i = 0; i < 3; i++) turned.m[i][3] = 0;
    out->home = vs_affine_multiply(&turned, &out->home);
    out->there = vs_affine_translation(vs_affine_point(&e->placement, out->middle));
  }
  return true;
}

bool vs_shared_keep(vs_emitter *e, vs_shared_shapes *s, vs_node *n, vs_shared_place *place, uint32_t number) {
  place->number = number, place->written = true;
  if (!place->shared) return true;
  if (!vs_emit_grow(e, &s->made, &s->made_room, s->made_count + 1, sizeof *s->made)) return false;
  uint64_t *at = vs_nodemap_put_held(&s->nodes, n, NULL);
  if (at == NULL) return vs_emit_no_memory(e);
  s->made[s->made_count++] = (vs_shared_node){ number, place->middle };
  *at = s->made_count;
  return true;
}

vs_vec3 vs_shared_line_middle(const vs_emitter *e, const struct vs_line *l) {
  vs_bounds b = vs_bounds_empty();
  for (uint32_t i = 0; i < l->points->count; i++) vs_bounds_add(&b, vs_affine_point(&e->placement, l->points->at[i]));
  return vs_v3_scale(vs_v3_add(b.min, b.max), 0.5);
}
