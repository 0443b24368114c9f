/* Implements environments (environment.h): their tables, chains and imports. */
#include "vm/front/environment.h"
#include "vm/compiler/code.h"
#include "vm/machine/native.h"
#include "vm/values/heap.h"

/* ---- tables of identifiers ---- */
enum { FIRST_ROOM = 4 };

static uint64_t id_hash(vs_value id) {
  uint64_t h =
      vs_is(id, VS_T_SYMBOL) ? vs_as_symbol(id)->hash : vs_as_alias(id)->mark * UINT64_C(0x9E3779B97F4A7C15) >> 32;
  return h;
}

static bool make(vs_scheme *vm, size_t room, vs_value *out) {
  if (!vs_make_vector(vm, 1 + 2 * room, VS_VACANT, out)) return false;
  vs_as_vector(*out)->at[0] = vs_fix(0);
  return true;
}

bool vs_idtable_new(vs_scheme *vm, vs_value *out) { return make(vm, FIRST_ROOM, out); }

int64_t vs_idtable_count(vs_value table) { return vs_fixnum(vs_as_vector(table)->at[0]); }

/* Returns the slot of table t that contains the identifier id, or the free slot where id belongs. The number of slots
 * is a power of two. */
static size_t slot(const vs_vector *t, vs_value id) {
  size_t room = (t->length - 1) / 2, i = (size_t)id_hash(id) & (room - 1);
  VS_ASSERT(room > 0 && (room & (room - 1)) == 0);
  while (t->at[1 + 2 * i] != VS_VACANT && t->at[1 + 2 * i] != id) i = (i + 1) & (room - 1);
  return 1 + 2 * i;
}

vs_value vs_idtable_get(vs_value table, vs_value id) {
  const vs_vector *t = vs_as_vector(table);
  return t->at[slot(t, id) + 1];
}

bool vs_idtable_put(vs_scheme *vm, vs_value *table, vs_value id, vs_value v) {
  vs_vector *t = vs_as_vector(*table);
  size_t room = (t->length - 1) / 2, i = slot(t, id);
  if (t->at[i] == VS_VACANT && (size_t)(vs_idtable_count(*table) + 1) * 4 > room * 3) {
    VS_ROOTS(vm, r, 3);
    r[0] = id; r[1] = v;
    if (!make(vm, 2 * room, &r[2])) return false;
    t = vs_as_vector(*table);
    vs_vector *n = vs_as_vector(r[2]);
    for (size_t k = 1; k < t->length; k += 2) {
      if (t->at[k] == VS_VACANT) continue;
      size_t to = slot(n, t->at[k]);
      vs_gc_store(vm, n, &n->at[to], t->at[k]);
      vs_gc_store(vm, n, &n->at[to + 1], t->at[k + 1]);
    }
    n->at[0] = t->at[0];
    *table = r[2];
    id = r[0]; v = r[1];
    t = n;
    i = slot(t, id);
  }
  if (t->at[i] == VS_VACANT) t->at[0] = vs_fix(vs_fixnum(t->at[0]) + 1);
  vs_gc_store(vm, t, &t->at[i], id);
  vs_gc_store(vm, t, &t->at[i + 1], v);
  return true;
}

bool vs_idtable_slot(vs_value table, size_t i, vs_value *key, vs_value *value) {
  const vs_vector *t = vs_as_vector(table);
  if (1 + 2 * i >= t->length) return false;
  *key = t->at[1 + 2 * i];
  *value = t->at[2 + 2 * i];
  return true;
}

/* ---- identifiers ---- */
vs_value vs_identifier_symbol(vs_value id) {
  VS_ASSERT(vs_is_identifier(id));
  while (vs_is(id, VS_T_ALIAS)) id = vs_as_alias(id)->name;
  return id;
}

bool vs_make_alias(vs_scheme *vm, vs_value name, vs_value env, vs_value *out) {
  VS_ROOTS(vm, r, 2);
  VS_ASSERT(vs_is_identifier(name) && vs_is(env, VS_T_ENVIRONMENT));
  r[0] = name; r[1] = env;
  vs_alias *a = (vs_alias *)(void *)vs_gc_alloc(vm, VS_T_ALIAS, VS_WORDS(vs_alias));
  if (!a) return false;
  a->name = r[0]; a->env = r[1]; a->data = VS_FALSE;
  a->mark = ++vm->aliases;
  *out = vs_from_object(a);
  return true;
}

