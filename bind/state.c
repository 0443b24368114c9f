/* Creates and frees the data that an interpreter has outside of its Scheme heap. Also determines the model of a
 * program: the objects that it draws or, if it draws none, the values of its top-level expressions. */
#include "bind/measures.h"
#include "bind/state.h"

#include "bind/back_ends.h"
#include "bind/call/call.h"
#include "bind/call/convert.h"
#include "bind/call/refuse.h"
#include "bind/call/scratch.h"
#include "bind/custom.h"
#include "bind/objects.h"
#include "bind/parameters.h"
#include "bind/rules/lineage.h"
#include "bind/solids/design_rules.h"
#include "bind/thrown.h"
#include "bind/warnings.h"
#include "model/store/cache.h"
#include "model/store/nodemap.h"
#include "model/walk.h"
#include "vm/machine/activation.h"
#include "vm/machine/fail.h"

static bool going(void *bind, const char *stage, double fraction) {
  (void)stage;
  return vs_bind_keep_going(((vs_bind *)bind)->vm, fraction);
}

bool vs_bind_open(vs_bind *b, vs_scheme *vm, vs_store *store) {
  *b = (vs_bind){ .vm = vm, .store = vs_store_retain(store), .refused = b->refused, .job = { going, .context = b } };
  vs_scene_init(&b->scene, store);
  vs_store_on_ticket(store, vs_bind_ticket_gone, b);
  vm->host = b;
  return true;
}

static void forget_returned(vs_bind *b) {
  for (size_t i = 0; i < b->returned_count; i++) vs_node_release(b->returned[i].node);
  b->returned_count = 0;
  vs_bind_forget_dropped(b);
  b->drawn_last = b->drawn_away = NULL;
}

/* Frees the data that belong to one run of a program. */
static void forget_run(vs_bind *b) {
  vs_store *s = b->store;
  forget_returned(b);
  vs_store_realloc(s, b->returned, b->returned_room * sizeof *b->returned, 0);
  vs_store_realloc(s, b->told, b->told_room * sizeof *b->told, 0);
  for (size_t i = 0; i < b->parameter_count; i++)
    vs_store_realloc(s, b->parameters[i].choices, b->parameters[i].choice_count * sizeof *b->parameters->choices, 0);
  vs_store_realloc(s, b->parameters, b->parameter_room * sizeof *b->parameters, 0);
  vs_store_realloc(s, b->reports, b->report_room * sizeof *b->reports, 0);
  vs_store_realloc(s, b->design_rules, b->design_rule_room * sizeof *b->design_rules, 0);
  vs_lineage_free(b);
  vs_inside_cache_free(b->inside);
  vs_store_on_ticket(s, NULL, NULL);
  vs_store_realloc(s, b->tickets, b->ticket_room * sizeof *b->tickets, 0);
  vs_store_realloc(s, b->gone, b->ticket_room * sizeof *b->gone, 0);
  vs_store_realloc(s, b->back_ends, b->back_end_room * sizeof *b->back_ends, 0);
  vs_scene_free(&b->scene);
}

void vs_bind_restart(vs_bind *b) {
  forget_run(b);
  vs_bind kept = *b;
  *b = (vs_bind){ .vm = kept.vm,
                  .store = kept.store,
                  .settings = kept.settings,
                  .setting_count = kept.setting_count,
                  .setting_room = kept.setting_room,
                  .refused = kept.refused,
                  .library_files = kept.library_files,
                  .is_built_in = kept.is_built_in,
                  .is_format = kept.is_format,
                  .host_call = kept.host_call,
                  .job = kept.job };
  for (size_t i = 0; i < b->setting_count; i++) b->settings[i].used = false;
  vs_scene_init(&b->scene, b->store);
  vs_store_on_ticket(b->store, vs_bind_ticket_gone, b);
}

void vs_bind_close(vs_bind *b) {
  vs_store *s = b->store;
  if (!s) return;
  forget_run(b);
  vs_store_realloc(s, b->settings, b->setting_room * sizeof *b->settings, 0);
  vs_cache_free(vs_store_cache(s)); /* frees the cache first, because it holds references to nodes */
  vs_store_release(s);
  *b = (vs_bind){ 0 };
}

