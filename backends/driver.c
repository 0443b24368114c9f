/* Implements the driver: it plans a drawing, walks it without recursion, lowers each node once, and calls the
 * back-end's emit functions.
 *
 * Plan: a pass over the distinct nodes, children first, finds the nodes that draw nothing (`vain`). The pass also
 * counts the references to each node in the text (`uses`) and the levels of nesting in its text (`height`). A leaf with
 * a single reference has no entry, so a million boxes need no memory here. Templates are the entries with several uses,
 * and the entries at which the text reaches the depth VS_DEPTH_MAX. Templates keep the order of the plan, so each
 * template follows the templates that it uses.
 *
 * Walk: a stack contains a frame for each open operation. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "backends/lower.h"
#include "backends/text_runs.h"
#include "geometry/primitives/shape.h"
#include "backends/drive.h"
#include "backends/format_numbers.h"
#include "model/kinds.h"
#include "solids/drawn_bounds.h"
#include "model/store/cache.h"
#include "model/job.h"

/* ---- functions of the driver for emit functions ---- */

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
         vs_error_set(e->error, VS_ERROR_MEMORY, NULL, "the result has more than %zu triangles, the limit", limit);
}

static bool drive_going(void *context) { return vs_emit_progress(context, "writing", -1); }
void vs_emit_watch(vs_emitter *e, vs_writer *w) {
  w->going = drive_going;
  w->going_context = e;
}

const vs_origin *vs_emit_line_origin(const vs_emitter *e, uint32_t line) {
  const vs_drive *d = e->drive;
  size_t low = 0, high = d->line_count; /* low becomes the index of the last entry at or before the line */
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (d->lines[middle].line <= line) low = middle + 1; else high = middle;
  }
  return low > 0 ? d->lines[low - 1].origin : NULL;
}

/* ---- entries ---- */

static void drive_find_operations(vs_drive *d) {
  vs_drive_find_short(d);
  for (int kind = 0; kind < VS_KIND_COUNT; kind++)
    d->operation[kind] = vs_kind_get((vs_kind)kind)->level == VS_LEVEL_OPERATION || kind == VS_NATIVE ||
                         kind == VS_HIGHLIGHT || kind == VS_GHOST;
}

static drive_entry *drive_find(const vs_emitter *e, const vs_node *n) {
  const uint64_t *at = n->refs > 1 || drive_is_operation(e, n) ? vs_nodemap_get(&e->drive->index, n) : NULL;
  return at != NULL ? &e->drive->entries[*at - 1] : NULL;
}
static bool drive_vain(const vs_emitter *e, const vs_ref *ref) { return drive_look(e, ref->node).vain; }

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

static bool drive_add_material(vs_emitter *e, const vs_material *m) {
  vs_drive *d = e->drive;
  bool found;
  uint64_t *at = vs_nodemap_put(&d->paints, m, &found);
  if (at == NULL) return vs_emit_no_memory(e);
  if (found) return true;
  if (!vs_emit_grow(e, &d->materials, &d->material_room, d->material_count + 1, sizeof *d->materials)) return false;
  d->materials[d->material_count++] = m;
  *at = d->material_count;
  return true;
}

static bool drive_op_vain(const vs_emitter *e, const drive_entry *entry) {
  const vs_node *n = entry->ref.node;
  if (drive_has(e, VS_VERBATIM)) return false;
  if (n->kind == VS_NATIVE) return false;
  if (n->kind == VS_HULL || n->kind == VS_UNION) return entry->shown == 0;
  if (n->kind == VS_INTERSECTION) return n->child_count == 0 || entry->some_vain;
  bool one = n->kind == VS_DIFFERENCE || n->kind == VS_GHOST || vs_node_role(n) == VS_ROLE_PLACED ||
             vs_node_role(n) == VS_ROLE_WRAPPER;
  return one && (n->child_count == 0 || entry->first_vain);
}

/* ---- the plan ---- */

/* Adds the facts about a child to its parent's entry. The child's own children must already be added. child NULL: the
 * child has no entry. */