/* Stack of data that are still to be visited, for replacing aliases (renamed identifiers) by symbols. Most data contain
 * no aliases; a test finds this first. */
typedef struct { vs_scheme *vm; vs_value *at; size_t count, room; struct vs_roots roots; } stack;
static bool push(stack *s, vs_value v) {
  if (s->count == s->room) {
    size_t room = s->room ? 2 * s->room : 64;
    vs_value *at = vs_mem(s->vm, s->at, s->room * sizeof *at, room * sizeof *at);
    if (!at) return false;
    s->at = s->roots.slots = at;
    s->room = room;
  }
  s->at[s->count++] = v;
  s->roots.count = s->count;
  return true;
}

bool vs_datum_any(vs_scheme *vm, vs_value datum, vs_datum_test (*test)(vs_scheme *vm, vs_value v), bool *yes) {
  stack s = {.vm = vm};
  bool ok = push(&s, datum);
  size_t seen = 0, lap = 1;
  vs_value turtle = VS_FALSE;              /* an element visited earlier, compared with the current one to detect a
                                            * cyclic datum (one with labels) */
  *yes = false;
  while (ok && s.count && !*yes) {
    vs_value v = s.at[--s.count];
    vs_datum_test found = test(vm, v);
    if (found == VS_DATUM_YES) *yes = true;
    else if (found == VS_DATUM_NO_MORE) continue;
    else if (vs_is_pair(v)) {
      if (v == turtle) continue;
      if (++seen == lap) { turtle = v; lap *= 2; }
      vs_value a = vs_car(v), d = vs_cdr(v);
      if (vs_is_object(d)) ok = push(&s, d);
      if (ok && vs_is_object(a)) ok = push(&s, a);
    } else if (vs_is_vector(v)) {
      if (v == turtle) continue;
      if (++seen == lap) { turtle = v; lap *= 2; }
      for (size_t i = vs_as_vector(v)->length; ok && i-- > 0;)
        if (vs_is_object(vs_as_vector(v)->at[i])) ok = push(&s, vs_as_vector(v)->at[i]);
    }
  }
  if (s.at) vs_mem(vm, s.at, s.room * sizeof *s.at, 0);
  return ok;
}

/* Tests a datum for aliases (renamed identifiers). An immutable vector comes from the reader, and contains no aliases;
 * vectors of macros are mutable. Skipping immutable vectors saves time for GML programs, whose procedures are nested
 * quotations. */
static vs_datum_test is_alias(vs_scheme *vm, vs_value v) {
  (void)vm;
  if (vs_is(v, VS_T_ALIAS)) return VS_DATUM_YES;
  return vs_is_vector(v) && vs_object_of(v)->flags & VS_F_IMMUTABLE ? VS_DATUM_NO_MORE : VS_DATUM_NO;
}

/* Replaces *v by a copy with the same elements. If *v is an alias, replaces it by its symbol. */
static bool copy_level(vs_scheme *vm, vs_value *v) {
  VS_ROOTS(vm, r, 2);
  r[0] = *v;
  if (vs_is(*v, VS_T_ALIAS)) { *v = vs_identifier_symbol(*v); return true; }
  if (vs_is_pair(*v)) return vs_cons(vm, vs_car(r[0]), vs_cdr(r[0]), v);
  if (!vs_is_vector(*v)) return true;
  if (!vs_make_vector(vm, vs_as_vector(r[0])->length, VS_FALSE, &r[1])) return false;
  for (size_t i = 0; i < vs_as_vector(r[0])->length; i++)
    vs_gc_store(vm, vs_as_vector(r[1]), &vs_as_vector(r[1])->at[i], vs_as_vector(r[0])->at[i]);
  *v = r[1];
  return true;
}

