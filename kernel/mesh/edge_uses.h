/* Declares the sorting of directed edges by their ends. It serves to find the items, triangles or faces, at an edge. */
#ifndef VS_KERNEL_MESH_EDGE_USES_H
#define VS_KERNEL_MESH_EDGE_USES_H

#include "kernel/exact/interned.h"
#include "model/store/disjoint.h"

typedef struct { uint32_t high, item; } vs_half; /* A directed edge. high: number of its higher point; item: number of
                                                  * the triangle or face that has this edge. The position in the list
                                                  * `at` implies the lower point. */

typedef struct {
  VS_LIST(vs_half) at;      /* the directed edges, sorted by lower point, then by higher point, then by item */
  VS_LIST(uint32_t) first;  /* first[p]: index in `at` of the first edge whose lower point is p; an extra element marks
                             * the end */
  uint32_t shift, ranges;   /* ranges: number of ranges of points, each of which one task sorts; a range has 1 << shift
                             * points, the last range fewer */
} vs_halves;

/* Sets ends[i] to the two points of the edge of item begin + i, for each i < count. Two equal points mean that the item
 * has no edge. */
typedef void vs_ends_fn(const void *context, uint32_t begin, uint32_t count, uint32_t (*ends)[2]);
bool vs_halves_sort(vs_kernel *k, vs_halves *h, uint32_t points, uint32_t items, vs_ends_fn *ends, const void *context);
void vs_halves_free(vs_kernel *k, vs_halves *h);

/* Returns the first point of range `range`. The range ends before the first point of the next range. */
static inline uint32_t vs_halves_begin(const vs_halves *h, size_t range) {
  uint32_t points = (uint32_t)h->first.count - 1;
  return range >= h->ranges ? points : (uint32_t)range << h->shift;
}

#endif
