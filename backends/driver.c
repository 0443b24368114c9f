/* Implements the driver: it plans a drawing (drawing_plan.c), computes its bounds (camera_boxes.c), and writes its
 * templates and its objects (tree_walk.c). */
#include "backends/driver.h"

#include <string.h>

#include "backends/camera_boxes.h"
#include "backends/drive.h"
#include "backends/lower.h"
#include "backends/drawing_plan.h"
#include "backends/text_runs.h"
#include "backends/tree_walk.h"
#include "model/job.h"
#include "model/store/cache.h"

/* Searches the cache for the text of the consecutive drawn objects that begin at index `from`. If the text is
 * cached, writes it and sets *next to the index after them. Sets *asked to the index before which no further search
 * is needed. */
static bool drive_root(vs_emitter *e, const vs_run_row *row, size_t from, size_t *asked, size_t *next) {
  vs_run run;
  if (e->drive->reuse.cache == NULL || e->drive->reuse.open || from < *asked) return true;
  if (!vs_drive_run(e, row, from, &run)) return false;
  *asked = run.until;
  if (run.found) *next = run.until;
  return true;
}

static bool drive_definitions(vs_emitter *e) {
  vs_drive *d = e->drive;
  for (size_t i = 0; i < d->order_count; i++) {
    drive_entry entry = d->entries[d->order[i]];
    if (entry.definition == 0) continue;
    size_t asked = 0, next = 0;
    vs_drive_reset(e);
    if (!vs_drive_mark_ref(e, &entry.ref) || !e->backend->define(e, entry.definition, &entry.ref, true)) return false;
    e->depth = 1;
    e->body = entry.ref.node;
    if (!drive_root(e, &(vs_run_row){ NULL, &entry.ref, 1, true }, 0, &asked, &next) ||
        (next == 0 && !vs_drive_walk(e, &entry.ref, true)))
      return false;
    if (d->reuse.open) vs_drive_run_end(e);
    if (!e->backend->define(e, entry.definition, &entry.ref, false)) return false;
  }
  return true;
}

static bool drive_all_vain(vs_emitter *e) {
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (!drive_vain(e, &e->scene->drawn[i])) return false;
  return true;
}

/* Walks the objects that are not solid, for a format that also receives the union of all solids. Sets *any to true if
 * there are such objects. */
static bool drive_loose(vs_emitter *e, bool *any) {
  for (size_t i = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    if (ref->node->class_ == VS_SOLID || drive_vain(e, ref)) continue;
    *any = true;
    vs_drive_reset(e);
    if (!vs_drive_walk(e, ref, false)) return false;
  }
  vs_drive_reset(e);
  return true;
}