bool vs_strip(vs_scheme *vm, vs_value datum, vs_value *out) {
  if (vs_is(datum, VS_T_ALIAS)) { *out = vs_identifier_symbol(datum); return true; }
  bool any;
  if (!vs_datum_any(vm, datum, is_alias, &any)) return false;
  if (!any) { *out = datum; return true; }
  VS_ROOTS(vm, v, 2);
  v[0] = datum;
  if (!copy_level(vm, &v[0])) return false;
  stack s = {.vm = vm, .roots = {NULL, vm, NULL, 0}};       /* stack of copied objects; their elements are not copied
                                                             * yet */
  vs_gc_link(&s.roots);
  bool ok = push(&s, v[0]);
  while (ok && s.count) {
    v[1] = s.at[--s.count];
    s.roots.count = s.count;
    size_t n = vs_is_pair(v[1]) ? 2 : vs_is_vector(v[1]) ? vs_as_vector(v[1])->length : 0;
    VS_ROOTS(vm, part, 1);
    for (size_t i = 0; ok && i < n; i++) {
      part[0] = vs_is_pair(v[1]) ? (i ? vs_cdr(v[1]) : vs_car(v[1])) : vs_as_vector(v[1])->at[i];
      if (!vs_is(part[0], VS_T_ALIAS) && !vs_is_pair(part[0]) && !vs_is_vector(part[0])) continue;
      ok = copy_level(vm, &part[0]);
      if (!ok) break;
      vs_object *o = vs_object_of(v[1]);
      vs_value *field =
          vs_is_pair(v[1]) ? (i ? &vs_as_pair(v[1])->cdr : &vs_as_pair(v[1])->car) : &vs_as_vector(v[1])->at[i];
      vs_gc_store(vm, o, field, part[0]);
      if (!vs_is(part[0], VS_T_SYMBOL)) ok = push(&s, part[0]);
    }
  }
  vs_gc_unlink(&s.roots);
  if (s.at) vs_mem(vm, s.at, s.room * sizeof *s.at, 0);
  *out = v[0];
  return ok;
}

/* ---- environments and scopes ---- */
enum { SKIP = 16, DEPTH_BITS = 24 };

static int64_t depth_of(vs_value env) {
  return vs_is_top(env) ? 0 : vs_fixnum(vs_as_environment(env)->name) & (((int64_t)1 << DEPTH_BITS) - 1);
}
static int64_t late_bindings(const vs_environment *scope) {
  vs_value count = vs_as_environment(scope->top)->top;
  return vs_is_fixnum(count) ? vs_fixnum(count) : 0;
}
static bool can_skip(const vs_environment *scope) {
  return scope->imports != VS_NIL && vs_fixnum(scope->name) >> DEPTH_BITS == late_bindings(scope);
}

/* Adds to *table the names of the table `from` that *table lacks. The value of each is `scope` or, if `scope` is
 * VACANT, the value in `from`. */
static bool skip_add(vs_scheme *vm, vs_value *table, vs_value from, vs_value scope) {
  VS_ROOTS(vm, r, 4);
  r[0] = from; r[1] = scope;
  for (size_t i = 0; vs_idtable_slot(r[0], i, &r[2], &r[3]); i++)
    if (r[2] != VS_VACANT && vs_idtable_get(*table, r[2]) == VS_VACANT &&
        !vs_idtable_put(vm, table, r[2], r[1] == VS_VACANT ? r[3] : r[1]))
      return false;
  return true;
}

/* Creates the table of the bindings in the scopes around a new scope. By this table a search skips these scopes.
 * `scope` points to a root of the garbage collector. */
static bool skip_make(vs_scheme *vm, const vs_value *scope) {
  VS_ROOTS(vm, r, 2);              /* roots of the garbage collector: a scope around the new scope, the table of
                                    * bindings */
  int64_t depth = depth_of(*scope), span = SKIP;
  while (depth % (span * SKIP) == 0) span *= SKIP;
  if (!vs_idtable_new(vm, &r[1])) return false;
  r[0] = vs_as_environment(*scope)->parent;
  while (!vs_is_top(r[0]) && depth_of(r[0]) > depth - span) {
    if (!skip_add(vm, &r[1], vs_as_environment(r[0])->table, r[0])) return false;
    const vs_environment *e = vs_as_environment(r[0]);
    if (can_skip(e)) {
      if (!skip_add(vm, &r[1], e->imports, VS_VACANT)) return false;
      r[0] = vs_as_environment(r[0])->exports;
    } else {
      r[0] = e->parent;
    }
  }
  vs_environment *s = vs_as_environment(*scope);
  vs_gc_store(vm, s, &s->imports, r[1]);
  vs_gc_store(vm, s, &s->exports, r[0]);
  s->name = vs_fix(late_bindings(s) << DEPTH_BITS | depth);
  return true;
}

