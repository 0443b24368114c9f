/* Implements derivations (applications of rules to a scope and its children): their begin and end, the stack of scopes
 * that wait for their rules, the objects that rules have created, and their random numbers. */
#include "bind/rules/derivation.h"

#include <stdio.h>
#include <string.h>

#include "bind/call/call.h"
#include "bind/call/convert.h"
#include "bind/call/procedure.h"
#include "bind/call/refuse.h"
#include "bind/call/take.h"
#include "bind/objects.h"
#include "bind/origins.h"
#include "bind/rules/place.h"
#include "bind/state.h"
#include "vm/library/kept.h"
#include "vm/library/system.h"
#include "vm/values/heap.h"

/* ---- creating and freeing derivations ---- */

static void mark_task(vs_scheme *vm, vs_rule_task *t, void (*mark)(vs_scheme *vm, vs_value *slot)) {
  if (!t->many) mark(vm, &t->rules[0]);
  for (uint32_t i = t->next; t->many && i < t->count; i++) mark(vm, &t->rules[i]);
}
static void derivation_trace(vs_scheme *vm, void *object, void (*mark)(vs_scheme *vm, vs_value *slot)) {
  vs_derivation *d = object;
  mark(vm, &d->rule);
  for (size_t i = 0; i < d->count; i++) mark_task(vm, d->stack[i], mark);
  for (size_t i = 0; i < d->waiting_count; i++) mark_task(vm, d->waiting[i].task, mark);
}

void vs_task_drop(vs_derivation *d, vs_rule_task *t) {
  for (uint32_t i = t->next; i < t->count; i++) vs_scope_release(t->child[i]);
  vs_store_realloc(d->store, t, t->bytes, 0);
}

/* Releases the objects of a derivation, after their union was returned or after the derivation failed. */
static void forget_made(vs_derivation *d) {
  vs_store *s = d->store;
  for (size_t i = 0; i < d->made_count; i++) {
    vs_node_release(d->made[i].node);
    if (i < d->flags_room) vs_scope_flags_release(s, d->made_flags[i]);
  }
  vs_store_realloc(s, d->made, d->made_room * sizeof *d->made, 0);
  vs_store_realloc(s, d->made_flags, d->flags_room * sizeof *d->made_flags, 0);
  vs_surroundings_free(d->around);
  d->made = NULL, d->made_flags = NULL, d->around = NULL;
  d->made_count = d->made_room = d->flags_room = 0;
}

static void derivation_release(void *object) {
  vs_derivation *d = object;
  vs_bind *b = d->bind;
  vs_store *s = b->store;
  if (b->growing == d) b->growing = NULL; /* an error has ended the derivation d, so b->growing still points to it */
  while (d->count) vs_task_drop(d, d->stack[--d->count]);
  vs_store_realloc(s, d->stack, d->room * sizeof *d->stack, 0);
  while (d->waiting_count) vs_task_drop(d, d->waiting[--d->waiting_count].task);
  vs_store_realloc(s, d->waiting, d->waiting_room * sizeof *d->waiting, 0);
  forget_made(d);
  vs_scope_release(d->now);
  vs_lineage_release(d->lineage);
  vs_node_release(d->fitted);
  vs_store_realloc(s, d, sizeof *d, 0);
}
const vs_foreign_type vs_derivation_type = { "a derivation", derivation_release, NULL, NULL,
                                             NULL,           derivation_trace,   false };

/* Returns the address by which a scope's Scheme object is marked as live (being processed by the derivation d): the
 * address of d, plus 1 if the rule is to run at once. */
static const void *live_mark(const vs_derivation *d, bool run) { return (const char *)d + run; }
static bool is_live(const vs_bind *b, vs_value wrapper, bool *run) {
  const void *with = vs_as_foreign(wrapper)->with;
  if (!b->growing || !with) return false;
  *run = with == live_mark(b->growing, true);
  return *run || with == live_mark(b->growing, false);
}

/* Removes a derivation that was ended by an uncaught error, which does not restore b->growing. A running derivation has
 * an entry in the list vm->winders (dynamic-wind). If this list is empty, the derivation has ended. */
