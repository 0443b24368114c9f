/* Finds the scopes of a script in two walks over its tree. The first walk collects declarations, the second walk
 * assignments and jumps.
 *
 * The walks recurse, since the height of the tree is limited. */
#include "vm/javascript/script_scopes.h"

#include "model/assert.h"

#include <string.h>

typedef struct jump_target {
  struct jump_target *up;
  uint32_t node, label;
  unsigned depth;
} jump_target;

typedef struct {
  vs_scopes *k;
  vs_script *s;
  uint32_t scope;
  jump_target *jump_targets;
} walker;

enum { NO_JUMP = 1u << 30 };

static uint32_t hash(uint32_t scope, uint32_t name) {
  uint32_t h = scope * 2654435761u ^ name * 2246822519u;
  return h ^ h >> 15;
}

static uint32_t bound(const vs_scopes *k, uint32_t scope, uint32_t name) {
  if (!k->slots) return 0;
  for (size_t at = hash(scope, name) & (k->slots - 1); k->table[at]; at = (at + 1) & (k->slots - 1)) {
    const vs_variable *v = &k->variables[k->table[at]];
    if (v->scope == scope && v->name == name) return k->table[at];
  }
  return 0;
}

uint32_t vs_scopes_resolve(const vs_scopes *k, uint32_t scope, uint32_t name) {
  VS_ASSERT(scope < k->scope_count);
  for (; scope; scope = k->scopes[scope].parent) {
    uint32_t v = bound(k, scope, name);
    if (v) return v;
  }
  return 0;
}

static bool table_grow(vs_scopes *k) {
  if (2 * (k->variable_count + 1) < k->slots) return true;
  size_t more = k->slots ? 2 * k->slots : 128;
  uint32_t *fresh = k->s->resize(k->s->context, NULL, 0, more * sizeof *fresh);
  if (!fresh) return k->s->no_memory = true, false;
  memset(fresh, 0, more * sizeof *fresh);
  for (size_t i = 0; i < k->slots; i++) {
    if (!k->table[i]) continue;
    const vs_variable *v = &k->variables[k->table[i]];
    size_t at = hash(v->scope, v->name) & (more - 1);
    while (fresh[at]) at = (at + 1) & (more - 1);
    fresh[at] = k->table[i];
  }
  if (k->table) k->s->resize(k->s->context, k->table, k->slots * sizeof *k->table, 0);
  k->table = fresh, k->slots = more;
  return true;
}

/* Declares a variable in the scope. If the scope already has it, marks it as assigned. */
static bool declare(walker *w, uint32_t scope, uint32_t name, vs_variable_kind kind, uint32_t declaration) {
  vs_scopes *k = w->k;
  uint32_t known = bound(k, scope, name);
  if (known) {
    vs_variable *v = &k->variables[known];
    if (kind != VS_VARIABLE_FUNCTION) return true;
    v->assigned = true;
    v->declaration = declaration; /* the last of several function declarations with one name is valid */
    if (v->kind == VS_VARIABLE_VAR) v->kind = VS_VARIABLE_FUNCTION;
    return true;
  }
  if (!table_grow(k) ||
      !vs_script_room(w->s, &k->variables, &k->variable_room, k->variable_count + 1, sizeof *k->variables))
    return false;
  uint32_t i = (uint32_t)k->variable_count++;
  k->variables[i] = (vs_variable){ .scope = scope, .name = name, .kind = (uint8_t)kind, .declaration = declaration };
  size_t at = hash(scope, name) & (k->slots - 1);
  while (k->table[at]) at = (at + 1) & (k->slots - 1);
  k->table[at] = i;
  vs_scope_of_script *o = &k->scopes[scope];
  if (o->last)
    k->variables[o->last].next = i;
  else
    o->first = i;
  o->last = i;
  return true;
}

static bool new_scope(walker *w, uint32_t parent, uint32_t node, uint32_t *out) {
  vs_scopes *k = w->k;
  if (!vs_script_room(w->s, &k->scopes, &k->scope_room, k->scope_count + 1, sizeof *k->scopes)) return false;
  *out = (uint32_t)k->scope_count++;
  k->scopes[*out] = (vs_scope_of_script){ .parent = parent, .node = node };
  return true;
}

static const vs_script_node *node(const walker *w, uint32_t i) { return vs_script_at(w->s, i); }