static bool environment(vs_scheme *vm, vs_value name, vs_value parent, vs_value data, vs_value *out) {
  VS_ROOTS(vm, r, 4);
  r[0] = name; r[1] = parent; r[2] = data;
  if (!vs_idtable_new(vm, &r[3])) return false;
  vs_environment *e = (vs_environment *)(void *)vs_gc_alloc(vm, VS_T_ENVIRONMENT, VS_WORDS(vs_environment));
  if (!e) return false;
  e->name = r[0]; e->table = r[3]; e->imports = VS_NIL; e->exports = VS_TRUE; e->parent = r[1]; e->data = r[2];
  e->top = r[1] == VS_FALSE || vs_is_top(r[1]) ? r[1] : vs_as_environment(r[1])->top;
  *out = vs_from_object(e);
  return true;
}

bool vs_environment_new(vs_scheme *vm, vs_value name, vs_value *out) {
  return environment(vm, name, VS_FALSE, VS_FALSE, out);
}

bool vs_scope_new(vs_scheme *vm, vs_value parent, int64_t serial, vs_value *out) {
  VS_ROOTS(vm, r, 1);
  int64_t depth = depth_of(parent) + 1;
  if (depth >> DEPTH_BITS) return vs_fail(vm, vm->sym.syntax, "this is nested too deeply");
  if (!vs_is_top(parent)) vs_object_of(parent)->flags |= VS_F_AROUND;
  if (!environment(vm, vs_fix(depth), parent, vs_fix(serial), &r[0]) || (depth % SKIP == 0 && !skip_make(vm, &r[0])))
    return false;
  *out = r[0];
  return true;
}

bool vs_environment_bind(vs_scheme *vm, vs_value env, vs_value id, vs_value binding) {
  VS_ROOTS(vm, r, 2);
  r[0] = env;
  r[1] = vs_as_environment(env)->table;
  if (!vs_is_top(env)) {
    vs_environment *scope = vs_as_environment(env);
    vs_object_of(id)->flags |= VS_F_LOCAL;
    if (scope->h.flags & VS_F_AROUND) vs_as_environment(scope->top)->top = vs_fix(late_bindings(scope) + 1);
  }
  if (!vs_idtable_put(vm, &r[1], id, binding)) return false;
  vs_environment *e = vs_as_environment(r[0]);
  vs_gc_store(vm, e, &e->table, r[1]);
  return true;
}

static bool is_private(vs_value symbol) { return vs_as_symbol(symbol)->name[0] == '%'; }

/* Returns the binding that the library with the environment `env` exports under `name`, or VS_VACANT. Follows imports,
 * since a library may export names that it imports; `depth` limits the recursion. */
static vs_value exported(vs_value env, vs_value name, int depth);

static vs_value imported(vs_value env, vs_value name, int depth) {
  for (vs_value l = vs_as_environment(env)->imports; vs_is_pair(l); l = vs_cdr(l)) {
    vs_value from = vs_car(vs_car(l)), mapping = vs_cdr(vs_car(l)), there = name;
    if (mapping != VS_TRUE) there = vs_idtable_get(mapping, name);
    if (there == VS_VACANT) continue;
    vs_value v = exported(from, there, depth + 1);
    if (v != VS_VACANT) return v;
  }
  return VS_VACANT;
}

static vs_value exported(vs_value env, vs_value name, int depth) {
  const vs_environment *e = vs_as_environment(env);
  if (depth > 64) return VS_VACANT;
  if (e->exports == VS_TRUE) return is_private(name) ? VS_VACANT : vs_idtable_get(e->table, name);
  vs_value inside = vs_idtable_get(e->exports, name);
  if (inside == VS_VACANT) return VS_VACANT;
  vs_value own = vs_idtable_get(e->table, inside);
  return own != VS_VACANT || !vs_is(inside, VS_T_SYMBOL) ? own : imported(env, inside, depth);
}

/* ---- imports ---- */
vs_intake vs_environment_intake(vs_value env) {
  vs_value data = vs_as_environment(env)->data;
  return vs_is_fixnum(data) ? (vs_intake)vs_fixnum(data) : VS_INTAKE_STRICT;
}
void vs_environment_set_intake(vs_value env, vs_intake intake) {
  VS_ASSERT(vs_is_top(env));
  vs_as_environment(env)->data = vs_fix((int64_t)intake);
}
void vs_environment_forget_imports(vs_value env) { vs_as_environment(env)->imports = VS_NIL; }