static void forget_ended(vs_bind *b) {
  if (!b->growing || b->vm->winders != VS_NIL) return;
  if (!b->growing->outer) vs_random_restore(b->vm, b->growing->random);
  b->growing = NULL;
}

static vs_derivation *derivation_new(vs_bind *b, vs_value *holder) {
  forget_ended(b);
  vs_derivation *d = vs_store_realloc(b->store, NULL, 0, sizeof *d);
  if (!d) return (void)vs_fail_memory(b->vm), NULL;
  *d = (vs_derivation){
    .vm = b->vm, .bind = b, .store = b->store, .rule = VS_FALSE, .most = b->growing ? b->growing->most : VS_RULES_DEPTH
  };
  const vs_derivation *outer = b->growing;
  if (outer) {
    /* numbers the steps of a nested derivation from 1000, 2000, ..., so that the paths of its scopes differ from those
     * of other derivations of this rule */
    d->name = outer->name, d->steps = 1000 * ++b->growing->steps;
    d->entry = outer->entry, d->position = outer->position;
  }
  d->lineage = outer ? vs_lineage_retain(outer->lineage) : vs_lineage_new(b->store);
  if (!d->lineage) return vs_store_realloc(b->store, d, sizeof *d, 0), (void)vs_fail_memory(b->vm), NULL;
  return vs_make_foreign(b->vm, &vs_derivation_type, d, sizeof *d, holder) ? d
                                                                           : NULL; /* if vs_make_foreign fails, it has
                                                                                    * released the derivation */
}

vs_derivation *vs_rules_begin(vs_args *f, vs_value *holder) {
  bool run;
  vs_bind *b = f->bind;
  if (!is_live(b, f->arg[0].value, &run)) return derivation_new(b, holder);
  vs_as_foreign(f->arg[0].value)->with = NULL;
  *holder = VS_UNSPECIFIC;
  b->growing->steps++;
  return b->growing;
}

/* ---- the stack of waiting scopes ---- */

vs_rule_task *vs_task_new(vs_derivation *d, uint32_t count, bool many) {
  size_t rules = many && count ? count : 1;
  size_t bytes = sizeof(vs_rule_task) + (size_t)count * sizeof(vs_scope *) + rules * sizeof(vs_value);
  vs_rule_task *t = vs_store_realloc(d->store, NULL, 0, bytes);
  if (!t) return (void)vs_fail_memory(d->vm), NULL;
  memset(t, 0, bytes);
  t->bytes = bytes, t->many = many, t->rules = (vs_value *)(void *)(t->child + count);
  t->count = count;
  for (size_t i = 0; i < rules; i++) t->rules[i] = VS_FALSE;
  return t;
}

/* Adds an entry to the derivation's record: the running rule `rule` has created the scopes of the task t by the
 * operator `op`. Returns false when memory is out. */
static bool record(vs_derivation *d, vs_rule_task *t, const char *rule, const char *op) {
  uint32_t index = t->count == 1 && t->child[0] ? t->child[0]->index : 0;
  return vs_lineage_add(d->lineage,
                       (vs_lineage_entry){
                           .parent = d->entry, .position = d->position, .count = t->count, .index = index },
                       rule, op, &t->entry);
}

bool vs_task_push(vs_derivation *d, vs_rule_task *t) {
  const char *op = NULL;
  for (uint32_t i = 0; i < t->count && !op; i++)
    if (t->child[i]) op = t->child[i]->op;
  if ((op && !record(d, t, d->name, op)) ||
      !vs_store_grow(d->store, &d->stack, &d->room, d->count + 1, sizeof *d->stack)) {
    vs_task_drop(d, t);
    return vs_fail_memory(d->vm);
  }
  t->origin = vs_bind_origin(d->bind);
  for (uint32_t i = 0; i < t->count; i++)
    if (t->child[i]) t->child[i]->origin = t->origin;
  d->stack[d->count++] = t;
  return true;
}

static uint64_t text_hash(const char *text) {
  uint64_t h = UINT64_C(0xCBF29CE484222325);
  for (; text && *text; text++) h = (h ^ (unsigned char)*text) * UINT64_C(0x100000001B3);
  return h;
}

