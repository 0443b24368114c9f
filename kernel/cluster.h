/* Owns the state of one cluster: the leaves that touch, as integer triangles, and the arrangement that grows from them.
 *
 * Notation.
 *   facet   a maximal set of coplanar triangles of one leaf that hang together by edges; cut and classified as one
 *   group   facets of one plane that touch: they are arranged together
 *   face    a region of the arrangement in one plane, not cut by anything; its + side is where the plane's normal points
 *   cover   for each leaf that has the face: w(-side) = w(+side) + delta, w the leaf's winding number (inside: w > 0)
 *   use     a boundary edge of a face, directed so that the face lies left of it as seen from the + side
 *   cell    a region of space: a set of sides of faces */
#ifndef VS_KERNEL_CLUSTER_H
#define VS_KERNEL_CLUSTER_H

#include "kernel/bvh.h"
#include "kernel/expression.h"
#include "kernel/table.h"

enum { VS_BESIDE_FLAT = 8 }; /* next to a triangle that the grid has made a line */

typedef struct {
  uint32_t v[3];   /* counter-clockwise seen from outside its leaf */
  uint32_t leaf;   /* of the problem */
  uint32_t plane, facet;
  uint32_t source; /* which of its mesh's triangles */
  bool flip;       /* the leaf's outward normal is the plane's reversed */
  uint8_t inner;   /* bit i: the edge from v[i] to the next lies inside the facet; VS_BESIDE_FLAT */
} vs_soup_triangle;

typedef struct {
  uint32_t leaf, plane, first; /* first: into facet_triangles, up to the next facet's */
  uint32_t group;  /* union-find parent, a facet */
  bool flip, touched; /* touched: something meets it; else its triangles are copied */
} vs_facet;

typedef struct { uint32_t facet, p, q, plane; } vs_cut; /* p to q lies in the facet, and in plane; p == q: a point */

typedef struct { uint32_t leaf; int32_t delta; } vs_cover;
typedef struct {
  uint32_t plane;
  uint32_t cover, cover_count;
  uint32_t facet;  /* whose triangles it is, or VS_NONE */
  uint32_t tag;
} vs_face;
typedef struct { uint32_t from, to, face; } vs_use;

/* the frame and grid: world = frame * ((grid + offset) * step) */
typedef struct {
  vs_affine frame;
  bool framed;        /* else frame is the identity */
  double scale, unit; /* step = unit / scale, both of them exact where the step is decimal */
  double offset[3];   /* whole steps */
} vs_grid;

typedef struct {
  const vs_kernel_problem *problem;
  const uint32_t *leaves;
  uint32_t leaf_count;
  vs_grid grid;
  vs_points_table points;
  vs_planes_table planes;
  VS_LIST(vs_soup_triangle) triangles;
  VS_LIST(vs_facet) facets;
  VS_LIST(uint32_t) facet_triangles;
  VS_LIST(vs_box) boxes; /* of the triangles */
  vs_bvh bvh;
  VS_LIST(vs_cut) cuts;
  VS_LIST(vs_face) faces;
  VS_LIST(vs_cover) covers;
  VS_LIST(vs_use) uses;
  VS_LIST(uint8_t) kept; /* a face: 0 no, 1 outside is its + side, 2 its - side */
  bool inspect;          /* of one leaf, which may be inside out: the next two are wanted */
  VS_LIST(uint32_t) side_cell; /* 2 * face (+ side), 2 * face + 1 (- side) -> cell */
  VS_LIST(int32_t) wound;      /* of a cell: the leaf's winding number */
} vs_cluster;

/* The steps, in order. All false on error. */
bool vs_frame_choose(vs_kernel *k, vs_cluster *c, vs_affine *local_to_frame /* one a leaf of the cluster */);
bool vs_soup_build(vs_kernel *k, vs_cluster *c);                       /* frame, weld, grid, triangles, facets */
bool vs_meet_triangles(vs_kernel *k, vs_cluster *c);                   /* cuts, groups */
bool vs_arrange_planes(vs_kernel *k, vs_cluster *c);                   /* faces, uses */
bool vs_classify_faces(vs_kernel *k, vs_cluster *c, vs_expression *e); /* kept */
bool vs_output_faces(vs_kernel *k, vs_cluster *c, vs_mesh *out);
void vs_cluster_free(vs_kernel *k, vs_cluster *c);

vs_vec3 vs_grid_world(const vs_grid *g, const vs_point *p);

/* Sorts numbers of uses by edge, in place: by the smaller end through buckets, each bucket by the larger. */
bool vs_uses_sort(vs_kernel *k, const vs_use *uses, uint32_t *at, size_t count, size_t point_count);
static inline bool vs_use_same_edge(const vs_use *a, const vs_use *b) {
  return (a->from == b->from && a->to == b->to) || (a->from == b->to && a->to == b->from);
}

/* union-find with path halving; the smaller number becomes the root, so results do not depend on the order of unions */
static inline uint32_t vs_find(uint32_t *parent, uint32_t x) {
  while (parent[x] != x) x = parent[x] = parent[parent[x]];
  return x;
}
static inline void vs_unite(uint32_t *parent, uint32_t a, uint32_t b) {
  a = vs_find(parent, a);
  b = vs_find(parent, b);
  if (a < b) parent[b] = a;
  else parent[a] = b;
}

#endif