static void drive_plan_add(drive_entry *parent, const drive_entry *child, bool vain, bool first) {
  uint32_t height = child == NULL || child->cut ? 1 : child->height;
  if (height > parent->height) parent->height = height;
  parent->some_vain |= vain;
  parent->first_vain |= vain && first;
  if (vain) return;
  parent->shown++;
  parent->bare |= child == NULL || child->bare;
  parent->painted |= child != NULL && child->painted;
  parent->layered |= child != NULL && child->layered;
}

static bool drive_plan_omitted(vs_emitter *e, const vs_ref *ref) {
  const vs_node *n = ref->node;
  if (n->kind == VS_EMPTY || n->class_ >= VS_MIXED || e->backend->omit[n->class_] == NULL) return true;
  return vs_emit_warn_once(e, ref, e->backend->omit[n->class_]);
}

/* Plans a reference: counts a use of its entry. A new entry is pushed on the stack, and is added to its parent when it
 * is popped. */
static bool drive_plan_meet(vs_emitter *e, const vs_ref *ref, bool operation, size_t parent, bool first) {
  vs_drive *d = e->drive;
  bool found;
  if (!operation && !drive_plan_omitted(e, ref)) return false;
  uint64_t *at = vs_nodemap_put(&d->index, ref->node, &found);
  if (at == NULL) return vs_emit_no_memory(e);
  if (found) {
    drive_entry *entry = &d->entries[*at - 1];
    entry->uses++;
    if (parent != SIZE_MAX) drive_plan_add(&d->entries[parent], entry, entry->vain, first);
    return true;
  }
  if (!vs_emit_grow(e, &d->entries, &d->entry_room, d->entry_count + 1, sizeof *d->entries)) return false;
  d->entries[d->entry_count++] = (drive_entry){ .ref = *ref, .uses = 1 };
  *at = d->entry_count;
  if (!vs_emit_grow(e, &d->steps, &d->step_room, d->step_count + 1, sizeof *d->steps)) return false;
  d->steps[d->step_count++] = (drive_step){ d->entry_count - 1, 0 };
  return true;
}

static bool drive_plan_leave(vs_emitter *e, size_t index) {
  vs_drive *d = e->drive;
  drive_entry *entry = &d->entries[index];
  const vs_node *n = entry->ref.node;
  if (drive_is_operation(e, n)) {
    entry->vain = drive_op_vain(e, entry);
    if (n->kind == VS_MATERIAL && !entry->vain) {
      entry->bare = false;
      entry->painted = true;
      if (!drive_add_material(e, VS_AS(material, n)->material)) return false;
    }
    entry->layered |= n->kind == VS_LAYER && !entry->vain;
    entry->height++;
    entry->cut = entry->height >= VS_DEPTH_MAX;
  } else {
    entry->vain = drive_leaf_vain(e, n);
    entry->bare = true;
    entry->height = 1;
  }
  if (d->step_count > 0) {
    const drive_step *above = &d->steps[d->step_count - 1];
    drive_plan_add(&d->entries[above->entry], entry, entry->vain, above->next == 1);
  }
  if (!vs_emit_grow(e, &d->order, &d->order_room, d->order_count + 1, sizeof *d->order)) return false;
  d->order[d->order_count++] = (uint32_t)index;
  return (++d->ticks & 0xfff) != 0 || vs_emit_progress(e, "writing", -1);
}

/* Plans the children of an entry. Stops at the first child whose own children must be planned; *pushed is then true. */
static bool drive_plan_children(vs_emitter *e, drive_step *step, bool *pushed) {
  vs_drive *d = e->drive;
  size_t index = step->entry, depth = d->step_count;
  const vs_node *n = d->entries[index].ref.node;
  while (step->next < n->child_count) {
    const vs_ref *child = vs_node_next(n, step->next++);
    bool operation = drive_is_operation(e, child->node), first = step->next == 1;
    if (child->node->refs < 2 && !operation) { /* planned at once, without an entry */
      if (!drive_plan_omitted(e, child)) return false;
      drive_plan_add(&d->entries[index], NULL, drive_leaf_vain(e, child->node), first);
      if ((++d->ticks & 0xfff) == 0 && !vs_emit_progress(e, "writing", -1)) return false;
      continue;
    }
    if (!drive_plan_meet(e, child, operation, index, first)) return false;
    if (d->step_count > depth) return *pushed = true; /* the stack may have been reallocated, so `step` is no longer
                                                       * valid */
  }
  return true;
}