/* Returns the scope of the enclosing function, in which var and function declarations are visible. */
static uint32_t function_scope(const walker *w) {
  uint32_t at = w->scope;
  while (at > 1 && node(w, w->k->scopes[at].node)->kind != VS_SCRIPT_FUNCTION) at = w->k->scopes[at].parent;
  return at;
}

/* ---- the first walk: declarations ---- */

static bool declare_in(walker *w, uint32_t i);

static bool declare_list(walker *w, uint32_t i) {
  for (; i; i = node(w, i)->next)
    if (!declare_in(w, i)) return false;
  return true;
}

static bool declare_function(walker *w, uint32_t i) {
  const vs_script_node *n = node(w, i);
  uint32_t outer = w->scope, own;
  if (n->c && n->flag) {
    if (!declare(w, function_scope(w), node(w, n->c)->name, VS_VARIABLE_FUNCTION, i)) return false;
  } else if (n->c) {
    if (!new_scope(w, w->scope, 0, &own) || !declare(w, own, node(w, n->c)->name, VS_VARIABLE_SELF, i)) return false;
    w->scope = own;
  }
  if (!new_scope(w, w->scope, i, &own)) return false;
  w->k->targets[i] = own;
  w->scope = own;
  for (uint32_t p = n->a; p; p = node(w, p)->next)
    if (!declare(w, own, node(w, p)->name, VS_VARIABLE_PARAMETER, 0)) return false;
  bool ok = declare_list(w, n->b);
  w->scope = outer;
  return ok;
}

static bool declare_in(walker *w, uint32_t i) {
  if (!i) return true;
  const vs_script_node *n = node(w, i);
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_FUNCTION: return declare_function(w, i);
  case VS_SCRIPT_THIS: w->k->scopes[function_scope(w)].uses_this = true; return true;
  case VS_SCRIPT_NAME:
    if (vs_script_is(w->s, n->name, "arguments")) w->k->scopes[function_scope(w)].uses_arguments = true;
    return true;
  case VS_SCRIPT_DECLARATOR:
    return declare(w, function_scope(w), node(w, n->a)->name, VS_VARIABLE_VAR, 0) && declare_in(w, n->b);
  case VS_SCRIPT_TRY: {
    if (!declare_in(w, n->a)) return false;
    uint32_t own, outer = w->scope;
    if (n->c) {
      if (!new_scope(w, w->scope, 0, &own)) return false;
      w->k->targets[i] = own;
      if (!declare(w, own, node(w, n->b)->name, VS_VARIABLE_CATCH, 0)) return false;
      w->scope = own;
      if (!declare_in(w, n->c)) return false;
      w->scope = outer;
    }
    return declare_in(w, n->d);
  }
  case VS_SCRIPT_MEMBER: return declare_in(w, n->a);
  case VS_SCRIPT_PROPERTY: return declare_in(w, n->b);
  case VS_SCRIPT_ARRAY:
  case VS_SCRIPT_OBJECT:
  case VS_SCRIPT_PROGRAM:
  case VS_SCRIPT_BLOCK:
  case VS_SCRIPT_VAR: return declare_list(w, n->a);
  case VS_SCRIPT_CALL:
  case VS_SCRIPT_NEW:
  case VS_SCRIPT_SWITCH:
  case VS_SCRIPT_CASE: return declare_in(w, n->a) && declare_list(w, n->b);
  case VS_SCRIPT_LABEL: return declare_in(w, n->b);
  case VS_SCRIPT_CONTINUE:
  case VS_SCRIPT_BREAK: return true;
  /* Native text (Scheme inside a script) may refer to any variable, including `this`. */
  case VS_SCRIPT_NATIVE: w->k->scopes[function_scope(w)].uses_this = true; return true;
  default: return declare_in(w, n->a) && declare_in(w, n->b) && declare_in(w, n->c) && declare_in(w, n->d);
  }
}

/* ---- the second walk: assignments and jumps. *least becomes the smallest number of a target to which the node jumps
 * (0: the end of the function) ---- */

static bool follow(walker *w, uint32_t i, unsigned *least);

static bool follow_list(walker *w, uint32_t i, unsigned *least) {
  for (; i; i = node(w, i)->next)
    if (!follow(w, i, least)) return false;
  return true;
}

static bool assign(walker *w, uint32_t target) {
  const vs_script_node *n = node(w, target);
  if (n->kind != VS_SCRIPT_NAME) return true;
  uint32_t v = vs_scopes_resolve(w->k, w->scope, n->name);
  if (v) return w->k->variables[v].assigned = true;
  return declare(w, 1, n->name, VS_VARIABLE_UNDECLARED, 0);
}

