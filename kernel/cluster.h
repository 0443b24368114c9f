/* Defines the state of one cluster: its leaves, converted to triangles with integer coordinates, and the arrangement of
 * these triangles.
 *
 * Notation.
 *   facet   a maximal set of coplanar triangles of one leaf that edges connect; it is cut and classified in one piece
 *   sheet   connected facets of one leaf that nearly lie in one plane: the grid has split a planar facet of the input
 *           into them
 *   bend    a corner of the result where a cut through a sheet passes from one facet of the sheet to the next
 *   group   facets of one plane that touch each other; the kernel arranges a group together
 *   face    a region of the arrangement in one plane that nothing cuts; the plane's normal points to its + side
 *   cover   of a face, for each leaf whose surface contains it: w(-side) = w(+side) + delta, where w is the leaf's
 *           winding number (inside: w > 0)
 *   use     a boundary edge of a face; its direction has the face on the left, seen from the + side
 *   cell    a region of space, represented by the sides of faces that bound it
 *   plain   of a triangle: no other leaf touches it; it has neither a facet nor a face (untouched_triangles.c)
 *   region  connected plain triangles of a leaf: one face, which lies in no plane; its + side is outside of the leaf
 *   patch   the part of a facet that is tested against others as a unit: a whole convex facet, or one triangle of
 *           another facet
 *   side    a border edge of a facet that is defined by its borders instead of its triangles: see levels.c
 *   line    of a side: the edge of the input that contains the side, or the second plane that contains it
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

enum { VS_BESIDE_FLAT = 8 }; /* bit of `inner`: an edge of the triangle borders a triangle whose corners the grid has
                              * moved onto one line */

typedef struct {
  uint32_t v[3];   /* numbers of the corners in `points`, counter-clockwise as seen from outside its leaf */
  uint32_t leaf;   /* number of the triangle's leaf in the problem */
  uint32_t plane, facet;
  uint32_t source; /* index of the triangle in the mesh of its leaf */
  bool flip;       /* true if the leaf's outward normal is opposite to the plane's normal */
  uint8_t inner;   /* bit i: the edge from v[i] to the next corner lies inside the facet, between two of its triangles;
                    * and the bit VS_BESIDE_FLAT */
} vs_grid_triangle;

typedef struct {
  uint32_t leaf, place, plane, first; /* place: index of the leaf in the cluster's `placed`; first: index of the facet's
                                       * first triangle in facet_triangles; the facet ends at the `first` of the next
                                       * facet */
  uint32_t group;  /* parent in a union-find structure whose elements are facets */
  bool flip, touched; /* touched: another facet intersects or touches this one; the kernel copies the triangles of all
                       * other facets */
} vs_facet;

typedef struct {
  uint32_t facet, place, plane, first, count; /* place: index of the patch's leaf in `placed`; first, count: range of
                                               * the patch's corners in patch_corners, counter-clockwise as seen from
                                               * outside the leaf */
  bool flip;
  uint8_t inner;   /* for a patch that is a triangle: the bits of vs_grid_triangle's `inner`; for any other patch: 0 */
} vs_patch;
typedef struct { int32_t at[3]; uint32_t point; } vs_patch_corner;

/* A border edge of a facet, from one point to another, counter-clockwise as seen from outside the leaf. line: VS_LINE
 * plus an index in `lines`, or the number of a plane. */
typedef struct { uint32_t from, to, line; } vs_facet_side;
typedef struct { int32_t at[2][3]; } vs_line;        /* the two ends of an edge of the input, in steps */
#define VS_LINE (UINT32_C(1) << 31)

typedef struct { uint32_t low, high; } vs_edge; /* an edge between two vertices of the input, as indices with low <
                                                 * high */
/* A segment from point p to point q that lies in the facet and in the plane. If p == q, it is a single point. */
typedef struct { uint32_t facet, p, q, plane; } vs_facet_cut;

typedef struct { uint32_t leaf; int32_t delta; } vs_cover;
typedef struct {
  uint32_t plane;  /* number of the face's plane; VS_NONE: the face is a region of plain triangles */
  uint32_t cover, cover_count;
  uint32_t facet;  /* index of the facet if the face consists of a facet's triangles; index of the region if the face is
                    * a region; else VS_NONE */
  uint32_t tag;
  uint32_t use, use_count; /* range of the face's boundary edges in `uses` */
} vs_face;
typedef struct { uint32_t from, to, face; } vs_use;

