/* Owns the life of what bind/ keeps besides the heap, and the rule of what a file's model is: what it drew, else what its top-level
 * expressions returned. */
#include "bind/bind.h"

#include "model/nodemap.h"

bool vs_bind_open(vs_bind *b, vs *vm, vs_store *store) {
  *b = (vs_bind){ .vm = vm, .store = vs_store_retain(store) };
  vs_scene_init(&b->scene, store);
  vm->host = b;
  return true;
}

static void forget_returned(vs_bind *b) {
  for (size_t i = 0; i < b->returned_count; i++) vs_node_release(b->returned[i].node);
  b->returned_count = 0;
}

void vs_bind_close(vs_bind *b) {
  vs_store *s = b->store;
  if (!s) return;
  forget_returned(b);
  vs_store_realloc(s, b->returned, b->returned_room * sizeof *b->returned, 0);
  vs_store_realloc(s, b->told, b->told_room * sizeof *b->told, 0);
  for (size_t i = 0; i < b->parameter_count; i++) vs_store_realloc(s, b->parameters[i].choices, b->parameters[i].choice_count * sizeof *b->parameters->choices, 0);
  vs_store_realloc(s, b->parameters, b->parameter_room * sizeof *b->parameters, 0);
  vs_store_realloc(s, b->settings, b->setting_room * sizeof *b->settings, 0);
  vs_scene_free(&b->scene);
  vs_store_release(s);
  *b = (vs_bind){ 0 };
}

/* the objects go; camera, sun and the like stay as they were set */
void vs_bind_clear_drawing(vs_bind *b) {
  for (size_t i = 0; i < b->scene.drawn_count; i++) vs_node_release(b->scene.drawn[i].node);
  b->scene.drawn_count = 0;
  forget_returned(b);
  b->drew = false;
}

static bool remember(vs_bind *b, vs_ref ref, vs_pos place) {
  if (b->returned_count == b->returned_room) {
    size_t room = b->returned_room ? b->returned_room * 2 : 16;
    void *more = vs_store_realloc(b->store, b->returned, b->returned_room * sizeof *b->returned, room * sizeof *b->returned);
    if (!more) return vs_fail_memory(b->vm);
    b->returned = more, b->returned_room = room;
  }
  b->returned[b->returned_count].node = vs_node_retain(ref.node);
  b->returned[b->returned_count].origin = ref.origin;
  b->returned[b->returned_count++].place = place;
  return true;
}

/* A list counts when all in it are objects: other lists are the program's own data. */
bool vs_bind_returned(vs_bind *b, vs_value v, vs_pos place) {
  vs_shape *s = vs_bind_shape(v);
  if (s) return remember(b, s->ref, place);
  if (!vs_is_pair(v)) return true;
  vs_frame f = { .vm = b->vm, .bind = b };
  vs_ref *ref;
  size_t n;
  vs_value bad = VS_ABSENT;
  bool ok = vs_bind_refs(&f, v, &ref, &n, &bad);
  for (size_t i = 0; ok && i < n; i++) ok = remember(b, ref[i], place);
  if (!ok && bad != VS_ABSENT) ok = true;
  vs_bind_scratch_free(&f);
  return ok;
}

/* was it drawn too, then or later, itself or as a part? Only the first is looked for: a part drawn alone is rare */
static bool drawn(const vs_bind *b, const vs_node *n) {
  for (size_t i = 0; i < b->scene.drawn_count; i++)
    if (b->scene.drawn[i].node == n) return true;
  return false;
}

bool vs_bind_finish(vs_bind *b, bool *uses_returned) {
  *uses_returned = !b->drew;
  if (!b->drew) return true;
  for (size_t i = 0; i < b->returned_count; i++)
    if (!drawn(b, b->returned[i].node) && !vs_bind_is_empty(b->returned[i].node) && b->warn)
      b->warn(b->warn_context, b->returned[i].origin, "this object is made and thrown away: others are drawn, this one is not; unite them, or (draw ...) it too");
  forget_returned(b);
  return true;
}

/* ---- counting ---- */

bool vs_bind_count(vs_ref ref, double *count) {
  vs_nodemap known = { .store = ref.node->store };
  vs_walk *w = vs_walk_new(ref.node->store, ref);
  vs_ref at;
  size_t depth;
  bool ok = w != NULL;
  while (ok) {
    vs_walk_event e = vs_walk_next(w, &at, &depth);
    if (e == VS_WALK_DONE) break;
    if (e == VS_WALK_FAILED) { ok = false; break; }
    bool found;
    if (e == VS_WALK_ENTER) {
      if (vs_nodemap_get(&known, at.node)) vs_walk_skip(w);
      continue;
    }
    if (vs_nodemap_get(&known, at.node)) continue;
    double sum = at.node->child_count || at.node->kind == VS_EMPTY ? 0 : 1;
    bool whole = at.node->kind == VS_REGION || at.node->kind == VS_EXTRUDE || at.node->kind == VS_SWEEP || at.node->kind == VS_THICKEN;
    for (uint32_t i = 0; !whole && i < at.node->child_count; i++) {
      double part;
      uint64_t *word = vs_nodemap_get(&known, at.node->children[i].node);
      if (word) memcpy(&part, word, sizeof part), sum += part;
    }
    if (whole) sum = 1; /* a profile is not an object beside its solid */
    uint64_t *slot = vs_nodemap_put(&known, at.node, &found);
    if (!slot) ok = false;
    else memcpy(slot, &sum, sizeof sum);
  }
  uint64_t *word = ok ? vs_nodemap_get(&known, ref.node) : NULL;
  if (word) memcpy(count, word, sizeof *count);
  vs_walk_free(w);
  vs_nodemap_free(&known);
  return word != NULL;
}

/* ---- what geometry.scm leaves for C: parameter objects ---- */

enum { HOST_VALUES = 4 };

vs_status vs_p_host_set(vs_frame *f, vs_value *out) {
  vs *vm = f->vm;
  (void)out;
  if (f->arg[0].integer >= HOST_VALUES) return vs_bind_refuse(f, "index", "smaller", f->arg[0].value);
  VS_ROOTS(vm, r, 1);
  r[0] = f->arg[1].value;
  if (!vs_is_vector(vm->at.host) && !vs_make_vector(vm, HOST_VALUES, VS_FALSE, &vm->at.host)) return VS_ERROR;
  vs_vector *v = vs_as_vector(vm->at.host);
  vs_gc_store(vm, v, &v->at[f->arg[0].integer], r[0]);
  return VS_OK;
}
