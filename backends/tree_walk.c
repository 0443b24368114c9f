/* Implements the walk over a drawn object, without recursion: a stack contains a frame for each open operation. The
 * walk calls the back-end's emit functions. Each node that the format cannot express is replaced once by simpler
 * kinds. */
#include "backends/tree_walk.h"

#include <float.h>
#include <math.h>

#include "backends/drive.h"
#include "backends/lower.h"
#include "backends/text_runs.h"
#include "geometry/primitives/shape.h"
#include "model/kinds.h"

static bool drive_finite_at(const vs_field_info *f, const void *data) {
  const char *at = (const char *)data + f->offset;
  const double *numbers = (const double *)(const void *)at;
  size_t count = vs_field_reals[f->type];
  if (f->type == VS_FIELD_points) {
    const vs_points *points = *(const vs_field_points *)(const void *)at;
    numbers = &points->at[0].x;
    count = 3 * (size_t)points->count;
  }
  for (size_t i = 0; i < count; i++)
    if (!isfinite(numbers[i])) return false;
  return true;
}

static bool drive_check(vs_emitter *e, const vs_ref *ref) {
  if (!vs_kind_within((vs_kind)ref->node->kind, vs_node_data(ref->node), DBL_MAX)) {
    const vs_kind_info *info = vs_kind_get((vs_kind)ref->node->kind);
    size_t i = 0;
    while (i + 1 < info->field_count && drive_finite_at(&info->fields[i], vs_node_data(ref->node))) i++;
    return vs_error_set(e->error, VS_ERROR_MODEL, ref->origin, "%s: %s is infinite or not a number", info->name,
                        info->fields[i].argument);
  }
  if (ref->node->kind == VS_TRANSFORM) {
    double size = vs_affine_determinant(&VS_AS(transform, ref->node)->matrix);
    if (size == 0 || !isfinite(size)) return vs_emit_fail(e, ref, "the transformation flattens the object to nothing");
  }
  return true;
}

bool vs_drive_mark_ref(vs_emitter *e, const vs_ref *ref) {
  const vs_drive *d = e->drive;
  if (!drive_has(e, VS_KEEPS_ORIGINS) || (d->line_count > 0 && d->lines[d->line_count - 1].origin == ref->origin))
    return true;
  return vs_drive_mark(e, vs_writer_line(e->out), ref->origin);
}

/* Returns the node's rank for lowering: a node is replaced only by nodes of lower rank, so that lowering ends. Ranks
 * follow the column `level` of the table of kinds. */
static int drive_rank(const vs_node *n) {
  if (n->kind == VS_POLYFACE_MESH || n->kind == VS_LINE) return 2 * VS_LEVEL_MESH;
  const vs_shape *shape = vs_shape_of(n);
  return 2 * (int)vs_kind_get((vs_kind)n->kind)->level + (shape && shape->parts);
}

static bool drive_enter(vs_emitter *e, const vs_ref *ref, bool body);

/* Returns true if every node of the tree n has a rank below `rank`. n replaces another node. Recursion is safe: the
 * trees that lower.c creates are only a few nodes deep. */
static bool drive_stands_below(const vs_node *n, int rank) {
  if (vs_kind_get((vs_kind)n->kind)->level != VS_LEVEL_OPERATION) return drive_rank(n) < rank;
  for (size_t i = 0; i < n->child_count; i++)
    if (!drive_stands_below(n->children[i].node, rank)) return false;
  return true;
}

/* Replaces the node by simpler kinds and emits these. They must have a lower rank than the node, so that repeated
 * replacement ends. */
