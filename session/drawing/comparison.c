/* Implements the comparison of two drawings (visualscheme.h). It keeps the first drawing, and reports the parts of the
 * second drawing that differ (solids/changed_parts.h). Marks such as highlights are removed from the drawings before
 * the comparison. */
#include "session/drawing/comparison.h"

#include <string.h>

#include "bind/call/precision.h"
#include "bind/print.h"
#include "passes/sugar.h"
#include "session/handles.h"
#include "session/host.h"
#include "session/report.h"
#include "session/spine.h"
#include "solids/changed_parts.h"

static void free_refs(vs_session *s, vs_ref **refs, size_t *count) {
  vs_session_give_back(s, *refs, *count);
  *refs = NULL, *count = 0;
}

void vs_session_free_comparison(vs_session *s) {
  free_refs(s, &s->kept, &s->kept_count);
  free_refs(s, &s->change, &s->change_count);
}

vs_outcome vs_drawing_keep(vs_scheme *vm) {
  vs_session *s = vs_session_of(vm);
  if (vs_session_busy(s, "vs_drawing_keep")) return VS_OUTCOME_USAGE;
  free_refs(s, &s->kept, &s->kept_count);
  return vs_session_take(s, &s->kept, &s->kept_count);
}

/* ---- the text that describes a part ---- */

enum { TOLD = 100 /* greatest length in bytes of the expression that describes a part */ };
typedef struct { char text[TOLD + 8]; size_t count; bool cut; } told;

/* Appends to the text until it has TOLD bytes. Returns false when it is full. */
static bool put_told(void *context, const char *text, size_t length) {
  told *t = context;
  size_t room = TOLD - t->count, n = length < room ? length : room;
  if (n) memcpy(t->text + t->count, text, n);
  t->count += n;
  t->cut = n < length;
  return !t->cut;
}

static void tell(told *t, const vs_drawn_part *p, vs_part_info *out) {
  const vs_affine *m = &p->place;
  *t = (told){ .count = 0 };
  bool placed = !vs_affine_is_identity(m), shifted = vs_affine_is_translation(m);
  if (placed) put_told(t, shifted ? "(do-move " : "(do-transform ", shifted ? 9 : 14);
  vs_bind_print_node(p->thing.node, put_told, t);
  if (placed && shifted && !t->cut) {
    put_told(t, " (vxyz", 6);
    for (int i = 0; i < 3; i++) {
      char number[32];
      vs_bind_number_text(number, m->m[i][3]);
      put_told(t, " ", 1);
      put_told(t, number, strlen(number));
    }
    put_told(t, "))", 2);
  } else if (placed) put_told(t, " ...)", 5);
  while (t->cut && t->count && ((unsigned char)t->text[t->count - 1] & 0xc0) == 0x80) t->count--; /* removes the bytes
                                                                                                   * of an incomplete
                                                                                                   * character from the
                                                                                                   * end of a text that
                                                                                                   * was cut */
  if (t->cut && t->count && (unsigned char)t->text[t->count - 1] >= 0xc0) t->count--;
  strcpy(t->text + t->count, t->cut ? " ..." : "");
  const vs_origin *at = p->thing.origin;
  *out = (vs_part_info){ .layer = p->layer, .material = p->material ? p->material->name : "", .text = t->text };
  if (at) out->at = (vs_span){ at->file, at->line, at->column, 0, 0 };
}

typedef bool each_part(void *context, vs_part_difference what, const vs_part_info *before, const vs_part_info *after);

/* The parts of two drawings, a (the earlier) and b (the later), and their matches. before[i]: match of part i of a;
 * after[i]: match of part i of b. */
typedef struct {
  vs_drawn_parts a, b;
  vs_part_match *before, *after; /* the arrays are in one block of memory; `before` is NULL until the block is
                                  * allocated */
  size_t bytes;
} pairing;

/* Allocates the matches of all parts. Returns false when memory is out. */
static bool pairing_open(pairing *p, vs_error *e) {
  p->bytes = (p->a.count + p->b.count + 1) * sizeof *p->before;
  p->before = vs_store_realloc(p->a.store, NULL, 0, p->bytes);
  if (!p->before) return vs_error_memory(e, NULL);
  p->after = p->before + p->a.count;
  return true;
}

static void pairing_close(pairing *p) {
  if (p->before) vs_store_realloc(p->a.store, p->before, p->bytes, 0);
  vs_drawn_parts_free(&p->a);
  vs_drawn_parts_free(&p->b);
}

