/* Searches an object for marked scopes. A mark is a node without geometry that is created in a scope. The library
 * rules.scm creates marks like objects of define-primitive, so that they are moved and copied together with the objects
 * around them. */
#include "bind/call/give.h"
#include "bind/call/positional.h"
#include "bind/rules/derivation.h"
#include "bind/rules/move_scopes.h"

#include <stdlib.h>
#include <string.h>

#include "bind/state.h"
#include "model/store/array.h"
#include "model/store/nodemap.h"

typedef struct {
  const vs_node *node;
  uint32_t next; /* next: index of the next child to visit */
  bool found;    /* whether the node or a descendant is a mark */
} visit;

static const char mark_kind[] = "marked-scope";
static bool is_mark(const vs_node *n) { return n->kind == VS_CUSTOM && !strcmp(VS_AS(custom, n)->name, mark_kind); }

enum { WITHOUT = 1, WITH = 2 };

/* Stores in `known`, for each node of the tree n, whether it contains a mark. Returns false when memory is out. */
static bool note_marks(const vs_node *n, vs_nodemap *known) {
  visit *stack = NULL;
  size_t count = 0, room = 0;
  bool ok = VS_GROW(stack, room, 1);
  if (ok) stack[count++] = (visit){ n, 0, is_mark(n) };
  while (ok && count) {
    visit *v = &stack[count - 1];
    if (v->next < v->node->child_count) {
      const vs_node *child = v->node->children[v->next++].node;
      uint64_t *seen = vs_nodemap_get(known, child);
      if (seen)
        v->found = v->found || *seen == WITH;
      else if (!child->child_count && !is_mark(child))
        continue; /* a leaf that is no mark gets no entry, since a drawing may have a million leaves */
      else if ((ok = VS_GROW(stack, room, count + 1)))
        stack[count++] = (visit){ child, 0, is_mark(child) };
      continue;
    }
    bool found = v->found;
    uint64_t *slot = vs_nodemap_put(known, v->node, NULL);
    ok = slot != NULL;
    if (ok) *slot = found ? WITH : WITHOUT;
    if (--count && found) stack[count - 1].found = true;
  }
  free(stack);
  return ok;
}

typedef struct {
  const vs_node *node;
  vs_affine map;
} placed;

/* (%find-scopes o): returns a list of (number . matrix) for the marks in the object, in the order of its tree: the
 * number of a mark, and its placement. */
vs_status vs_p_marks(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  vs_nodemap known = { .store = vs_call_store(f) };
  placed *stack = NULL, *found = NULL;
  size_t count = 0, room = 0, found_count = 0, found_room = 0;
  bool ok = note_marks(vs_arg_ref(f, 0).node, &known) && VS_GROW(stack, room, 1);
  if (ok) stack[count++] = (placed){ vs_arg_ref(f, 0).node, vs_affine_identity() };
  while (ok && count) {
    placed p = stack[--count];
    const uint64_t *seen = vs_nodemap_get(&known, p.node);
    if (!seen || *seen != WITH) continue;
    if (is_mark(p.node)) {
      if ((ok = VS_GROW(found, found_room, found_count + 1))) found[found_count++] = p;
      continue;
    }
    if (p.node->kind == VS_TRANSFORM) p.map = vs_affine_multiply(&p.map, &VS_AS(transform, p.node)->matrix);
    ok = VS_GROW(stack, room, count + p.node->child_count);
    for (uint32_t i = p.node->child_count; ok && i-- > 0;)
      stack[count++] = (placed){ p.node->children[i].node, p.map };
  }
  vs_nodemap_free(&known);
  free(stack);
  if (!ok) return free(found), vs_fail_memory(vm);
  VS_ROOTS(vm, r, 2);
  r[0] = VS_NIL;
  for (size_t i = found_count; ok && i-- > 0;)
    ok = vs_bind_give_matrix(f, &found[i].map, &r[1]) &&
         vs_cons(vm, vs_fix(VS_AS(custom, found[i].node)->values->id), r[1], &r[1]) &&
         vs_cons(vm, r[1], r[0], &r[0]) && vs_poll(vm, 8);
  free(found);
  *out = r[0];
  return ok ? VS_OK : VS_ERROR;
}

/* Returns a copy of the scope s that has the mark with this number. If it fails, sets the error and returns NULL. */
static vs_scope *with_mark(vs_args *f, vs_scope *s, int64_t number) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_bind *b = vs_call_bind(f);
  vs_scope *c = NULL;
  if ((uint64_t)number >= b->ticket_count || !b->tickets[number])
    vs_fail(vm, vm->sym.error, "there is no mark of number %lld", (long long)number);
  else if (!(c = vs_scope_copy(s)))
    vs_fail_memory(vm);
  else if (!vs_scope_set_mark(c, b->tickets[number]))
    vs_scope_release(c), c = NULL, vs_fail_memory(vm);
  return c;
}

/* (%scope-mark s mark): adds the mark to the objects of the running derivation, and returns a copy of the scope s that
 * has the mark. */
vs_status vs_p_scope_mark(vs_args *f, vs_value *out) {
  vs_scheme *vm = vs_call_vm(f);
  const vs_node *n = vs_arg_ref(f, 1).node;
  vs_derivation *d = vs_call_bind(f)->growing;
  if (!d) return vs_fail(vm, vm->sym.error, "works only in a rule: outside of a rule there is no scope");
  if (!vs_rules_gather(d, vs_arg_ref(f, 1), vs_arg_scope(f, 0)->flags)) return VS_ERROR;
  vs_scope *s = with_mark(f, vs_arg_scope(f, 0), VS_AS(custom, n)->values->id);
  return s ? vs_bind_give_scope(vm, s, out) : VS_ERROR;
}

/* (%scope-found s number matrix): returns a copy of the scope s that is moved by the matrix and has the mark with this
 * number. */
vs_status vs_p_scope_found(vs_args *f, vs_value *out) {
  vs_scope *s = with_mark(f, vs_arg_scope(f, 0), vs_arg_integer(f, 1));
  if (!s) return VS_ERROR;
  vs_affine m = vs_arg_matrix(f, 2);
  vs_scope *at = vs_scope_placed(s, &m);
  vs_scope_release(s);
  return vs_bind_give_scope(vs_call_vm(f), at, out);
}

/* (%scope-mark-number s): returns the number of the mark of the scope s, or #f if s has no mark. */
vs_status vs_p_scope_mark_number(vs_args *f, vs_value *out) {
  const vs_scope_extra *e = vs_arg_scope(f, 0)->extra;
  *out = e && e->mark ? vs_fix(e->mark->id) : VS_FALSE;
  return VS_OK;
}