static bool drive_lower(vs_emitter *e, const vs_ref *ref) {
  drive_entry *entry = drive_find(e, ref->node);
  vs_node *made = NULL;
  vs_ref lower = { entry != NULL ? entry->lowered : NULL, ref->origin };
  if (lower.node == NULL && (lower.node = made = vs_lower(e, ref)) == NULL) return false;
  const vs_kind_info *from = vs_kind_get((vs_kind)ref->node->kind);
  if (vs_kind_get((vs_kind)lower.node->kind)->level == VS_LEVEL_OPERATION &&
      drive_stands_below(lower.node, drive_rank(ref->node))) {
    if (made != NULL) {
      if (!vs_emit_grow(e, &e->drive->kept, &e->drive->kept_room, e->drive->kept_count + 1, sizeof *e->drive->kept)) {
        vs_node_release(made);
        return false;
      }
      e->drive->kept[e->drive->kept_count++] = made;
      if (entry != NULL && entry->uses > 1 && entry->definition == 0) entry->lowered = vs_node_retain(made);
    }
    return drive_enter(e, &lower, false);
  }
  vs_emit_fn *fn = vs_backend_writes(e->backend, lower.node);
  bool was_smooth = e->smooth, ok = true;
  if (lower.node->kind != VS_EMPTY) {
    vs_emit_status status = VS_LOWER;
    const char *lossy = e->backend->emit[lower.node->kind].lossy;
    e->smooth = vs_lower_is_round(ref->node);
    if (fn != NULL && drive_rank(lower.node) < drive_rank(ref->node))
      status = lossy != NULL && !vs_emit_warn_once(e, ref, lossy) ? VS_FAILED : fn(e, &lower, VS_PHASE_LEAF);
    ok = status == VS_EMITTED;
    if (status == VS_LOWER)
      vs_error_set(e->error, VS_ERROR_MODEL, ref->origin, "%s cannot be written in this format", from->name);
    e->smooth = was_smooth;
  }
  if (made != NULL) {
    /* the text of a template is written only once, so the simpler nodes that replace it need not be kept */
    if (entry != NULL && entry->uses > 1 && entry->definition == 0) entry->lowered = made;
    else vs_node_release(made);
  }
  return ok;
}

static size_t drive_shown(const vs_emitter *e, const vs_node *n, const drive_entry *entry) {
  size_t count = 0;
  if (entry != NULL) return entry->shown;
  for (size_t i = 0; i < n->child_count; i++) count += !drive_vain(e, &n->children[i]);
  return count;
}

/* Sets e->reach to the space in which an operation with a half-space has an effect: the bounds of the operation if they
 * are finite. */
static bool drive_reach(vs_emitter *e, const vs_node *n) {
  vs_bounds b;
  vs_affine back;
  if (n->kind == VS_TRANSFORM && vs_affine_invert(&VS_AS(transform, n)->matrix, &back))
    e->reach = vs_bounds_transform(&e->reach, &back);
  if (n->flags & VS_NODE_ENDLESS || drive_has(e, VS_VERBATIM)) return true;
  if (!vs_bounds_memo_get(&e->drive->bounds, n, &b, e->error)) return false;
  if (n->kind != VS_TRANSFORM && !vs_bounds_is_empty(&b)) e->reach = b;
  return true;
}

/* Sets the fineness for nodes below a placement, by their size after the placement, as the kernel does. Pictures are
 * finer. */
static void drive_place(vs_emitter *e, const vs_affine *placement) {
  e->placement = *placement;
  e->facets = vs_fineness_placed(&e->drawing_facets, placement);
  e->facets.tolerance *= e->chord;
}

/* Emits a reference that draws something: as a use of a template, as a leaf, or as an operation, which is pushed on the
 * stack. */