static bool drive_plan_below(vs_emitter *e, const vs_ref *ref) {
  vs_drive *d = e->drive;
  bool operation = drive_is_operation(e, ref->node);
  if (ref->node->refs < 2 && !operation) return drive_plan_omitted(e, ref);
  if (!drive_plan_meet(e, ref, operation, SIZE_MAX, false)) return false;
  while (d->step_count > 0) {
    drive_step *top = &d->steps[d->step_count - 1];
    size_t index = top->entry;
    bool pushed = false;
    if (drive_is_operation(e, d->entries[index].ref.node) && !drive_plan_children(e, top, &pushed)) return false;
    if (pushed) continue;
    d->step_count--;
    if (!drive_plan_leave(e, index)) return false;
  }
  return true;
}

/* Marks the nodes inside intersections and differences. Visits parents before children. */
static void drive_plan_carved(vs_emitter *e) {
  vs_drive *d = e->drive;
  for (size_t i = d->order_count; i-- > 0;) {
    const drive_entry *entry = &d->entries[d->order[i]];
    const vs_node *n = entry->ref.node;
    if (!drive_is_operation(e, n) || !(n->flags & VS_NODE_CARVED)) continue; /* no emit function reads the mark of the
                                                                              * nodes below */
    if (!entry->carved && n->kind != VS_INTERSECTION && n->kind != VS_DIFFERENCE) continue;
    for (uint32_t k = 0; k < n->child_count; k++) {
      drive_entry *child = drive_find(e, n->children[k].node);
      if (child != NULL) child->carved = true;
    }
  }
}

static bool drive_plan(vs_emitter *e) {
  vs_drive *d = e->drive;
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (!drive_plan_below(e, &e->scene->drawn[i])) return false;
  drive_plan_carved(e);
  if (e->backend->define == NULL) return true;
  uint32_t id = 0;
  for (size_t i = 0; i < d->order_count; i++) {
    drive_entry *entry = &d->entries[d->order[i]];
    if (!entry->vain && (entry->cut || (entry->uses > 1 && !drive_is_brief(d, entry->ref.node) &&
                                        !(entry->ref.node->flags & VS_NODE_ENDLESS))))
      entry->definition = ++id;
  }
  if (d->reuse.cache != NULL) vs_drive_weigh(e);
  return true;
}

/* ---- the walk ---- */

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

bool vs_drive_mark(vs_emitter *e, uint32_t line, const vs_origin *origin) {
  vs_drive *d = e->drive;
  /* the origin of an entry is valid up to the next entry */
  if (d->line_count > 0 && d->lines[d->line_count - 1].origin == origin) return true;
  if (d->line_count > 0 && d->lines[d->line_count - 1].line == line) {
    d->lines[d->line_count - 1].origin = origin;
    return true;
  }
  if (!vs_emit_grow(e, &d->lines, &d->line_room, d->line_count + 1, sizeof *d->lines)) return false;
  d->lines[d->line_count++] = (vs_reuse_line){ line, origin };
  return true;
}

static bool drive_mark(vs_emitter *e, const vs_ref *ref) {
  const vs_drive *d = e->drive;
  if (!drive_has(e, VS_KEEPS_ORIGINS) || (d->line_count > 0 && d->lines[d->line_count - 1].origin == ref->origin))
    return true;
  return vs_drive_mark(e, vs_writer_line(e->out), ref->origin);
}

/* Returns the node's rank in the strict order of lowering. Ranks follow the levels of the table of kinds. Within a
 * level, shapes with parts rank above other shapes. The two kinds in which all lowering ends have the lowest ranks. */
static int drive_rank(const vs_node *n) {
  if (n->kind == VS_POLYFACE_MESH || n->kind == VS_LINE) return 2 * VS_LEVEL_MESH;
  const vs_shape *shape = vs_shape_of(n);
  return 2 * (int)vs_kind_get((vs_kind)n->kind)->level + (shape && shape->parts);
}

static bool drive_enter(vs_emitter *e, const vs_ref *ref, bool body);

/* Returns true if every node of a lowered tree ranks below `rank`. Recursion is safe: the trees of lower.c are only a
 * few nodes deep. */
