/* Implements the boolean expression (expression.h): flattens it, and evaluates it incrementally. The functions do not
 * recurse, because operands come before the terms that use them. */
#include "kernel/expression.h"

/* Working memory of vs_expression_build. */
typedef struct {
  VS_LIST(uint32_t) uses;   /* uses[t]: number of terms that have t as an operand */
  VS_LIST(uint32_t) pairs;  /* pairs of numbers: the number of an operand, then 2 * user + 1 if the term `user`
                             * subtracts it, else 2 * user */
  VS_LIST(uint32_t) stack;  /* stack of operands still to be examined: 2 * term + 1 if the term is subtracted, else 2 *
                             * term */
  VS_LIST(uint8_t) live;    /* live[t]: 1 if operands lead from the root to term t, and t was not merged into the term
                             * that has it as an operand */
} building;

/* Returns true if the term `inner` can be merged into a term of kind `outer` that has it as an operand: that term then
 * gets the operands of `inner` instead. `off`: true if that term subtracts `inner`. */
static bool absorbed(const vs_kernel_problem *p, const building *b, vs_term_kind outer, bool off, uint32_t inner) {
  vs_term_kind kind = p->terms[inner].kind;
  if (b->uses.at[inner] != 1) return false;
  if (outer == VS_TERM_UNION || (outer == VS_TERM_DIFFERENCE && off)) return kind == VS_TERM_UNION;
  return kind == outer; /* an intersection is merged into an intersection, and a difference into a difference of which
                         * it is the first operand */
}

static bool collect(vs_kernel *k, const vs_kernel_problem *p, building *b, vs_expression *e, uint32_t user) {
  const vs_kernel_term *t = &p->terms[user];
  b->stack.count = 0;
  for (uint32_t i = t->count; i-- > 0;)
    if (!VS_PUSH(k, b->stack, p->operands[t->first + i] * 2 + (t->kind == VS_TERM_DIFFERENCE && i > 0))) return false;
  while (b->stack.count) {
    uint32_t top = b->stack.at[--b->stack.count], inner = top / 2;
    bool off = top & 1;
    if (absorbed(p, b, t->kind, off, inner)) {
      const vs_kernel_term *s = &p->terms[inner];
      for (uint32_t i = s->count; i-- > 0;)
        if (!VS_PUSH(k, b->stack, p->operands[s->first + i] * 2 + (off || (s->kind == VS_TERM_DIFFERENCE && i > 0))))
          return false;
      if (s->kind == VS_TERM_INTERSECTION && s->count == 0) e->need.at[user] = UINT32_MAX; /* an intersection without
                                                                                            * operands is the empty
                                                                                            * solid, so it is never
                                                                                            * true */
      continue;
    }
    b->live.at[inner] = 1;
    if (!off && e->need.at[user] != UINT32_MAX) e->need.at[user]++;
    if (!VS_PUSH(k, b->pairs, inner) || !VS_PUSH(k, b->pairs, user * 2 + off)) return false;
  }
  return true;
}

/* Finds the leaves and terms that alone determine the result: a true operand of a union at the root, or a false
 * operand of an intersection at the root. Operands of such operands count, too. A leaf that is the only term is not
 * included. */
