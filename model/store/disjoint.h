/* Owns disjoint sets of numbers, as a forest of parents: a set's root is its smallest member, so results do not depend
 * on the order of unions. */
#ifndef VS_MODEL_STORE_DISJOINT_H
#define VS_MODEL_STORE_DISJOINT_H

#include <stdatomic.h>
#include <stdint.h>

/* parent[i] is i for the root of a set, and for every number at first; else a smaller member. */
static inline void vs_disjoint(uint32_t *parent, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) parent[i] = i;
}

/* Returns the root of x's set; halves the path to it (Tarjan, van Leeuwen 1984). parent[x] is x or smaller. */
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

/* The same for threads that unite at the same time: the roots are the sets' smallest members in any order of the
 * unions. */
static inline uint32_t vs_find_shared(_Atomic uint32_t *parent, uint32_t x) {
  for (;;) {
    uint32_t up = atomic_load_explicit(&parent[x], memory_order_relaxed);
    if (up == x) return x;
    uint32_t over = atomic_load_explicit(&parent[up], memory_order_relaxed);
    /* The value is some ancestor, regardless of the order of writes. */
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
