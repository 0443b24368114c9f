/* Implements disjoint sets of numbers (union-find) as a forest of parents. The root of a set is its smallest number, so
 * that results do not depend on the order of unions. */
#ifndef VS_MODEL_STORE_DISJOINT_H
#define VS_MODEL_STORE_DISJOINT_H

#include <stdatomic.h>
#include <stdint.h>

/* Makes each number a set of its own: parent[i] = i. Later, parent[i] is a smaller member of the same set, or i itself
 * for the root. */
static inline void vs_disjoint(uint32_t *parent, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) parent[i] = i;
}

/* Returns the root of the set that contains x. Shortens the path to the root by half (Tarjan, van Leeuwen 1984).
 * parent[x] is at most x. */
static inline uint32_t vs_find(uint32_t *parent, uint32_t x) {
  VS_ASSERT(parent[x] <= x);
  while (parent[x] != x) x = parent[x] = parent[parent[x]];
  return x;
}

static inline void vs_unite(uint32_t *parent, uint32_t a, uint32_t b) {
  a = vs_find(parent, a);
  b = vs_find(parent, b);
  if (a < b) parent[b] = a;
  else parent[a] = b;
}

/* Returns the root of the set that contains x, while other threads may unite sets. The root is the smallest member, and
 * does not depend on the order in which sets are united. */
static inline uint32_t vs_find_shared(_Atomic uint32_t *parent, uint32_t x) {
  for (;;) {
    uint32_t up = atomic_load_explicit(&parent[x], memory_order_relaxed);
    if (up == x) return x;
    uint32_t over = atomic_load_explicit(&parent[up], memory_order_relaxed);
    /* Any ancestor is a valid parent of x. Therefore threads may write parents in any order. */
    if (over != up) atomic_store_explicit(&parent[x], over, memory_order_relaxed);
    x = over;
  }
}
static inline void vs_unite_shared(_Atomic uint32_t *parent, uint32_t a, uint32_t b) {
  for (;;) {
    a = vs_find_shared(parent, a);
    b = vs_find_shared(parent, b);
    if (a == b) return;
    uint32_t low = a < b ? a : b, high = a < b ? b : a, expected = high;
    if (atomic_compare_exchange_strong_explicit(&parent[high], &expected, low, memory_order_relaxed,
                                                memory_order_relaxed))
      return;
  }
}

#endif