static bool find_forces(vs_kernel *k, vs_expression *e, const vs_kernel_problem *p, const uint8_t *live) {
  enum { IF_TRUE = 1, IF_FALSE = 2 };
  VS_LIST(uint8_t) flag = { 0 };
  uint32_t n = p->term_count, root = n;
  e->gate_count = 0;
  if (!VS_ROOM(k, e->forces.at, e->forces.room, (size_t)p->leaf_count + 1) ||
      !VS_ROOM(k, flag.at, flag.room, (size_t)n + 1))
    return false;
  for (uint32_t i = 0; i < p->leaf_count; i++) e->forces.at[i] = 0;
  for (uint32_t i = 0; i < n; i++) flag.at[i] = i + 1 == n ? IF_TRUE | IF_FALSE : 0;
  while (root && p->terms[root - 1].kind != VS_TERM_LEAF && p->terms[root - 1].count == 1)
    root = p->operands[p->terms[root - 1].first] + 1;
  if (root && p->terms[root - 1].kind != VS_TERM_LEAF) {
    e->forced = p->terms[root - 1].kind == VS_TERM_UNION;
    for (uint32_t i = 0; i < n; i++) flag.at[i] = i + 1 == root ? IF_TRUE | IF_FALSE : 0;
    for (uint32_t i = root; i-- > 0;) {
      const vs_kernel_term *t = &p->terms[i];
      if (t->kind == VS_TERM_LEAF) {
        if (flag.at[i] & IF_TRUE) e->forces.at[t->first] = 1;
      } else {
        for (uint32_t j = 0; j < t->count; j++) {
          uint8_t up = flag.at[i], *down = &flag.at[p->operands[t->first + j]];
          if (t->kind == VS_TERM_DIFFERENCE && j > 0) *down |= up & IF_FALSE ? IF_TRUE : 0;
          else *down |= t->count == 1 ? up : up & (t->kind == VS_TERM_UNION ? IF_TRUE : IF_FALSE);
        }
      }
      if (i + 1 < root && (flag.at[i] & IF_FALSE) && live[i] && e->gate_count < VS_GATES) e->gates[e->gate_count++] = i;
    }
  }
  VS_DROP(k, flag);
  return true;
}

bool vs_expression_build(vs_kernel *k, vs_expression *e, const vs_kernel_problem *p) {
  building b = { 0 };
  uint32_t n = p->term_count;
  bool ok = VS_ROOM(k, e->kind.at, e->kind.room, (size_t)n + 1) &&
            VS_ROOM(k, e->need.at, e->need.room, (size_t)n + 1) &&
            VS_ROOM(k, e->positive.at, e->positive.room, (size_t)n + 1) &&
            VS_ROOM(k, e->negative.at, e->negative.room, (size_t)n + 1) &&
            VS_ROOM(k, e->user_first.at, e->user_first.room, (size_t)n + 2) &&
            VS_ROOM(k, b.uses.at, b.uses.room, (size_t)n + 1) && VS_ROOM(k, b.live.at, b.live.room, (size_t)n + 1) &&
            VS_ROOM(k, e->winding.at, e->winding.room, (size_t)p->leaf_count + 1) &&
            VS_ROOM(k, e->leaf_first.at, e->leaf_first.room, (size_t)p->leaf_count + 2) &&
            VS_ROOM(k, e->leaf_terms.at, e->leaf_terms.room, (size_t)n + 1) &&
            VS_ROOM(k, e->taken_off.at, e->taken_off.room, (size_t)p->leaf_count + 1) &&
            VS_ROOM(k, e->waits.at, e->waits.room, (size_t)n + 1);
  if (ok) {
    for (uint32_t i = 0; i < n; i++) {
      e->kind.at[i] = (uint8_t)p->terms[i].kind;
      e->need.at[i] = e->positive.at[i] = e->negative.at[i] = 0;
      e->waits.at[i] = 0;
      b.uses.at[i] = 0;
      b.live.at[i] = i + 1 == n;
    }
    for (uint32_t i = 0; i < n + 2; i++) e->user_first.at[i] = 0;
    for (uint32_t i = 0; i < p->leaf_count; i++) e->winding.at[i] = 0;
    for (uint32_t i = 0; i < p->leaf_count + 2; i++) e->leaf_first.at[i] = 0;
    e->root = n ? n - 1 : 0;
    for (uint32_t i = n; i-- > 0;) { /* The loop reaches a term after all terms that have it as operand. Therefore
                                      * uses[i] is complete when term i is reached. */
      if (p->terms[i].kind == VS_TERM_LEAF) continue;
      for (uint32_t j = 0; j < p->terms[i].count; j++) b.uses.at[p->operands[p->terms[i].first + j]]++;
    }
    for (uint32_t i = n; ok && i-- > 0;)
      if (b.live.at[i] && p->terms[i].kind != VS_TERM_LEAF) ok = collect(k, p, &b, e, i);
    ok = ok && find_forces(k, e, p, b.live.at);
  }
  /* Sorts the pairs (operand, term that uses it) by operand, and the terms of leaves by leaf. */
  if (ok && VS_ROOM(k, e->users.at, e->users.room, b.pairs.count / 2 + 1)) {
    for (size_t i = 0; i < b.pairs.count; i += 2) e->user_first.at[b.pairs.at[i] + 1]++;
    for (uint32_t i = 0; i < n; i++) e->user_first.at[i + 1] += e->user_first.at[i];
    for (size_t i = b.pairs.count; i > 0; i -= 2)
      e->users.at[--e->user_first.at[b.pairs.at[i - 2] + 1]] = b.pairs.at[i - 1];
    for (uint32_t i = 0; i < n; i++) e->user_first.at[i] = e->user_first.at[i + 1];
    if (n) e->user_first.at[n] = (uint32_t)(b.pairs.count / 2);
    uint32_t live = 0;
    for (uint32_t i = 0; i < n; i++)
      if (b.live.at[i] && p->terms[i].kind == VS_TERM_LEAF) e->leaf_first.at[p->terms[i].first + 1]++, live++;
    for (uint32_t i = 0; i < p->leaf_count; i++) e->leaf_first.at[i + 1] += e->leaf_first.at[i];
    for (uint32_t i = n; i-- > 0;)
      if (b.live.at[i] && p->terms[i].kind == VS_TERM_LEAF)
        e->leaf_terms.at[--e->leaf_first.at[p->terms[i].first + 1]] = i;
    for (uint32_t i = 0; i < p->leaf_count; i++) e->leaf_first.at[i] = e->leaf_first.at[i + 1];
    e->leaf_first.at[p->leaf_count] = live;
    for (uint32_t i = n; i-- > 0;) { /* uses[i] becomes 1 if term i is subtracted an odd number of times on the way to
                                      * the root, else 0. The loop reaches terms before their operands. */
      uint32_t first = e->user_first.at[i];
      b.uses.at[i] = first < e->user_first.at[i + 1] ? b.uses.at[e->users.at[first] / 2] ^ (e->users.at[first] & 1) : 0;
      if (p->terms[i].kind == VS_TERM_LEAF) e->taken_off.at[p->terms[i].first] = (uint8_t)b.uses.at[i];
    }
  } else {
    ok = false;
  }
  VS_DROP(k, b.uses);
  VS_DROP(k, b.pairs);
  VS_DROP(k, b.stack);
  VS_DROP(k, b.live);
  return ok;
}

