/* Owns the state of one cluster: the leaves that touch, as integer triangles, and their arrangement.
 *
 * Notation.
 *   facet   a maximal set of coplanar triangles of one leaf, connected by edges; cut and classified as one
 *   sheet   connected facets of one leaf that nearly lie in one plane: the grid has split a planar facet of the input
 *           into them
 *   bend    a corner of the result where a cut through a sheet passes from one of its facets to the next
 *   group   facets of one plane that touch: the kernel arranges them together
 *   face    a region of the arrangement in one plane that nothing cuts; the plane's normal points to its + side
 *   cover   of a face, for each leaf whose surface contains it: w(-side) = w(+side) + delta, where w is the leaf's
 *           winding number (inside: w > 0)
 *   use     a boundary edge of a face; its direction has the face on the left, seen from the + side
 *   cell    a region of space: a set of sides of faces
 *   plain   of a triangle: no other leaf touches it; it has neither a facet nor a face (untouched_triangles.c)
 *   region  connected plain triangles of a leaf: one face, which lies in no plane; its + side is outside of the leaf
 *   patch   the part of a facet that is tested against others as a unit: a whole convex facet, or one triangle of
 *           another facet
 *   side    a border edge of a facet, where borders and not triangles define the facets: see levels.c
 *   line    of a side: the edge of the input that it lies on, or the second plane that it lies in
 *   settled of places: inside a leaf that makes the whole expression true (or false) by itself, or outside of a gate.
 *           No surface of the result is there. The kernel omits triangles and cuts that are well inside settled space
 *           from the start, so the arrangement is not complete there. It is complete on the border of that space,
 *           because a triangle that reaches the border is not well inside. */
#ifndef VS_KERNEL_CLUSTER_H
#define VS_KERNEL_CLUSTER_H

#include "kernel/problem.h"
#include "kernel/mesh/bvh.h"
#include "kernel/expression.h"
#include "kernel/mesh/edge_uses.h"
#include "kernel/distinct_meshes.h"
#include "kernel/exact/interned.h"
#include "model/store/disjoint.h"

enum { VS_BESIDE_FLAT = 8 }; /* the edge is next to a triangle that the grid has made a line */

typedef struct {
  uint32_t v[3];   /* points, counter-clockwise seen from outside its leaf */
  uint32_t leaf;   /* an index in the problem */
  uint32_t plane, facet;
  uint32_t source; /* index of the triangle in its mesh */
  bool flip;       /* the leaf's outward normal is opposite to the plane's */
  uint8_t inner;   /* bit i: the edge from v[i] to the next vertex lies inside the facet; or VS_BESIDE_FLAT */
} vs_grid_triangle;

typedef struct {
  uint32_t leaf, place, plane, first; /* place: of the leaf in the cluster; first: index in facet_triangles, which end
                                       * at the next facet's first */
  uint32_t group;  /* union-find parent: a facet */
  bool flip, touched; /* touched: another facet meets it; the kernel copies the triangles of other facets */
} vs_facet;

typedef struct {
  uint32_t facet, place, plane, first, count; /* place: of its leaf; first, count: its corners, in their order seen from
                                               * outside of the leaf */
  bool flip;
  uint8_t inner;   /* for a triangle: the bits of vs_grid_triangle; else 0 */
} vs_patch;
typedef struct { int32_t at[3]; uint32_t point; } vs_patch_corner;

/* The points are in counter-clockwise order as seen from outside; line: VS_LINE plus an index in `lines`, or a
 * plane. */
typedef struct { uint32_t from, to, line; } vs_facet_side;
typedef struct { int32_t at[2][3]; } vs_line;        /* the ends of an edge of the input */
#define VS_LINE (UINT32_C(1) << 31)

typedef struct { uint32_t low, high; } vs_edge; /* vertices of the input */
/* The segment from p to q lies in the facet and in the plane; if p == q, it is a point. */
typedef struct { uint32_t facet, p, q, plane; } vs_facet_cut;

typedef struct { uint32_t leaf; int32_t delta; } vs_cover;
typedef struct {
  uint32_t plane;  /* VS_NONE: the face is a region */
  uint32_t cover, cover_count;
  uint32_t facet;  /* the facet whose triangles the face has, or VS_NONE; for a region: its index */
  uint32_t tag;
  uint32_t use, use_count; /* its boundary: a range of `uses` */
} vs_face;
typedef struct { uint32_t from, to, face; } vs_use;

