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

enum { VS_BESIDE_FLAT = 8 }; /* bit of vs_grid_triangle's `inner`: the triangle has a neighbour across an edge whose
                              * corners the grid has moved onto one line */

typedef struct {
  uint32_t v[3];   /* numbers of the triangle's corners in `points`, counter-clockwise as seen from outside the leaf */
  uint32_t leaf;   /* number of the triangle's leaf in the kernel's problem */
  uint32_t plane, facet;
  uint32_t source; /* index of the triangle in its leaf's mesh */
  bool flip;       /* true if the outward normal of the leaf is opposite to the normal of the plane */
  uint8_t inner;   /* bit i: the edge from v[i] to the next corner lies between two triangles of the facet; also the bit
                    * VS_BESIDE_FLAT */
} vs_grid_triangle;

typedef struct {
  uint32_t leaf, place, plane, first; /* place: index of the facet's leaf in `placed`; first: index of the facet's first
                                       * triangle in facet_triangles; the next facet's `first` marks the end */
  uint32_t group;  /* parent of the facet in a union-find structure of touching facets in one plane */
  bool flip, touched; /* flip: true if the leaf's outward normal is opposite to the plane's normal; touched: true if
                       * another facet intersects or touches this one. If it is false, the kernel copies the facet's
                       * triangles. */
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
typedef struct { int32_t at[2][3]; } vs_line;        /* the two ends of an edge of the input mesh, in grid steps */
#define VS_LINE (UINT32_C(1) << 31)

typedef struct { uint32_t low, high; } vs_edge; /* an edge of the input mesh: the point numbers of its two ends, with
                                                 * low < high */
/* A segment from point p to point q, in which a facet is cut by the plane with the number `plane`. If p == q, the cut
 * is a single point. */
typedef struct { uint32_t facet, p, q, plane; } vs_facet_cut;

typedef struct { uint32_t leaf; int32_t delta; } vs_cover;
typedef struct {
  uint32_t plane;  /* number of the plane that contains the face; VS_NONE for a region of triangles that nothing
                    * touches, which may be curved */
  uint32_t cover, cover_count;
  uint32_t facet;  /* index of the facet, or of the region of untouched triangles, that the face covers completely;
                    * VS_NONE if the face is only a part of facets */
  uint32_t tag;
  uint32_t use, use_count; /* range of the face's boundary edges in `uses` */
} vs_face;
typedef struct { uint32_t from, to, face; } vs_use;

typedef struct {
  uint32_t place, face;     /* place: index of the region's leaf in `placed`; face: index of the region's face in
                             * `faces`, set after the planes are arranged */
  uint32_t count, triangle; /* count: number of triangles in the region; triangle: index, in the leaf's mesh, of a large
                             * triangle of the region */
  bool open;                /* true if triangles beside the region were removed because another leaf hides them */
} vs_region;
enum { VS_ARRANGED, VS_CULLED, VS_PLAIN }; /* How the kernel treats a triangle: it is cut against others, removed
                                            * because another leaf hides it, or copied because nothing touches it. */

/* The frame and the grid of the cluster: world = frame * ((grid + offset) * step). */
typedef struct {
  vs_affine frame;
  bool framed;        /* true if `frame` is a rotation or another map than the identity */
  double scale, unit; /* Width of a grid step is unit / scale. Both numbers are exact if the step is a decimal
                       * number. */
  double offset[3];   /* position of the grid's origin, in whole steps */
} vs_grid;

/* A leaf (placed mesh) of the cluster. placed[i] belongs to the leaf with the number leaves[i] in the problem. */
typedef struct {
  const vs_part *part;
  uint32_t first;     /* index of the leaf's first vertex in `corners` */
  size_t first_triangle; /* index of the leaf's first triangle in `fate` */
  bool searched;      /* true if the kernel searches this leaf for untouched triangles */
  vs_bvh_box box;         /* bounding box of the leaf, in grid steps */
  vs_affine to_local; /* map from grid steps to the coordinates of the leaf's part; set only if the member `lid` is
                       * true */
  double margin;      /* length of two grid steps in the coordinates of the leaf's part */
  double middle[3];   /* middle of the leaf's part, in grid steps, from which the squared distances well_inside and
                       * outside are measured */
  double well_inside, outside; /* A point closer to the middle than sqrt(well_inside) is more than two steps inside the
                                * leaf. A point farther than sqrt(outside) is outside of the leaf. The values are -1 and
                                * infinity if the placement does not scale equally in all directions. */
  bool lid;           /* true if the leaf is convex and decides alone whether places inside it belong to the result */
  bool star;          /* true if the leaf is a star (its middle sees every triangle from inside) and does not intersect
                       * itself on the grid */
  uint32_t lids_first, lids_count; /* Range in the cluster's list `lids` of the convex leaves near this leaf that alone
                                    * decide the result inside them. It begins at a multiple of four. */
  uint32_t lines;     /* number of rays tested against this leaf, counted for large leaves only; after many rays, the
                       * kernel builds a tree of the boxes of the leaf's triangles */
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
  const vs_bounds *gate; /* bounds in world coordinates outside of which the result is empty; NULL if there are none */
  vs_grid grid;
  VS_LIST(vs_placed) placed;
  int32_t (*corners)[3];  /* coordinates, in grid steps, of the vertices of all leaves' meshes */
  size_t corner_room;
  vs_bvh leaf_bvh;        /* tree of the bounding boxes of all leaves */
  VS_LIST(vs_bvh_box) leaf_boxes;
  VS_LIST(uint32_t) lids; /* for each leaf in turn: the indices of the lids (convex, deciding leaves) near it */
  VS_LIST(vs_pack) lid_boxes; /* bounding boxes of the leaves in `lids`, in packs of four */
  VS_LIST(_Atomic uint8_t) fate; /* fate[t]: treatment of triangle t, numbered over the meshes of all leaves:
                                  * VS_ARRANGED, VS_CULLED or VS_PLAIN. If the list is empty, all triangles are
                                  * arranged. */
  size_t plain_count;
  VS_LIST(uint32_t) region_of;   /* region_of[t]: for untouched triangle t, the index in `regions` of the region that
                                  * contains it */
  VS_LIST(vs_region) regions;
  VS_LIST(uint32_t) point_of;    /* point_of[v]: number in `points` of vertex v, counted over the meshes of all leaves.
                                  * Set only if the vertex's mesh has untouched triangles and others, else VS_NONE. */
  vs_points_table points;
  vs_planes_table planes;
  VS_LIST(vs_grid_triangle) triangles;
  VS_LIST(vs_facet) facets;
  VS_LIST(uint32_t) facet_triangles;
  /* sheets[f]: first facet of the sheet (facets that the grid split from one plane) that contains facet f; empty if the
   * result keeps bends */
  VS_LIST(uint32_t) sheets;
  uint32_t corner_points; /* number of points that are corners of the leaves; these points come first in `points` */
  size_t straightened;    /* number of bends that were removed from the result; a bend is a corner where a cut passes
                           * between two facets of one sheet */
  VS_LIST(vs_patch) patches;
  VS_LIST(vs_patch_corner) patch_corners;
  VS_LIST(vs_bvh_box) boxes; /* bounding boxes of the patches, in grid steps */
  vs_bvh bvh;
  VS_LIST(vs_facet_cut) cuts;
  VS_LIST(vs_edge) edge_of; /* edge_of[p]: an edge of the input that contains point p, where triangles intersect; both
                             * ends are 0 if there is none. The list is freed after the planes are arranged. */
  VS_LIST(vs_face) faces;
  VS_LIST(vs_cover) covers;
  VS_LIST(vs_use) uses;
  vs_halves edges;       /* index that finds the faces' boundary edges between two given points */
  VS_LIST(uint8_t) kept; /* kept[f]: 0 if face f is not part of the result; 1 if the outside of the result is on the +
                          * side of the face; 2 if it is on the - side */
  /* The members below are used while solids are united two by two (levels.c). Otherwise they are empty. */
  /* crowd: number of leaves that can be united two by two. crowded: true if all facets together have too many cuts to
   * be cut against each other at once. */
  size_t crowd;
  bool crowded;
  VS_LIST(vs_facet_side) sides;     /* border edges of the facets; while solids are united two by two, a facet's member
                                     * `first` is an index in this list, not in facet_triangles */
  VS_LIST(vs_line) lines;     /* edges of the input that contain border edges of facets; while two solids are united,
                               * the array belongs to the enclosing cluster */
  VS_LIST(uint32_t) use_line; /* use_line[i]: number of the line that contains uses[i], coded as the member `line` of
                               * vs_facet_side */
  uint32_t *solid;            /* union-find structure over the problem's leaves; each set contains the leaves that have
                               * been united to one solid; NULL unless solids are united two by two */
  uint8_t *layered;           /* layered[i]: 1 if leaf i of the problem is first united with others two by two; NULL
                               * unless solids are united two by two */
  size_t solid_room, layered_room;
  const uint32_t *joining;    /* numbers of the solids that are united now, while all others are ignored; NULL
                               * otherwise */
  uint32_t joining_count;
  bool inspect;          /* true if the kernel only inspects whether one leaf is inside out; it then sets side_cell and
                          * wound */
  VS_LIST(uint32_t) side_cell; /* cells (connected pieces of space) beside a face: element [2 * face] is the number of
                                * the cell on its + side, [2 * face + 1] on its - side */
  VS_LIST(int32_t) wound;      /* wound[c]: winding number of the only leaf (placed mesh) in cell c (connected piece of
                                * space) */
} vs_cluster;

/* Enlarges box b, in grid steps, so that it contains point p. A fractional coordinate is rounded both down and up. */
static inline void vs_box_add_point(vs_bvh_box *b, const vs_point *p) {
  for (int a = 0; a < 3; a++) {
    bool whole = vs_point_exact(p) && !(p->fixed[a] & (((int64_t)1 << VS_FIXED_BITS) - 1));
    int32_t low = (int32_t)(p->fixed[a] >> VS_FIXED_BITS), high = low + !whole;
    if (low < b->min[a]) b->min[a] = low;
    if (high > b->max[a]) b->max[a] = high;
  }
}

/* Returns the solid that currently contains the leaf. A solid is identified by the number of its first leaf. */
static inline uint32_t vs_solid_of(const vs_cluster *c, uint32_t leaf) {
  return c->solid ? vs_find(c->solid, leaf) : leaf;
}

/* Returns true if there are too many cuts to arrange all facets at once. Leaves should then be united two by two first,
 * which levels.c does. */
static inline bool vs_too_many(const vs_cluster *c, size_t cuts) {
  enum { EACH = 160, LEAST = 20000 };
  return c->crowd > 2 && !c->layered && cuts > EACH * c->facets.count + LEAST;
}

/* Returns true if leaves should be united two by two first, because too many crossings of cuts are hidden inside the
 * union. The number of cuts is `cuts`; `crossed` counts their crossings, and `hidden` the hidden crossings. */
static inline bool vs_too_hidden(const vs_cluster *c, size_t cuts, size_t crossed, size_t hidden) {
  enum { EACH = 6, LEAST = 20000, SHOWN = 8 };
  return vs_too_many(c, crossed / SHOWN) || (c->crowd > 2 && !c->layered && hidden > EACH * cuts + LEAST &&
      hidden > crossed / 4 * 3);
}

/* A list of facets with their border edges. The border edges contain numbers of the cluster's points. The `leaf` of a
 * facet is the tag of the face of which it was a part. */
typedef struct {
  VS_LIST(vs_facet) facets; /* facets; the last element only marks the end of the border edges of the facet before it */
  VS_LIST(vs_facet_side) sides;
} vs_outlines;
void vs_cluster_free(vs_kernel *k, vs_cluster *c);

/* Number of the bits in a vertex's mask that belong to convex leaves (lids) near the vertex's leaf. Bit b is set if the
 * vertex is at least two steps inside lid b. The last six bits show that the vertex lies beyond a side of the bounds in
 * vs_cluster's `gate`. */
enum { VS_LIDS = 48 };

/* A face in the cyclic order of faces around an edge. x, y: two coordinates of the face's normal, whose axes and signs
 * classify.c chooses for the edge. */
typedef struct { int64_t x, y; uint32_t ccw, cw; } vs_around; /* ccw, cw: numbers that the caller gives to the face's
                                                               * sides in counter-clockwise and clockwise direction */

#endif
