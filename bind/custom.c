/* Implements objects of kinds that users define: their nodes and numbers, nodes with replaced children, and the calls
 * of drawing functions.
 *
 * The number of such an object identifies its arguments on the Scheme side. All nodes with the same number have one
 * ticket, which counts them. When the last of these nodes is released, the number is added to a list. primitives.scm
 * reads this list, and deletes the arguments of the objects with these numbers. */
#include "bind/custom.h"

#include "bind/build.h"
#include "bind/call/call.h"
#include "bind/objects.h"
#include "bind/state.h"
#include "vm/machine/run.h"
#include "vm/values/heap.h"

void vs_bind_ticket_gone(void *bind, uint32_t number) {
  vs_bind *b = bind;
  if (number >= b->ticket_count || !b->tickets[number]) return; /* ignores a ticket of a node that an earlier
                                                                 * interpreter created */
  b->tickets[number] = NULL;
  if (b->gone_count < b->ticket_room) b->gone[b->gone_count++] = number;
}

static bool tickets_grow(vs_bind *b, size_t need) {
  if (need <= b->ticket_room) return true;
  size_t room = b->ticket_room + b->ticket_room / 2 + 64, old = b->ticket_room;
  if (room < need) room = need;
  vs_ticket **tickets = vs_store_realloc(b->store, b->tickets, old * sizeof *tickets, room * sizeof *tickets);
  if (!tickets) return false;
  b->tickets = tickets;
  uint32_t *gone = vs_store_realloc(b->store, b->gone, old * sizeof *gone, room * sizeof *gone);
  if (!gone) { /* gives `tickets` its old size again, so that both arrays have the same size */
    vs_ticket **less = vs_store_realloc(b->store, tickets, room * sizeof *tickets, old ? old * sizeof *tickets : 0);
    b->tickets = less;
    return false;
  }
  b->gone = gone;
  for (size_t i = old; i < room; i++) tickets[i] = NULL;
  b->ticket_room = room;
  return true;
}

vs_status vs_p_custom_new(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  uint32_t number = (uint32_t)f->arg[2].integer;
  vs_ref child = vs_bind_take_ref(f->arg[3].value);
  struct vs_custom d = { vs_store_text(b->store, f->arg[0].text.at, f->arg[0].text.length),
                         vs_store_text(b->store, f->arg[1].text.at, f->arg[1].text.length), NULL, 0 };
  if (!d.name || !d.made || !tickets_grow(b, (size_t)number + 1)) return vs_fail_memory(f->vm);
  if (number >= b->ticket_count) b->ticket_count = (size_t)number + 1;
  bool fresh = !b->tickets[number];
  vs_ticket *t = fresh ? vs_ticket_new(b->store, number) : b->tickets[number];
  if (!t) return vs_fail_memory(f->vm);
  b->tickets[number] = t;
  d.values = t;
  vs_node *n = vs_node_new(b->store, VS_CUSTOM, &d, child.node ? &child : NULL, child.node ? 1 : 0);
  if (fresh) vs_ticket_release(b->store, t); /* releases this function's reference; a created node keeps the ticket
                                              * alive */
  return vs_bind_give_node(f, n, out);
}

/* Returns the number of an object whose last node was released, or #f if there is none. Each number is returned
 * once. */
vs_status vs_p_custom_gone(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  /* Skips released numbers that new nodes have again. */
  while (b->gone_count && b->tickets[b->gone[b->gone_count - 1]]) b->gone_count--;
  *out = b->gone_count ? vs_fix(b->gone[--b->gone_count]) : VS_FALSE;
  return VS_OK;
}

vs_status vs_p_custom_number(vs_args *f, vs_value *out) {
  const vs_node *n = vs_bind_take_ref(f->arg[0].value).node;
  *out = n && n->kind == VS_CUSTOM ? vs_fix(VS_AS(custom, n)->values->id) : VS_FALSE;
  return VS_OK;
}

vs_status vs_p_custom_open(vs_args *f, vs_value *out) {
  const vs_node *n = vs_bind_take_ref(f->arg[0].value).node;
  *out = vs_bool(n && n->flags & VS_NODE_OPEN);
  return VS_OK;
}

/* Returns a number for the node. Two calls with the same node return the same number. */
vs_status vs_p_node_number(vs_args *f, vs_value *out) {
  *out = vs_fix((int64_t)((uintptr_t)f->arg[0].ref.node >> 3));
  return VS_OK;
}

