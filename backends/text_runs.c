/* Finds the runs of a drawing whose text is cached: where each begins and ends, and the key of its text.
 *
 * A run is a sequence of neighbours in an operation or in the drawing, or the body of a template. The weight of a run
 * is about the number of its shapes, and limits its length. Within these limits, a hash of a node determines whether
 * the run ends after it. Therefore, after an insertion or a removal, the runs soon end at the same nodes as before. If
 * a node is too heavy for a run, the search continues among its operands.
 *
 * The key contains the kind and numbers of each node in the order of the walk, and the run's templates and materials by
 * their order of use. Before them it contains all members of the emitter that emit functions read. If an operation on
 * regions is written as a single region, the key contains all of the operation. */
#include "backends/text_runs.h"

#include "backends/drive.h"
#include "model/store/cache.h"
#include "model/job.h"

/* Weights of runs (sequences of shapes), about the number of shapes. LIGHT: least weight of a run whose text is cached.
 * USUAL: usual weight. HEAVY: greatest weight, unless the run is a single shape. */
enum { LIGHT = 48, USUAL = 256, HEAVY = 1024 };

void vs_drive_find_short(vs_drive *d) {
  for (int kind = 0; kind < VS_KIND_COUNT; kind++) {
    const vs_kind_info *info = vs_kind_get((vs_kind)kind);
    d->brief[kind] = vs_kind_traits[kind] & VS_IS_SHORT;
    d->facets_at[kind] = SIZE_MAX;
    for (size_t i = 0; i < info->field_count; i++) {
      const vs_field_info *field = &info->fields[i];
      bool facets = field->type == VS_FIELD_integer && strcmp(field->argument, "segments") == 0;
      if (facets) d->facets_at[kind] = field->offset;
    }
  }
}

/* ---- weights ---- */

static uint32_t leaf_weight(const vs_emitter *e, const vs_node *n) {
  enum { OUTLINED = 12, MESHED = 128 }; /* approximate weights of a region that is written as an outline, and of a shape
                                         * that is written as triangles */
  uint32_t weight = OUTLINED;
  if (drive_is_brief(e->drive, n)) return 1;
  if (n->kind == VS_LINE) weight = VS_AS(line, n)->points->count;
  else if (n->kind == VS_POLYFACE_MESH) weight = VS_AS(polyface_mesh, n)->points->count;
  else if (n->class_ == VS_SURFACE || (n->class_ == VS_SOLID && n->kind != VS_EXTRUDE && n->kind != VS_PYRAMID))
    weight = MESHED;
  return weight < HEAVY ? weight : HEAVY;
}

static uint32_t weight_of(const vs_emitter *e, const vs_node *n, drive_view view) {
  if (view.vain) return 0;
  if (view.entry == NULL) return view.operation ? HEAVY : leaf_weight(e, n);
  return view.entry->definition > 0 ? 1 : view.entry->weight;
}

void vs_drive_weigh(vs_emitter *e) {
  vs_drive *d = e->drive;
  for (size_t i = 0; i < d->order_count; i++) {
    drive_entry *entry = &d->entries[d->order[i]];
    const vs_node *n = entry->ref.node;
    bool operation = drive_is_operation(e, n);
    entry->weight = operation ? 1 : leaf_weight(e, n);
    for (uint32_t k = 0; operation && k < n->child_count && entry->weight < HEAVY; k++)
      entry->weight += weight_of(e, n->children[k].node, drive_look(e, n->children[k].node));
    if (entry->weight > HEAVY) entry->weight = HEAVY;
  }
}

/* ---- the key ---- */

typedef struct { const vs_node *node; uint32_t next; bool whole; } step;
/* The key of a run while it is built. cut: whether the run contains a half-space; thin: whether it contains an object
 * that is not a solid */
typedef struct { step *steps; size_t count, room; bool cut, thin; size_t shapes; } spelling;

enum { MOST_SHAPES = 1 << 16 }; /* greatest number of shapes in a key; a tree of nodes may refer to one part many
                                 * times */
enum { TAG_WHOLE = 1u << 16, TAG_TEMPLATE = 1u << 17, TAG_SHOWN = 1u << 18, TAG_CARVED = 1u << 19 };

static uint64_t paint_bits(const vs_emitter *e, const vs_node *n) {
  return n == NULL ? 0 : 1 | (uint64_t)vs_emit_is_bare(e, n) << 1 | (uint64_t)vs_emit_is_painted(e, n) << 2;
}

/* Puts the values into the key that the run's surroundings determine: placement, fineness and other members of the
 * emitter. Words that depend on the run's contents follow at the end of the key. */