static bool is_loop(vs_script_kind kind) {
  return kind == VS_SCRIPT_FOR || kind == VS_SCRIPT_FOR_IN || kind == VS_SCRIPT_WHILE || kind == VS_SCRIPT_DO;
}

/* Returns the loop or other statement that follows the labels of node i. */
static uint32_t labelled(const walker *w, uint32_t i) {
  while (node(w, i)->kind == VS_SCRIPT_LABEL) i = node(w, i)->b;
  return i;
}

static bool jump(walker *w, uint32_t i, unsigned *least) {
  const vs_script_node *n = node(w, i);
  bool again = n->kind == VS_SCRIPT_CONTINUE;
  jump_target *t = w->jump_targets;
  for (; t; t = t->up) {
    vs_script_kind kind = (vs_script_kind)node(w, t->node)->kind;
    if (n->a) {
      if (kind == VS_SCRIPT_LABEL && t->label == node(w, n->a)->name) break;
    } else if (is_loop(kind) || (kind == VS_SCRIPT_SWITCH && !again))
      break;
  }
  if (!t) {
    size_t length;
    const char *text = n->a ? vs_script_spelling(w->s, node(w, n->a)->name, &length) : "";
    return n->a ? vs_script_fail(w->s, node(w, n->a)->at, "no statement around here has the label %.*s", (int)length,
                                 text)
                : vs_script_fail(w->s, n->at, "this is not inside a loop of its function");
  }
  uint32_t to = t->node;
  if (again) {
    to = labelled(w, to);
    if (!is_loop((vs_script_kind)node(w, to)->kind))
      return vs_script_fail(w->s, node(w, n->a)->at,
                            "continue needs the label of a loop, and this label names another statement");
    while (t->node != to) { /* goes inwards from the label's target to the loop that the label names */
      jump_target *inner = w->jump_targets;
      while (inner->up != t) inner = inner->up;
      t = inner;
    }
  }
  w->k->targets[i] = to;
  w->k->facts[to] |= again ? VS_CONTINUED : VS_BROKEN;
  w->k->facts[i] |= VS_STAYS | VS_JUMPS_OUT;
  if (t->depth < *least) *least = t->depth;
  return true;
}

static bool stays(const walker *w, uint32_t i) { return i && w->k->facts[i] & VS_STAYS; }

static bool stays_list(const walker *w, uint32_t i) {
  for (; i; i = node(w, i)->next)
    if (stays(w, i)) return true;
  return false;
}

static bool follow_parts(walker *w, uint32_t i, unsigned *least) {
  const vs_script_node *n = node(w, i);
  vs_scopes *k = w->k;
  uint32_t outer = w->scope;
  switch ((vs_script_kind)n->kind) {
  case VS_SCRIPT_FUNCTION: {
    jump_target *was = w->jump_targets;
    unsigned none = NO_JUMP;
    w->jump_targets = NULL;
    w->scope = k->targets[i];
    bool ok = follow_list(w, n->b, &none);
    w->scope = outer;
    w->jump_targets = was;
    return ok;
  }
  case VS_SCRIPT_ASSIGN:
  case VS_SCRIPT_UPDATE:
    if (!assign(w, n->a)) return false;
    break;
  case VS_SCRIPT_DECLARATOR:
    if (n->b && !assign(w, n->a)) return false;
    return follow(w, n->b, least);
  case VS_SCRIPT_FOR_IN:
    if (!assign(w, node(w, n->a)->kind == VS_SCRIPT_VAR ? node(w, node(w, n->a)->a)->a : n->a)) return false;
    break;
  case VS_SCRIPT_TRY:
    if (!follow(w, n->a, least)) return false;
    w->scope = n->c ? k->targets[i] : outer;
    if (!follow(w, n->c, least)) return false;
    w->scope = outer;
    if (!follow(w, n->d, least)) return false;
    if (stays(w, n->d) || (stays(w, n->a) && (!n->c || stays(w, n->c)))) k->facts[i] |= VS_STAYS;
    return true;
  case VS_SCRIPT_ARRAY:
  case VS_SCRIPT_OBJECT:
  case VS_SCRIPT_PROGRAM:
  case VS_SCRIPT_VAR: return follow_list(w, n->a, least);
  case VS_SCRIPT_BLOCK:
    if (!follow_list(w, n->a, least)) return false;
    if (stays_list(w, n->a)) k->facts[i] |= VS_STAYS;
    return true;
  case VS_SCRIPT_CALL:
  case VS_SCRIPT_NEW:
  case VS_SCRIPT_SWITCH:
  case VS_SCRIPT_CASE: return follow(w, n->a, least) && follow_list(w, n->b, least);
  case VS_SCRIPT_MEMBER: return follow(w, n->a, least);
  case VS_SCRIPT_PROPERTY: return follow(w, n->b, least);
  case VS_SCRIPT_LABEL:
    if (!follow(w, n->b, least)) return false;
    if (stays(w, n->b) && !(k->facts[i] & VS_BROKEN)) k->facts[i] |= VS_STAYS;
    return true;
  case VS_SCRIPT_CONTINUE:
  case VS_SCRIPT_BREAK: return jump(w, i, least);
  case VS_SCRIPT_RETURN:
    *least = 0;
    k->facts[i] |= VS_STAYS | VS_JUMPS_OUT;
    return follow(w, n->a, least);
  case VS_SCRIPT_THROW: k->facts[i] |= VS_STAYS; return follow(w, n->a, least);
  case VS_SCRIPT_IF:
    if (!follow(w, n->a, least) || !follow(w, n->b, least) || !follow(w, n->c, least)) return false;
    if (stays(w, n->b) && stays(w, n->c)) k->facts[i] |= VS_STAYS;
    return true;
  default: break;
  }
  return follow(w, n->a, least) && follow(w, n->b, least) && follow(w, n->c, least) && follow(w, n->d, least);
}

