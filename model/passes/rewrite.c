/* Owns the one loop that all passes are run by: every distinct node once, children first, results remembered; and the counting of commands. */
#include "model/passes/rewrite.h"

#include <string.h>

typedef struct { vs_node *node; const vs_origin *origin; } vs_rewritten;
typedef struct { vs_store *store; vs_rewritten *at; size_t count, room; vs_nodemap places; vs_ref *kids; size_t kid_room; } vs_results;

const vs_pass_info *vs_pass_get(vs_pass_kind pass) {
  static const vs_pass_info passes[] = {
#define VS_PASS(upper, lower, doc) { #lower, doc },
#include "model/passes/passes.def"
  };
  return &passes[pass];
}

bool vs_rewrite_visit(vs_store *s, const vs_ref *refs, size_t count, vs_visit_fn *visit, void *context, vs_error *e) {
  vs_nodemap seen = { .store = s };
  bool ok = true;
  for (size_t i = 0; ok && i < count; i++) {
    vs_walk *w = vs_walk_new(s, refs[i]);
    vs_walk_event ev;
    vs_ref at;
    ok = w || vs_error_memory(e, NULL);
    while (ok && (ev = vs_walk_next(w, &at, NULL)) != VS_WALK_DONE) {
      if (ev == VS_WALK_FAILED) ok = vs_error_memory(e, NULL);
      else if (vs_nodemap_get(&seen, at.node)) {
        if (ev == VS_WALK_ENTER) vs_walk_skip(w);
      } else if (ev == VS_WALK_LEAVE) ok = visit(context, at, e) && (vs_nodemap_put(&seen, at.node, NULL) || vs_error_memory(e, NULL));
    }
    vs_walk_free(w);
  }
  vs_nodemap_free(&seen);
  return ok;
}

/* ---- uses ---- */

static bool vs_uses_add(vs_nodemap *uses, const vs_ref *refs, size_t count, vs_error *e) {
  for (size_t i = 0; i < count; i++) {
    uint64_t *n = vs_nodemap_put(uses, refs[i].node, NULL);
    if (!n) return vs_error_memory(e, refs[i].origin);
    ++*n;
  }
  return true;
}

static bool vs_uses_visit(void *context, vs_ref at, vs_error *e) { return vs_uses_add(context, at.node->children, at.node->child_count, e); }

bool vs_rewrite_count_uses(vs_nodemap *uses, vs_store *s, const vs_ref *refs, size_t count, vs_error *e) {
  return vs_uses_add(uses, refs, count, e) && vs_rewrite_visit(s, refs, count, vs_uses_visit, uses, e);
}

bool vs_rewrite_lone(const vs_rewrite *w, const vs_node *old) {
  const uint64_t *n = vs_nodemap_get(&w->uses, old);
  return n && *n == 1;
}

/* ---- rewriting ---- */

vs_node *vs_rewrite_keep(vs_rewrite *w, const vs_node *n, const vs_ref *kids) {
  bool same = true;
  for (uint32_t i = 0; same && i < n->child_count; i++) same = kids[i].node == n->children[i].node;
  return same ? vs_node_retain((vs_node *)(uintptr_t)n) : vs_node_new(w->store, (vs_kind)n->kind, n->data, kids, n->child_count);
}

typedef struct { vs_rewrite *w; vs_rewrite_fn *fn; vs_results results; } vs_rewriting;

static vs_ref vs_results_of(const vs_results *r, vs_ref old) {
  const vs_rewritten *new = &r->at[*vs_nodemap_get(&r->places, old.node)];
  return (vs_ref){ new->node, new->origin ? new->origin : old.origin };
}

static bool vs_rewrite_node(void *context, vs_ref at, vs_error *e) {
  vs_rewriting *g = context;
  vs_results *r = &g->results;
  const vs_node *n = at.node;
  if (r->kid_room < n->child_count) {
    vs_ref *grown = vs_store_realloc(r->store, r->kids, r->kid_room * sizeof *grown, n->child_count * sizeof *grown);
    if (!grown) return vs_error_memory(e, at.origin);
    r->kids = grown;
    r->kid_room = n->child_count;
  }
  if (r->count == r->room) {
    size_t room = r->room ? r->room * 2 : 64;
    vs_rewritten *grown = vs_store_realloc(r->store, r->at, r->room * sizeof *grown, room * sizeof *grown);
    if (!grown) return vs_error_memory(e, at.origin);
    r->at = grown;
    r->room = room;
  }
  for (uint32_t i = 0; i < n->child_count; i++) r->kids[i] = vs_results_of(r, n->children[i]);
  vs_rewritten new = { NULL, NULL };
  uint64_t *place = vs_nodemap_put(&r->places, n, NULL);
  if (place) new.node = g->fn(g->w, n, r->kids, &new.origin);
  if (!new.node) {
    if (e && e->kind == VS_ERROR_NONE) vs_error_memory(e, at.origin);
    if (e && !e->origin) e->origin = at.origin;
    return false;
  }
  *place = r->count;
  r->at[r->count++] = new;
  return true;
}