typedef struct {
  uint32_t place, face;     /* place: index of the region's leaf in `placed`; face: the region's index in `faces`, set
                             * after the planes are arranged */
  uint32_t count, triangle; /* count: number of the region's triangles; triangle: index in the mesh of a large triangle
                             * of the region */
  bool open;                /* true if culled triangles continue the surface of the region */
} vs_region;
enum { VS_ARRANGED, VS_CULLED, VS_PLAIN }; /* how the kernel treats a leaf's triangle */

/* The frame and the grid of the cluster: world = frame * ((grid + offset) * step). */
typedef struct {
  vs_affine frame;
  bool framed;        /* true if `frame` is not the identity */
  double scale, unit; /* step = unit / scale; unit and scale are exact if the step is a decimal number */
  double offset[3];   /* position of the grid's origin, in whole steps */
} vs_grid;

/* A leaf of the cluster. placed[i] belongs to the leaf with the problem's number leaves[i]. */
typedef struct {
  const vs_part *part;
  uint32_t first;     /* index of the leaf's first vertex in `corners` */
  size_t first_triangle; /* index of the leaf's first triangle in `fate` */
  bool searched;      /* true if some of the leaf's triangles may be plain */
  vs_bvh_box box;         /* bounding box of the leaf, in steps */
  vs_affine to_local; /* map from steps to the coordinates of the leaf's part; set for lids only */
  double margin;      /* length of two steps in the part's coordinates */
  double middle[3];   /* middle of the leaf's part, in steps; the next two members are squared distances from it */
  double well_inside, outside; /* A point closer to the middle than sqrt(well_inside) is more than two steps inside the
                                * leaf. A point farther than sqrt(outside) is outside. The values are -1 and infinity if
                                * the placement is not a similarity. */
  bool lid;           /* true if the leaf is convex and the space inside it is settled */
  bool star;          /* true if the leaf is a star, and its triangles touch each other only in shared corners and edges
                       * on the grid, too */
  uint32_t lids_first, lids_count; /* range in `lids` of the lids whose boxes intersect the box of this leaf; it begins
                                    * at a multiple of four */
  uint32_t lines;     /* number of lines that were tested against this leaf if it is large; after many lines, an index
                       * of its triangles is built */
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
  const vs_bounds *gate; /* bounds in world coordinates outside of which a gate of the expression is false; NULL: there
                          * is no gate */
  vs_grid grid;
  VS_LIST(vs_placed) placed;
  int32_t (*corners)[3];  /* coordinates of the vertices of every leaf's mesh, in steps */
  size_t corner_room;
  vs_bvh leaf_bvh;        /* tree of the boxes of `placed` */
  VS_LIST(vs_bvh_box) leaf_boxes;
  VS_LIST(uint32_t) lids; /* indices of the lids in `leaves` */
  VS_LIST(vs_pack) lid_boxes; /* the boxes of `lids`, in packs of four */
  VS_LIST(_Atomic uint8_t) fate; /* fate (VS_ARRANGED, VS_CULLED or VS_PLAIN) of every triangle of every leaf's mesh; if
                                  * empty, all are arranged */
  size_t plain_count;
  VS_LIST(uint32_t) region_of;   /* index in `regions` for each plain triangle */
  VS_LIST(vs_region) regions;
  VS_LIST(uint32_t) point_of;    /* for each vertex of every leaf's mesh: its number in `points`, if the mesh has plain
                                  * and other triangles; else VS_NONE */
  vs_points_table points;
  vs_planes_table planes;
  VS_LIST(vs_grid_triangle) triangles;
  VS_LIST(vs_facet) facets;
  VS_LIST(uint32_t) facet_triangles;
  /* sheets[f]: the first facet of the sheet that contains facet f; empty if bends are kept */
  VS_LIST(uint32_t) sheets;
  uint32_t corner_points; /* number of points that are corners of the leaves; these points come first in `points` */
  size_t straightened;    /* number of bends removed from the result */
  VS_LIST(vs_patch) patches;
  VS_LIST(vs_patch_corner) patch_corners;
  VS_LIST(vs_bvh_box) boxes; /* bounding boxes of the patches, in steps */
  vs_bvh bvh;
  VS_LIST(vs_facet_cut) cuts;
  VS_LIST(vs_edge) edge_of; /* edge_of[p]: if point p is an intersection, an edge of the input that contains it; else
                             * both ends are 0. The list is freed after the planes are arranged */
  VS_LIST(vs_face) faces;
  VS_LIST(vs_cover) covers;
  VS_LIST(vs_use) uses;
  vs_halves edges;       /* index of the uses at each edge */
  VS_LIST(uint8_t) kept; /* kept[f]: 0: face f is not in the result; 1: outside is on its + side; 2: outside is on its -
                          * side */
  /* The members below serve the union of solids level by level (levels.c). Without levels they are empty. */
  /* crowd: number of leaves that can be united in levels. crowded: true if there are too many cuts to arrange them all
   * in one step. */
  size_t crowd;
  bool crowded;
  VS_LIST(vs_facet_side) sides;     /* border edges of the facets; with levels, facets[].first is an index in this list,
                                     * not in facet_triangles */
  VS_LIST(vs_line) lines;     /* the lines of `sides`; within a level, the arrays belong to the enclosing cluster */
  VS_LIST(uint32_t) use_line; /* use_line[i]: line of uses[i], as in vs_facet_side */
  uint32_t *solid;            /* union-find structure over the problem's leaves: a set contains leaves that are already
                               * united to one solid; NULL: no levels */
  uint8_t *layered;           /* layered[i]: 1 if leaf i of the problem is united with other leaves in levels; NULL: no
                               * levels */
  size_t solid_room, layered_room;
  const uint32_t *joining;    /* in a level: the set of solids that the level unites; all other solids are ignored;
                               * NULL: no levels */
  uint32_t joining_count;
  bool inspect;          /* true if the cluster is one leaf that may be inside out; side_cell and wound are then set */
  VS_LIST(uint32_t) side_cell; /* cell on each side of a face: [2 * face] for the + side, [2 * face + 1] for the -
                                * side */
  VS_LIST(int32_t) wound;      /* wound[cell]: winding number of the leaf in that cell */
} vs_cluster;

