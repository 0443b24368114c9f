/* Defines the state of make_result.c, shared with straighten.c, which decides which bends the result may lose. */
#ifndef VS_KERNEL_MESH_RESULT_STATE_H
#define VS_KERNEL_MESH_RESULT_STATE_H

#include "kernel/cluster.h"
#include "kernel/mesh/triangulate.h"

typedef struct { VS_LIST(uint32_t) uses, firsts, seams; } vs_found_edges; /* of a range; seams: indices in firsts */
typedef struct { uint32_t v[3], tag, look; } vs_cut_triangle; /* v: points; look: 2 * plane, plus 1 if it faces against
                                                               * its normal */
typedef struct { VS_LIST(vs_cut_triangle) at; } vs_cut_chunk;

typedef struct vs_sheets vs_sheets;

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(vs_found_edges) found;
  VS_LIST(uint32_t) uses;            /* of kept faces, sorted by edge */
  VS_LIST(uint32_t) edge_first;      /* of edges that stay: index of their first use; an extra element marks the end */
  VS_LIST(_Atomic uint32_t) sets;    /* of faces, union-find */
  VS_LIST(uint32_t) parent;          /* for each face: the first face of its merged face */
  VS_LIST(uint32_t) edges;           /* for each point: two numbers, the first edges that stay */
  VS_LIST(uint8_t) degree;           /* for each point: number of such edges, 0 to 2, 3 for more; 4: needless */
  VS_LIST(uint8_t) rim;              /* for each point, if there are regions: 1: the rim of a kept region contains it */
  size_t rim_edges;
  VS_LIST(uint32_t) edge_of;         /* of each use of the cluster: its edge, or VS_NONE if that does not stay */
  VS_LIST(uint32_t) next;            /* for each face: the next face of its merged face, or VS_NONE */
  VS_LIST(_Atomic uint8_t) whole;    /* for each face: 1: it keeps its triangles */
  VS_LIST(uint32_t) out;             /* for each point: its vertex in the result */
  VS_LIST(uint32_t) points;          /* for each new vertex: its point */
  VS_LIST(uint32_t) looks;           /* for each new triangle: 2 * plane, plus 1 if it faces against its normal */
  VS_LIST(uint32_t) chunk_first;     /* of chunks of faces; an extra element marks the end */
  vs_cut_chunk chunks[VS_PIPELINE_WINDOW];
  VS_LIST(vs_triangulation) cutters; /* one for each thread */
  vs_mesh *mesh;
  size_t first_vertex;               /* in the mesh: this cluster's first vertex */
  /* if bends may be removed (straighten.c); else all of these are empty */
  VS_LIST(uint32_t) lone;            /* for each plane: its facet if it has exactly one, or VS_NONE */
  VS_LIST(uint32_t) seams;           /* edges that stay between two facets of a sheet */
  VS_LIST(uint8_t) gone;             /* for each edge: 1: a seam over which faces are merged */
  VS_LIST(uint8_t) bent;             /* for each point: 1: needless, and off the line of the remaining edges */
  VS_LIST(uint8_t) stays;            /* for each point: 1: bent, but needed in spite of that */
  vs_sheets *sheets;
} vs_result_state;

static inline const vs_use *vs_result_use(const vs_result_state *w, size_t i) { return &w->c->uses.at[w->uses.at[i]]; }
static inline uint32_t vs_result_other_end(const vs_use *u, uint32_t p) { return u->from == p ? u->to : u->from; }

/* Returns the facet of the face's plane if the plane has no other; else VS_NONE. */
static inline uint32_t vs_result_facet(const vs_result_state *w, const vs_face *f) {
  return w->lone.count && f->plane != VS_NONE ? w->lone.at[f->plane] : VS_NONE;
}

#endif