static bool tell_all(const pairing *p, each_part *each, void *context) {
  const vs_drawn_parts *a = &p->a, *b = &p->b;
  const vs_part_match *before = p->before, *after = p->after;
  static const vs_part_difference words[] = {
    [VS_PART_REPAINTED] = VS_PART_WAS_REPAINTED, [VS_PART_MOVED] = VS_PART_WAS_MOVED,
    [VS_PART_CHANGED] = VS_PART_WAS_CHANGED, [VS_PART_ALONE] = VS_PART_WAS_ADDED
  };
  told texts[2];
  vs_part_info old, new;
  for (size_t i = 0; i < a->count; i++) {
    if (before[i].fate != VS_PART_ALONE) continue;
    tell(&texts[0], &a->at[i], &old);
    if (!each(context, VS_PART_WAS_REMOVED, &old, NULL)) return false;
  }
  for (size_t i = 0; i < b->count; i++) {
    if (after[i].fate == VS_PART_SAME) continue;
    bool alone = after[i].fate == VS_PART_ALONE;
    if (!alone) tell(&texts[0], &a->at[after[i].other], &old);
    tell(&texts[1], &b->at[i], &new);
    if (!each(context, words[after[i].fate], alone ? NULL : &old, &new)) return false;
  }
  return true;
}

static void count_parts(const pairing *p, vs_comparison *out) {
  for (size_t i = 0; i < p->a.count; i++) out->removed += p->before[i].fate == VS_PART_ALONE;
  for (size_t i = 0; i < p->b.count; i++) {
    size_t *of[] = {
      [VS_PART_SAME] = &out->same, [VS_PART_REPAINTED] = &out->repainted, [VS_PART_MOVED] = &out->moved,
      [VS_PART_CHANGED] = &out->changed, [VS_PART_ALONE] = &out->added
    };
    ++*of[p->after[i].fate];
  }
}

/* Computes the parts of a drawing that contains only this object, without highlights and other marks. */
static bool parts_of(vs_session *s, vs_ref object, vs_drawn_parts *out, vs_error *e) {
  static const vs_sugar_options plain = { .highlights = VS_MARKS_DROP, .keeps_text = true };
  vs_scene scene = s->bind.scene;
  scene.drawn = NULL, scene.drawn_count = scene.drawn_room = 0;
  bool ok = vs_scene_draw(&scene, object) || vs_error_memory(e, NULL);
  ok = ok && vs_scene_sugar(&scene, &plain, e) && vs_drawn_parts_take(out, scene.drawn, scene.drawn_count, e);
  for (size_t i = 0; i < scene.drawn_count; i++) vs_node_release(scene.drawn[i].node);
  vs_store_realloc(s->bind.store, scene.drawn, scene.drawn_room * sizeof *scene.drawn, 0);
  return ok;
}

bool vs_session_compare_objects(vs_session *s, const vs_ref objects[2], bool *same, const vs_part_listener *listener,
                                vs_error *e) {
  pairing p = { .a.store = s->bind.store, .b.store = s->bind.store };
  bool ok = parts_of(s, objects[0], &p.a, e) && parts_of(s, objects[1], &p.b, e) && pairing_open(&p, e) &&
            vs_drawn_parts_match(&p.a, &p.b, p.before, p.after, e);
  vs_comparison found = { 0 };
  if (ok) count_parts(&p, &found);
  *same = found.repainted + found.moved + found.changed + found.added + found.removed == 0;
  if (ok && listener && listener->each) tell_all(&p, listener->each, listener->context);
  pairing_close(&p);
  return ok;
}

/* ---- the picture of the differences ---- */

static const struct { vs_change change; vs_material paint; } shown[] = {
  { VS_CHANGE_ADDED, { "added", .16, .66, .27, .6, 0, 0, 1.5, { 0 } } },
  { VS_CHANGE_REMOVED, { "removed", .86, .17, .15, .6, 0, 0, 1.5, { 0 } } },
  { VS_CHANGE_KEPT, { "unchanged", .82, .84, .88, .6, 0, .75, 1, { 0 } } },
};

/* Puts the object n on a layer and in a material that have the name of the change, and returns the result. Takes over
 * the reference to n. Returns NULL when memory is out. */
static vs_node *painted(vs_store *store, vs_node *n, const vs_material *paint) {
  vs_material m = *paint;
  m.name = vs_store_text(store, paint->name, strlen(paint->name));
  const vs_material *material = m.name ? vs_store_material(store, &m) : NULL;
  vs_node *coloured = material ? vs_node_new(store, VS_MATERIAL, &(struct vs_material){ material, 0 },
                                            &(vs_ref){ n, NULL }, 1) : NULL;
  vs_node *layered = coloured ? vs_node_new(store, VS_LAYER, &(struct vs_layer){ m.name, 0 },
                                           &(vs_ref){ coloured, NULL }, 1) : NULL;
  vs_node_release(coloured);
  vs_node_release(n);
  return layered;
}