/* Returns the binding that the environment `from` exports for the local name `name`, or VS_VACANT. The table `mapping`
 * converts local names to names in `from`. */
static vs_value offered(vs_value from, vs_value mapping, vs_value name) {
  vs_value there = mapping == VS_TRUE ? name : vs_idtable_get(mapping, name);
  return there == VS_VACANT ? VS_VACANT : exported(from, there, 0);
}

static bool same_binding(vs_value a, vs_value b) {
  if (a == b) return true;
  if (!vs_is(a, VS_T_CELL) || !vs_is(b, VS_T_CELL)) return false;
  return (vs_object_of(a)->flags & vs_object_of(b)->flags & VS_F_CONSTANT) &&
         vs_as_cell(a)->value == vs_as_cell(b)->value;
}

/* Returns a name for which the import of `from` and an earlier import of env have different bindings, or VS_VACANT. The
 * import of the whole library of the language is not counted, because any other binding replaces it. */
static vs_value find_clash(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping) {
  const vs_environment *e = vs_as_environment(env);
  vs_value names = mapping != VS_TRUE                            ? mapping
                   : vs_as_environment(from)->exports != VS_TRUE ? vs_as_environment(from)->exports
                                                                 : vs_as_environment(from)->table;
  vs_value key, value;
  if (e->imports == VS_NIL) return VS_VACANT;
  for (size_t i = 0; vs_idtable_slot(names, i, &key, &value); i++) {
    if (key == VS_VACANT || !vs_is_symbol(key) || is_private(key)) continue;
    vs_value before = VS_VACANT, now;
    for (vs_value l = e->imports; before == VS_VACANT && vs_is_pair(l); l = vs_cdr(l))
      if (vs_car(vs_car(l)) != vm->at.core) before = offered(vs_car(vs_car(l)), vs_cdr(vs_car(l)), key);
    if (before != VS_VACANT && (now = offered(from, mapping, key)) != VS_VACANT && !same_binding(before, now))
      return key;
  }
  return VS_VACANT;
}

/* Adapts the cells (variables) of env to an import: a cell without a definition gets the imported value. If env itself
 * defines an imported name, *clash becomes this name. look: only searches for such a name. */
static void settle(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping, bool look, vs_value *clash) {
  vs_vector *table = vs_as_vector(vs_as_environment(env)->table);
  vs_intake intake = vs_environment_intake(env);
  for (size_t i = 1; i < table->length; i += 2) {
    vs_value cell = table->at[i + 1];
    if (table->at[i] == VS_VACANT || !vs_is_symbol(table->at[i])) continue;
    vs_value found = offered(from, mapping, table->at[i]);
    if (found == VS_VACANT || found == cell) continue;
    bool undefined = vs_is(cell, VS_T_CELL) && vs_as_cell(cell)->value == VS_UNDEFINED;
    bool constant = vs_is(cell, VS_T_CELL) && vs_object_of(cell)->flags & VS_F_CONSTANT;
    if (!undefined && !constant) {
      if (intake != VS_INTAKE_PROMPT && vs_idtable_get(vs_as_environment(vm->at.core)->table, table->at[i]) == found)
        continue;
      if (intake != VS_INTAKE_PROMPT) { if (*clash == VS_VACANT) *clash = table->at[i]; continue; }
    }
    if (look || (constant && vs_is(found, VS_T_CELL) && vs_as_cell(cell)->value == vs_as_cell(found)->value)) continue;
    if (constant) vs_cell_redefine(cell);
    if (vs_is(cell, VS_T_CELL) && vs_is(found, VS_T_CELL))
      vs_gc_store(vm, vs_as_cell(cell), &vs_as_cell(cell)->value, vs_as_cell(found)->value);
    else vs_gc_store(vm, table, &table->at[i + 1], found);
  }
}

