/* Computes two bounds of a drawing: those that determine its fineness (the size of facets), and those that its camera
 * shows. */
#include "backends/camera_boxes.h"

#include <math.h>
#include <stdio.h>

#include "backends/drive.h"
#include "backends/format_numbers.h"
#include "model/job.h"
#include "solids/drawn_bounds.h"

static void drive_include(vs_bounds *all, const vs_bounds *b) {
  all->min = vs_v3(fmin(all->min.x, b->min.x), fmin(all->min.y, b->min.y), fmin(all->min.z, b->min.z));
  all->max = vs_v3(fmax(all->max.x, b->max.x), fmax(all->max.y, b->max.y), fmax(all->max.z, b->max.z));
}

/* Returns true if the drawing contains `native` text, which the user wrote for this format's program. */
static bool drive_has_native(const vs_emitter *e) {
  for (size_t i = 0; i < e->drive->entry_count; i++)
    if (e->drive->entries[i].ref.node->kind == VS_NATIVE) return true;
  return false;
}

/* Adds the bounds of a drawn object to e->boxes and to *all; for a union, the bounds of each part, up to `most` boxes
 * in total. If budget is not NULL, the bounds are those of the material that remains after cuts. */
static bool drive_boxes(vs_emitter *e, const vs_ref *ref, vs_bounds_memo *memo, size_t *budget, vs_bounds *all) {
  enum { most = 4096 };
  const vs_node *n = ref->node;
  vs_kernel_options options = { .job = e->job,
                                .max_bytes = e->job->limits.mesh_bytes,
                                .max_triangles = e->job->limits.mesh_triangles };
  vs_drawn_search search = { .facets = &e->drawing_facets, .options = &options, .budget = budget };
  while (vs_node_is_wrapper(n)) n = n->children[0].node;
  bool parts = n->kind == VS_UNION && n->child_count + e->box_count <= most;
  size_t count = parts ? n->child_count : 1;
  if (!vs_emit_grow(e, &e->boxes, &e->box_room, e->box_count + count, sizeof *e->boxes)) return false;
  for (size_t i = 0; i < count; i++) {
    if (!drive_tick(e)) return false;
    vs_bounds b;
    const vs_ref *part = parts ? &n->children[i] : ref;
    if (drive_vain(e, part)) continue;
    if (budget ? !vs_drawn_bounds(part, &search, &b, e->error)
               : !vs_bounds_memo_get(memo, part->node, &b, e->error)) {
      if (e->error->kind == VS_ERROR_MODEL && e->error->origin == NULL) e->error->origin = part->origin;
      return false;
    }
    if (b.min.x > b.max.x) continue;
    if (e->box_count == 0) *all = b;
    else drive_include(all, &b);
    if (e->box_count >= most) drive_include(&e->boxes[most - 1], &b); /* the last box also encloses all further parts */
    else e->boxes[e->box_count++] = b;
  }
  return true;
}

bool vs_drive_frame(vs_emitter *e) {
  size_t budget = VS_DRAWN_BOUNDS_MOST, wide = e->box_count;
  e->framed = e->bounds;
  if (!drive_has(e, VS_FRAMES) || e->scene->view == VS_VIEW_CAMERA || drive_has_native(e)) return true;
  e->box_count = 0;
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (!drive_vain(e, &e->scene->drawn[i]) &&
        !drive_boxes(e, &e->scene->drawn[i], &e->drive->bounds, &budget, &e->framed))
      return false;
  if (e->box_count > 0) return true;
  e->box_count = wide > 0; /* the cuts remove the whole drawing, so the camera shows the bounds of the uncut operands */
  e->boxes[0] = e->framed = e->bounds;
  return true;
}

bool vs_drive_nothing(vs_emitter *e) {
  const vs_ref *empty = NULL; /* Every format shows solids. If no bounds were found although the drawing contains
                               * solids, these solids are empty. */
  bool other = false;
  for (size_t i = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    if (!empty && (ref->node->class_ == VS_SOLID || ref->node->class_ == VS_NOTHING)) empty = ref;
    other = other || (ref->node->class_ != VS_SOLID && ref->node->class_ != VS_NOTHING);
  }
  if (empty && !other)
    return vs_error_set(e->error, VS_ERROR_MODEL, empty->origin,
                        "every drawn object is empty: a ghost, an object without extent, a solid that is subtracted "
                        "wholly, or an intersection of solids that do not overlap; (subtract object cutter) takes the "
                        "second from the first, and intersect keeps the common part of solids that overlap");
  return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "the drawing holds nothing that this format can show");
}

bool vs_drive_bounds(vs_emitter *e) {
  if (drive_has(e, VS_VERBATIM)) return true;
  for (size_t i = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    if (drive_vain(e, ref)) continue;
    if (ref->node->flags & VS_NODE_ENDLESS) return vs_emit_fail(e, ref, VS_ENDLESS_MESSAGE);
    if (!drive_boxes(e, ref, &e->drive->bounds, NULL, &e->bounds)) return false;
  }
  /* The size of native text is unknown. The camera shows a box of size 2 around the origin. */
  if (e->box_count == 0 && drive_has_native(e)) {
    if (!vs_emit_grow(e, &e->boxes, &e->box_room, 1, sizeof *e->boxes)) return false;
    e->bounds = e->boxes[e->box_count++] = (vs_bounds){ vs_v3(-1, -1, -1), vs_v3(1, 1, 1) };
  }
  if (e->box_count == 0) return vs_drive_nothing(e);
  const double *low = &e->bounds.min.x, *high = &e->bounds.max.x;
  for (int i = 0; i < 3; i++)
    if (!isfinite(low[i]) || !isfinite(high[i]))
      return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "the drawing is infinitely large");
  e->drawing_facets.segments = e->scene->segments;
  e->drawing_facets.tolerance = e->scene->tolerance > 0 ? e->scene->tolerance : vs_fineness_tolerance(&e->bounds);
  e->facets = e->drawing_facets;
  e->chord = 1;
  double most = 0;
  for (int i = 0; i < 3; i++) most = fmax(most, fmax(fabs(low[i]), fabs(high[i])));
  bool single = e->backend->numbers == VS_NUMBERS_SINGLE || e->backend->numbers == VS_NUMBERS_LOOSE;
  double step = ldexp(1, ilogb(most > 0 ? most : 1) - 23);
  if (single && step > vs_fineness_tolerance(&e->bounds) / 8 && e->job->warn != NULL) {
    char message[200];
    snprintf(message, sizeof message,
             "the drawing is too far from the origin for its size: this format's numbers have steps of %.3g there; "
             "move the drawing to the origin, or write .obj, .off or .glb",
             step);
    vs_job_warn(e->job, NULL, message);
  }
  return true;
}
