/* Owns the state of making a result's mesh (make_result.c), shared with the question of which bends go
 * (straighten.c). */
#ifndef VS_KERNEL_MESH_RESULT_STATE_H
#define VS_KERNEL_MESH_RESULT_STATE_H

#include "kernel/cluster.h"
#include "kernel/mesh/triangulate.h"

typedef struct { VS_LIST(uint32_t) uses, firsts, seams; } vs_found_edges; /* of a range; seams: into firsts */
typedef struct { uint32_t v[3], tag, look; } vs_cut_triangle; /* v: points; look: 2 * plane + against its normal */
typedef struct { VS_LIST(vs_cut_triangle) at; } vs_cut_chunk;

typedef struct vs_sheets vs_sheets;

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(vs_found_edges) found;
  VS_LIST(uint32_t) uses;            /* of kept faces, sorted by edge */
  VS_LIST(uint32_t) edge_first;      /* of edges that stay, into uses; one more */
  VS_LIST(_Atomic uint32_t) sets;    /* of faces, union-find */
  VS_LIST(uint32_t) parent;          /* of a face: the first of those it is merged with */
  VS_LIST(uint32_t) edges;           /* of a point: two numbers, the first edges that stay */
  VS_LIST(uint8_t) degree;           /* of a point: 0, 1, 2, 3 for more; 4: needless */
  VS_LIST(uint8_t) rim;              /* of a point, where there are regions: 1 a kept one's rim goes through it */
  size_t rim_edges;
  VS_LIST(uint32_t) edge_of;         /* of a use of the cluster: its edge, or VS_NONE where that does not stay */
  VS_LIST(uint32_t) next;            /* of a face: the next that is merged with it, or VS_NONE */
  VS_LIST(_Atomic uint8_t) whole;    /* a face: 1 still its own triangles */
  VS_LIST(uint32_t) out;             /* of a point: its vertex in the result */
  VS_LIST(uint32_t) points;          /* of the result's new vertices */
  VS_LIST(uint32_t) looks;           /* of its new triangles: 2 * plane + against its normal */
  VS_LIST(uint32_t) chunk_first;     /* of chunks of faces; one more */
  vs_cut_chunk chunks[VS_PIPELINE_WINDOW];
  VS_LIST(vs_triangulation) cutters; /* one a thread */
  vs_mesh *mesh;
  size_t first_vertex;               /* of the mesh, that is ours */
  /* where bends may go (straighten.c); else all of these are empty */
  VS_LIST(uint32_t) lone;            /* of a plane: the one facet in it, or VS_NONE */
  VS_LIST(uint32_t) seams;           /* edges that stay between two facets of a sheet */
  VS_LIST(uint8_t) gone;             /* of an edge: 1 a seam over which faces are merged */
  VS_LIST(uint8_t) bent;             /* of a point: 1 a needless one off the line of what stays */
  VS_LIST(uint8_t) stays;            /* of a point: 1 such a one that is needed all the same */
  vs_sheets *sheets;
} vs_result_state;

static inline const vs_use *vs_result_use(const vs_result_state *w, size_t i) { return &w->c->uses.at[w->uses.at[i]]; }
static inline uint32_t vs_result_other_end(const vs_use *u, uint32_t p) { return u->from == p ? u->to : u->from; }

/* The facet of the face's plane, where it is alone in there; else VS_NONE. */
static inline uint32_t vs_result_facet(const vs_result_state *w, const vs_face *f) {
  return w->lone.count && f->plane != VS_NONE ? w->lone.at[f->plane] : VS_NONE;
}

#endif
