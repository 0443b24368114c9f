/* Declares the functions for the sorting of directed edges by their ends, for all files that need the items at an
 * edge. */
#ifndef VS_KERNEL_MESH_EDGE_USES_H
#define VS_KERNEL_MESH_EDGE_USES_H

#include "kernel/exact/interned.h"
#include "model/store/disjoint.h"

typedef struct { uint32_t high, item; } vs_half; /* an edge at its smaller end */

typedef struct {
  VS_LIST(vs_half) at;      /* by smaller end, then larger end, then item */
  VS_LIST(uint32_t) first;  /* for each point: its first edge to a larger point; an extra element marks the end */
  uint32_t shift, ranges;   /* points are in ranges, 1 << shift in each but the last: tasks for threads */
} vs_halves;

/* Fills the ends of `count` items from `begin` on; equal ends if an item has no edge. */
typedef void vs_ends_fn(const void *context, uint32_t begin, uint32_t count, uint32_t (*ends)[2]);
bool vs_halves_sort(vs_kernel *k, vs_halves *h, uint32_t points, uint32_t items, vs_ends_fn *ends, const void *context);
void vs_halves_free(vs_kernel *k, vs_halves *h);

/* Returns the first point of a range; its points end before the next range's first. */
static inline uint32_t vs_halves_begin(const vs_halves *h, size_t range) {
  uint32_t points = (uint32_t)h->first.count - 1;
  return range >= h->ranges ? points : (uint32_t)range << h->shift;
}

#endif