static bool value(const vs_expression *e, uint32_t term) {
  switch ((vs_term_kind)e->kind.at[term]) {
  case VS_TERM_LEAF:
  case VS_TERM_UNION: return e->positive.at[term] > 0;
  case VS_TERM_INTERSECTION: return e->need.at[term] && e->positive.at[term] == e->need.at[term];
  case VS_TERM_DIFFERENCE: return e->positive.at[term] > 0 && e->negative.at[term] == 0;
  }
  return false;
}

bool vs_expression_value(const vs_expression *e) { return e->kind.at && value(e, e->root); }

bool vs_expression_upholds(vs_kernel *k, vs_expression *e, uint32_t leaf, bool *answer) {
  /* Greatest number of visited terms, because very many paths may lead from the leaf to the root. If it is reached, the
   * answer may be wrong, and a face then gets another material. */
  enum { STEPS = 256 };
  VS_ASSERT(e->winding.at[leaf] > 0);
  *answer = false;
  e->stack.count = 0;
  for (uint32_t i = e->leaf_first.at[leaf]; i < e->leaf_first.at[leaf + 1]; i++)
    if (value(e, e->leaf_terms.at[i]) && !VS_PUSH(k, e->stack, e->leaf_terms.at[i])) return false;
  for (int step = 0; e->stack.count && !*answer && step < STEPS; step++) {
    uint32_t t = e->stack.at[--e->stack.count];
    *answer = t == e->root;
    for (uint32_t i = e->user_first.at[t]; !*answer && i < e->user_first.at[t + 1]; i++)
      if (!(e->users.at[i] & 1) && value(e, e->users.at[i] / 2) && !VS_PUSH(k, e->stack, e->users.at[i] / 2))
        return false;
  }
  e->stack.count = 0;
  return true;
}

bool vs_expression_gated(const vs_expression *e) {
  for (uint32_t i = 0; i < e->gate_count; i++)
    if (!value(e, e->gates[i])) return true;
  return false;
}

