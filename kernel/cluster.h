/* Owns the state of one cluster: the leaves that touch, as integer triangles, and the arrangement that grows from them.
 *
 * Notation.
 *   facet   a maximal set of coplanar triangles of one leaf that hang together by edges; cut and classified as one
 *   sheet   facets of one leaf that hang together and nearly lie in one plane: a planar facet of the input, of which
 *   the
 *           grid has made several
 *   bend    a corner of the result where a cut through a sheet passes from one of its facets to the next
 *   group   facets of one plane that touch: they are arranged together
 *   face    a region of the arrangement in one plane, which nothing cuts; its + side is where the plane's normal points
 *   cover   of a face, for each leaf that has it: w(-side) = w(+side) + delta, where w is the leaf's winding number
 *           (inside: w > 0)
 *   use     a boundary edge of a face, directed so that the face lies left of it as seen from the + side
 *   cell    a region of space: a set of sides of faces
 *   plain   of a triangle: untouched by other leaves; it has neither facet nor face of its own (untouched_triangles.c)
 *   region  plain triangles of a leaf that hang together: one face, which lies in no plane; its + side is outside of
 *           the leaf
 *   patch   the part of a facet that is tested against others in one piece: all of a convex facet, else one of its
 *           triangles
 *   side    a border edge of a facet, where facets are given by their borders and not by triangles: see levels.c
 *   line    of a side: the edge of the input that it lies on, or the second plane that it lies in
 *   settled of places inside a leaf that makes the whole true (or false) by itself, or outside of a gate: nothing
 *           there can show. Triangles and cuts that are well inside settled space are left out from the start, so
 *           the arrangement is not complete there. It is complete on the border of that space, because a triangle
 *           that reaches the border is not well inside. */
#ifndef VS_KERNEL_CLUSTER_H
#define VS_KERNEL_CLUSTER_H

#include "kernel/problem.h"
#include "kernel/mesh/bvh.h"
#include "kernel/expression.h"
#include "kernel/mesh/edge_uses.h"
#include "kernel/distinct_meshes.h"
#include "kernel/exact/interned.h"
#include "model/store/disjoint.h"

enum { VS_BESIDE_FLAT = 8 }; /* next to a triangle that the grid has made a line */

typedef struct {
  uint32_t v[3];   /* counter-clockwise seen from outside its leaf */
  uint32_t leaf;   /* of the problem */
  uint32_t plane, facet;
  uint32_t source; /* which of its mesh's triangles */
  bool flip;       /* the leaf's outward normal is the plane's reversed */
  uint8_t inner;   /* bit i: the edge from v[i] to the next lies inside the facet; VS_BESIDE_FLAT */
} vs_grid_triangle;

typedef struct {
  uint32_t leaf, place, plane, first; /* place: of the leaf in the cluster; first: into facet_triangles, up to the next
                                       * facet's */
  uint32_t group;  /* union-find parent, a facet */
  bool flip, touched; /* touched: something meets it; else its triangles are copied */
} vs_facet;

typedef struct {
  uint32_t facet, place, plane, first, count; /* place: of its leaf; corners in order as seen from outside of that */
  bool flip;
  uint8_t inner;   /* of a triangle, as above; else 0 */
} vs_patch;
typedef struct { int32_t at[3]; uint32_t point; } vs_patch_corner;

/* counter-clockwise as seen from outside; line: VS_LINE and one of `lines`, or a plane */
typedef struct { uint32_t from, to, line; } vs_facet_side;
typedef struct { int32_t at[2][3]; } vs_line;        /* an edge of the input, by its ends */
#define VS_LINE (UINT32_C(1) << 31)

typedef struct { uint32_t low, high; } vs_edge; /* input vertices */
/* p to q lies in the facet, and in plane; p == q: a point */
typedef struct { uint32_t facet, p, q, plane; } vs_facet_cut;