static const char *class_noun(const vs_node *n) {
  switch ((vs_class)n->class_) {
    case VS_NOTHING: return "nothing";
    case VS_CURVE: return "a curve";
    case VS_REGION_CLASS: return "a region";
    case VS_SURFACE: return "a surface";
    case VS_SOLID: return "a solid";
    case VS_MIXED: case VS_INHERIT: break;
  }
  return "a union of several kinds";
}

/* Returns a node of the kind of argument 0 with other children, which get the origins of the old children. Placements,
 * wrappers and unions accept any children. For other operations, the new children must have the same classes as the old
 * ones. */
vs_status vs_p_object_with(vs_args *f, vs_value *out) {
  const vs_ref *o = &f->arg[0].ref, *kids = f->arg[1].refs.at;
  const vs_node *n = o->node;
  size_t count = f->arg[1].refs.count;
  bool free = n->kind == VS_TRANSFORM || n->kind == VS_UNION || n->kind == VS_GHOST || vs_node_is_wrapper(n);
  if (count != n->child_count)
    return vs_fail(f->vm, f->vm->sym.error, "a %s has %lu children, not %lu", vs_kind_get((vs_kind)n->kind)->name,
                   (unsigned long)n->child_count, (unsigned long)count);
  for (size_t i = 0; i < count && !free; i++) {
    const vs_node *was = n->children[i].node, *is = kids[i].node;
    bool same = was->class_ == is->class_ || is->class_ == VS_NOTHING || is->class_ == VS_MIXED ||
                (was->class_ == VS_CURVE && is->class_ == VS_REGION_CLASS);
    if (same) continue;
    const char *name = was->kind == VS_CUSTOM ? VS_AS(custom, was)->name : vs_kind_get((vs_kind)was->kind)->name;
    vs_error_set(&f->bind->handed, VS_ERROR_MODEL, n->children[i].origin,
                 "the drawing function of %s gave %s, where %s needs %s", name, class_noun(is),
                 vs_kind_get((vs_kind)n->kind)->name, class_noun(was));
    return vs_fail(f->vm, f->vm->sym.type, "%s", f->bind->handed.message);
  }
  vs_node *made = vs_node_new(f->store, (vs_kind)n->kind, vs_node_data(n), kids, count);
  if (!made) return vs_fail_memory(f->vm);
  vs_status s = vs_bind_give_ref(f->bind, (vs_ref){ made, o->origin }, out);
  vs_node_release(made);
  return s;
}

/* Sets whether drawing functions are running, and returns the previous value. */
vs_status vs_p_handing(vs_args *f, vs_value *out) {
  *out = vs_bool(f->bind->handing);
  f->bind->handing = f->arg[0].value != VS_FALSE;
  return VS_OK;
}

vs_status vs_p_is_format(vs_args *f, vs_value *out) {
  *out = vs_bool(f->bind->is_format && f->bind->is_format(f->bind, f->arg[0].text.at));
  return VS_OK;
}

/* ---- calling drawing functions ---- */

enum { HOST_HAND_ON = 2 }; /* index in vm->at.host at which primitives.scm stores its procedure when the program
                            * registers its first drawing function */

bool vs_bind_hands_on(const vs_bind *b) {
  vs_value all = b->vm->at.host;
  return vs_is_vector(all) && vs_as_vector(all)->at[HOST_HAND_ON] != VS_FALSE;
}

bool vs_bind_hand_on(vs_bind *b, vs_ref *refs, size_t count, const char *const *names) {
  vs_scheme *vm = b->vm;
  VS_ROOTS(vm, r, 4); /* roots of the garbage collector: the procedure, the objects, the names, and a name */
  r[0] = vs_as_vector(vm->at.host)->at[HOST_HAND_ON];
  r[2] = VS_NIL;
  if (!vs_bind_give_refs(b, refs, count, &r[1])) return false;
  for (; names && *names; names++)
    if (!vs_intern_c(vm, *names, &r[3]) || !vs_cons(vm, r[3], r[2], &r[2])) return false;
  b->handed.kind = VS_ERROR_NONE;
  vs_value arguments[2] = { r[1], r[2] };
  if (!vs_run(vm, r[0], 2, arguments, &r[3])) return false;
  vs_value l = r[3];
  for (size_t i = 0; i < count; i++, l = vs_cdr(l)) {
    vs_ref made = vs_is_pair(l) ? vs_bind_take_ref(vs_car(l)) : (vs_ref){ NULL, NULL };
    if (!made.node) return vs_fail(vm, vm->sym.error, "the drawing functions lost an object");
    vs_node_retain(made.node);
    vs_node_release(refs[i].node);
    refs[i] = made;
  }
  return true;
}