static void put_surroundings(vs_emitter *e, const vs_node *parent, bool body) {
  vs_reuse *r = &e->drive->reuse;
  const double reals[] = { e->unit, e->drawing_facets.tolerance, e->facets.tolerance };
  vs_reuse_put(r, (uintptr_t)e->backend);
  vs_reuse_put(r, e->depth << 1 | (body ? 1 : 0));
  vs_reuse_put(r, (uint64_t)(uint32_t)e->drawing_facets.segments << 32 | (uint32_t)e->facets.segments);
  vs_reuse_put_reals(r, reals, sizeof reals / sizeof *reals);
  /* only the linear part of the placement, without its translation, affects the number of facets below it */
  for (int row = 0; row < 3; row++) vs_reuse_put_reals(r, e->placement.m[row], 3);
  vs_reuse_put(r, (uintptr_t)e->material);
  vs_reuse_put(r, paint_bits(e, parent) << 16 | paint_bits(e, e->body) << 8 | (uint64_t)e->in_boolean << 1 | e->smooth);
  vs_reuse_put(r, parent != NULL ? parent->kind : VS_KIND_COUNT);
}

static void put_ends(vs_emitter *e, const spelling *s) {
  vs_reuse *r = &e->drive->reuse;
  double diagonal = vs_v3_length(vs_v3_sub(e->bounds.max, e->bounds.min));
  vs_reuse_put(r, (uint64_t)s->cut << 1 | s->thin);
  if (s->thin) { /* adds the thickness of lines to the key if the run contains lines */
    const double place[] = { diagonal,     e->placement.m[0][3], e->placement.m[1][3], e->placement.m[2][3],
                             e->pen.share, e->pen.least };
    vs_reuse_put_reals(r, place, sizeof place / sizeof *place);
    vs_reuse_put_reals(r, &e->pen.eye.x, 3);
    vs_reuse_put_reals(r, &e->pen.forward.x, 3);
  }
  if (s->cut) vs_reuse_put_reals(r, &e->reach.min.x, 3);
  if (s->cut) vs_reuse_put_reals(r, &e->reach.max.x, 3);
}

/* Puts a node into the key. If its children must follow, pushes it on the stack. */
static void put_node(vs_emitter *e, spelling *s, const vs_ref *ref, drive_view view, bool whole) {
  vs_reuse *r = &e->drive->reuse;
  const vs_node *n = ref->node;
  if (drive_has(e, VS_KEEPS_ORIGINS)) vs_reuse_put(r, (uintptr_t)ref->origin);
  if (view.entry != NULL && view.entry->definition > 0 && !whole) {
    vs_reuse_put(r, TAG_TEMPLATE | paint_bits(e, n));
    vs_reuse_put_number(r, VS_NUMBER_TEMPLATE, view.entry->definition);
    return;
  }
  bool inside = whole || !view.operation || (n->class_ == VS_REGION_CLASS && vs_node_is_set(n));
  s->cut = s->cut || n->flags & VS_NODE_CUT || n->kind == VS_HALF_SPACE;
  s->thin = s->thin || (inside && !whole && n->class_ != VS_SOLID);
  uint32_t shown = inside ? n->child_count : view.entry != NULL ? view.entry->shown : UINT32_MAX;
  if (shown == UINT32_MAX || ++s->shapes > MOST_SHAPES) r->unfit = true;
  uint32_t carved = e->backend->render && view.entry != NULL && view.entry->carved ? TAG_CARVED : 0;
  vs_reuse_put(r, (uint64_t)shown << 32 | (inside ? TAG_WHOLE : TAG_SHOWN) | carved | n->kind);
  vs_reuse_put_payload(r, vs_kind_get((vs_kind)n->kind), vs_node_data(n));
  if (n->kind == VS_MATERIAL)
    vs_reuse_put_number(r, VS_NUMBER_PAINT, (uint32_t)vs_emit_material_number(e, VS_AS(material, n)->material));
  if (n->child_count > 0 && vs_reuse_more(r, &s->steps, &s->room, s->count + 1, sizeof *s->steps))
    s->steps[s->count++] = (step){ n, 0, inside };
}

/* Puts a reference in the run, and all nodes below it, into the key. body: the reference is a template whose contents
 * are put into the key, not its number. */
static void put_tree(vs_emitter *e, spelling *s, const vs_ref *ref, bool body) {
  const vs_reuse *r = &e->drive->reuse;
  drive_view view = drive_look(e, ref->node);
  drive_entry inside;
  if (view.vain) return;
  if (body && view.entry != NULL) {
    inside = *view.entry;
    inside.definition = 0;
    view.entry = &inside;
  }
  put_node(e, s, ref, view, false);
  while (s->count > 0 && !r->unfit) {
    step *top = &s->steps[s->count - 1];
    if (top->next == top->node->child_count) {
      s->count--;
      continue;
    }
    const vs_ref *child = &top->node->children[top->next++];
    view = drive_look(e, child->node);
    if (top->whole || !view.vain) put_node(e, s, child, view, top->whole);
  }
  s->count = 0;
}

/* ---- runs ---- */

