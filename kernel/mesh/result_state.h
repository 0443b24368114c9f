/* Defines the state in which make_result.c makes the mesh of a result. straighten.c also uses it, to decide which bends
 * the result may lose. */
#ifndef VS_KERNEL_MESH_RESULT_STATE_H
#define VS_KERNEL_MESH_RESULT_STATE_H

#include "kernel/cluster.h"
#include "kernel/mesh/triangulate.h"

typedef struct { VS_LIST(uint32_t) uses, firsts, seams; } vs_found_edges; /* edges that a task found in its range;
                                                                           * seams: indices in firsts */
typedef struct { uint32_t v[3], tag, look; } vs_cut_triangle; /* v: points of the triangle; look: 2 * plane, plus 1 if
                                                               * the triangle faces against the plane's normal */
typedef struct { VS_LIST(vs_cut_triangle) at; } vs_cut_chunk;

typedef struct vs_sheets vs_sheets;

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(vs_found_edges) found;
  VS_LIST(uint32_t) uses;            /* border edges of the faces in the result, as indices in the cluster's uses,
                                      * sorted by edge */
  VS_LIST(uint32_t) edge_first;      /* for each edge that is not merged away: index of its first use in `uses`; an
                                      * extra element marks the end */
  VS_LIST(_Atomic uint32_t) sets;    /* union-find structure of the faces that are merged */
  VS_LIST(uint32_t) parent;          /* for each face: the first face of the merged face that contains it */
  VS_LIST(uint32_t) edges;           /* two elements for each point: the first two edges of edge_first that end there */
  VS_LIST(uint8_t) degree;           /* for each point: number of edges of edge_first that end there, where 3 means
                                      * three or more; 4: the corner is dropped */
  VS_LIST(uint8_t) rim;              /* for each point: 1 if it lies on the rim of a region in the result; empty if
                                      * there are no regions */
  size_t rim_edges;
  VS_LIST(uint32_t) edge_of;         /* for each use of the cluster: its edge in edge_first, or VS_NONE if the edge is
                                      * merged away */
  VS_LIST(uint32_t) next;            /* for each face: the next face of its merged face, or VS_NONE */
  VS_LIST(_Atomic uint8_t) whole;    /* for each face: 1 if it keeps its original triangles */
  VS_LIST(uint32_t) out;             /* for each point of the cluster: its vertex number in the result */
  VS_LIST(uint32_t) points;          /* for each new vertex of the result: its point in the cluster */
  VS_LIST(uint32_t) looks;           /* for each new triangle: 2 * plane, plus 1 if the triangle faces against the
                                      * plane's normal */
  VS_LIST(uint32_t) chunk_first;     /* first face of each chunk of faces; an extra element marks the end */
  vs_cut_chunk chunks[VS_PIPELINE_WINDOW];
  VS_LIST(vs_triangulation) cutters; /* working memory of the triangulation, for each thread */
  vs_mesh *mesh;
  size_t first_vertex;               /* index of this cluster's first vertex in the mesh */
  /* The members below are used only if bends may be removed (straighten.c). Otherwise they are empty. */
  VS_LIST(uint32_t) lone;            /* for each plane: its only facet, or VS_NONE if it does not have exactly one */
  VS_LIST(uint32_t) seams;           /* edges of edge_first between two facets of a sheet */
  VS_LIST(uint8_t) gone;             /* for each edge: 1 if it is a seam over which faces are merged */
  VS_LIST(uint8_t) bent;             /* for each point: 1 if it is a bend that is dropped, which lies off the line of
                                      * the remaining edges */
  VS_LIST(uint8_t) stays;            /* for each point: 1 if it is a bend that must not be dropped */
  vs_sheets *sheets;
} vs_result_state;

static inline const vs_use *vs_result_use(const vs_result_state *w, size_t i) { return &w->c->uses.at[w->uses.at[i]]; }
static inline uint32_t vs_result_other_end(const vs_use *u, uint32_t p) { return u->from == p ? u->to : u->from; }

/* Returns the facet in the plane of face f if it is the plane's only facet, else VS_NONE. */
static inline uint32_t vs_result_facet(const vs_result_state *w, const vs_face *f) {
  return w->lone.count && f->plane != VS_NONE ? w->lone.at[f->plane] : VS_NONE;
}

#endif