typedef struct { uint32_t leaf; int32_t delta; } vs_cover;
typedef struct {
  uint32_t plane;  /* VS_NONE: it is a region */
  uint32_t cover, cover_count;
  uint32_t facet;  /* whose triangles it is, or VS_NONE; or which region */
  uint32_t tag;
  uint32_t use, use_count; /* its boundary: into uses, in one piece */
} vs_face;
typedef struct { uint32_t from, to, face; } vs_use;

typedef struct {
  uint32_t place, face;     /* of its leaf; what it is among the faces, once planes are arranged */
  uint32_t count, triangle; /* how many triangles; a large one, of its mesh */
  bool open;                /* its surface goes on where things were left out */
} vs_region;
enum { VS_ARRANGED, VS_CULLED, VS_PLAIN }; /* what becomes of a leaf's triangle */

/* the frame and grid: world = frame * ((grid + offset) * step) */
typedef struct {
  vs_affine frame;
  bool framed;        /* else frame is the identity */
  double scale, unit; /* step = unit / scale, both of them exact where the step is decimal */
  double offset[3];   /* whole steps */
} vs_grid;

/* A leaf of the cluster, by its place in `leaves`. */
typedef struct {
  const vs_part *part;
  uint32_t first;     /* of its mesh's vertices, in `corners` */
  size_t first_triangle; /* in `fate` */
  bool searched;      /* some may be plain */
  vs_bvh_box box;         /* in steps */
  vs_affine to_local; /* steps -> where its part lies; filled where it is a lid */
  double margin;      /* two steps, there */
  double middle[3];   /* of the part, in steps; and squares of radii about it, in steps: within the first (less the
                       * margin) is well inside, */
  double well_inside, outside; /* beyond the second outside; -1 and infinity where the placement is no similarity */
  bool lid;           /* convex, and settles what is inside of it */
  bool star;          /* also on the grid: no two of its triangles touch but in corners and edges they share */
  uint32_t lids_first, lids_count; /* into `lids`, from a multiple of four on: those whose boxes meet its own */
  uint32_t lines;     /* that a large leaf was asked for; and the index of its triangles, made when they were many */
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
  const vs_bounds *gate; /* in the world: outside of it a gate is false; or NULL */
  vs_grid grid;
  VS_LIST(vs_placed) placed;
  int32_t (*corners)[3];  /* of every leaf's mesh, on the grid */
  size_t corner_room;
  vs_bvh leaf_bvh;        /* over placed[].box */
  VS_LIST(vs_bvh_box) leaf_boxes;
  VS_LIST(uint32_t) lids; /* places in `leaves` */
  VS_LIST(vs_pack) lid_boxes; /* theirs, by four */
  VS_LIST(_Atomic uint8_t) fate; /* of every leaf's mesh's triangles; empty: all are arranged */
  size_t plain_count;
  VS_LIST(uint32_t) region_of;   /* of those that are plain */
  VS_LIST(vs_region) regions;
  VS_LIST(uint32_t) point_of;    /* of every leaf's mesh's vertices, where some triangles are plain and others are not;
                                  * else VS_NONE */
  vs_points_table points;
  vs_planes_table planes;
  VS_LIST(vs_grid_triangle) triangles;
  VS_LIST(vs_facet) facets;
  VS_LIST(uint32_t) facet_triangles;
  /* of a facet: the first of the facets of its leaf that hang together and nearly lie in one plane; empty where bends
   * are kept */
  VS_LIST(uint32_t) sheets;
  uint32_t corner_points; /* the first points are corners of the leaves */
  size_t straightened;    /* bends that the result has lost */
  VS_LIST(vs_patch) patches;
  VS_LIST(vs_patch_corner) patch_corners;
  VS_LIST(vs_bvh_box) boxes; /* of the patches */
  vs_bvh bvh;
  VS_LIST(vs_facet_cut) cuts;
  VS_LIST(vs_edge) edge_of; /* of a point: one that it lies on, where meeting made it; else both ends are 0. Until
                             * planes are arranged */
  VS_LIST(vs_face) faces;
  VS_LIST(vs_cover) covers;
  VS_LIST(vs_use) uses;
  vs_halves edges;       /* the uses by edge */
  VS_LIST(uint8_t) kept; /* a face: 0 no, 1 outside is its + side, 2 its - side */
  /* Where solids are united level by level (levels.c); else all of these are empty. */
  /* leaves that could be united so; and whether what meets is too much to be arranged at once */
  size_t crowd;
  bool crowded;
  VS_LIST(vs_facet_side) sides;     /* facets[].first leads into these, not into facet_triangles */
  VS_LIST(vs_line) lines;     /* in a level: the cluster's, borrowed */
  VS_LIST(uint32_t) use_line; /* of each of the uses */
  uint32_t *solid;            /* union-find over the problem's leaves: which have become one solid; or NULL */
  uint8_t *layered;           /* of the problem's leaves: 1 it is united with others first; or NULL */
  size_t solid_room, layered_room;
  const uint32_t *joining;    /* a level: the solids that are united here, and nothing else counts; or NULL */
  uint32_t joining_count;
  bool inspect;          /* of one leaf, which may be inside out: the next two are wanted */
  VS_LIST(uint32_t) side_cell; /* 2 * face (+ side), 2 * face + 1 (- side) -> cell */
  VS_LIST(int32_t) wound;      /* of a cell: the leaf's winding number */
} vs_cluster;