static bool drive_stands_below(const vs_node *n, int rank) {
  if (vs_kind_get((vs_kind)n->kind)->level != VS_LEVEL_OPERATION) return drive_rank(n) < rank;
  for (size_t i = 0; i < n->child_count; i++)
    if (!drive_stands_below(n->children[i].node, rank)) return false;
  return true;
}

/* Emits the node's simpler kinds in its place. They must have a lower rank than the node, so repeated lowering ends. */
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
    /* a template is written only once, so its simpler kinds are not kept */
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

/* Computes the part of space in which an operation with a half-space has an effect: the bounds of the operation, if it
 * has bounds. */
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

/* Sets the number of facets of nodes below a placement by their size after the placement, as the kernel does. Pictures
 * have more facets. */
static void drive_place(vs_emitter *e, const vs_affine *placement) {
  e->placement = *placement;
  e->facets = vs_fineness_placed(&e->drawing_facets, placement);
  e->facets.tolerance *= e->chord;
}

/* Emits a reference that draws something: the use of a template, a leaf, or an operation, which is pushed on the
 * stack. */
static bool drive_show(vs_emitter *e, const vs_ref *ref, drive_view view, bool body) {
  vs_drive *d = e->drive;
  const vs_node *n = ref->node;
  if ((++d->ticks & 0xfff) == 0 && !vs_emit_progress(e, "writing", -1)) return false;
  if (!drive_check(e, ref) || !drive_mark(e, ref)) return false;
  if (view.entry != NULL && view.entry->definition > 0 && !body) return e->backend->use(e, view.entry->definition, ref);
  if (e->backend->emit[n->kind].lossy != NULL && !vs_emit_warn_once(e, ref, e->backend->emit[n->kind].lossy))
    return false;
  vs_emit_fn *fn = vs_backend_writes(e->backend, n);
  if (!view.operation) {
    vs_emit_status status = fn != NULL ? fn(e, ref, VS_PHASE_LEAF) : VS_LOWER;
    return status == VS_EMITTED || (status == VS_LOWER && drive_lower(e, ref));
  }
  drive_frame frame = {
    .ref = *ref, .material = e->material, .placement = e->placement, .reach = e->reach, .in_boolean = e->in_boolean
  };
  bool placed = n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER || n->kind == VS_NATIVE ||
                n->kind == VS_HIGHLIGHT || n->kind == VS_GHOST;
  size_t shown = drive_shown(e, n, view.entry);
  frame.silent = shown == 1 && !placed && n->kind != VS_HULL && !drive_has(e, VS_VERBATIM);
  if (!frame.silent) {
    e->child_count = shown;
    if (n->kind == VS_TRANSFORM) {
      vs_affine placement = vs_affine_multiply(&e->placement, &VS_AS(transform, n)->matrix);
      drive_place(e, &placement);
    }
    if (n->kind == VS_MATERIAL) e->material = VS_AS(material, n)->material;
    if (n->flags & VS_NODE_CUT && !drive_reach(e, n)) return false;
    e->carved = view.entry != NULL && view.entry->carved;
    bool area = !drive_has(e, VS_VERBATIM) && vs_lower_as_area(e, n);
    bool lowered = fn == NULL || (area && !drive_has(e, VS_AREA_SETS));
    vs_emit_status status = lowered ? VS_LOWER : fn(e, ref, VS_PHASE_ENTER);
    if (status != VS_EMITTED) {
      e->material = frame.material;
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

static bool drive_walk(vs_emitter *e, const vs_ref *root, bool body) {
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
      if (!drive_show(e, child, view, false)) return false; /* this call may reallocate the frames */
      continue;
    }
    drive_frame done = *top;
    d->frame_count--;
    if (done.silent) continue;
    e->depth--;
    e->in_boolean = done.in_boolean;
    e->material = done.material;
    drive_place(e, &done.placement);
    e->reach = done.reach;
    if (e->backend->emit[n->kind].fn(e, &done.ref, VS_PHASE_LEAVE) != VS_EMITTED) return false;
  }
  return !e->out->failed;
}

/* Restores a clean state. A walk that failed may have stopped anywhere. */
static void drive_reset(vs_emitter *e) {
  e->drive->frame_count = 0;
  e->depth = 0;
  e->child_count = e->child_index = 0;
  e->smooth = e->in_boolean = false;
  e->material = NULL;
  e->body = e->parent = NULL;
  vs_affine here = vs_affine_identity();
  drive_place(e, &here);
  e->reach = e->bounds;
}

/* Searches for a run that begins at index `from` of the row. If the run's text was kept, writes the text and sets *next
 * to the index after the run. Sets *asked to the index before which no further search is needed. */
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
    drive_reset(e);
    if (!drive_mark(e, &entry.ref) || !e->backend->define(e, entry.definition, &entry.ref, true)) return false;
    e->depth = 1;
    e->body = entry.ref.node;
    if (!drive_root(e, &(vs_run_row){ NULL, &entry.ref, 1, true }, 0, &asked, &next) ||
        (next == 0 && !drive_walk(e, &entry.ref, true)))
      return false;
    if (d->reuse.open) vs_drive_run_end(e);
    if (!e->backend->define(e, entry.definition, &entry.ref, false)) return false;
  }
  return true;
}

