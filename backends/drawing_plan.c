/* Plans a drawing's text: visits the distinct nodes, children first.
 *
 * The plan finds the nodes that draw nothing (`vain`). It counts the references to each node in the text (`uses`) and
 * the levels of nesting in its text (`height`). A leaf with a single reference has no entry, so a million boxes need no
 * memory here. Templates are the entries with several uses, and the entries at which the text reaches the depth
 * VS_DEPTH_MAX. Templates keep the order of the plan, so each template follows the templates that it uses. */
#include "backends/drawing_plan.h"

#include "backends/drive.h"
#include "backends/text_runs.h"
#include "model/kinds.h"

void vs_plan_operations(vs_drive *d) {
  vs_drive_find_short(d);
  for (int kind = 0; kind < VS_KIND_COUNT; kind++)
    d->operation[kind] = vs_kind_get((vs_kind)kind)->level == VS_LEVEL_OPERATION || kind == VS_NATIVE ||
                         kind == VS_PART || kind == VS_HIGHLIGHT || kind == VS_GHOST;
}

bool vs_plan_material(vs_emitter *e, const vs_material *m) {
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

/* Adds the data of a child to its parent's entry in the plan, after the child's own children were visited. `child` is
 * the child's entry, or NULL if it has none; `vain`: whether the child draws nothing; `first`: whether it is the first
 * child. */
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

/* Plans a reference to a node: counts a use in the node's entry. A new entry is pushed on the stack; when it is popped,
 * its data are added to its parent. */
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
      if (!vs_plan_material(e, VS_AS(material, n)->material)) return false;
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
  return drive_tick(e);
}

/* Plans the children of an entry. Stops at the first child whose own children must be planned; *pushed is then true. */
static bool drive_plan_children(vs_emitter *e, drive_step *step, bool *pushed) {
  vs_drive *d = e->drive;
  size_t index = step->entry, depth = d->step_count;
  const vs_node *n = d->entries[index].ref.node;
  while (step->next < n->child_count) {
    const vs_ref *child = vs_node_next(n, step->next++);
    bool operation = drive_is_operation(e, child->node), first = step->next == 1;
    if (child->node->refs < 2 && !operation) { /* plans the child at once, without an entry */
      if (!drive_plan_omitted(e, child)) return false;
      drive_plan_add(&d->entries[index], NULL, drive_leaf_vain(e, child->node), first);
      if (!drive_tick(e)) return false;
      continue;
    }
    if (!drive_plan_meet(e, child, operation, index, first)) return false;
    if (d->step_count > depth) return *pushed = true; /* the stack may have been reallocated, so the pointer `step` is
                                                       * no longer valid */
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

/* Sets the flag `carved` of the entries of all nodes inside intersections and differences. Visits parents before
 * children. */
static void drive_plan_carved(vs_emitter *e) {
  vs_drive *d = e->drive;
  for (size_t i = d->order_count; i-- > 0;) {
    const drive_entry *entry = &d->entries[d->order[i]];
    const vs_node *n = entry->ref.node;
    /* emit functions read the flag `carved` only of operations and their operands, so other nodes are skipped */
    if (!drive_is_operation(e, n) || !(n->flags & VS_NODE_CARVED)) continue;
    if (!entry->carved && n->kind != VS_INTERSECTION && n->kind != VS_DIFFERENCE) continue;
    for (uint32_t k = 0; k < n->child_count; k++) {
      drive_entry *child = drive_find(e, n->children[k].node);
      if (child != NULL) child->carved = true;
    }
  }
}

bool vs_plan_scene(vs_emitter *e) {
  vs_drive *d = e->drive;
  for (size_t i = 0; i < e->scene->drawn_count; i++)
    if (!drive_plan_below(e, &e->scene->drawn[i]) || !drive_tick(e)) return false;
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