/* Widens the box, in steps, to hold the point. A coordinate that is no whole step is less than the greatest one. */
static inline void vs_box_add_point(vs_bvh_box *b, const vs_point *p) {
  for (int a = 0; a < 3; a++) {
    bool whole = vs_point_exact(p) && !(p->fixed[a] & (((int64_t)1 << VS_FIXED_BITS) - 1));
    int32_t low = (int32_t)(p->fixed[a] >> VS_FIXED_BITS), high = low + !whole;
    if (low < b->min[a]) b->min[a] = low;
    if (high > b->max[a]) b->max[a] = high;
  }
}

/* Which solid the leaf is part of by now: the first leaf of it. */
static inline uint32_t vs_solid_of(const vs_cluster *c, uint32_t leaf) {
  return c->solid ? vs_find(c->solid, leaf) : leaf;
}

/* Are so many cuts too many to be arranged at once? Never where no leaves can be united before: see levels.c. */
static inline bool vs_too_many(const vs_cluster *c, size_t cuts) {
  enum { EACH = 160, LEAST = 20000 };
  return c->crowd > 2 && !c->layered && cuts > EACH * c->facets.count + LEAST;
}

/* The same of the planes that have been arranged so far. Crossings of cuts that are hidden are work in vain; where most
 * show, as in a lattice of holes, levels would only do them several times, and it takes very many to be too many. */
static inline bool vs_too_hidden(const vs_cluster *c, size_t cuts, size_t crossed, size_t hidden) {
  enum { EACH = 6, LEAST = 20000, SHOWN = 8 };
  return vs_too_many(c, crossed / SHOWN) || (c->crowd > 2 && !c->layered && hidden > EACH * cuts + LEAST &&
      hidden > crossed / 4 * 3);
}

/* Keeps a result as facets of its own: appends to sides and facets, in the numbers of the cluster's points; a facet's
 * leaf is its face's tag. */
typedef struct {
  VS_LIST(vs_facet) facets; /* one more behind them: where the last one's sides end */
  VS_LIST(vs_facet_side) sides;
} vs_outlines;
void vs_cluster_free(vs_kernel *k, vs_cluster *c);

/* Bit b of masks[vertex]: the leaf's vertex is well inside its b-th lid, or (the last six bits) beyond one side of the
 * gate. */
enum { VS_LIDS = 48 };

/* The order of faces around the edge from `low` to `high`: sign and axes in which (x, y) of their normals is looked at;
 * see classify.c. */
typedef struct { int64_t x, y; uint32_t ccw, cw; } vs_around; /* ccw, cw: the user's */

#endif