bool vs_rewrite_run(vs_rewrite *w, vs_rewrite_fn *fn, vs_ref *refs, size_t count) {
  vs_rewriting g = { w, fn, { .store = w->store, .places = { .store = w->store } } };
  bool ok = vs_rewrite_count_uses(&w->uses, w->store, refs, count, w->error) && vs_rewrite_visit(w->store, refs, count, vs_rewrite_node, &g, w->error);
  for (size_t i = 0; ok && i < count; i++) {
    vs_ref new = vs_results_of(&g.results, refs[i]);
    vs_node_retain(new.node);
    vs_node_release(refs[i].node);
    refs[i] = new;
  }
  for (size_t i = 0; i < g.results.count; i++) vs_node_release(g.results.at[i].node);
  vs_store_realloc(w->store, g.results.at, g.results.room * sizeof *g.results.at, 0);
  vs_store_realloc(w->store, g.results.kids, g.results.kid_room * sizeof *g.results.kids, 0);
  vs_nodemap_free(&g.results.places);
  vs_nodemap_free(&w->uses);
  return ok;
}

/* ---- counting ---- */

typedef struct { vs_nodemap *uses; double commands; } vs_counting;

static bool vs_commands_visit(void *context, vs_ref at, vs_error *e) {
  vs_counting *c = context;
  const vs_node *n = at.node;
  uint64_t uses = *vs_nodemap_get(c->uses, n);
  (void)e;
  switch (vs_kind_get((vs_kind)n->kind)->level) {
    case VS_LEVEL_MESH: case VS_LEVEL_FLAT: case VS_LEVEL_CURVED: case VS_LEVEL_SWEPT: case VS_LEVEL_SUGAR: c->commands += n->kind == VS_EMPTY ? 0 : 1; break;
    case VS_LEVEL_OPERATION:
      if (n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER) c->commands += 1;
      else if (n->child_count > 1) c->commands += n->child_count - 1;
      break;
  }
  if (uses > 1) c->commands += 1 + (double)uses;
  return true;
}

bool vs_commands_count(vs_store *s, const vs_ref *refs, size_t count, double *commands, vs_error *e) {
  vs_nodemap uses = { .store = s };
  vs_counting c = { &uses, count > 1 ? (double)(count - 1) : 0 }; /* the drawing is the union of what was drawn */
  bool ok = vs_rewrite_count_uses(&uses, s, refs, count, e) && vs_rewrite_visit(s, refs, count, vs_commands_visit, &c, e);
  vs_nodemap_free(&uses);
  *commands = c.commands;
  return ok;
}

/* ---- all of them ---- */

bool vs_passes_run(vs_store *s, vs_ref *refs, size_t count, const vs_pass_options *options, vs_pass_stats *stats, vs_error *e) {
  static vs_rewrite_fn *const passes[] = {
#define VS_PASS(upper, lower, doc) vs_pass_##lower,
#include "model/passes/passes.def"
  };
  vs_error local;
  if (!e) e = &local;
  e->kind = VS_ERROR_NONE;
  if (stats) *stats = (vs_pass_stats){ 0 };
  if (stats && !vs_commands_count(s, refs, count, &stats->commands_before, e)) return false;
  vs_ref *work = vs_store_realloc(s, NULL, 0, (count ? count : 1) * sizeof *work);
  if (!work) return vs_error_memory(e, NULL);
  for (size_t i = 0; i < count; i++) {
    work[i] = refs[i];
    vs_node_retain(work[i].node);
  }
  bool ok = true;
  for (int k = 0; ok && k < VS_PASS_COUNT; k++) {
    if (!(options->passes >> k & 1)) continue;
    vs_rewrite w = { .store = s, .options = options, .error = e, .uses = { .store = s } };
    if (k == VS_PASS_FLATTEN) ok = vs_flatten_begin(&w, work, count);
    if (k == VS_PASS_SHARE) ok = vs_share_begin(&w, work, count);
    ok = ok && vs_rewrite_run(&w, passes[k], work, count);
    if (k == VS_PASS_FLATTEN) vs_flatten_end(&w);
    if (k == VS_PASS_SHARE) vs_share_end(&w);
    if (stats) stats->changed[k] = w.changed;
  }
  if (ok && stats) ok = vs_commands_count(s, work, count, &stats->commands_after, e);
  for (size_t i = 0; i < count; i++) {
    vs_ref drop = ok ? refs[i] : work[i];
    if (ok) refs[i] = work[i];
    vs_node_release(drop.node);
  }
  vs_store_realloc(s, work, (count ? count : 1) * sizeof *work, 0);
  return ok;
}