static vs_status too_deep(vs_derivation *d, const vs_scope *s) {
  char path[500];
  vs_scope_path_text(s, path, sizeof path);
  vs_scheme *vm = d->vm;
  const vs_native *native = vm->native;
  vm->native = NULL; /* the error message begins with the rule's name, not the native's */
  vs_fail(vm, vm->sym.recursion,
          "%s: the derivation is %u levels deep, at %s; a rule that calls itself needs a clause that ends, or (derive "
          "scope rule #:depth n)",
          d->name ? d->name : "rule", d->most, path);
  vm->native = native;
  return VS_ERROR;
}

vs_scope *vs_rules_child(vs_derivation *d, vs_scope *parent, vs_scope_class c, const char *op, uint32_t index,
                         uint32_t count) {
  if (parent->depth >= d->most) return (void)too_deep(d, parent), NULL;
  vs_scope *s = vs_scope_fresh(parent->store, c);
  if (!s) return (void)vs_fail_memory(d->vm), NULL;
  s->depth = parent->depth + 1, s->index = index, s->count = count;
  s->rule = d->name, s->op = op;
  s->parent = vs_scope_retain(parent);
  if ((s->flags = parent->flags)) s->flags->refs++;
  s->hash = vs_scope_mix(vs_scope_mix(parent->hash, text_hash(d->name) + 3 * text_hash(op)),
                         (uint64_t)d->steps << 32 | index);
  return s;
}

bool vs_rules_class(vs_args *f, int i, unsigned classes) {
  const vs_scope *s = f->arg[i].scope;
  if (classes >> s->class_ & 1) return true;
  char wanted[200] = "";
  unsigned left = classes;
  for (uint8_t c = 0; c < VS_SCOPE_CLASSES; c++) {
    if (!(classes >> c & 1)) continue;
    left &= ~(1u << c);
    const char *between = !*wanted ? "" : left ? ", " : " or ";
    snprintf(wanted + strlen(wanted), sizeof wanted - strlen(wanted), "%s%s", between,
             vs_scope_noun(&(vs_scope){ .class_ = c }));
  }
  return vs_bind_refuse(f, f->procedure->form[f->form].at[i].name, wanted, f->arg[i].value);
}

const char *vs_rules_operator(vs_args *f) {
  const char *name = f->names;
  if (*name == '%') name++;
  return !strncmp(name, "scope-", 6) ? name + 6 : name;
}

/* ---- the objects that rules have created ---- */

bool vs_rules_gather(vs_derivation *d, vs_ref ref, vs_scope_flags *flags) {
  if (ref.node->kind == VS_EMPTY) return true;
  if (!vs_store_grow(d->store, &d->made, &d->made_room, d->made_count + 1, sizeof *d->made))
    return vs_fail_memory(d->vm);
  size_t had = d->flags_room;
  if (flags && !vs_store_grow(d->store, &d->made_flags, &d->flags_room, d->made_count + 1, sizeof *d->made_flags))
    return vs_fail_memory(d->vm);
  if (d->flags_room > had) memset(d->made_flags + had, 0, (d->flags_room - had) * sizeof *d->made_flags);
  if (flags) d->made_flags[d->made_count] = flags, flags->refs++;
  vs_node_retain(ref.node);
  d->made[d->made_count++] = ref;
  return true;
}

/* ---- steps of the loop in rules.scm ---- */

static vs_derivation *derivation_of(vs_args *f) { return vs_foreign_get(f->arg[0].value, &vs_derivation_type); }

vs_status vs_p_is_derivation(vs_args *f, vs_value *out) {
  *out = vs_bool(derivation_of(f) != NULL);
  return VS_OK;
}

vs_status vs_p_derivation_enter(vs_args *f, vs_value *out) {
  vs_derivation *d = derivation_of(f);
  (void)out;
  if (!d || d->over)
    return vs_fail(f->vm, f->vm->sym.error,
                   "the derivation is over: a rule's continuation can be entered only while it runs");
  d->outer = f->bind->growing;
  f->bind->growing = d;
  return vs_random_keep(f->vm, d->random) ? VS_OK : VS_ERROR;
}