/* Walks over node i. Possible targets of jumps are numbered from the outside in; the end of the function is number 0.
 * *least becomes the smallest number of a target to which the node jumps. */
static bool follow(walker *w, uint32_t i, unsigned *least) {
  if (!i) return true;
  const vs_script_node *n = node(w, i);
  vs_script_kind kind = (vs_script_kind)n->kind;
  unsigned mine = NO_JUMP, around = w->jump_targets ? w->jump_targets->depth : 0;
  jump_target t = { w->jump_targets, i, kind == VS_SCRIPT_LABEL ? node(w, n->a)->name : 0, around + 1 };
  bool target = is_loop(kind) || kind == VS_SCRIPT_SWITCH || kind == VS_SCRIPT_LABEL;
  if (target) w->jump_targets = &t;
  bool ok = follow_parts(w, i, &mine);
  w->jump_targets = t.up;
  if (!ok) return false;
  if (mine <= around) w->k->facts[i] |= VS_JUMPS_OUT;
  if (mine < *least) *least = mine;
  return true;
}

bool vs_scopes_find(vs_scopes *k, vs_script *s) {
  *k = (vs_scopes){ .s = s, .room = s->node_count, .variable_count = 1, .scope_count = 1 };
  walker w = { .k = k, .s = s };
  uint32_t program;
  unsigned none = NO_JUMP;
  k->facts = s->resize(s->context, NULL, 0, k->room);
  k->targets = s->resize(s->context, NULL, 0, k->room * sizeof *k->targets);
  if (!k->facts || !k->targets) return s->no_memory = true, false;
  memset(k->facts, 0, k->room);
  memset(k->targets, 0, k->room * sizeof *k->targets);
  if (!vs_script_room(s, &k->variables, &k->variable_room, 1, sizeof *k->variables) ||
      !vs_script_room(s, &k->scopes, &k->scope_room, 1, sizeof *k->scopes) || !new_scope(&w, 0, s->root, &program))
    return false;
  k->variables[0] = (vs_variable){ 0 };
  k->scopes[0] = (vs_scope_of_script){ 0 };
  w.scope = program;
  return declare_in(&w, s->root) && follow(&w, s->root, &none);
}

void vs_scopes_close(vs_scopes *k) {
  vs_script *s = k->s;
  struct {
    void *at;
    size_t bytes;
  } all[] = { { k->variables, k->variable_room * sizeof *k->variables },
              { k->scopes, k->scope_room * sizeof *k->scopes },
              { k->table, k->slots * sizeof *k->table },
              { k->facts, k->facts ? k->room : 0 },
              { k->targets, k->targets ? k->room * sizeof *k->targets : 0 } };
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (all[i].at) s->resize(s->context, all[i].at, all[i].bytes, 0);
}