/* Enlarges the box, in steps, so that it contains the point. A fractional coordinate is rounded both down and up. */
static inline void vs_box_add_point(vs_bvh_box *b, const vs_point *p) {
  for (int a = 0; a < 3; a++) {
    bool whole = vs_point_exact(p) && !(p->fixed[a] & (((int64_t)1 << VS_FIXED_BITS) - 1));
    int32_t low = (int32_t)(p->fixed[a] >> VS_FIXED_BITS), high = low + !whole;
    if (low < b->min[a]) b->min[a] = low;
    if (high > b->max[a]) b->max[a] = high;
  }
}

/* Returns the solid that currently contains the leaf, identified by the number of its first leaf. */
static inline uint32_t vs_solid_of(const vs_cluster *c, uint32_t leaf) {
  return c->solid ? vs_find(c->solid, leaf) : leaf;
}

/* Returns true if there are too many cuts to arrange them in one step, and leaves can be united in levels first: see
 * levels.c. */
static inline bool vs_too_many(const vs_cluster *c, size_t cuts) {
  enum { EACH = 160, LEAST = 20000 };
  return c->crowd > 2 && !c->layered && cuts > EACH * c->facets.count + LEAST;
}

/* Returns true if too many crossings of cuts in the planes arranged so far are hidden inside the union. The work on
 * hidden crossings is wasted, and levels avoid it. Where most crossings appear in the result, as in a lattice of holes,
 * levels would only repeat the work. The limit is therefore much higher there. */
static inline bool vs_too_hidden(const vs_cluster *c, size_t cuts, size_t crossed, size_t hidden) {
  enum { EACH = 6, LEAST = 20000, SHOWN = 8 };
  return vs_too_many(c, crossed / SHOWN) || (c->crowd > 2 && !c->layered && hidden > EACH * cuts + LEAST &&
      hidden > crossed / 4 * 3);
}

/* Facets of a result; the kernel appends to them. Facets and sides refer to points by the cluster's numbers. The leaf
 * of a facet is set to the tag of its face. */
typedef struct {
  VS_LIST(vs_facet) facets; /* the last element only marks the end of the sides of the facet before it */
  VS_LIST(vs_facet_side) sides;
} vs_outlines;
void vs_cluster_free(vs_kernel *k, vs_cluster *c);

/* Number of lids with a bit in masks[vertex]. Bit b is set if the vertex is well inside the b-th lid of its leaf. The
 * last six bits are set if the vertex lies beyond the corresponding side of the gate's bounds. */
enum { VS_LIDS = 48 };

/* A face in the cyclic order of faces around an edge. x and y are two coordinates of the face's normal; classify.c
 * chooses their axes and signs by the edge. */
typedef struct { int64_t x, y; uint32_t ccw, cw; } vs_around; /* ccw, cw: numbers that the caller attaches to the face,
                                                               * one for each of its two sides */

#endif