static void drive_include(vs_bounds *all, const vs_bounds *b) {
  all->min = vs_v3(fmin(all->min.x, b->min.x), fmin(all->min.y, b->min.y), fmin(all->min.z, b->min.z));
  all->max = vs_v3(fmax(all->max.x, b->max.x), fmax(all->max.y, b->max.y), fmax(all->max.z, b->max.z));
}

/* Returns true if the drawing contains text that the user wrote for this program (`native`). */
static bool drive_has_native(const vs_emitter *e) {
  for (size_t i = 0; i < e->drive->entry_count; i++)
    if (e->drive->entries[i].ref.node->kind == VS_NATIVE) return true;
  return false;
}

/* Adds the bounds of a drawn object to e->boxes and to *all. For a union it adds the bounds of each part, up to
 * `most` boxes in total. Boxes of parts are tighter: two boxes frame a cross of two beams better than one box. If
 * budget is not NULL, the bounds are those of the material that remains after cuts, as far as the budget allows
 * (drawn_bounds.h). */
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
    if (e->box_count >= most) drive_include(&e->boxes[most - 1], &b); /* all further parts share the last box */
    else e->boxes[e->box_count++] = b;
  }
  return true;
}

/* Computes the bounds that the camera frames: e->framed and e->boxes, without the material that is cut away. The
 * fineness still depends on the bounds of all operands, as in measures. */
static bool drive_frame_boxes(vs_emitter *e) {
  size_t budget = VS_DRAWN_BOUNDS_MOST, wide = e->box_count;
  e->framed = e->bounds;
  if (!drive_has(e, VS_FRAMES) || e->scene->view == VS_VIEW_CAMERA || drive_has_native(e)) return true;
  e->box_count = 0;
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (!drive_vain(e, &e->scene->drawn[i]) &&
        !drive_boxes(e, &e->scene->drawn[i], &e->drive->bounds, &budget, &e->framed))
      return false;
  if (e->box_count > 0) return true;
  e->box_count = wide > 0; /* nothing of the drawing remains, so the camera frames the operands */
  e->boxes[0] = e->framed = e->bounds;
  return true;
}