typedef struct {
  uint32_t place, face;     /* place: of its leaf; face: its index in `faces`, set once the planes are arranged */
  uint32_t count, triangle; /* count: number of triangles; triangle: a large one, by its index in the mesh */
  bool open;                /* its surface continues in culled triangles */
} vs_region;
enum { VS_ARRANGED, VS_CULLED, VS_PLAIN }; /* the fate of a leaf's triangle */

/* The frame and the grid: world = frame * ((grid + offset) * step). */
typedef struct {
  vs_affine frame;
  bool framed;        /* false: frame is the identity */
  double scale, unit; /* step = unit / scale; both are exact if the step is decimal */
  double offset[3];   /* a whole number of steps */
} vs_grid;

/* A leaf of the cluster, at its place in `leaves`. */
typedef struct {
  const vs_part *part;
  uint32_t first;     /* index of its first vertex in `corners` */
  size_t first_triangle; /* index in `fate` */
  bool searched;      /* some of its triangles may be plain */
  vs_bvh_box box;         /* in steps */
  vs_affine to_local; /* from steps to the coordinates of its part; set for lids only */
  double margin;      /* two steps, in the part's coordinates */
  double middle[3];   /* the middle of the part, in steps. Next, squares of radii about it, in steps: places within the
                       * first (less the margin) are well inside, */
  double well_inside, outside; /* places beyond the second are outside; -1 and infinity if the placement is no
                                * similarity */
  bool lid;           /* convex, and settles the space inside it */
  bool star;          /* also on the grid: its triangles touch each other only in shared corners and edges */
  uint32_t lids_first, lids_count; /* a range of `lids`, from a multiple of four on: those whose boxes meet its box */
  uint32_t lines;     /* number of lines for which a large leaf was queried; after many of them, an index of its
                       * triangles exists */
  vs_bvh bvh;
  vs_bvh_box *bvh_boxes;
  size_t bvh_box_room;
} vs_placed;

typedef struct {
  const vs_kernel_problem *problem;
  const vs_parts *parts;
  const vs_expression *expression;
  const uint32_t *leaves;
  uint32_t leaf_count;
  const vs_bounds *gate; /* in the world; outside of it a gate of the expression is false; or NULL */
  vs_grid grid;
  VS_LIST(vs_placed) placed;
  int32_t (*corners)[3];  /* of the vertices of every leaf's mesh, on the grid */
  size_t corner_room;
  vs_bvh leaf_bvh;        /* over the boxes of `placed` */
  VS_LIST(vs_bvh_box) leaf_boxes;
  VS_LIST(uint32_t) lids; /* places in `leaves` */
  VS_LIST(vs_pack) lid_boxes; /* the boxes of `lids`, in packs of four */
  VS_LIST(_Atomic uint8_t) fate; /* of the triangles of every leaf's mesh; empty: all are arranged */
  size_t plain_count;
  VS_LIST(uint32_t) region_of;   /* of plain triangles */
  VS_LIST(vs_region) regions;
  VS_LIST(uint32_t) point_of;    /* of the vertices of every leaf's mesh: the point if the mesh has plain and other
                                  * triangles; else VS_NONE */
  vs_points_table points;
  vs_planes_table planes;
  VS_LIST(vs_grid_triangle) triangles;
  VS_LIST(vs_facet) facets;
  VS_LIST(uint32_t) facet_triangles;
  /* sheets[f]: the first facet of the sheet of facet f; empty if bends are kept */
  VS_LIST(uint32_t) sheets;
  uint32_t corner_points; /* number of the first points, which are corners of the leaves */
  size_t straightened;    /* number of bends removed from the result */
  VS_LIST(vs_patch) patches;
  VS_LIST(vs_patch_corner) patch_corners;
  VS_LIST(vs_bvh_box) boxes; /* of the patches */
  vs_bvh bvh;
  VS_LIST(vs_facet_cut) cuts;
  VS_LIST(vs_edge) edge_of; /* edge_of[p]: for a point that an intersection made, an edge that it lies on; else both
                             * ends are 0. It exists until the planes are arranged */
  VS_LIST(vs_face) faces;
  VS_LIST(vs_cover) covers;
  VS_LIST(vs_use) uses;
  vs_halves edges;       /* the uses by edge */
  VS_LIST(uint8_t) kept; /* kept[f]: 0: the face is not in the result; 1: its + side is outside; 2: its - side is
                          * outside */
  /* The members below serve the union of solids level by level (levels.c); else all are empty. */
  /* crowd: number of leaves that can be united so; crowded: too many cuts to be arranged at once. */
  size_t crowd;
  bool crowded;
  VS_LIST(vs_facet_side) sides;     /* facets[].first is an index in this list, not in facet_triangles */
  VS_LIST(vs_line) lines;     /* in a level: borrowed from the cluster */
  VS_LIST(uint32_t) use_line; /* use_line[i]: of uses[i] */
  uint32_t *solid;            /* union-find over the problem's leaves that have become one solid; or NULL */
  uint8_t *layered;           /* layered[i]: 1: the problem's leaf i is first united with others; or NULL */
  size_t solid_room, layered_room;
  const uint32_t *joining;    /* in a level: the solids that it unites, the only ones that count; or NULL */
  uint32_t joining_count;
  bool inspect;          /* the cluster is one leaf, which may be inside out: the next two members are set */
  VS_LIST(uint32_t) side_cell; /* 2 * face (+ side), 2 * face + 1 (- side) -> cell */
  VS_LIST(int32_t) wound;      /* wound[cell]: the leaf's winding number */
} vs_cluster;