/* Removes all objects from the drawing. Camera, sun and other settings remain. */
void vs_bind_clear_drawing(vs_bind *b) {
  for (size_t i = 0; i < b->scene.drawn_count; i++) vs_node_release(b->scene.drawn[i].node);
  b->scene.drawn_count = 0;
  forget_returned(b);
  b->drew = false;
}

static bool remember(vs_bind *b, vs_ref ref, bool shown) {
  if (ref.node->flags & VS_NODE_ENDLESS) { /* an unbounded object cannot be drawn */
    if (!shown) vs_job_warn(&b->job, ref.origin, VS_ENDLESS_MESSAGE);
    return true;
  }
  if (b->returned_count == b->returned_room) {
    size_t room = b->returned_room ? b->returned_room * 2 : 16;
    void *more =
        vs_store_realloc(b->store, b->returned, b->returned_room * sizeof *b->returned, room * sizeof *b->returned);
    if (!more) return vs_fail_memory(b->vm);
    b->returned = more, b->returned_room = room;
  }
  b->returned[b->returned_count].node = vs_node_retain(ref.node);
  b->returned[b->returned_count].shown = shown;
  b->returned[b->returned_count++].origin = ref.origin;
  return true;
}

/* Stores the objects in a top-level value as a possible part of the model. A list counts only if all its elements are
 * objects. */
bool vs_bind_returned(vs_bind *b, vs_value v, bool shown) {
  if (b->away) return true;
  vs_ref one = vs_bind_take_ref(v);
  if (one.node) return remember(b, one, shown);
  if (!vs_is_pair(v)) return true;
  vs_args f = { .vm = b->vm, .bind = b };
  vs_ref *ref;
  size_t n;
  vs_value bad = VS_ABSENT;
  bool ok = vs_bind_take_refs(&f, v, &ref, &n, &bad);
  for (size_t i = 0; ok && i < n; i++) ok = remember(b, ref[i], shown);
  if (!ok && bad != VS_ABSENT) ok = true;
  vs_bind_scratch_free(&f);
  return ok;
}

/* Returns true if the node itself was drawn, or if it is a union whose children were all drawn: (draw a list) draws the
 * objects of the list and returns their union. If only some of the children were drawn, returns false, which is rarely
 * wrong. */
static bool drawn(const vs_nodemap *all, const vs_node *n) {
  if (vs_nodemap_get(all, n)) return true;
  if (n->kind != VS_UNION) return false;
  for (uint32_t i = 0; i < n->child_count; i++)
    if (!vs_nodemap_get(all, n->children[i].node)) return false;
  return true;
}

bool vs_bind_finish(vs_bind *b) {
  vs_bind_tell_dropped(b);
  if (!b->drew) return true;
  if (b->away) return false; /* a node other than the root has the focus */
  vs_nodemap all = { .store = b->store };
  bool known = b->returned_count > 0; /* known: whether the set of drawn nodes could be computed; when memory for it is
                                       * out, there are no warnings */
  for (size_t i = 0; known && i < b->scene.drawn_count; i++)
    known = vs_nodemap_put(&all, b->scene.drawn[i].node, NULL) != NULL;
  for (size_t i = 0; known && i < b->returned_count; i++)
    if (!b->returned[i].shown && !drawn(&all, b->returned[i].node) && !vs_node_is_empty(b->returned[i].node))
      vs_bind_warn_thrown(b, b->returned[i].node, b->returned[i].origin, false);
  vs_nodemap_free(&all);
  forget_returned(b);
  return false;
}

/* Returns true if the children of node n are counted instead of n. Each shared node is counted once, and its count is
 * stored, so that the time is proportional to the number of nodes. */

static bool is_transparent(const vs_node *n) {
  return n->kind == VS_UNION || n->kind == VS_TRANSFORM || vs_node_is_wrapper(n);
}