bool vs_environment_import(vs_scheme *vm, vs_value env, vs_value from, vs_value mapping, vs_value *clash, bool *own) {
  bool whole = from == vm->at.core && mapping == VS_TRUE;
  VS_ROOTS(vm, r, 4);
  VS_ASSERT(vs_is_top(env) && vs_is_top(from));
  r[0] = env; r[1] = from; r[2] = mapping;
  *clash = VS_VACANT;
  *own = false;
  vs_value last = VS_NIL;
  for (vs_value l = vs_as_environment(env)->imports; vs_is_pair(l); l = vs_cdr(l)) {
    if (mapping == VS_TRUE && vs_car(vs_car(l)) == from && vs_cdr(vs_car(l)) == VS_TRUE &&
        (whole || l == vs_as_environment(env)->imports))
      return true;
    last = l;                                   /* afterwards, `last` is the last pair of the list */
  }
  if (vs_environment_intake(env) == VS_INTAKE_STRICT && !whole) *clash = find_clash(vm, env, from, mapping);
  if (*clash == VS_VACANT && !whole) { settle(vm, env, from, mapping, true, clash); *own = *clash != VS_VACANT; }
  if (*clash != VS_VACANT) return true;
  if (!vs_cons(vm, r[1], r[2], &r[3]) || !vs_cons(vm, r[3], whole ? VS_NIL : vs_as_environment(r[0])->imports, &r[3]))
    return false;
  vs_environment *e = vs_as_environment(r[0]);
  if (!whole || last == VS_NIL) vs_gc_store(vm, e, &e->imports, r[3]);
  else {                                        /* adds the import at the end of the list of imports */
    for (last = e->imports; vs_is_pair(vs_cdr(last));) last = vs_cdr(last);
    vs_gc_store(vm, vs_as_pair(last), &vs_as_pair(last)->cdr, r[3]);
  }
  settle(vm, r[0], r[1], r[2], false, clash);
  *clash = VS_VACANT;
  return true;
}

vs_meaning vs_environment_find(vs_value env, vs_value id) {
  for (;;) {
    vs_value own = VS_VACANT;
    /* Most names of a program have no local binding in any scope, so that their search skips all scopes. */
    if (!vs_is_top(env) && !(vs_object_of(id)->flags & VS_F_LOCAL)) env = vs_as_environment(env)->top;
    while (!vs_is_top(env)) {
      const vs_environment *e = vs_as_environment(env);
      own = vs_idtable_get(e->table, id);
      if (own != VS_VACANT) break;
      if (!can_skip(e)) { env = e->parent; continue; }
      vs_value far = vs_idtable_get(e->imports, id);
      if (far != VS_VACANT) { env = far; own = vs_idtable_get(vs_as_environment(far)->table, id); break; }
      env = e->exports;
    }
    if (own == VS_VACANT) own = vs_idtable_get(vs_as_environment(env)->table, id);
    if (own != VS_VACANT) {
      vs_meaning m = { vs_is(own, VS_T_MACRO)  ? VS_MEANS_MACRO
                       : vs_is(own, VS_T_CELL) ? VS_MEANS_CELL
                                               : VS_MEANS_LOCAL,
                       own, env, id, false };
      return m;
    }
    if (vs_is(id, VS_T_SYMBOL)) break;
    env = vs_as_alias(id)->env;
    id = vs_as_alias(id)->name;
  }
  vs_value v = imported(env, id, 0);
  vs_meaning m = { v == VS_VACANT         ? VS_MEANS_NOTHING
                   : vs_is(v, VS_T_MACRO) ? VS_MEANS_MACRO
                                          : VS_MEANS_CELL,
                   v, env, id, v != VS_VACANT };
  return m;
}

/* Returns true if identifier a in env_a and identifier b in env_b refer to the same binding. Two programs' copies of an
 * imported constant count as the same binding if their names are equal. */
bool vs_same_meaning(vs_value env_a, vs_value a, vs_value env_b, vs_value b) {
  vs_meaning m = vs_environment_find(env_a, a), n = vs_environment_find(env_b, b);
  if (m.kind != n.kind) return false;
  if (m.kind == VS_MEANS_NOTHING) return m.id == n.id;
  if (m.value == n.value) return m.kind != VS_MEANS_LOCAL || m.env == n.env;
  if (m.kind != VS_MEANS_CELL) return false;
  const vs_cell *c = vs_as_cell(m.value), *d = vs_as_cell(n.value);
  return (c->h.flags & d->h.flags & VS_F_CONSTANT) && c->name == d->name && c->value == d->value;
}

