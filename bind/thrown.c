/* Warns about objects that a program creates but does not use: values of expressions in a body before its last
 * expression, or at the top level of a file that draws other objects.
 *
 * The interpreter reports each object that is the unused value of an expression in a body. If the value is a list, it
 * reports the first object of the list. The result of the last `draw` does not count. The first object at each place is
 * recorded, for at most sixteen places. At the end of the evaluation, the objects that are part of the model are
 * removed from the record, since the program may have stored them in a list. */
#include "bind/thrown.h"

#include "bind/objects.h"
#include "bind/state.h"
#include "bind/warnings.h"
#include "model/store/nodemap.h"
#include "model/walk.h"

void vs_bind_forget_dropped(vs_bind *b) {
  for (size_t i = 0; i < b->dropped_count; i++) vs_node_release(b->dropped[i].node);
  b->dropped_count = 0;
}

static bool same_place(const vs_origin *a, const vs_origin *b) {
  return a->file == b->file && a->line == b->line && a->column == b->column;
}

void vs_bind_dropped(vs_scheme *vm, vs_value v) {
  vs_bind *b = vs_bind_of(vm);
  vs_ref ref = vs_bind_take_ref(v);
  if (b->away || !ref.node || !ref.origin || vs_node_is_empty(ref.node)) return;
  if (ref.node == b->drawn_last || ref.node == b->drawn_away) return;
  if (b->dropped_count == sizeof b->dropped / sizeof *b->dropped) return;
  for (size_t i = 0; i < b->dropped_count; i++)
    if (same_place(b->dropped[i].origin, ref.origin)) return;
  b->dropped[b->dropped_count].node = vs_node_retain(ref.node);
  b->dropped[b->dropped_count++].origin = ref.origin;
}

void vs_bind_warn_thrown(vs_bind *b, const vs_node *node, const vs_origin *origin, bool in_body) {
  if (!b->job.warn || vs_bind_warned(b, origin, "thrown away")) return;
  vs_job_warn(&b->job, origin,
          node->kind == VS_TRANSFORM ? "this object is made and not used: do-move, do-rotate and similar procedures "
                                       "return a new object, and do not change their argument: (draw (do-move o v))"
          : in_body ? "this object is made and not used: a body returns only its last value, a loop returns none; "
                      "unite the objects, or (draw ...) each of them"
                    : "this object is made and not used: other objects are drawn, but this object is not; unite the "
                      "objects, or (draw ...) this object too");
}

/* Clears left[i] for each recorded object i that is `root` or one of its descendants. *count: number of recorded
 * objects i with left[i]. */
static bool look_below(vs_bind *b, vs_nodemap *seen, vs_ref root, bool *left, size_t *count) {
  vs_walk *w = vs_walk_new(b->store, root);
  vs_ref at;
  size_t depth;
  bool ok = w != NULL;
  while (ok && *count > 0) {
    vs_walk_event e = vs_walk_next(w, &at, &depth);
    if (e == VS_WALK_DONE) break;
    ok = e != VS_WALK_FAILED;
    if (!ok || e != VS_WALK_ENTER) continue;
    bool found;
    ok = vs_nodemap_put(seen, at.node, &found) != NULL;
    if (found) {
      vs_walk_skip(w);
      continue;
    }
    for (size_t i = 0; i < b->dropped_count; i++)
      if (left[i] && b->dropped[i].node == at.node) left[i] = false, --*count;
  }
  vs_walk_free(w);
  return ok;
}

void vs_bind_tell_dropped(vs_bind *b) {
  size_t count = b->dropped_count;
  if (count == 0) return;
  /* left[i]: whether recorded object i is not part of the model. When memory for the test is out, there are no
   * warnings. */
  bool left[sizeof b->dropped / sizeof *b->dropped], ok = true;
  for (size_t i = 0; i < count; i++) left[i] = true;
  vs_nodemap seen = { .store = b->store };
  size_t roots = b->drew ? b->scene.drawn_count : b->returned_count;
  for (size_t i = 0; ok && i < roots && count > 0; i++)
    ok = look_below(b, &seen, b->drew ? b->scene.drawn[i] : (vs_ref){ b->returned[i].node, b->returned[i].origin },
                    left, &count);
  vs_nodemap_free(&seen);
  for (size_t i = 0; ok && i < b->dropped_count; i++)
    if (left[i]) vs_bind_warn_thrown(b, b->dropped[i].node, b->dropped[i].origin, true);
  vs_bind_forget_dropped(b);
}