static vs_bind_counts count_node(const vs_node *n, const vs_nodemap *known, const vs_bind_counts *sums) {
  vs_bind_counts c = { 0 };
  if (n->class_ == VS_NOTHING) {
    c.all = n->kind == VS_NATIVE; /* a node with native text counts as an object, although only one format shows it */
    return c;
  }
  if (!is_transparent(n)) {
    c.all = 1;
    c.of[n->class_ == VS_MIXED ? VS_SOLID : n->class_] = 1;
    return c;
  }
  for (uint32_t i = 0; i < n->child_count; i++) {
    const vs_bind_counts *part = &sums[*vs_nodemap_get(known, n->children[i].node)];
    c.all += part->all;
    for (int k = 0; k < VS_INHERIT; k++) c.of[k] += part->of[k];
  }
  return c;
}

enum { COUNT_WORK = 200 }; /* estimated time in nanoseconds for counting a node, for vs_store_going */

bool vs_bind_count(vs_ref ref, vs_bind_counts *out, vs_error *e) {
  vs_store *s = ref.node->store;
  vs_nodemap known = { .store = s };
  vs_bind_counts *sums = NULL;
  size_t count = 0, room = 0, depth;
  vs_walk *w = vs_walk_new(s, ref);
  vs_ref at;
  bool ok = w != NULL, going = true;
  while (ok && (going = vs_store_going(s, COUNT_WORK, e))) {
    vs_walk_event event = vs_walk_next(w, &at, &depth);
    if (event == VS_WALK_DONE) break;
    if (event == VS_WALK_FAILED) ok = false;
    else if (event == VS_WALK_ENTER) {
      if (!is_transparent(at.node) || vs_nodemap_get(&known, at.node)) vs_walk_skip(w);
    } else if (!vs_nodemap_get(&known, at.node)) {
      if (count == room) {
        vs_bind_counts *more = vs_store_realloc(s, sums, room * sizeof *more, (room ? 2 * room : 64) * sizeof *more);
        if (!more) { ok = false; break; }
        sums = more, room = room ? 2 * room : 64;
      }
      sums[count] = count_node(at.node, &known, sums);
      uint64_t *slot = vs_nodemap_put(&known, at.node, NULL);
      ok = slot != NULL;
      if (slot) *slot = count++;
    }
  }
  if (!ok) vs_error_memory(e, ref.origin);
  ok = ok && going;
  if (ok) *out = sums[count - 1];
  if (sums) vs_store_realloc(s, sums, room * sizeof *sums, 0);
  vs_walk_free(w);
  vs_nodemap_free(&known);
  return ok;
}

/* ---- parameter objects of geometry.scm ---- */

enum { HOST_VALUES = 6 };

vs_status vs_p_host_set(vs_args *f, vs_value *out) {
  vs_scheme *vm = f->vm;
  (void)out;
  if (f->arg[0].integer >= HOST_VALUES) return vs_bind_refuse(f, "index", "smaller", f->arg[0].value);
  VS_ROOTS(vm, r, 1);
  r[0] = f->arg[1].value;
  if (!vs_is_vector(vm->at.host) && !vs_make_vector(vm, HOST_VALUES, VS_FALSE, &vm->at.host)) return VS_ERROR;
  vs_vector *v = vs_as_vector(vm->at.host);
  vs_gc_store(vm, v, &v->at[f->arg[0].integer], r[0]);
  return VS_OK;
}

/* ---- warnings and errors of the library in Scheme ---- */

vs_status vs_p_warn(vs_args *f, vs_value *out) {
  (void)out;
  vs_bind_warn(f->bind, f->arg[0].text.at, "%s", f->arg[0].text.at);
  return VS_OK;
}

/* (%reserved name instead): raises the error that `name` is reserved; macros of geometry.scm call it. */
vs_status vs_p_reserved(vs_args *f, vs_value *out) {
  (void)out;
  return vs_fail_at(f->vm, f->vm->sym.unbound, vs_call_place(f->vm), VS_NIL,
                    "%s: this procedure does not exist yet; instead: %s", f->arg[0].text.at, f->arg[1].text.at);
}
