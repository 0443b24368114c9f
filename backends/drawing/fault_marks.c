/* Marks the objects that break a rule of the design in views with a cut. */
#include "backends/drawing/fault_marks.h"

#include <math.h>

#include "backends/lower.h"
#include "solids/sections.h"

/* Returns true if the view is a plan, and the cut removes no part of the mesh. */
static bool below_plan(const vs_scene_view *spec, const vs_mesh *m) {
  bool below = spec->cut_normal.z < -0.999999;
  for (size_t i = 0; below && i < m->vertex_count; i++)
    below = vs_v3_dot(vs_v3_sub(m->vertices[i], spec->cut_point), spec->cut_normal) >= 0;
  return below;
}

static bool add_outline(vs_emitter *e, vs_flat_view *v, const vs_outline *o) {
  const uint32_t first = (uint32_t)v->loop_count;
  for (size_t i = 0; i < o->count; i++) {
    const vs_polyline *p = &o->loops[i];
    if (!vs_emit_grow(e, &v->points, &v->point_room, v->point_count + p->count, sizeof *v->points) ||
        !vs_emit_grow(e, &v->loops, &v->loop_room, v->loop_count + 1, sizeof *v->loops))
      return false;
    v->loops[v->loop_count].first = (uint32_t)v->point_count, v->loops[v->loop_count++].count = (uint32_t)p->count;
    for (size_t k = 0; k < p->count; k++) v->points[v->point_count++] = vs_flat_view_project(v, p->at[k]);
  }
  if (!o->count) return true;
  if (!vs_emit_grow(e, &v->fills, &v->fill_room, v->fill_count + 1, sizeof *v->fills)) return false;
  v->fills[v->fill_count++] =
      (vs_flat_fill){ .first_loop = first, .loop_count = (uint32_t)o->count, .kind = VS_FILL_FAULT };
  return true;
}

static bool add_fault(vs_emitter *e, vs_flat_view *v, const vs_ref *fault) {
  vs_solid solid = { .part_count = 0 };
  vs_outline o = { 0 };
  const vs_scene_view *spec = &v->spec;
  bool ok = vs_lower_solids(e, fault, 1, VS_BENT_AGAIN, &solid) &&
            vs_mesh_section(&solid.mesh, spec->cut_point, spec->cut_normal, &o, e->error);
  if (ok && !o.count && solid.mesh.triangle_count && below_plan(spec, &solid.mesh)) {
    vs_outline_free(&o);
    ok = vs_mesh_shadow(&solid.mesh, spec->cut_point, spec->cut_normal, &o, e->error);
  }
  ok = ok && add_outline(e, v, &o);
  vs_outline_free(&o);
  vs_solid_free(&solid);
  return ok;
}

bool vs_flat_faults(vs_emitter *e, vs_flat_view *v) {
  const vs_scene *scene = e->scene;
  bool ok = true;
  for (size_t i = 0; ok && v->has_cut && v->look.parallel && i < scene->fault_count; i++)
    ok = scene->faults[i].node->class_ != VS_SOLID || add_fault(e, v, &scene->faults[i]);
  return ok;
}
