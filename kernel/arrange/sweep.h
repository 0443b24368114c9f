/* Declares the sweep over a planar graph whose edges meet only at their ends. It yields the vertices in order, each
 * with its edges to the left and to the right and the edges directly below and above it. Faces and triangulation use
 * it.
 *
 * The plane is seen along its normal in the axes (u, v). Vertices are local numbers in lexicographic order of (u, v),
 * exact; an edge runs from its smaller vertex to its larger; `above` an edge is its left side, even if it is vertical.
 * The status is a treap threaded in order. */
#ifndef VS_KERNEL_ARRANGE_SWEEP_H
#define VS_KERNEL_ARRANGE_SWEEP_H

#include "kernel/exact/sort.h"
#include "kernel/exact/interned.h"

typedef struct { uint32_t l, r; } vs_sweep_edge;
typedef struct { uint32_t parent, left, right, previous, next; } vs_sweep_node;

typedef struct {
  vs_points_view points;
  int u, v;
  VS_LIST(uint32_t) vertices; /* from the local number to the point */
  VS_LIST(vs_sweep_edge) edges;
  /* vs_sweep_begin fills the members below */
  VS_LIST(uint32_t) first;    /* for each vertex: an index in `rights` */
  VS_LIST(uint32_t) rights;   /* edges by left end, from below upwards */
  VS_LIST(uint32_t) arrival;  /* an edge that ends at the vertex, or VS_NONE */
  VS_LIST(vs_sweep_node) nodes; /* one for each edge */
  VS_LIST(uint32_t) lefts;    /* of the current vertex, from below upwards */
  uint32_t root, at;
  VS_LIST(vs_keyed) keyed;    /* to sort the vertices: twice as many */
} vs_sweep;

typedef struct {
  uint32_t vertex, below, above; /* below, above: edges or VS_NONE */
  const uint32_t *lefts, *rights;
  uint32_t left_count, right_count;
} vs_sweep_event;

/* Sorts the points into `vertices` without duplicates. scratch: as long as points. */
bool vs_sweep_order(vs_kernel *k, vs_sweep *s, uint32_t *points, size_t count, uint32_t *scratch);
bool vs_sweep_begin(vs_kernel *k, vs_sweep *s); /* the caller has filled the edges */
bool vs_sweep_next(vs_kernel *k, vs_sweep *s, vs_sweep_event *event); /* returns false at the end or on an error */
bool vs_sweep_done(const vs_sweep *s);
void vs_sweep_free(vs_kernel *k, vs_sweep *s);

/* Returns the sign of the turn a -> b -> c of local vertices. */
static inline int vs_sweep_turn(const vs_sweep *s, uint32_t a, uint32_t b, uint32_t c) {
  return vs_orient2d(s->points, s->vertices.at[a], s->vertices.at[b], s->vertices.at[c], s->u, s->v);
}

#endif
