/* Implements a walk through a DAG along every path (walk.h). It uses an explicit stack, so that 200,000 nested unions
 * cause no overflow. */
#include "model/walk.h"

typedef struct { vs_ref ref; uint32_t next; } vs_walk_level;

struct vs_walk {
  vs_store *store;
  vs_walk_level *levels;
  size_t depth, room;
  vs_ref root;
  bool started, skip;
};

vs_walk *vs_walk_new(vs_store *s, vs_ref root) {
  vs_walk *w = vs_store_realloc(s, NULL, 0, sizeof *w);
  if (!w) return NULL;
  *w = (vs_walk){ .store = vs_store_retain(s), .root = root };
  vs_node_retain(root.node);
  return w;
}

static vs_walk_event walk_enter(vs_walk *w, vs_ref into, vs_ref *ref, size_t *depth) {
  if (w->depth == w->room) {
    size_t room = w->room ? w->room * 2 : 64;
    vs_walk_level *grown = vs_store_realloc(w->store, w->levels, w->room * sizeof *grown, room * sizeof *grown);
    if (!grown) return VS_WALK_FAILED;
    w->levels = grown;
    w->room = room;
  }
  if (depth) *depth = w->depth;
  w->levels[w->depth++] = (vs_walk_level){ into, 0 };
  *ref = into;
  return VS_WALK_ENTER;
}

vs_walk_event vs_walk_next(vs_walk *w, vs_ref *ref, size_t *depth) {
  if (!w->depth) {
    if (w->started) return VS_WALK_DONE;
    w->started = true;
    return walk_enter(w, w->root, ref, depth);
  }
  vs_walk_level *top = &w->levels[w->depth - 1];
  if (!w->skip && top->next < top->ref.node->child_count)
    return walk_enter(w, top->ref.node->children[top->next++], ref, depth);
  w->skip = false;
  *ref = top->ref;
  if (depth) *depth = w->depth - 1;
  w->depth--;
  return VS_WALK_LEAVE;
}

void vs_walk_skip(vs_walk *w) {
  VS_ASSERT(w->depth > 0);
  w->skip = true;
}

void vs_walk_free(vs_walk *w) {
  if (!w) return;
  vs_store *s = w->store;
  vs_node_release(w->root.node);
  vs_store_realloc(s, w->levels, w->room * sizeof *w->levels, 0);
  vs_store_realloc(s, w, sizeof *w, 0);
  vs_store_release(s);
}