vs_status vs_p_derivation_leave(vs_args *f, vs_value *out) {
  vs_derivation *d = derivation_of(f);
  (void)out;
  f->bind->growing = d->outer;
  d->outer = NULL;
  return vs_random_restore(f->vm, d->random) ? VS_OK : VS_ERROR;
}

/* Begins to apply the rule `name` to s: from now on, random numbers depend on the path of s. */
static bool rule_begins(vs_derivation *d, const char *name, const vs_scope *s) {
  d->name = name;
  d->steps = 0;
  return vs_random_branch(d->vm, vs_scope_mix(s->hash, text_hash(name)));
}

/* Moves the scopes that waited for signals to the stack of waiting scopes, in order, so that the first one is on top.
 * If it fails, sets the error and returns false. */
static bool waiting_begin(vs_derivation *d) {
  if (!vs_store_grow(d->store, &d->stack, &d->room, d->waiting_count, sizeof *d->stack))
    return vs_fail_memory(d->vm);
  while (d->waiting_count) d->stack[d->count++] = d->waiting[--d->waiting_count].task;
  return true;
}

/* (%derivation-next d): returns the next scope whose rule is a procedure, or #f at the end. %derivation-rule then
 * returns that procedure. If a scope's rule is an object, places the object in the scope and continues. */
vs_status vs_p_derivation_next(vs_args *f, vs_value *out) {
  vs_derivation *d = derivation_of(f);
  VS_ROOTS(f->vm, r, 2);
  for (size_t low = d->begun, high = d->count; low + 1 < high; low++, high--) {
    vs_rule_task *t = d->stack[low];
    d->stack[low] = d->stack[high - 1], d->stack[high - 1] = t;
  }
  for (;;) {
    d->begun = d->count;
    if (!d->count && !waiting_begin(d)) return VS_ERROR;
    if (!d->count) return *out = VS_FALSE, VS_OK;
    vs_rule_task *t = d->stack[d->count - 1];
    if (t->next == t->count) {
      d->count--;
      vs_task_drop(d, t);
      continue;
    }
    uint32_t i = t->next++;
    vs_scope *s = t->child[i];
    vs_value rule = t->rules[t->many ? i : 0];
    vs_ref object = vs_bind_take_ref(rule);
    if (!s) continue;
    if (rule == VS_FALSE || object.node) {
      bool ok = !object.node || vs_rules_place(d, s, object, t->origin);
      vs_scope_release(s);
      if (!ok || !vs_poll(f->vm, 20)) return VS_ERROR;
      continue;
    }
    r[0] = rule;
    vs_scope_release(d->now);
    d->now = vs_scope_retain(s), d->entry = t->entry, d->position = i;
    if (t->body && !rule_begins(d, t->name, s)) return vs_scope_release(s), VS_ERROR;
    bool body = t->body;
    if (!vs_bind_give_scope(f->vm, s, &r[1])) return VS_ERROR;
    if (!body && vs_is(r[0], VS_T_CLOSURE) && vs_object_of(r[0])->flags & VS_F_MARKED)
      vs_as_foreign(r[1])->with = live_mark(d, true);
    d->rule = r[0], d->begun = d->count;
    return *out = r[1], VS_OK;
  }
}

vs_status vs_p_derivation_rule(vs_args *f, vs_value *out) {
  *out = derivation_of(f)->rule;
  return VS_OK;
}

/* Sets the error that `got` is wrong. The message begins with the name of the running rule, not of the native that
 * found the error. Returns false. */
static bool refuse_of_rule(vs_args *f, const char *what, const char *expected, vs_value got) {
  VS_ROOTS(f->vm, r, 2);
  const vs_derivation *d = f->bind->growing;
  r[0] = got;
  if (!vs_cons(f->vm, r[0], VS_NIL, &r[1])) return false;
  f->vm->native = NULL;
  return vs_fail_with(f->vm, f->vm->sym.type, r[1], "%s: %s must be %s, got", d && d->name ? d->name : "rule", what,
                      expected);
}