/* Widens the box, in steps, to contain the point. The function rounds a fractional coordinate down and up. */
static inline void vs_box_add_point(vs_bvh_box *b, const vs_point *p) {
  for (int a = 0; a < 3; a++) {
    bool whole = vs_point_exact(p) && !(p->fixed[a] & (((int64_t)1 << VS_FIXED_BITS) - 1));
    int32_t low = (int32_t)(p->fixed[a] >> VS_FIXED_BITS), high = low + !whole;
    if (low < b->min[a]) b->min[a] = low;
    if (high > b->max[a]) b->max[a] = high;
  }
}

/* Returns the solid that contains the leaf so far, as the number of its first leaf. */
static inline uint32_t vs_solid_of(const vs_cluster *c, uint32_t leaf) {
  return c->solid ? vs_find(c->solid, leaf) : leaf;
}

/* Returns true if the cuts are too many to be arranged at once. Returns false if no leaves can be united before: see
 * levels.c. */
static inline bool vs_too_many(const vs_cluster *c, size_t cuts) {
  enum { EACH = 160, LEAST = 20000 };
  return c->crowd > 2 && !c->layered && cuts > EACH * c->facets.count + LEAST;
}

/* Returns true if the crossings in the planes arranged so far are too many. The kernel computes hidden crossings in
 * vain. Where most crossings show, as in a lattice of holes, levels would only repeat the work; therefore the limit is
 * much higher there. */
static inline bool vs_too_hidden(const vs_cluster *c, size_t cuts, size_t crossed, size_t hidden) {
  enum { EACH = 6, LEAST = 20000, SHOWN = 8 };
  return vs_too_many(c, crossed / SHOWN) || (c->crowd > 2 && !c->layered && hidden > EACH * cuts + LEAST &&
      hidden > crossed / 4 * 3);
}

/* Facets of a result, to which the kernel appends: facets and sides use the numbers of the cluster's points. A facet's
 * leaf is the tag of its face. */
typedef struct {
  VS_LIST(vs_facet) facets; /* has one more element at the end: it marks the end of the last facet's sides */
  VS_LIST(vs_facet_side) sides;
} vs_outlines;
void vs_cluster_free(vs_kernel *k, vs_cluster *c);

/* Bit b of masks[vertex]: the leaf's vertex is well inside its b-th lid, or (the last six bits) beyond one side of the
 * gate. */
enum { VS_LIDS = 48 };

/* The order of faces around the edge from `low` to `high`: the sign and the axes of the two coordinates (x, y) of their
 * normals that are compared; see classify.c. */
typedef struct { int64_t x, y; uint32_t ccw, cw; } vs_around; /* ccw, cw: values of the caller */

#endif
