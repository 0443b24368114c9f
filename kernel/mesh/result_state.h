/* Defines the state in which make_result.c makes the mesh of a result. straighten.c also uses it, to decide which bends
 * the result may lose. A bend is a corner where a cut passes between facets that the grid has split. */
#ifndef VS_KERNEL_MESH_RESULT_STATE_H
#define VS_KERNEL_MESH_RESULT_STATE_H

#include "kernel/cluster.h"
#include "kernel/mesh/triangulate.h"

typedef struct { VS_LIST(uint32_t) uses, firsts, seams; } vs_found_edges; /* Edges that a task found in its range.
                                                                           * `uses`: boundary edges of faces; `firsts`:
                                                                           * for each edge, the position in `uses` of
                                                                           * its first boundary edge; `seams`: indices
                                                                           * in `firsts` of edges at which the grid has
                                                                           * split a planar facet. */
typedef struct { uint32_t v[3], tag, look; } vs_cut_triangle; /* v: point numbers of the triangle's corners; look: 2 *
                                                               * number of the triangle's plane, plus 1 if the triangle
                                                               * faces against the plane's normal */
typedef struct { VS_LIST(vs_cut_triangle) at; } vs_cut_chunk;

typedef struct vs_sheets vs_sheets;

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(vs_found_edges) found;
  VS_LIST(uint32_t) uses;            /* boundary edges of the faces in the result, as indices in the cluster's `uses`,
                                      * sorted by edge */
  VS_LIST(uint32_t) edge_first;      /* edge_first[e]: for an edge e that stays in the result, position in `uses` of its
                                      * first boundary edge; an extra element marks the end */
  VS_LIST(_Atomic uint32_t) sets;    /* union-find structure of the faces that are merged */
  VS_LIST(uint32_t) parent;          /* parent[f]: first face of the merged face that contains face f */
  VS_LIST(uint32_t) edges;           /* edges[2 * p], edges[2 * p + 1]: two edges that end at point p, as indices in
                                      * edge_first */
  VS_LIST(uint8_t) degree;           /* degree[p]: number of edges in edge_first that end at point p; 3 means three or
                                      * more; 4: the corner at p is dropped */
  VS_LIST(uint8_t) rim;              /* rim[p]: 1 if point p lies on the rim of a region of untouched triangles in the
                                      * result; empty if there are no regions */
  size_t rim_edges;
  VS_LIST(uint32_t) edge_of;         /* edge_of[u]: index in edge_first of the edge to which the cluster's boundary edge
                                      * u belongs; VS_NONE if the edge vanished because its faces were merged */
  VS_LIST(uint32_t) next;            /* next[f]: face that follows f in the list of faces merged with it, or VS_NONE */
  VS_LIST(_Atomic uint8_t) whole;    /* whole[f]: 1 if face f keeps its original triangles */
  VS_LIST(uint32_t) out;             /* out[p]: number of the vertex in the result at the cluster's point p */
  VS_LIST(uint32_t) points;          /* points[i]: number in the cluster of the point at vertex i of the result,
                                      * counting only vertices that this cluster has added */
  VS_LIST(uint32_t) looks;           /* looks[i]: for triangle i that this cluster has added: 2 * number of its plane,
                                      * plus 1 if the triangle faces against the plane's normal */
  VS_LIST(uint32_t) chunk_first;     /* chunk_first[i]: first face of chunk i (the faces of one task); an extra element
                                      * marks the end */
  vs_cut_chunk chunks[VS_PIPELINE_WINDOW];
  VS_LIST(vs_triangulation) cutters; /* working memory of the triangulation, with an element for each thread */
  vs_mesh *mesh;
  size_t first_vertex;               /* index in the result's mesh of this cluster's first vertex */
  /* The members below are used only if the kernel straightens cuts that the grid has bent (straighten.c). Otherwise
   * they are empty. */
  VS_LIST(uint32_t) lone;            /* lone[p]: number of the only facet in plane p; VS_NONE if plane p has no facet or
                                      * several */
  VS_LIST(uint32_t) seams;           /* edges of edge_first between two facets of a sheet (a planar facet that the grid
                                      * has split) */
  VS_LIST(uint8_t) gone;             /* gone[e]: 1 if edge e, at which the grid has split a planar facet, vanishes
                                      * because the faces on its two sides are merged */
  VS_LIST(uint8_t) bent;             /* bent[p]: 1 if the corner at point p is dropped although it lies off the straight
                                      * line between its two neighbours */
  VS_LIST(uint8_t) stays;            /* stays[p]: 1 if the corner at point p must not be dropped, although the grid has
                                      * only bent a straight cut there */
  vs_sheets *sheets;
} vs_result_state;

static inline const vs_use *vs_result_use(const vs_result_state *w, size_t i) { return &w->c->uses.at[w->uses.at[i]]; }
static inline uint32_t vs_result_other_end(const vs_use *u, uint32_t p) { return u->from == p ? u->to : u->from; }

/* Returns the facet in the plane of face f if it is the plane's only facet, else VS_NONE. */
static inline uint32_t vs_result_facet(const vs_result_state *w, const vs_face *f) {
  return w->lone.count && f->plane != VS_NONE ? w->lone.at[f->plane] : VS_NONE;
}

#endif