static bool gather_value(vs_args *f, vs_derivation *d, const vs_scope *s, vs_value v, const char *what,
                         const char *expected) {
  vs_scope_flags *flags = s ? s->flags : NULL;
  if (v == VS_UNSPECIFIC) return true;
  vs_ref ref = vs_bind_take_ref(v), *refs;
  if (ref.node) return vs_rules_gather(d, ref, flags);
  size_t n;
  vs_value bad = VS_ABSENT;
  if (v == VS_NIL) return true;
  if (vs_is_pair(v)) {
    if (!vs_bind_take_refs(f, v, &refs, &n, &bad)) {
      if (bad == VS_ABSENT) return false;
      return refuse_of_rule(f, what, expected, bad);
    }
    for (size_t i = 0; i < n; i++)
      if (!vs_rules_gather(d, refs[i], flags)) return false;
    return true;
  }
  return refuse_of_rule(f, what, expected, v);
}

/* (%derivation-made d value): adds the objects in `value`, the result of a rule that is a procedure, to the objects of
 * the derivation. */
vs_status vs_p_derivation_made(vs_args *f, vs_value *out) {
  (void)out;
  vs_derivation *d = derivation_of(f);
  vs_value v = f->arg[1].value;
  const char *expected = vs_bind_take_scope(v) ? "an object or a list of objects (scope-place puts one into the scope)"
                                          : "an object or a list of objects";
  return gather_value(f, d, d->now, v, "the value of a rule", expected) ? VS_OK : VS_ERROR;
}

/* (%derivation-object d): returns the union of all objects that the rules have created, and ends the derivation. */
vs_status vs_p_derivation_object(vs_args *f, vs_value *out) {
  vs_derivation *d = derivation_of(f);
  vs_store *s = f->store;
  if (d->over) return vs_fail(f->vm, f->vm->sym.error, "the derivation is over");
  d->over = true;
  vs_node *n;
  if (d->made_count == 1)
    n = vs_node_retain(d->made[0].node);
  else if (d->made_count)
    n = vs_node_new(s, VS_UNION, &(struct vs_union){ 0 }, d->made, d->made_count);
  else
    n = vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
  const vs_origin *origin = d->made_count == 1 ? d->made[0].origin : NULL;
  forget_made(d);
  if (!n) return vs_fail_memory(f->vm);
  if (!f->bind->growing && !vs_lineage_keep(f->bind, n, d->lineage))
    return vs_node_release(n), vs_fail_memory(f->vm);
  if (!origin) return vs_bind_give_object(f->bind, n, out);
  vs_status status = vs_bind_give_ref(f->bind, (vs_ref){ n, origin }, out);
  vs_node_release(n);
  return status;
}