static bool drive_show(vs_emitter *e, const vs_ref *ref, drive_view view, bool body) {
  vs_drive *d = e->drive;
  const vs_node *n = ref->node;
  if (!drive_tick(e)) return false;
  if (!drive_check(e, ref) || !vs_drive_mark_ref(e, ref)) return false;
  if (view.entry != NULL && view.entry->definition > 0 && !body) return e->backend->use(e, view.entry->definition, ref);
  if (e->backend->emit[n->kind].lossy != NULL && !vs_emit_warn_once(e, ref, e->backend->emit[n->kind].lossy))
    return false;
  vs_emit_fn *fn = vs_backend_writes(e->backend, n);
  if (!view.operation) {
    vs_emit_status status = fn != NULL ? fn(e, ref, VS_PHASE_LEAF) : VS_LOWER;
    return status == VS_EMITTED || (status == VS_LOWER && drive_lower(e, ref));
  }
  drive_frame frame = {
    .ref = *ref, .material = e->material, .layer = e->layer, .part = e->part, .placement = e->placement,
    .reach = e->reach, .in_boolean = e->in_boolean
  };
  bool placed = n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER || n->kind == VS_NATIVE ||
                n->kind == VS_PART || n->kind == VS_HIGHLIGHT || n->kind == VS_GHOST;
  size_t shown = drive_shown(e, n, view.entry);
  frame.silent = shown == 1 && !placed && n->kind != VS_HULL && !drive_has(e, VS_VERBATIM);
  if (!frame.silent) {
    e->child_count = shown;
    if (n->kind == VS_TRANSFORM) {
      vs_affine placement = vs_affine_multiply(&e->placement, &VS_AS(transform, n)->matrix);
      drive_place(e, &placement);
    }
    if (n->kind == VS_MATERIAL) e->material = VS_AS(material, n)->material;
    if (n->kind == VS_LAYER) e->layer = VS_AS(layer, n)->name;
    if (n->kind == VS_PART) e->part = VS_AS(part, n)->name;
    if (n->kind == VS_PART && e->layer == NULL) e->layer = e->part;
    if (n->flags & VS_NODE_CUT && !drive_reach(e, n)) return false;
    e->carved = view.entry != NULL && view.entry->carved;
    bool area = !drive_has(e, VS_VERBATIM) && vs_lower_as_area(e, n);
    bool lowered = fn == NULL || (area && !drive_has(e, VS_AREA_SETS));
    vs_emit_status status = lowered ? VS_LOWER : fn(e, ref, VS_PHASE_ENTER);
    if (status != VS_EMITTED) {
      e->material = frame.material;
      e->layer = frame.layer;
      e->part = frame.part;
      drive_place(e, &frame.placement);
      e->reach = frame.reach;
      return status == VS_WHOLE || (status == VS_LOWER && drive_lower(e, ref));
    }
    if (n->kind == VS_INTERSECTION || n->kind == VS_DIFFERENCE) e->in_boolean = true;
    e->depth++;
  }
  if (!vs_emit_grow(e, &d->frames, &d->frame_room, d->frame_count + 1, sizeof *d->frames)) return false;
  d->frames[d->frame_count++] = frame;
  return true;
}

static bool drive_enter(vs_emitter *e, const vs_ref *ref, bool body) {
  drive_view view = drive_look(e, ref->node);
  return view.vain || drive_show(e, ref, view, body);
}

bool vs_drive_walk(vs_emitter *e, const vs_ref *root, bool body) {
  vs_drive *d = e->drive;
  e->child_index = 0;
  e->parent = NULL;
  if (!drive_enter(e, root, body)) return false;
  while (d->frame_count > 0 && !e->out->failed) {
    drive_frame *top = &d->frames[d->frame_count - 1];
    const vs_node *n = top->ref.node;
    if (d->reuse.open && d->frame_count == d->run_frames && top->next == d->run_until) vs_drive_run_end(e);
    if (d->reuse.cache != NULL && !d->reuse.open && top->next >= top->asked && top->next < n->child_count) {
      vs_run run;
      if (!vs_drive_run(e, &(vs_run_row){ n, n->children, n->child_count, false }, top->next, &run)) return false;
      top->asked = run.until;
      if (run.found) {
        top->next = run.until;
        top->shown += run.shown;
        continue;
      }
    }
    if (top->next < n->child_count) {
      const vs_ref *child = vs_node_next_whole(n, (uint32_t)top->next++);
      drive_view view = drive_look(e, child->node);
      if (view.vain) continue;
      e->child_index = top->silent ? e->child_index : top->shown;
      e->parent = n;
      top->shown++;
      if (!drive_show(e, child, view, false)) return false; /* drive_show may reallocate the frames */
      continue;
    }
    drive_frame done = *top;
    d->frame_count--;
    if (done.silent) continue;
    e->depth--;
    e->in_boolean = done.in_boolean;
    e->material = done.material;
    e->layer = done.layer;
    e->part = done.part;
    drive_place(e, &done.placement);
    e->reach = done.reach;
    if (e->backend->emit[n->kind].fn(e, &done.ref, VS_PHASE_LEAVE) != VS_EMITTED) return false;
  }
  return !e->out->failed;
}

void vs_drive_reset(vs_emitter *e) {
  e->drive->frame_count = 0;
  e->depth = 0;
  e->child_count = e->child_index = 0;
  e->smooth = e->in_boolean = false;
  e->material = NULL;
  e->layer = e->part = NULL;
  e->body = e->parent = NULL;
  vs_affine here = vs_affine_identity();
  drive_place(e, &here);
  e->reach = e->bounds;
}