bool vs_environment_cell(vs_scheme *vm, const vs_meaning *m, vs_value *cell) {
  VS_ROOTS(vm, r, 3);
  VS_ASSERT(m->kind != VS_MEANS_LOCAL);
  if (m->kind == VS_MEANS_CELL && (!m->foreign || !(vs_as_cell(m->value)->h.flags & VS_F_CONSTANT))) {
    *cell = m->value;
    return true;
  }
  r[0] = m->env; r[1] = m->id;
  vs_value value = m->kind == VS_MEANS_CELL ? vs_as_cell(m->value)->value : VS_UNDEFINED;
  if (!vs_make_cell(vm, vs_identifier_symbol(m->id), value, &r[2])) return false;
  if (m->kind == VS_MEANS_CELL) vs_object_of(r[2])->flags |= VS_F_CONSTANT;
  if (!vs_environment_bind(vm, r[0], r[1], r[2])) return false;
  *cell = r[2];        /* sets *cell only now, since binding may move the cell */
  return true;
}

bool vs_environment_define(vs_scheme *vm, vs_value env, vs_value id, vs_value *cell) {
  VS_ROOTS(vm, r, 3);
  VS_ASSERT(vs_is_top(env));
  r[0] = env; r[1] = id;
  vs_value own = vs_idtable_get(vs_as_environment(env)->table, id);
  if (own != VS_VACANT && vs_is(own, VS_T_CELL)) {
    *cell = r[2] = own;
    if (vs_object_of(own)->flags & VS_F_CONSTANT) vs_cell_redefine(own);
    return true;
  }
  /* A new definition may use the imported value: (define sqrt (traced sqrt)). */
  vs_meaning m = vs_environment_find(env, id);
  vs_value before =
      own == VS_VACANT && m.foreign && m.kind == VS_MEANS_CELL ? vs_as_cell(m.value)->value : VS_UNDEFINED;
  if (!vs_make_cell(vm, vs_identifier_symbol(id), before, &r[2])) return false;
  if (!vs_environment_bind(vm, r[0], r[1], r[2])) return false;
  *cell = r[2];        /* sets *cell only now, since binding may move the cell */
  return true;
}

vs_value vs_environment_value(vs_value env, vs_value symbol) {
  vs_meaning m = vs_environment_find(env, symbol);
  return m.kind == VS_MEANS_CELL ? vs_as_cell(m.value)->value : VS_UNDEFINED;
}

static bool each_own(vs_value env, vs_value shown, bool (*each)(void *, vs_value, vs_value), void *context) {
  vs_value key, value;
  for (size_t i = 0; vs_idtable_slot(vs_as_environment(env)->table, i, &key, &value); i++) {
    if (key == VS_VACANT || !vs_is(key, VS_T_SYMBOL) || is_private(key)) continue;
    if (vs_is(value, VS_T_CELL) && vs_as_cell(value)->value == VS_UNDEFINED) continue;
    /* the name was already passed to the callback */
    if (shown != VS_VACANT && vs_idtable_get(shown, key) != VS_VACANT) continue;
    if (!each(context, key, value)) return false;
  }
  return true;
}

bool vs_environment_each(vs_value env, bool (*each)(void *, vs_value, vs_value), void *context) {
  vs_value own = vs_as_environment(env)->table;
  if (!each_own(env, VS_VACANT, each, context)) return false;
  for (vs_value l = vs_as_environment(env)->imports; vs_is_pair(l); l = vs_cdr(l)) {
    vs_value from = vs_car(vs_car(l)), mapping = vs_cdr(vs_car(l)), key, value;
    if (mapping == VS_TRUE && vs_as_environment(from)->exports == VS_TRUE) {
      if (!each_own(from, own, each, context)) return false;
      continue;
    }
    vs_value names = mapping == VS_TRUE ? vs_as_environment(from)->exports : mapping;
    for (size_t i = 0; vs_idtable_slot(names, i, &key, &value); i++) {
      if (key == VS_VACANT || vs_idtable_get(own, key) != VS_VACANT) continue;
      vs_value binding = exported(from, mapping == VS_TRUE ? key : value, 0);
      if (binding != VS_VACANT && !each(context, key, binding)) return false;
    }
  }
  return true;
}

void vs_environment_seal(vs_value env) {
  vs_value key, value;
  VS_ASSERT(vs_is_top(env));
  for (size_t i = 0; vs_idtable_slot(vs_as_environment(env)->table, i, &key, &value); i++)
    if (key != VS_VACANT && vs_is(value, VS_T_CELL) && vs_as_cell(value)->value != VS_UNDEFINED &&
        !(vs_object_of(value)->flags & VS_F_ASSIGNED))
      vs_object_of(value)->flags |= VS_F_CONSTANT;
}