static bool drive_nothing(vs_emitter *e) {
  const vs_ref *empty = NULL; /* Every format shows solids. If the drawing contains solids here, they are empty. */
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

static bool drive_bounds(vs_emitter *e) {
  if (drive_has(e, VS_VERBATIM)) return true;
  for (size_t i = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    if (drive_vain(e, ref)) continue;
    if (ref->node->flags & VS_NODE_ENDLESS) return vs_emit_fail(e, ref, VS_ENDLESS_MESSAGE);
    if (!drive_boxes(e, ref, &e->drive->bounds, NULL, &e->bounds)) return false;
  }
  /* The size of native text is unknown. The camera frames a box of size 2 around the origin. */
  if (e->box_count == 0 && drive_has_native(e)) {
    if (!vs_emit_grow(e, &e->boxes, &e->box_room, 1, sizeof *e->boxes)) return false;
    e->bounds = e->boxes[e->box_count++] = (vs_bounds){ vs_v3(-1, -1, -1), vs_v3(1, 1, 1) };
  }
  if (e->box_count == 0) return drive_nothing(e);
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

static bool drive_all_vain(vs_emitter *e) {
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (!drive_vain(e, &e->scene->drawn[i])) return false;
  return true;
}

/* Walks the objects that are not solid, for a format that also receives the union of all solids. Sets *any if there are
 * such objects. */
static bool drive_loose(vs_emitter *e, bool *any) {
  for (size_t i = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    if (ref->node->class_ == VS_SOLID || drive_vain(e, ref)) continue;
    *any = true;
    drive_reset(e);
    if (!drive_walk(e, ref, false)) return false;
  }
  drive_reset(e);
  return true;
}

bool vs_drive_scene(vs_emitter *e) {
  vs_drive *d = vs_store_realloc(e->scene->store, NULL, 0, sizeof *d);
  if (d == NULL) return vs_emit_no_memory(e);
  memset(d, 0, sizeof *d);
  d->index.store = d->paints.store = d->bounds.places.store = e->scene->store;
  vs_job_stage(e->job, "meshing");
  e->drive = d;
  drive_find_operations(d);
  d->reuse = (vs_reuse){ .store = e->scene->store };
  if (drive_has(e, VS_KEEPS_TEXT) && vs_cache_asks(vs_store_cache(e->scene->store)))
    d->reuse.cache = vs_store_cache(e->scene->store);
  e->out->keeps_lines = drive_has(e, VS_KEEPS_ORIGINS);
  if (e->scene->has_ground && e->scene->ground_material != NULL && !drive_add_material(e, e->scene->ground_material))
    return false;
  if (!drive_plan(e)) return false;
  if (e->scene->drawn_count == 0 && !drive_has(e, VS_VERBATIM))
    return vs_error_set(e->error, VS_ERROR_MODEL, NULL, "nothing is drawn");
  if (drive_all_vain(e) && !drive_has(e, VS_VERBATIM)) return drive_nothing(e);
  if (!drive_bounds(e) || (!drive_has(e, VS_VERBATIM) && !drive_frame_boxes(e))) return false;
  drive_reset(e);
  if (!e->backend->begin(e)) return false;
  bool loose = false;
  if (drive_has(e, VS_LOOSE) && !drive_loose(e, &loose)) return false;
  if (e->backend->solid != NULL) {
    vs_solid mesh = { .part_count = 0 };
    bool ok = drive_has(e, VS_DRAWS) || (vs_lower_drawing(e, &mesh) && (mesh.mesh.triangle_count > 0 || loose ||
                                                                   drive_nothing(e)));
    ok = ok && e->backend->solid(e, &mesh);
    vs_solid_free(&mesh);
    return ok && e->backend->end(e);
  }
  if (e->backend->copies != NULL) {
    vs_solid_copies parts = { .part_count = 0 };
    bool ok = vs_lower_drawing_copies(e, &parts) && (parts.meshes.copy_count > 0 || drive_nothing(e)) &&
              e->backend->copies(e, &parts);
    vs_solid_copies_free(&parts);
    return ok && e->backend->end(e);
  }
  double share = 1 / ((double)e->scene->drawn_count + 1); /* of each object; the definitions have the first */
  vs_job_part(e->job, 0, share);
  if (!drive_definitions(e)) return false;
  const vs_run_row drawn = { NULL, e->scene->drawn, e->scene->drawn_count, false };
  for (size_t i = 0, asked = 0; i < e->scene->drawn_count; i++) {
    const vs_ref *ref = &e->scene->drawn[i];
    size_t next = i;
    vs_job_part(e->job, (double)(i + 1) * share, share);
    drive_reset(e);
    if (d->reuse.open && i == d->run_until) vs_drive_run_end(e);
    if (!drive_root(e, &drawn, i, &asked, &next)) return false;
    if (next > i) {
      i = next - 1;
      continue;
    }
    if (drive_vain(e, ref)) continue;
    if (!drive_mark(e, ref)) return false;
    if (e->backend->item != NULL && !e->backend->item(e, i, false)) return false;
    if (!drive_walk(e, ref, false)) return false;
    if (e->backend->item != NULL && !e->backend->item(e, i, true)) return false;
  }
  if (d->reuse.open) vs_drive_run_end(e);
  drive_reset(e);
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
  vs_solid_free(&e->drive->scratch); /* also after a failure to keep the mesh, which costs only time */
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