/* (%derive s rule depth): returns a derivation that begins by applying the rule to s, for `derive`. */
vs_status vs_p_derivation(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  r[0] = f->arg[1].value;
  vs_derivation *d = derivation_new(f->bind, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  d->most = (uint32_t)f->arg[2].integer;
  t->child[0] = vs_scope_retain(f->arg[0].scope);
  t->rules[0] = r[0];
  if (!vs_store_grow(f->store, &d->stack, &d->room, 1, sizeof *d->stack))
    return vs_task_drop(d, t), vs_fail_memory(f->vm);
  t->origin = vs_bind_origin(f->bind);
  d->stack[d->count++] = t;
  *out = r[1];
  return record(d, t, d->name, "derive") ? VS_OK : vs_fail_memory(f->vm);
}

/* ---- procedures that are rules ---- */

/* (%marked procedure): marks the procedure as a rule or operator, which accepts live scopes, and returns it. */
vs_status vs_p_marked(vs_args *f, vs_value *out) {
  if (vs_is(f->arg[0].value, VS_T_CLOSURE)) vs_object_of(f->arg[0].value)->flags |= VS_F_MARKED;
  *out = f->arg[0].value;
  return VS_OK;
}

/* (%marked-as procedure like): if the procedure `like` is marked as a rule or operator, also marks `procedure`. Returns
 * it. */
vs_status vs_p_marked_as(vs_args *f, vs_value *out) {
  vs_value like = f->arg[1].value;
  *out = f->arg[0].value;
  return vs_is(like, VS_T_CLOSURE) && vs_object_of(like)->flags & VS_F_MARKED ? vs_p_marked(f, out) : VS_OK;
}

/* (%live procedure s): returns the scope s as an argument for a call of the procedure in a rule. If the procedure is
 * marked as a rule or operator, this scope is live: it refers to the running derivation. */
vs_status vs_p_live(vs_args *f, vs_value *out) {
  vs_value procedure = f->arg[0].value, self = f->arg[1].value;
  *out = self;
  if (!f->bind->growing || !vs_is(procedure, VS_T_CLOSURE) || !(vs_object_of(procedure)->flags & VS_F_MARKED))
    return VS_OK;
  vs_scope *s = vs_bind_take_scope(self);
  if (!s) return VS_OK;
  if (!vs_bind_give_scope(f->vm, vs_scope_retain(s), out)) return VS_ERROR;
  vs_as_foreign(*out)->with = live_mark(f->bind->growing, false);
  return VS_OK;
}

/* (%enter self name body): called by a rule. Returns #t if the rule's body is to run now, #f if it waits on the stack.
 * Outside of a derivation, returns a new derivation that runs the body. */
vs_status vs_p_rule_enter(vs_args *f, vs_value *out) {
  vs_bind *b = f->bind;
  vs_scope *s = f->arg[0].scope;
  vs_value symbol = f->arg[1].value;
  const char *name =
      vs_is_symbol(symbol) ? vs_store_text(b->store, vs_as_symbol(symbol)->name, vs_as_symbol(symbol)->length) : "rule";
  bool run = false, live = is_live(b, f->arg[0].value, &run);
  if (!name) return vs_fail_memory(f->vm);
  if (live && run) {
    vs_as_foreign(f->arg[0].value)->with = NULL;
    *out = VS_TRUE;
    return rule_begins(b->growing, name, s) ? VS_OK : VS_ERROR;
  }
  VS_ROOTS(f->vm, r, 2);
  r[0] = f->arg[2].value;
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  t->body = true, t->name = name, t->rules[0] = r[0];
  if (live) { /* adds a level to the scope's path, so that two rules that are called with one scope have different
               * random numbers */
    vs_scope *child = vs_rules_child(d, s, (vs_scope_class)s->class_, name, 0, 1);
    if (!child) return vs_task_drop(d, t), VS_ERROR;
    vs_scope_become(child, s);
    child->index = s->index, child->count = s->count, child->left = s->left, child->right = s->right;
    t->child[0] = child;
  } else
    t->child[0] = vs_scope_retain(s);
  if (!vs_store_grow(b->store, &d->stack, &d->room, d->count + 1, sizeof *d->stack))
    return vs_task_drop(d, t), vs_fail_memory(f->vm);
  t->origin = vs_bind_origin(b);
  if (live) t->child[0]->origin = t->origin;
  d->stack[d->count++] = t;
  *out = live ? VS_FALSE : r[1];
  return record(d, t, d->name, name) ? VS_OK : vs_fail_memory(f->vm);
}

/* ---- signals between scopes ---- */

/* (%scope-await s name rule): applies the rule to s when all other scopes have been processed, so that s can receive
 * signals of this name. */
vs_status vs_p_scope_await(vs_args *f, vs_value *out) {
  VS_ROOTS(f->vm, r, 2);
  vs_scope *s = f->arg[0].scope;
  r[0] = f->arg[2].value;
  const char *name = vs_store_text(f->store, f->arg[1].text.at, f->arg[1].text.length);
  if (!name) return vs_fail_memory(f->vm);
  vs_derivation *d = vs_rules_begin(f, &r[1]);
  vs_rule_task *t = d ? vs_task_new(d, 1, false) : NULL;
  if (!t) return VS_ERROR;
  t->rules[0] = r[0];
  vs_scope *c = t->child[0] = vs_rules_child(d, s, (vs_scope_class)s->class_, "await", 0, 1);
  if (!c) return vs_task_drop(d, t), VS_ERROR;
  vs_scope_become(c, s);
  c->index = s->index, c->count = s->count, c->left = s->left, c->right = s->right;
  c->origin = t->origin = vs_bind_origin(f->bind);
  if (!vs_store_grow(f->store, &d->waiting, &d->waiting_room, d->waiting_count + 1, sizeof *d->waiting) ||
      !record(d, t, d->name, "await"))
    return vs_task_drop(d, t), vs_fail_memory(f->vm);
  d->waiting[d->waiting_count++] = (vs_waiting){ t, name };
  *out = r[1];
  return VS_OK;
}

/* (scope-signal s name): sends the signal to all scopes that wait for a signal of this name and touch s. */
vs_status vs_p_scope_signal(vs_args *f, vs_value *out) {
  vs_scope *s = f->arg[0].scope;
  const char *name = vs_store_text(f->store, f->arg[1].text.at, f->arg[1].text.length);
  if (!name) return vs_fail_memory(f->vm);
  for (vs_derivation *d = f->bind->growing; d; d = d->outer)
    for (size_t i = 0; i < d->waiting_count; i++) {
      vs_scope *to = d->waiting[i].task->child[0];
      bool touch = false;
      if (d->waiting[i].name != name) continue;
      if (!vs_scopes_touch(f->bind, s, to, &touch)) return VS_ERROR;
      if (!touch) continue;
      if (!vs_scope_add_signal(to, s)) return vs_fail_memory(f->vm);
    }
  *out = f->arg[0].value;
  return VS_OK;
}

/* (scope-signals s): returns the scopes that have sent a signal to s, in the order of the signals. */
vs_status vs_p_scope_signals(vs_args *f, vs_value *out) {
  const vs_scope_extra *e = f->arg[0].scope->extra;
  VS_ROOTS(f->vm, r, 2);
  r[0] = VS_NIL;
  for (uint32_t i = e ? e->count : 0; i-- > 0;)
    if (!vs_bind_give_scope(f->vm, vs_scope_retain(e->from[i]), &r[1]) || !vs_cons(f->vm, r[1], r[0], &r[0]))
      return VS_ERROR;
  *out = r[0];
  return VS_OK;
}

/* (%took self value): processes the value of an expression in a rule. A scope becomes the new `self`; an object is
 * added to the objects of the derivation. */
vs_status vs_p_took(vs_args *f, vs_value *out) {
  vs_value v = f->arg[1].value;
  *out = f->arg[0].value;
  if (v == VS_UNSPECIFIC) return VS_OK;
  if (vs_bind_take_scope(v)) return *out = v, VS_OK;
  if (!f->bind->growing) return vs_fail(f->vm, f->vm->sym.error, "no rule is being derived");
  return gather_value(f, f->bind->growing, vs_bind_take_scope(*out), v, "the value of a form of a rule",
                      "a scope, an object or a list of objects")
             ? VS_OK
             : VS_ERROR;
}

/* (%choose p ...): returns the index of an alternative in a rule, chosen at random. Each p is a probability; each #f
 * gets an equal part of the remaining probability. If all p are numbers and their sum is less than 1, the result may be
 * -1, which means no alternative. */
vs_status vs_p_choose(vs_args *f, vs_value *out) {
  size_t n = f->arg[0].values.count, open = 0;
  const vs_value *v = f->arg[0].values.at;
  double sum = 0, p, x;
  for (size_t i = 0; i < n; i++) {
    if (v[i] == VS_FALSE) {
      open++;
      continue;
    }
    if (!vs_bind_take_number(f->vm, v[i], &p) || !(p >= 0 && p <= 1))
      return refuse_of_rule(f, "#:chance", "a number from 0 to 1", v[i]);
    sum += p;
  }
  if (sum > 1 + 1e-9) {
    const char *name = f->bind->growing ? f->bind->growing->name : NULL;
    f->vm->native = NULL;
    return vs_fail(f->vm, f->vm->sym.range, "%s: the chances of a clause sum to %.12g, which is more than 1",
                   name ? name : "rule", sum);
  }
  if (!vs_random_unit(f->vm, &x)) return VS_ERROR;
  double share = open ? fmax(0, 1 - sum) / (double)open : 0;
  for (size_t i = 0; i < n; i++) {
    p = share;
    if (v[i] != VS_FALSE) vs_bind_take_number(f->vm, v[i], &p);
    if (x < p) return *out = vs_fix((int64_t)i), VS_OK;
    x -= p;
  }
  /* If the sum of the probabilities is below 1 only by rounding, the last alternative is chosen; otherwise none. */
  *out = vs_fix(sum < 1 - 1e-9 && !open ? -1 : (int64_t)n - 1);
  return VS_OK;
}

/* Returns the place of the origin, with the number of its file, or 0 if there is none. */
static vs_pos position_of(vs_scheme *vm, const vs_origin *o) {
  vs_value files = vm->at.files;
  for (size_t i = 1; o && vs_is_vector(files) && i < vs_as_vector(files)->length; i++) {
    const char *name = vs_bind_file_name(vs_bind_of(vm), vs_pos_make((uint32_t)i, 1, 1));
    if (name && !strcmp(name, o->file)) return vs_pos_make((uint32_t)i, o->line, o->column);
  }
  return 0;
}

/* (%rule-refuses name predicate place self): raises the error that the scope `self` is not of the class that the rule
 * requires. The error names the place of the operator that applies the rule, and that of the rule. */
vs_status vs_p_rule_refuses(vs_args *f, vs_value *out) {
  vs_scheme *vm = f->vm;
  vs_bind *b = f->bind;
  (void)out;
  VS_ROOTS(vm, r, 2);
  const vs_scope *s = vs_bind_take_scope(f->arg[3].value);
  bool run = false, live = s && is_live(b, f->arg[3].value, &run);
  const vs_origin *origin = live && run && s->origin ? s->origin : vs_bind_origin(b);
  char *name = NULL, *wanted = NULL, at[200] = "";
  size_t name_bytes = 0, wanted_bytes = 0;
  vs_pos rule = vs_is_fixnum(f->arg[2].value) ? vs_pos_of(f->arg[2].value) : 0;
  const char *file = rule ? vs_bind_file_name(b, rule) : NULL;
  if (file) snprintf(at, sizeof at, "; the rule is at %.150s:%u:%u", file, vs_pos_line(rule), vs_pos_col(rule));
  r[0] = f->arg[3].value;
  if (!vs_bind_take_text(vm, f->arg[0].value, &name, &name_bytes) ||
      !vs_bind_take_text(vm, f->arg[1].value, &wanted, &wanted_bytes)) {
    if (name) vs_mem(vm, name, name_bytes, 0);
    return VS_ERROR;
  }
  vs_pos place = position_of(vm, origin);
  if (s)
    vs_fail_at(vm, vm->sym.contract, place, VS_NIL, "%s: self must satisfy %s, got %s%s", name, wanted,
               vs_scope_noun(s), at);
  else if (vs_cons(vm, r[0], VS_NIL, &r[1])) {
    vm->native = NULL;
    vs_fail_with(vm, vm->sym.contract, r[1], "%s: self must satisfy %s%s, got", name, wanted, at);
  }
  vs_mem(vm, name, name_bytes, 0);
  vs_mem(vm, wanted, wanted_bytes, 0);
  return VS_ERROR;
}

/* (%cons-at form head tail): returns a pair (head . tail) with the place of the form. Macros use it for results that
 * may appear in messages. */
vs_status vs_p_cons_at(vs_args *f, vs_value *out) {
  vs_value form = f->arg[0].value;
  vs_pos pos = vs_is_pair(form) ? vs_pair_pos(form) : 0;
  if (!pos) return vs_cons(f->vm, f->arg[1].value, f->arg[2].value, out);
  return vs_cons_at(f->vm, f->arg[1].value, f->arg[2].value, pos, out);
}
/* (%place-of form): returns the place of the form in the source as a number. */
vs_status vs_p_place_of(vs_args *f, vs_value *out) {
  vs_value form = f->arg[0].value;
  *out = vs_fix(vs_is_pair(form) ? (int64_t)vs_pair_pos(form) : 0);
  return VS_OK;
}
