/* Declares a plane sweep over a planar graph whose edges intersect only at their ends. It returns the vertices in
 * order, each with the edges to its left and right, and the edges directly below and above it. The arrangement of
 * planes and the triangulation use it.
 *
 * The plane is seen along its normal, in the axes (u, v). Vertices have local numbers in the exact lexicographic order
 * of (u, v). An edge runs from its smaller vertex to its larger. `above` an edge is its left side, even if it is
 * vertical. The edges under the sweep line form a treap whose nodes are also linked in order. */
#ifndef VS_KERNEL_ARRANGE_SWEEP_H
#define VS_KERNEL_ARRANGE_SWEEP_H

#include "kernel/exact/sort.h"
#include "kernel/exact/interned.h"

typedef struct { uint32_t l, r; } vs_sweep_edge;
typedef struct { uint32_t parent, left, right, previous, next; } vs_sweep_node;

typedef struct {
  vs_points_view points;
  int u, v;
  VS_LIST(uint32_t) vertices; /* vertices[i]: number in the table of points of the sweep's vertex i */
  VS_LIST(vs_sweep_edge) edges;
  /* vs_sweep_begin sets all members from here on; the caller sets the members above. */
  VS_LIST(uint32_t) first;    /* first[v]: index in `rights` of the first edge that leads from vertex v to the right */
  VS_LIST(uint32_t) rights;   /* edges grouped by their left end; the edges of one vertex are in order from the lowest
                               * to the highest */
  VS_LIST(uint32_t) arrival;  /* arrival[v]: an edge that ends at vertex v, or VS_NONE */
  VS_LIST(vs_sweep_node) nodes; /* nodes[e]: node of edge e in the tree of edges under the sweep line */
  VS_LIST(uint32_t) lefts;    /* edges that end at the current vertex, from the lowest to the highest */
  uint32_t root, at;
  VS_LIST(vs_keyed) keyed;    /* working memory of the sort, with twice as many elements as the sweep has vertices */
} vs_sweep;

typedef struct {
  uint32_t vertex, below, above; /* vertex: the vertex that the sweep has reached; below, above: the edges directly
                                  * below and above it, or VS_NONE */
  const uint32_t *lefts, *rights;
  uint32_t left_count, right_count;
} vs_sweep_event;

/* Sorts `count` points and stores them without duplicates in s->vertices. scratch has as many elements as points.
 * Returns false when memory is out or the caller interrupts. */
bool vs_sweep_order(vs_kernel *k, vs_sweep *s, uint32_t *points, size_t count, uint32_t *scratch);
bool vs_sweep_begin(vs_kernel *k, vs_sweep *s); /* begins the sweep over the edges that the caller has set; returns
                                                 * false when memory is out */
bool vs_sweep_next(vs_kernel *k, vs_sweep *s, vs_sweep_event *event); /* moves to the next vertex and describes it in
                                                                       * *event; returns false after the last vertex or
                                                                       * on an error */
bool vs_sweep_done(const vs_sweep *s);
void vs_sweep_free(vs_kernel *k, vs_sweep *s);

/* Returns 1 if the way from vertex a over b to c turns left, -1 if it turns right, 0 if it is straight. */
static inline int vs_sweep_turn(const vs_sweep *s, uint32_t a, uint32_t b, uint32_t c) {
  return vs_orient2d(s->points, s->vertices.at[a], s->vertices.at[b], s->vertices.at[c], s->u, s->v);
}

#endif
