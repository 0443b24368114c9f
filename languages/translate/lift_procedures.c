/* Chooses the local definitions that move to top level ("lifting"), and the additional arguments of such procedures.
 *
 * The translation lifts a local definition if the target cannot express it locally: a solid with a name, a procedure
 * that makes or draws solids, or a procedure that calls itself. Each call of a lifted procedure passes the variables of
 * the surrounding procedures that it uses. These include the variables that it needs for its own calls of lifted
 * procedures. */
#include "languages/translate/lift_procedures.h"

#include "languages/translate/words.h"
#include "model/store/array.h"

enum { MOST_PAIRS = 100000 };

/* Finds the variables that are used within their own value, or before their definition, as recursive procedures are. */
static void find_recursion(translation *t) {
  for (tr_index i = 1; i < t->node_count; i++) {
    if (t->nodes[i].kind != TR_NAME) continue;
    tr_variable *v = &t->variables[t->nodes[i].variable];
    bool called = t->nodes[t->nodes[i].parent].kind == TR_CALL && t->nodes[t->nodes[i].parent].first == i;
    if (!called) v->handed = true;
    if (!v->procedure || v->global || !v->define) continue;
    tr_index body = t->nodes[v->define].parent;
    for (tr_index n = i; n; n = t->nodes[n].parent)
      if (t->nodes[n].parent == body) {
        if (n <= v->define) v->recursive = true;
        break;
      }
  }
}

/* ---- loops ---- */

static tr_index around(const translation *t, tr_index n) {
  for (n = t->nodes[n].parent; n && t->nodes[n].kind != TR_PROCEDURE;) n = t->nodes[n].parent;
  return n;
}

/* Returns true if the value of the node is the value of the surrounding procedure. */
static bool ends(const translation *t, tr_index n) {
  for (; t->nodes[t->nodes[n].parent].kind != TR_PROCEDURE; n = t->nodes[n].parent) {
    const tr_node *p = &t->nodes[t->nodes[n].parent];
    bool last = p->kind == TR_BODY ? p->last == n : p->kind == TR_IF && p->first != n;
    if (!last) return false;
  }
  return true;
}

static bool calls_at_end(const translation *t, tr_index call) {
  tr_index callee = t->nodes[call].first;
  if (t->nodes[call].kind != TR_CALL || t->nodes[callee].kind != TR_NAME) return false;
  tr_index p = t->variables[t->nodes[callee].variable].procedure;
  return p && around(t, call) == p && ends(t, call);
}

bool tr_turns(const translation *t, tr_index call) {
  return calls_at_end(t, call) && t->variables[t->nodes[t->nodes[call].first].variable].loops;
}

/* Finds the procedures that call themselves only at their end. Such a procedure becomes a loop, unless an inner
 * procedure may be used after the iteration that made it. */
static void find_loops(translation *t) {
  for (tr_index i = 1; i < t->node_count; i++)
    if (calls_at_end(t, i)) t->variables[t->nodes[t->nodes[i].first].variable].loops = true;
  for (tr_index i = 1; i < t->node_count; i++) {
    if (t->nodes[i].kind != TR_PROCEDURE) continue;
    for (tr_index p = around(t, i); p; p = around(t, p)) {
      tr_index define = t->nodes[p].parent;
      if (t->nodes[define].kind == TR_DEFINE) t->variables[t->nodes[define].variable].loops = false;
    }
  }
}

static bool boundary(const translation *t, tr_index n) {
  if (t->nodes[n].kind != TR_DEFINE || t->nodes[t->nodes[n].parent].kind == TR_MAP) return false;
  const tr_variable *v = &t->variables[t->nodes[n].variable];
  return v->lifted || (v->global && (v->procedure || v->module));
}

static bool add(translation *t, tr_index define, tr_index variable) {
  for (size_t i = 0; i < t->pair_count; i += 2)
    if (t->pairs[i] == define && t->pairs[i + 1] == variable) return false;
  if (t->pair_count >= MOST_PAIRS) {
    return know_fail(t->k, NULL, VS_OUTCOME_MODEL, "the program's procedures within procedures use too many variables");
  }
  if (!VS_GROW(t->pairs, t->pair_room, t->pair_count + 2)) {
    return know_fail(t->k, NULL, VS_OUTCOME_MACHINE, "out of memory");
  }
  t->pairs[t->pair_count++] = define;
  t->pairs[t->pair_count++] = variable;
  return true;
}

static bool use(translation *t, tr_index node, tr_index variable) {
  bool more = false;
  const tr_variable *v = &t->variables[variable];
  if (v->global || v->lifted || !v->define) return false;
  for (tr_index b = t->nodes[node].procedure; b && b != v->owner && !*t->k->trouble; b = t->nodes[b].procedure)
    more |= add(t, b, variable);
  return more;
}

tr_index tr_besides(const translation *t, tr_index define, uint32_t nth) {
  for (size_t i = 0; i < t->pair_count; i += 2)
    if (t->pairs[i] == define && !nth--) return t->pairs[i + 1];
  return 0;
}

static bool is_module(const translation *t, const tr_variable *v) {
  if (!v->define || t->nodes[v->define].kind != TR_DEFINE || t->nodes[t->nodes[v->define].parent].kind == TR_MAP)
    return false;
  return v->procedure ? v->gives == TR_A_SOLID || v->draws : v->type == TR_A_SOLID;
}

bool tr_lift(translation *t) {
  find_recursion(t);
  find_loops(t);
  for (size_t i = 1; i < t->variable_count; i++) {
    tr_variable *v = &t->variables[i];
    v->module = t->target->lifts == TR_LIFTS_SOLIDS && is_module(t, v);
    v->lifted = !v->global && t->target->lifts &&
        (t->target->lifts == TR_LIFTS_SOLIDS ? v->module || v->recursive : v->procedure != 0);
  }
  for (tr_index i = 1; i < t->node_count; i++) {
    tr_index parent = t->nodes[i].parent;
    t->nodes[i].procedure = boundary(t, parent) ? parent : t->nodes[parent].procedure;
  }
  for (size_t i = 1; i < t->variable_count; i++)
    if (t->variables[i].define) t->variables[i].owner = t->nodes[t->variables[i].define].procedure;
  bool more = t->target->lifts;
  while (more && !*t->k->trouble) {
    more = false;
    for (tr_index i = 1; i < t->node_count && !*t->k->trouble; i++) {
      if (t->nodes[i].kind != TR_NAME) continue;
      tr_index v = t->nodes[i].variable;
      more |= use(t, i, v);
      for (uint32_t nth = 0; t->variables[v].lifted; nth++) {
        tr_index w = tr_besides(t, t->variables[v].define, nth);
        if (!w) break;
        more |= use(t, i, w);
      }
    }
  }
  return !*t->k->trouble;
}