/* ---- a leaf that is an operand of several terms: a heap evaluates each term once, after all of its operands ---- */

static bool wait_push(vs_kernel *k, vs_expression *e, uint32_t term) {
  if (e->waits.at[term]) return true;
  e->waits.at[term] = value(e, term) ? 3 : 1;
  if (!VS_PUSH(k, e->stack, term)) return false;
  uint32_t *heap = e->stack.at, i = (uint32_t)e->stack.count - 1;
  for (; i && heap[(i - 1) / 2] > term; i = (i - 1) / 2) heap[i] = heap[(i - 1) / 2];
  heap[i] = term;
  return true;
}

static uint32_t wait_pop(vs_expression *e) {
  uint32_t *heap = e->stack.at, top = heap[0], last = heap[--e->stack.count], n = (uint32_t)e->stack.count, i = 0;
  for (uint32_t child; (child = 2 * i + 1) < n; i = child) {
    if (child + 1 < n && heap[child + 1] < heap[child]) child++;
    if (heap[child] >= last) break;
    heap[i] = heap[child];
  }
  if (n) heap[i] = last;
  return top;
}

static bool add_to_several(vs_kernel *k, vs_expression *e, uint32_t leaf, bool now) {
  for (uint32_t i = e->leaf_first.at[leaf]; i < e->leaf_first.at[leaf + 1]; i++) {
    if (!wait_push(k, e, e->leaf_terms.at[i])) return false;
    e->positive.at[e->leaf_terms.at[i]] = now;
  }
  while (e->stack.count) {
    uint32_t t = wait_pop(e);
    bool old = e->waits.at[t] == 3, up = value(e, t);
    e->waits.at[t] = 0;
    if (old == up) continue;
    for (uint32_t i = e->user_first.at[t]; i < e->user_first.at[t + 1]; i++) {
      uint32_t user = e->users.at[i] / 2;
      if (!wait_push(k, e, user)) return false;
      *(e->users.at[i] & 1 ? &e->negative.at[user] : &e->positive.at[user]) += up ? 1u : UINT32_MAX;
    }
  }
  return true;
}

bool vs_expression_add(vs_kernel *k, vs_expression *e, uint32_t leaf, int32_t delta) {
  bool before = e->winding.at[leaf] > 0;
  e->winding.at[leaf] += delta;
  bool now = e->winding.at[leaf] > 0;
  if (before == now) return true;
  e->stack.count = 0;
  if (e->leaf_first.at[leaf + 1] - e->leaf_first.at[leaf] > 1) return add_to_several(k, e, leaf, now);
  for (uint32_t i = e->leaf_first.at[leaf]; i < e->leaf_first.at[leaf + 1]; i++) {
    uint32_t t = e->leaf_terms.at[i];
    e->positive.at[t] = now;
    if (!VS_PUSH(k, e->stack, t * 2 + now)) return false;
  }
  while (e->stack.count) { /* The stack contains terms whose value has changed, and for which the terms that use them
                            * have not been evaluated again. The value of a term may change several times. */
    uint32_t t = e->stack.at[--e->stack.count] / 2;
    bool up = e->stack.at[e->stack.count] & 1;
    for (uint32_t i = e->user_first.at[t]; i < e->user_first.at[t + 1]; i++) {
      uint32_t user = e->users.at[i] / 2;
      uint32_t *count = e->users.at[i] & 1 ? &e->negative.at[user] : &e->positive.at[user];
      bool old = value(e, user);
      *count += up ? 1u : UINT32_MAX;
      if (value(e, user) != old && !VS_PUSH(k, e->stack, user * 2 + !old)) return false;
    }
  }
  return true;
}

void vs_expression_free(vs_kernel *k, vs_expression *e) {
  VS_DROP(k, e->kind);
  VS_DROP(k, e->need);
  VS_DROP(k, e->positive);
  VS_DROP(k, e->negative);
  VS_DROP(k, e->user_first);
  VS_DROP(k, e->users);
  VS_DROP(k, e->winding);
  VS_DROP(k, e->leaf_first);
  VS_DROP(k, e->leaf_terms);
  VS_DROP(k, e->taken_off);
  VS_DROP(k, e->stack);
  VS_DROP(k, e->waits);
  VS_DROP(k, e->forces);
}
