/* Implements the functions that a format's emit functions may call: for memory, messages, progress, and the data of
 * nodes, materials and lines that the plan has computed. */
#include "backends/emitter.h"

#include "backends/backend.h"
#include "backends/drive.h"
#include "model/job.h"

bool vs_emit_grow(vs_emitter *e, void *array, size_t *room, size_t need, size_t size) {
  return vs_store_grow(e->scene->store, array, room, need, size) || vs_emit_no_memory(e);
}

void vs_emit_release(vs_emitter *e, void *array, size_t room, size_t size) {
  if (array != NULL) vs_store_realloc(e->scene->store, array, room * size, 0);
}

bool vs_emit_fail(vs_emitter *e, const vs_ref *ref, const char *message) {
  return vs_error_set(e->error, VS_ERROR_MODEL, ref != NULL ? ref->origin : NULL, "%s", message);
}

bool vs_emit_no_memory(vs_emitter *e) {
  return vs_error_set(e->error, VS_ERROR_MEMORY, NULL, "out of memory while writing the drawing");
}

bool vs_emit_warn_once(vs_emitter *e, const vs_ref *ref, const char *message) {
  vs_drive *d = e->drive;
  vs_reuse_warned(&d->reuse, message);
  for (size_t i = 0; i < d->said_count; i++)
    if (d->said[i] == message) return true;
  if (e->options->strict) return vs_emit_fail(e, ref, message);
  if (!vs_emit_grow(e, &d->said, &d->said_room, d->said_count + 1, sizeof *d->said)) return false;
  d->said[d->said_count++] = message;
  vs_job_warn(e->job, ref != NULL ? ref->origin : NULL, message);
  return true;
}

bool vs_emit_progress(vs_emitter *e, const char *stage, double fraction) {
  if (vs_job_going(e->job, stage, fraction)) return true;
  return vs_error_set(e->error, VS_ERROR_INTERRUPT, NULL, "interrupted");
}

bool vs_emit_triangles(vs_emitter *e, size_t count) {
  vs_tally *tally = vs_store_tally(e->scene->store);
  size_t limit = e->job->limits.mesh_triangles;
  e->triangles += count;
  if (tally != NULL) tally->triangles += count;
  return !limit || e->triangles <= limit ||
         vs_error_set(e->error, VS_ERROR_LIMIT, NULL, "the result has more than %zu triangles, the limit", limit);
}

static bool drive_going(void *context) { return vs_emit_progress(context, "writing", -1); }
void vs_emit_watch(vs_emitter *e, vs_writer *w) {
  w->going = drive_going;
  w->going_context = e;
}

const vs_origin *vs_emit_line_origin(const vs_emitter *e, uint32_t line) {
  const vs_drive *d = e->drive;
  size_t low = 0, high = d->line_count; /* binary search: `low` becomes the index of the last recorded line at or before
                                         * `line` */
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (d->lines[middle].line <= line) low = middle + 1; else high = middle;
  }
  return low > 0 ? d->lines[low - 1].origin : NULL;
}

/* ---- facts of the plan ---- */

unsigned vs_emit_looks(const vs_emitter *e, const vs_node *n) {
  const drive_entry *entry = drive_find(e, n);
  if (entry == NULL) return VS_LOOKS_BARE;
  return (entry->bare ? VS_LOOKS_BARE : 0u) | (entry->painted ? VS_LOOKS_PAINTED : 0u) |
         (entry->layered ? VS_LOOKS_LAYERED : 0u);
}

size_t vs_emit_material_count(const vs_emitter *e) { return e->drive->material_count; }
const vs_material *vs_emit_material_at(const vs_emitter *e, size_t number) { return e->drive->materials[number - 1]; }

size_t vs_emit_material_number(const vs_emitter *e, const vs_material *m) {
  const uint64_t *at = m != NULL ? vs_nodemap_get(&e->drive->paints, m) : NULL;
  return at != NULL ? (size_t)*at : 0;
}

bool vs_emit_put_template_number(vs_emitter *e, uint32_t id) {
  vs_reuse_numbered(&e->drive->reuse, e->out, VS_NUMBER_TEMPLATE, id);
  return vs_put_u32(e->out, id);
}

bool vs_emit_put_material_number(vs_emitter *e, const vs_material *m) {
  uint32_t number = (uint32_t)vs_emit_material_number(e, m);
  vs_reuse_numbered(&e->drive->reuse, e->out, VS_NUMBER_PAINT, number);
  return vs_put_u32(e->out, number);
}

/* ---- origins of lines ---- */

bool vs_drive_mark(vs_emitter *e, uint32_t line, const vs_origin *origin) {
  vs_drive *d = e->drive;
  /* the origin of a recorded line is valid up to the next recorded line */
  if (d->line_count > 0 && d->lines[d->line_count - 1].origin == origin) return true;
  if (d->line_count > 0 && d->lines[d->line_count - 1].line == line) {
    d->lines[d->line_count - 1].origin = origin;
    return true;
  }
  if (!vs_emit_grow(e, &d->lines, &d->line_room, d->line_count + 1, sizeof *d->lines)) return false;
  d->lines[d->line_count++] = (vs_reuse_line){ line, origin };
  return true;
}
