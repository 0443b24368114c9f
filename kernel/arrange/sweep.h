/* Declares a sweep over a planar graph whose edges intersect only at their ends. It returns the vertices in order, each
 * with the edges to its left and right, and the edges directly below and above it. The arrangement of planes and the
 * triangulation use it.
 *
 * The plane is seen along its normal, in the axes (u, v). Vertices have local numbers in the exact lexicographic order
 * of (u, v). An edge runs from its smaller vertex to its larger. `above` an edge is its left side, even if it is
 * vertical. The status is a treap whose nodes are also linked in order. */
#ifndef VS_KERNEL_ARRANGE_SWEEP_H
#define VS_KERNEL_ARRANGE_SWEEP_H

#include "kernel/exact/sort.h"
#include "kernel/exact/interned.h"

typedef struct { uint32_t l, r; } vs_sweep_edge;
typedef struct { uint32_t parent, left, right, previous, next; } vs_sweep_node;

typedef struct {
  vs_points_view points;
  int u, v;
  VS_LIST(uint32_t) vertices; /* point number for each local vertex number */
  VS_LIST(vs_sweep_edge) edges;
  /* The members below are set by vs_sweep_begin. */
  VS_LIST(uint32_t) first;    /* for each vertex: index in `rights` of the first edge that leads from it to the right */
  VS_LIST(uint32_t) rights;   /* edges grouped by left end, from the lowest to the highest */
  VS_LIST(uint32_t) arrival;  /* for each vertex: an edge that ends there, or VS_NONE */
  VS_LIST(vs_sweep_node) nodes; /* node of each edge in the status tree */
  VS_LIST(uint32_t) lefts;    /* edges that end at the current vertex, from the lowest to the highest */
  uint32_t root, at;
  VS_LIST(vs_keyed) keyed;    /* memory for sorting, with twice as many elements as vertices */
} vs_sweep;

typedef struct {
  uint32_t vertex, below, above; /* vertex: the current vertex; below, above: the edges directly below and above it, or
                                  * VS_NONE */
  const uint32_t *lefts, *rights;
  uint32_t left_count, right_count;
} vs_sweep_event;

/* Sorts the points, without duplicates, into s->vertices. scratch has as many elements as points. Returns false when
 * memory is out or the caller interrupts. */
bool vs_sweep_order(vs_kernel *k, vs_sweep *s, uint32_t *points, size_t count, uint32_t *scratch);
bool vs_sweep_begin(vs_kernel *k, vs_sweep *s); /* begins the sweep; the caller has set the edges before; returns false
                                                 * when memory is out */
bool vs_sweep_next(vs_kernel *k, vs_sweep *s, vs_sweep_event *event); /* moves to the next vertex; returns false after
                                                                       * the last vertex or on an error */
bool vs_sweep_done(const vs_sweep *s);
void vs_sweep_free(vs_kernel *k, vs_sweep *s);

/* Returns the sign of the turn a -> b -> c of local vertices. */
static inline int vs_sweep_turn(const vs_sweep *s, uint32_t a, uint32_t b, uint32_t c) {
  return vs_orient2d(s->points, s->vertices.at[a], s->vertices.at[b], s->vertices.at[c], s->u, s->v);
}

#endif