/* Sets run->until to the end of the run that begins at `from`, and run->shown to the number of its nodes that draw
 * something. Returns the run's weight, which is about the number of its shapes. */
static uint32_t run_end(const vs_emitter *e, const vs_run_row *row, size_t from, vs_run *run) {
  uint32_t weight = 0;
  *run = (vs_run){ .until = from };
  for (bool ends = false; !ends && run->until < row->count; run->until++) {
    const vs_node *n = row->refs[run->until].node;
    drive_view view = drive_look(e, n);
    uint32_t own = row->body && view.entry != NULL ? view.entry->weight : weight_of(e, n, view);
    bool alone = own >= HEAVY; /* alone: whether the node is too heavy for a run with other nodes; unless it is a single
                                * shape, the search continues among its operands */
    if (alone && run->until > from) break;
    run->shown += !view.vain;
    weight += alone && view.operation ? 0 : own;
    ends = alone || weight >= HEAVY || (weight >= LIGHT && (n->hash >> 32) < UINT32_MAX / USUAL * (uint64_t)own);
  }
  return weight;
}

static bool all_said(const vs_emitter *e, const vs_reused *found) {
  const vs_drive *d = e->drive;
  for (size_t i = 0; i < found->said_count; i++) {
    bool said = false;
    for (size_t k = 0; k < d->said_count; k++) said = said || d->said[k] == found->said[i];
    if (!said) return false;
  }
  return true;
}

static bool put_out(vs_emitter *e, const vs_ref *first, const vs_reused *found) {
  vs_tally *tally = vs_store_tally(e->scene->store);
  bool ok = true;
  if (drive_has(e, VS_KEEPS_ORIGINS)) {
    uint32_t line = vs_writer_line(e->out);
    ok = vs_drive_mark(e, line, first->origin);
    for (size_t i = 0; ok && i < found->line_count; i++)
      ok = vs_drive_mark(e, line + found->lines[i].line, found->lines[i].origin);
  }
  ok = ok && vs_emit_triangles(e, found->triangles) && vs_reuse_put_out(&e->drive->reuse, found, e->out);
  if (ok && tally != NULL) tally->texts_found++, tally->bytes_found += found->size;
  return ok && vs_emit_progress(e, "writing", -1);
}

static void run_begin(vs_emitter *e, size_t until) {
  vs_drive *d = e->drive;
  d->run_frames = d->frame_count;
  d->run_until = until;
  if (drive_has(e, VS_KEEPS_ORIGINS)) {
    d->run_line = vs_writer_line(e->out);
    /* The first recorded origin that belongs to the run. The origin of the current line may still change. */
    d->run_first =
        d->line_count > 0 && d->lines[d->line_count - 1].line == d->run_line ? d->line_count - 1 : d->line_count;
  }
  vs_reuse_begin(&d->reuse, e->out);
  d->reuse.triangles = e->triangles;
}

void vs_drive_run_end(vs_emitter *e) {
  vs_drive *d = e->drive;
  size_t count = drive_has(e, VS_KEEPS_ORIGINS) ? d->line_count - d->run_first : 0;
  vs_reuse_line *lines = count > 0 ? d->lines + d->run_first : NULL;
  for (size_t i = 0; i < count; i++) lines[i].line -= (uint32_t)d->run_line;
  d->reuse.triangles = e->triangles - d->reuse.triangles;
  vs_reuse_end(&d->reuse, e->out, lines, count);
  for (size_t i = 0; i < count; i++) lines[i].line += (uint32_t)d->run_line;
}

bool vs_drive_run(vs_emitter *e, const vs_run_row *row, size_t from, vs_run *run) {
  vs_reuse *r = &e->drive->reuse;
  vs_tally *tally = vs_store_tally(e->scene->store);
  const vs_ref *refs = row->refs;
  if (run_end(e, row, from, run) < LIGHT) return true;
  spelling s = { .count = 0 };
  size_t first = from;
  vs_reuse_start(r);
  put_surroundings(e, row->parent, row->body);
  for (size_t i = from; i < run->until && !r->unfit; i++) {
    vs_reuse_mix(r, refs[i].node->hash);
    put_tree(e, &s, &refs[i], row->body);
  }
  put_ends(e, &s);
  vs_emit_release(e, s.steps, s.room, sizeof *s.steps);
  if (r->unfit) return true;
  while (drive_look(e, refs[first].node).vain) first++;
  if (tally != NULL) tally->texts++;
  vs_reused kept;
  if (!vs_reuse_find(r, &kept)) {
    run_begin(e, run->until);
    return true;
  }
  run->found = all_said(e, &kept); /* uses the cached text only if all its warnings were already given; otherwise the
                                    * run is written again, so that the warnings get their places */
  bool ok = !run->found || put_out(e, &refs[first], &kept);
  vs_cache_let_go(r->cache, kept.held);
  return ok;
}