bool vs_drive_scene(vs_emitter *e) {
  vs_drive *d = vs_store_realloc(e->scene->store, NULL, 0, sizeof *d);
  if (d == NULL) return vs_emit_no_memory(e);
  memset(d, 0, sizeof *d);
  d->index.store = d->paints.store = d->bounds.places.store = e->scene->store;
  vs_job_stage(e->job, "meshing");
  e->drive = d;
  vs_plan_operations(d);
  d->reuse = (vs_reuse){ .store = e->scene->store };
  if (drive_has(e, VS_KEEPS_TEXT) && vs_cache_asks(vs_store_cache(e->scene->store)))
    d->reuse.cache = vs_store_cache(e->scene->store);
  e->out->keeps_lines = drive_has(e, VS_KEEPS_ORIGINS);
  if (e->scene->has_ground && e->scene->ground_material != NULL && !vs_plan_material(e, e->scene->ground_material))
    return false;
  if (!vs_plan_scene(e)) return false;
  if (e->scene->drawn_count == 0 && !drive_has(e, VS_VERBATIM))
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "nothing is drawn");
  if (drive_all_vain(e) && !drive_has(e, VS_VERBATIM)) return vs_drive_nothing(e);
  if (!vs_drive_bounds(e) || (!drive_has(e, VS_VERBATIM) && !vs_drive_frame(e))) return false;
  vs_drive_reset(e);
  if (!e->backend->begin(e)) return false;
  bool loose = false;
  if (drive_has(e, VS_LOOSE) && !drive_loose(e, &loose)) return false;
  if (e->backend->solid != NULL) {
    vs_solid mesh = { .part_count = 0 };
    bool ok = drive_has(e, VS_DRAWS) || (vs_lower_drawing(e, &mesh) && (mesh.mesh.triangle_count > 0 || loose ||
                                                                   vs_drive_nothing(e)));
    ok = ok && e->backend->solid(e, &mesh);
    vs_solid_free(&mesh);
    return ok && e->backend->end(e);
  }
  if (e->backend->copies != NULL) {
    vs_solid_copies parts = { .part_count = 0 };
    bool ok = vs_lower_drawing_copies(e, &parts) && (parts.meshes.copy_count > 0 || vs_drive_nothing(e)) &&
              e->backend->copies(e, &parts);
    vs_solid_copies_free(&parts);
    return ok && e->backend->end(e);
  }
  double share = 1 / ((double)e->scene->drawn_count + 1); /* fraction of the progress for each object; the templates
                                                           * count as one more object */
  vs_job_part(e->job, 0, share);
  if (!drive_definitions(e)) return false;
  const vs_run_row drawn = { NULL, e->scene->drawn, e->scene->drawn_count, false };
  for (size_t i = 0, asked = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    size_t next = i;
    vs_job_part(e->job, (double)(i + 1) * share, share);
    vs_drive_reset(e);
    if (d->reuse.open && i == d->run_until) vs_drive_run_end(e);
    if (!drive_root(e, &drawn, i, &asked, &next)) return false;
    if (next > i) {
      i = next - 1;
      continue;
    }
    if (drive_vain(e, ref)) continue;
    if (!vs_drive_mark_ref(e, ref)) return false;
    if (e->backend->item != NULL && !e->backend->item(e, i, false)) return false;
    if (!vs_drive_walk(e, ref, false)) return false;
    if (e->backend->item != NULL && !e->backend->item(e, i, true)) return false;
  }
  if (d->reuse.open) vs_drive_run_end(e);
  vs_drive_reset(e);
  return e->backend->end(e) && !e->out->failed;
}

const vs_solid *vs_emit_mesh(vs_emitter *e, const vs_ref *ref) {
  drive_entry *entry = drive_find(e, ref->node);
  if (entry != NULL && entry->mesh != NULL) return entry->mesh;
  vs_solid made = { .part_count = 0 };
  if (!vs_lower_mesh(e, ref, &made)) {
    vs_solid_free(&made);
    return NULL;
  }
  if (entry != NULL && entry->uses > 1) {
    entry->mesh = vs_store_realloc(e->scene->store, NULL, 0, sizeof *entry->mesh);
    if (entry->mesh != NULL) {
      *entry->mesh = made;
      return entry->mesh;
    }
  }
  vs_solid_free(&e->drive->scratch);
  e->drive->scratch = made;
  return &e->drive->scratch;
}

void vs_drive_free(vs_emitter *e) {
  vs_drive *d = e->drive;
  if (d == NULL) return;
  for (size_t i = 0; i < d->entry_count; i++) {
    vs_node_release(d->entries[i].lowered);
    if (d->entries[i].mesh == NULL) continue;
    vs_solid_free(d->entries[i].mesh);
    vs_emit_release(e, d->entries[i].mesh, 1, sizeof *d->entries[i].mesh);
  }
  vs_solid_free(&d->scratch);
  vs_reuse_free(&d->reuse);
  vs_bounds_memo_free(&d->bounds);
  vs_nodemap_free(&d->index);
  vs_nodemap_free(&d->paints);
  vs_emit_release(e, d->materials, d->material_room, sizeof *d->materials);
  vs_emit_release(e, d->entries, d->entry_room, sizeof *d->entries);
  vs_emit_release(e, d->order, d->order_room, sizeof *d->order);
  vs_emit_release(e, d->steps, d->step_room, sizeof *d->steps);
  vs_emit_release(e, d->frames, d->frame_room, sizeof *d->frames);
  vs_emit_release(e, d->lines, d->line_room, sizeof *d->lines);
  for (size_t i = 0; i < d->kept_count; i++) vs_node_release(d->kept[i]);
  vs_emit_release(e, d->kept, d->kept_room, sizeof *d->kept);
  vs_emit_release(e, d->said, d->said_room, sizeof *d->said);
  vs_emit_release(e, e->boxes, e->box_room, sizeof *e->boxes);
  e->boxes = NULL;
  e->box_count = e->box_room = 0;
  vs_emit_release(e, d, 1, sizeof *d);
  e->drive = NULL;
}