static bool compare(vs_session *s, pairing *p, vs_comparison *out, vs_error *e) {
  vs_kernel_options options = { .job = s->writing, .cache = vs_store_cache(s->bind.store) };
  double tolerance = vs_bind_tolerance(s->bind.vm);
  vs_node *nodes[VS_CHANGES];
  if (!vs_drawn_parts_match(&p->a, &p->b, p->before, p->after, e)) return false;
  count_parts(p, out);
  if (!vs_drawn_parts_change(&p->a, &p->b, p->before, p->after, nodes, e)) return false;
  bool ok = vs_drawn_parts_volume(nodes[VS_CHANGE_ADDED], tolerance, &options, &out->volume_added, e) &&
            vs_drawn_parts_volume(nodes[VS_CHANGE_REMOVED], tolerance, &options, &out->volume_removed, e);
  s->change = ok ? vs_store_realloc(s->bind.store, NULL, 0, (VS_CHANGES + 1) * sizeof *s->change) : NULL;
  if (ok && !s->change) ok = vs_error_memory(e, NULL);
  for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
    vs_node *n = nodes[shown[i].change];
    if (!ok) vs_node_release(n);
    else if (n && (n = painted(s->bind.store, n, &shown[i].paint))) s->change[s->change_count++] = (vs_ref){ n, NULL };
    else if (nodes[shown[i].change]) ok = vs_error_memory(e, NULL);
  }
  return ok;
}

bool vs_session_swell(vs_session *s, size_t number, vs_ref *ref, vs_error *e) {
  vs_kernel_options options = { .job = &s->job, .cache = vs_store_cache(s->bind.store) };
  const struct vs_material *paint = VS_AS(material, s->change[number].node->children[0].node);
  vs_node *n = s->change[number].node->children[0].node->children[0].node, *swollen;
  if (!strcmp(paint->material->name, shown[VS_CHANGES - 1].paint.name)) return true; /* an unchanged part keeps its
                                                                                      * size */
  if (!vs_drawn_parts_swell(n, vs_bind_tolerance(s->bind.vm), &options, &swollen, e)) return false;
  swollen = painted(s->bind.store, swollen, paint->material);
  if (!swollen) return vs_error_memory(e, NULL);
  vs_node_release(ref->node);
  ref->node = swollen;
  return true;
}

static bool volume_of(vs_session *s, const vs_ref *refs, size_t count, double *volume, vs_error *e) {
  vs_kernel_options options = { .job = s->writing, .cache = vs_store_cache(s->bind.store) };
  vs_node *all = vs_node_new(s->bind.store, VS_UNION, &(struct vs_union){ 0 }, refs, count);
  bool ok = all ? vs_drawn_parts_volume(all, vs_bind_tolerance(s->bind.vm), &options, volume, e)
                : vs_error_memory(e, NULL);
  vs_node_release(all);
  return ok;
}

vs_outcome vs_drawing_compare(vs_scheme *vm, vs_comparison *out, each_part *each, void *context) {
  vs_session *s = vs_session_of(vm);
  *out = (vs_comparison){ 0 };
  if (vs_session_busy(s, "vs_drawing_compare")) return VS_OUTCOME_USAGE;
  free_refs(s, &s->change, &s->change_count);
  vs_ref *now;
  size_t count;
  vs_outcome outcome = vs_session_take(s, &now, &count);
  if (outcome != VS_OUTCOME_DONE) return outcome;
  pairing p = { .a.store = s->bind.store, .b.store = s->bind.store };
  vs_error e = { 0 };
  vs_job job = vs_session_job(s);
  job.limits.seconds = s->options.limit_time; /* the comparison has the same time limit as an output */
  vs_job_start(&job);
  vs_store_set_job(s->bind.store, s->writing = &job);
  bool ok = vs_drawn_parts_take(&p.a, s->kept, s->kept_count, &e) && vs_drawn_parts_take(&p.b, now, count, &e) &&
            pairing_open(&p, &e) && compare(s, &p, out, &e);
  bool differs = out->repainted + out->moved + out->changed + out->added + out->removed > 0;
  ok = ok && volume_of(s, s->kept, s->kept_count, &out->volume_before, &e);
  if (!differs) out->volume_after = out->volume_before;
  else ok = ok && volume_of(s, now, count, &out->volume_after, &e);
  s->writing = NULL;
  vs_store_set_job(s->bind.store, &s->job);
  if (ok && each) tell_all(&p, each, context);
  pairing_close(&p);
  free_refs(s, &now, &count);
  return ok ? VS_OUTCOME_DONE : vs_session_report_error(s, &e);
}
