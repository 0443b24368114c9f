/* Arranges the facets in one plane: a group of facets and the cuts in them become faces that nothing crosses, each with
 * its cover.
 *
 * A group is arranged in five steps. (1) Segments are made of the facets' boundary edges and the cuts. Each lies in a
 * second plane, its `side`. (2) All crossings and contacts of segments whose boxes intersect become points on both
 * segments. Edges come first, then the cuts that lie on no edge. (3) Every segment is split at its points. Equal pieces
 * become one edge. It stores, for each leaf, the change of the cover from its right to its left. (4) A sweep numbers
 * the faces on both sides of every edge. (5) A walk from the outside inwards computes the covers. Facets that nothing
 * touches become faces unchanged.
 *
 * A group has its own numbers for its points, both copies of the cluster's and new ones. Therefore threads can arrange
 * several groups at once. The results are appended in the order of the groups. Only then do new points get numbers in
 * the cluster. */
#include "kernel/arrange/arrange_planes.h"

#include "kernel/arrange/cull.h"
#include "kernel/cluster.h"
#include "kernel/arrange/sweep.h"
#include "kernel/threads.h"

#include <string.h>

enum { FEW = 24 }; /* greatest number of segments for which every pair is tested; for more segments, a tree of their
                    * boxes finds the pairs */

typedef struct {
  uint32_t p, q;
  uint32_t leaf;   /* For a boundary edge of a facet: number of the leaf (placed mesh) that contains the facet; the
                    * facet is to the left of p->q. For a cut through a facet: VS_NONE. */
  /* A number below VS_LINE: number of a second plane that contains the segment. VS_NONE: the segment is an edge between
   * two vertices of the input. VS_LINE + i: it is a part of the edge lines[i] of the cluster. */
  uint32_t side;
  uint8_t axis;    /* coordinate axis (0, 1 or 2) along which the ends p and q are far apart */
} segment;
typedef struct { uint32_t segment, point; } incidence;
/* The part of a segment between two neighbouring points on it, from the sweep's vertex l to its vertex r. `delta`:
 * number of layers of the leaf's surface directly above this part minus the number directly below. */
typedef struct { uint32_t l, r, leaf; int32_t delta; uint32_t side; } piece;

/* Output of one task, which arranges a chunk of planes. A point number from VS_POINT_MORE on is an index in `fresh`. */
typedef struct {
  VS_LIST(vs_face) faces;    /* faces of the arrangement; the member `cover` of a face is an index in the array `covers`
                              * below */
  VS_LIST(vs_cover) covers;
  VS_LIST(vs_use) uses;      /* boundary edges of the faces; the member `face` of an edge is an index in the array
                              * `faces` above */
  VS_LIST(uint32_t) lines;   /* lines[i]: number of the line that contains boundary edge uses[i]; set only if facets are
                              * given by their border edges instead of triangles */
  VS_LIST(vs_fresh_point) fresh;
  size_t cuts, crossed;      /* cuts: number of segments that cut through facets, in this chunk of planes so far;
                              * crossed: number of points where two of these segments cross */
  size_t hidden;             /* estimated number of the crossings in `crossed` that lie inside a leaf and so do not
                              * appear in the result */
} findings;

/* Memory in which one thread arranges one plane after another. */
typedef struct {
  vs_kernel *k;
  const vs_cluster *c;
  findings *to;
  uint32_t plane_id, place;      /* plane_id: number of the plane that the thread arranges; place: index, in the
                                  * cluster, of a leaf that has a facet in this plane */
  vs_plane plane;
  VS_LIST(vs_point) points;      /* points of the facets and cuts in the plane; their member `next` links them in a hash
                                  * table */
  VS_LIST(uint32_t) global;      /* global[i]: number in the cluster of the plane's point i. For a point that the
                                  * cluster does not contain, VS_POINT_MORE plus its index among the chunk's new
                                  * points. */
  VS_LIST(vs_homogeneous) more;  /* exact coordinates of the points that are new: the chunk made them, and the cluster
                                  * does not contain them */
  VS_LIST(uint32_t) known;       /* known[p]: index in `points` of the cluster's point p; valid only if `global` at this
                                  * index is p */
  VS_LIST(uint32_t) heads;
  VS_LIST(segment) segments;     /* segments in the plane: first the boundary edges of facets, then the segments that
                                  * cut through facets */
  VS_LIST(incidence) on;
  VS_LIST(uint32_t) families;    /* families[i]: family of segment i for the search of pairs in the tree of boxes
                                  * (bvh.h). Segments of family 0 have already been tested against each other. */
  VS_LIST(uint32_t) through;     /* through[i]: index in `holds` of the first entry for point i; each entry names one
                                  * segment that contains the point */
  VS_LIST(incidence) holds;      /* entries of linked lists, one list for each point; the member `point` of an entry is
                                  * the index of the next entry */
  VS_LIST(vs_bvh_box) boxes;
  vs_bvh bvh;
  VS_LIST(uint32_t) list, scratch;
  VS_LIST(uint32_t) local;       /* local[i]: number of point i as a vertex of the plane sweep */
  VS_LIST(piece) pieces;
  VS_LIST(piece) sorted;
  VS_LIST(uint32_t) on_first;    /* before the sweep: for each segment, index of the first point on it; during the
                                  * sweep: for each vertex, index of the first piece of a segment that begins there */
  VS_LIST(vs_keyed) keyed;
  VS_LIST(uint32_t) payload;     /* payload[e]: index in `sorted` of the first piece of segments on edge e of the plane
                                  * sweep; an extra element marks the end */
  /* line[e]: the member `side` of a segment that contains edge e of the plane sweep; a segment on an edge of the input
   * is preferred */
  VS_LIST(uint32_t) line;
  VS_LIST(uint32_t) above, below, face; /* above[e], below[e]: number of the face above and below edge e of the sweep;
                                         * face[f]: final number of face f, because several numbers may belong to one
                                         * face */
  VS_LIST(uint32_t) face_first, face_edges, queue;
  VS_LIST(vs_cover) cover;       /* for each face of the plane: how each leaf's winding number changes from one side of
                                  * the plane to the other */
  VS_LIST(uint32_t) cover_first, cover_count;
  vs_sweep sweep;
} plane_work;

static vs_points_view view(const plane_work *w) {
  return (vs_points_view){ w->points.at, w->c->points.big.at, w->more.at };
}

static void grid_of(const plane_work *w, uint32_t point, int32_t out[3]) { /* returns the coordinates, in grid steps, of
                                                                            * a point that is a vertex of the input */
  for (int i = 0; i < 3; i++) out[i] = vs_point_grid(&w->points.at[point], i);
}

/* ---- points of the group ---- */

static bool own_point(plane_work *w, uint32_t global, uint32_t *point) {
  uint32_t at = w->known.at[global];
  if (at < w->points.count && w->global.at[at] == global) {
    *point = at;
    return true;
  }
  *point = w->known.at[global] = (uint32_t)w->points.count;
  return VS_PUSH(w->k, w->points, w->c->points.all.at[global]) && VS_PUSH(w->k, w->global, global);
}

static size_t slot_of(const plane_work *w, const int64_t f[3]) { return vs_points_hash(f) & (w->heads.count - 1); }

/* Makes the hash table of the plane's points: at the first search for a point, and again when the table is full. */
static bool chain_points(plane_work *w) {
  size_t want = 64;
  while (want < 2 * w->points.count) want *= 2;
  if (!VS_ROOM(w->k, w->heads.at, w->heads.room, want)) return false;
  w->heads.count = want;
  for (size_t i = 0; i < want; i++) w->heads.at[i] = VS_NONE;
  for (uint32_t i = 0; i < w->points.count; i++) {
    size_t slot = slot_of(w, w->points.at[i].fixed);
    w->points.at[i].next = w->heads.at[slot];
    w->heads.at[slot] = i;
  }
  return true;
}

static bool new_point(plane_work *w, const vs_homogeneous *h, uint32_t *point) {
  vs_fresh_point f = { .at = *h };
  vs_fresh_fill(&f);
  if (w->points.count >= w->heads.count && !chain_points(w)) return false;
  size_t slot = f.hash & (w->heads.count - 1);
  for (uint32_t i = w->heads.at[slot]; i != VS_NONE; i = w->points.at[i].next) {
    const vs_point *p = &w->points.at[i];
    if (p->fixed[0] != f.fixed[0] || p->fixed[1] != f.fixed[1] || p->fixed[2] != f.fixed[2] ||
        vs_point_exact(p) != f.exact)
      continue;
    if (!f.exact && !vs_homogeneous_equal(h, p->big & VS_POINT_MORE ? &w->more.at[p->big & ~VS_POINT_MORE]
                                                                    : &w->c->points.big.at[p->big]))
      continue;
    *point = i;
    return true;
  }
  vs_point p = { { f.fixed[0], f.fixed[1], f.fixed[2] },
                 f.exact ? VS_POINT_EXACT : VS_POINT_MORE | (uint32_t)w->more.count,
                 w->heads.at[slot] };
  *point = (uint32_t)w->points.count;
  w->heads.at[slot] = *point;
  return (f.exact || VS_PUSH(w->k, w->more, *h)) && VS_PUSH(w->k, w->points, p) &&
         VS_PUSH(w->k, w->global, VS_POINT_MORE | (uint32_t)w->to->fresh.count) && VS_PUSH(w->k, w->to->fresh, f);
}

/* ---- step 1: segments ---- */

static bool add_segment(plane_work *w, uint32_t p, uint32_t q, uint32_t leaf, uint32_t side) {
  segment s = { .p = p, .q = q, .leaf = leaf, .side = side };
  const vs_point *a = &w->points.at[p], *b = &w->points.at[q];
  int64_t du = a->fixed[w->plane.u] - b->fixed[w->plane.u], dv = a->fixed[w->plane.v] - b->fixed[w->plane.v];
  s.axis = (du < 0 ? -du : du) >= (dv < 0 ? -dv : dv) ? w->plane.u : w->plane.v;
  if (du == 0 && dv == 0) { /* the points are closer than fixed-point numbers can distinguish */
    s.axis = vs_compare(view(w), p, q, w->plane.u) ? w->plane.u : w->plane.v;
  }
  return VS_PUSH(w->k, w->segments, s);
}

/* Sets p and q to the two ends, in grid steps, of the input's edge that contains segment s. Returns false if no such
 * edge is known. */
static bool edge_ends(const plane_work *w, const segment *s, int32_t p[3], int32_t q[3]) {
  if (s->side == VS_NONE) {
    grid_of(w, s->p, p);
    grid_of(w, s->q, q);
    return true;
  }
  if (!(s->side & VS_LINE)) return false;
  const vs_line *line = &w->c->lines.at[s->side & ~VS_LINE];
  memcpy(p, line->at[0], sizeof line->at[0]);
  memcpy(q, line->at[1], sizeof line->at[1]);
  return true;
}

static void side_plane(const plane_work *w, const segment *s, vs_plane *out) {
  int32_t x[3], y[3];
  if (edge_ends(w, s, x, y)) vs_plane_along(x, y, w->plane.k, out);
  else *out = w->c->planes.all.at[s->side];
}

static bool add_facet(plane_work *w, const vs_facet *f) {
  for (uint32_t i = f[0].first; w->c->sides.count && i < f[1].first; i++) {
    const vs_facet_side *s = &w->c->sides.at[i];
    uint32_t p, q;
    if (!own_point(w, s->from, &p) || !own_point(w, s->to, &q) || !add_segment(w, p, q, f->leaf, s->line)) return false;
  }
  if (w->c->sides.count) return true;
  for (uint32_t i = f[0].first; i < f[1].first; i++) {
    const vs_grid_triangle *t = &w->c->triangles.at[w->c->facet_triangles.at[i]];
    for (int j = 0; j < 3; j++) {
      uint32_t p, q;
      if (t->inner >> j & 1) continue;
      if (!own_point(w, t->v[j], &p) || !own_point(w, t->v[(j + 1) % 3], &q) || !add_segment(w, p, q, t->leaf, VS_NONE))
        return false;
    }
  }
  return true;
}

/* ---- step 2: crossings ---- */

/* Records that point `point` lies inside segment s, unless it is an end of s. */
static bool put(plane_work *w, uint32_t s, uint32_t point) {
  const segment *x = &w->segments.at[s];
  VS_ASSERT(s < w->segments.count);
  if (x->p == point || x->q == point) return true;
  return VS_PUSH(w->k, w->on, ((incidence){ s, point }));
}

static bool within(const plane_work *w, const segment *s, uint32_t x) { /* returns true if point x, which lies on the
                                                                         * infinite line through segment s, is between
                                                                         * the ends of s */
  return vs_compare(view(w), s->p, x, s->axis) * vs_compare(view(w), x, s->q, s->axis) > 0;
}

/* Computes on which side of segment s the point x lies, as seen along the plane's normal. Returns false if the
 * fixed-point numbers are not accurate enough to decide. */
static bool side_quick(const plane_work *w, const segment *s, uint32_t x, int *sign) {
  *sign = 0;
  if (x == s->p || x == s->q) return true;
  *sign = vs_orient2d_quick(view(w), s->p, s->q, x, w->plane.u, w->plane.v);
  if (*sign != VS_UNSURE) return true;
  uint32_t p = w->global.at[s->p], q = w->global.at[s->q], point = w->global.at[x];
  if (s->side != VS_NONE || point >= w->c->edge_of.count) return false;
  const vs_edge *e = &w->c->edge_of.at[point]; /* most cuts end at a point on an input edge whose two ends are known */
  *sign = 0;
  return (e->low == p && e->high == q) || (e->low == q && e->high == p);
}

/* Determines on which side of the line of segment s the two ends of segment t lie. Sets *a and *b to 0 for an end on
 * the line, and to opposite signs for ends on opposite sides. Which side is positive is not specified. */
static void sides_of(const plane_work *w, const segment *s, const segment *t, int *a, int *b) {
  bool known_a = side_quick(w, s, t->p, a), known_b = side_quick(w, s, t->q, b);
  if (known_a && known_b) return;
  vs_plane side;
  side_plane(w, s, &side);
  if (!known_a || *a) *a = vs_side(view(w), &side, t->p);
  if (!known_b || *b) *b = vs_side(view(w), &side, t->q);
}

static bool lies_on(const plane_work *w, const segment *s, uint32_t x) { /* returns true if point x lies on segment s,
                                                                          * but is not an end of s */
  int sign;
  if (!side_quick(w, s, x, &sign)) {
    vs_plane side;
    side_plane(w, s, &side);
    sign = vs_side(view(w), &side, x);
  }
  return sign == 0 && within(w, s, x);
}

/* Computes the point where the segments s and t cross. The caller knows that the point is not an end of either. */
static bool meet(const plane_work *w, const segment *s, const segment *t, vs_homogeneous *out) {
  vs_plane a, b;
  int32_t p[3], q[3];
  bool first = edge_ends(w, s, p, q), edge = first || edge_ends(w, t, p, q);
  side_plane(w, first ? t : s, &b);
  if (edge) return vs_meet_edge(p, q, &b, out);
  side_plane(w, t, &a);
  return vs_meet_planes(&w->plane, &a, &b, out);
}

/* Counts a crossing of two cuts. For every 16th crossing, tests whether a leaf hides it in the result. Returns false
 * once too many crossings are hidden. */
static bool look_whether_hidden(plane_work *w, uint32_t point) {
  enum { ONE_IN = 16 };
  findings *to = w->to;
  if (!w->c->crowd || w->c->layered || ++to->crossed % ONE_IN) return true;
  const int64_t *fixed = w->points.at[point].fixed;
  double at[3];
  for (int a = 0; a < 3; a++) at[a] = (double)fixed[a] / (double)((int64_t)1 << VS_FIXED_BITS);
  if (vs_cull_point(w->c, w->place, at)) to->hidden += ONE_IN;
  return !vs_too_hidden(w->c, to->cuts, to->crossed, to->hidden);
}

static bool cross(void *context, uint32_t i, uint32_t j) {
  plane_work *w = context;
  if (!vs_kernel_poll(w->k, 0.5)) return false;
  if (i > j) {
    uint32_t t = i;
    i = j;
    j = t;
  }
  const segment *s = &w->segments.at[i], *t = &w->segments.at[j];
  if (s->p == s->q) return t->p == t->q || !lies_on(w, t, s->p) || put(w, j, s->p); /* segment s is a single point */
  if (t->p == t->q) return !lies_on(w, s, t->p) || put(w, i, t->p);
  int a, b, c, d;
  sides_of(w, s, t, &a, &b);
  if (a * b > 0) return true;
  if (a == 0 && b == 0) {
    return (!within(w, s, t->p) || put(w, i, t->p)) && (!within(w, s, t->q) || put(w, i, t->q)) &&
           (!within(w, t, s->p) || put(w, j, s->p)) && (!within(w, t, s->q) || put(w, j, s->q));
  }
  uint32_t end = a == 0 ? t->p : t->q; /* the end of segment t that lies on the infinite line through segment s */
  if (a * b == 0 && (end == s->p || end == s->q)) return true;
  sides_of(w, t, s, &c, &d);
  if (c * d > 0) return true;
  if (a * b == 0) return c * d == 0 || put(w, i, end);
  if (c * d == 0) return put(w, j, c == 0 ? s->p : s->q);
  vs_homogeneous h;
  uint32_t x;
  if (!meet(w, s, t, &h)) return VS_BROKEN(w->k, "two cuts do not meet");
  return new_point(w, &h, &x) && look_whether_hidden(w, x) && put(w, i, x) && put(w, j, x);
}

/* Finds the crossings of all pairs of segments, except pairs of two among the first `tried` segments, which were tested
 * earlier. */
static bool crossings(plane_work *w, uint32_t tried) {
  uint32_t n = (uint32_t)w->segments.count;
  VS_ASSERT(tried <= n);
  if (n == tried) return true;
  if (!VS_ROOM(w->k, w->boxes.at, w->boxes.room, n)) return false;
  for (uint32_t i = 0; i < n; i++) {
    vs_bvh_box *b = &w->boxes.at[i];
    const vs_point *p = &w->points.at[w->segments.at[i].p], *q = &w->points.at[w->segments.at[i].q];
    for (int a = 0; a < 3; a++) {
      int64_t x = p->fixed[a], y = q->fixed[a];
      b->min[a] = (int32_t)((x < y ? x : y) >> VS_FIXED_BITS);
      b->max[a] = (int32_t)((x < y ? y : x) >> VS_FIXED_BITS) + 1;
    }
  }
  if (n > FEW) {
    if (!VS_ROOM(w->k, w->families.at, w->families.room, n)) return false;
    for (uint32_t i = 0; i < n; i++) w->families.at[i] = i < tried ? 0 : UINT32_MAX;
    w->bvh.families = tried ? w->families.at : NULL;
    return vs_bvh_build(w->k, &w->bvh, w->boxes.at, n) && vs_bvh_pairs(w->k, &w->bvh, 0, UINT32_MAX, cross, w);
  }
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = i < tried ? tried : i + 1; j < n; j++)
      if (vs_box_meet(&w->boxes.at[i], &w->boxes.at[j]) && !cross(w, i, j)) return false;
  return true;
}

/* Records that segment s contains the point with the number `point`. */
static bool hold(plane_work *w, uint32_t s, uint32_t point) {
  uint32_t *at = &w->through.at[point];
  VS_ASSERT(point < w->through.count);
  if (!VS_PUSH(w->k, w->holds, ((incidence){ s, *at }))) return false;
  *at = (uint32_t)w->holds.count - 1;
  return true;
}

/* Makes, for each point, the list of the segments that contain it. */
static bool index_points(plane_work *w) {
  size_t points = w->points.count;
  if (!VS_ROOM(w->k, w->through.at, w->through.room, points)) return false;
  memset(w->through.at, 0xff, points * sizeof *w->through.at); /* sets every element to VS_NONE */
  w->through.count = points;
  w->holds.count = 0;
  for (uint32_t i = 0; i < w->segments.count; i++)
    if (!hold(w, i, w->segments.at[i].p) || !hold(w, i, w->segments.at[i].q)) return false;
  for (size_t i = 0; i < w->on.count; i++)
    if (!hold(w, w->on.at[i].segment, w->on.at[i].point)) return false;
  return true;
}

/* Returns true if some segment contains the points p and q. */
static bool joined(const plane_work *w, uint32_t p, uint32_t q) {
  for (uint32_t i = w->through.at[p]; i != VS_NONE; i = w->holds.at[i].point)
    for (uint32_t j = w->through.at[q]; j != VS_NONE; j = w->holds.at[j].point)
      if (w->holds.at[i].segment == w->holds.at[j].segment) return true;
  return false;
}

/* ---- step 3: pieces ---- */

static bool on_before(const void *context, uint32_t x, uint32_t y) { /* orders two points of one segment along it; x and
                                                                      * y are indices of their incidences */
  const plane_work *w = context;
  const incidence *a = &w->on.at[x], *b = &w->on.at[y];
  const segment *s = &w->segments.at[a->segment];
  return vs_compare(view(w), a->point, b->point, s->axis) * vs_compare(view(w), s->p, s->q, s->axis) > 0;
}

/* Sorts pairs of a segment and a point on it: first by segment, then by the point's position along the segment. Writes
 * the result to w->list. */
static bool order_on(plane_work *w) {
  size_t n = w->segments.count, m = w->on.count;
  if (!VS_ROOM(w->k, w->on_first.at, w->on_first.room, n + 2) || !VS_ROOM(w->k, w->keyed.at, w->keyed.room, 2 * m + 1))
    return false;
  uint32_t *first = w->on_first.at, *list = w->list.at;
  memset(first, 0, (n + 2) * sizeof *first);
  for (size_t i = 0; i < m; i++) first[w->on.at[i].segment + 2]++;
  for (size_t i = 2; i < n + 2; i++) first[i] += first[i - 1];
  for (uint32_t i = 0; i < m; i++) list[first[w->on.at[i].segment + 1]++] = i;
  for (uint32_t i = 0; i < n; i++) {
    uint32_t low = first[i], count = first[i + 1] - low;
    if (count < 2) continue;
    const segment *s = &w->segments.at[i];
    bool down = vs_compare(view(w), s->p, s->q, s->axis) > 0;
    vs_keyed *at = w->keyed.at;
    for (uint32_t j = 0; j < count; j++) {
      int64_t x = w->points.at[w->on.at[list[low + j]].point].fixed[s->axis];
      at[j] = (vs_keyed){ down ? -x : x, list[low + j] };
    }
    vs_sort_keyed(at, at + m, count);
    for (uint32_t j = 0; j < count; j++) list[low + j] = at[j].item;
    for (uint32_t j = 0, end; j < count; j = end) { /* handles points that occur twice or are closer than fixed-point
                                                     * numbers can distinguish */
      for (end = j + 1; end < count && at[end].key == at[j].key;) end++;
      if (end > j + 1) vs_kernel_sort(list + low + j, w->scratch.at, end - j, on_before, w);
    }
  }
  return true;
}

static bool piece_before(const piece *x, const piece *y) {
  if (x->r != y->r) return x->r < y->r;
  if (x->leaf != y->leaf) return x->leaf < y->leaf;
  return x->delta != y->delta ? x->delta < y->delta : x->side < y->side;
}

/* Sorts the pieces of segments by their two ends and their leaf, into w->sorted. Pieces that compare equal have equal
 * members, so the result is unique. */
static bool order_pieces(plane_work *w) {
  enum { MANY = 64 };
  size_t n = w->sweep.vertices.count, m = w->pieces.count;
  if (!VS_ROOM(w->k, w->on_first.at, w->on_first.room, n + 2) || !VS_ROOM(w->k, w->sorted.at, w->sorted.room, m + 1))
    return false;
  uint32_t *first = w->on_first.at;
  memset(first, 0, (n + 2) * sizeof *first);
  for (size_t i = 0; i < m; i++) first[w->pieces.at[i].l + 2]++;
  for (size_t i = 2; i < n + 2; i++) first[i] += first[i - 1];
  for (size_t i = 0; i < m; i++) w->sorted.at[first[w->pieces.at[i].l + 1]++] = w->pieces.at[i];
  for (size_t v = 0; v < n; v++) {
    piece *at = w->sorted.at + first[v];
    uint32_t count = first[v + 1] - first[v];
    /* Shell sort: most vertices begin few pieces of segments, but some begin very many. */
    for (uint32_t gap = count > MANY ? count / 2 : 1; gap; gap = gap == 2 ? 1 : (uint32_t)(gap / 2.2))
      for (uint32_t i = gap; i < count; i++) {
        piece x = at[i];
        uint32_t j = i;
        for (; j >= gap && piece_before(&x, &at[j - gap]); j -= gap) at[j] = at[j - gap];
        at[j] = x;
      }
  }
  return true;
}

/* Adds the piece of segment s between the points p and q, which are different vertices of the plane sweep. */
static bool add_piece(plane_work *w, uint32_t p, uint32_t q, const segment *s) {
  uint32_t a = w->local.at[p], b = w->local.at[q];
  VS_ASSERT(a != b);
  return VS_PUSH(w->k, w->pieces, ((piece){ a < b ? a : b, a < b ? b : a, s->leaf,
      s->leaf == VS_NONE ? 0 : a < b ? 1 : -1, s->side }));
}

static bool split(plane_work *w) {
  size_t n = w->segments.count, m = w->on.count, ends = 2 * n + m;
  vs_kernel *k = w->k;
  if (!VS_ROOM(k, w->list.at, w->list.room, ends) || !VS_ROOM(k, w->scratch.at, w->scratch.room, ends) ||
      !VS_ROOM(k, w->local.at, w->local.room, w->points.count))
    return false;
  uint32_t *list = w->list.at;
  for (size_t i = 0; i < n; i++) list[2 * i] = w->segments.at[i].p, list[2 * i + 1] = w->segments.at[i].q;
  for (size_t i = 0; i < m; i++) list[2 * n + i] = w->on.at[i].point;
  /* Numbers the vertices of the plane sweep. Each point that is an end of a piece gets one number, in the sweep's
   * order. */
  size_t unique = 0;
  for (size_t i = 0; i < ends; i++) w->local.at[list[i]] = VS_NONE;
  for (size_t i = 0; i < ends; i++)
    if (w->local.at[list[i]] == VS_NONE) w->local.at[list[i]] = 0, list[unique++] = list[i];
  w->sweep.points = view(w);
  w->sweep.u = w->plane.u;
  w->sweep.v = w->plane.v;
  if (!vs_sweep_order(k, &w->sweep, list, unique, w->scratch.at)) return false;
  for (uint32_t i = 0; i < w->sweep.vertices.count; i++) w->local.at[w->sweep.vertices.at[i]] = i;

  if (!order_on(w)) return false;
  w->pieces.count = 0;
  size_t o = 0;
  for (uint32_t i = 0; i < n; i++) {
    const segment *s = &w->segments.at[i];
    uint32_t from = s->p;
    for (; o < m && w->on.at[list[o]].segment == i; o++) {
      uint32_t x = w->on.at[list[o]].point;
      if (x == from) continue;
      if (!add_piece(w, from, x, s)) return false;
      from = x;
    }
    if (from != s->q && !add_piece(w, from, s->q, s)) return false;
  }
  if (!order_pieces(w)) return false;
  const piece *sorted = w->sorted.at;
  w->sweep.edges.count = w->payload.count = w->line.count = 0;
  size_t kept = 0, count = w->pieces.count;
  for (size_t i = 0, end; i < count; i = end) { /* makes an edge for each pair (l, r) of vertices, and a piece on this
                                                 * edge for each leaf with a delta other than 0 */
    const piece *at = &sorted[i];
    if (!VS_PUSH(k, w->sweep.edges, ((vs_sweep_edge){ at->l, at->r })) || !VS_PUSH(k, w->payload, (uint32_t)kept))
      return false;
    uint32_t line = 0;
    for (end = i; end < count && sorted[end].l == at->l && sorted[end].r == at->r;) {
      piece sum = sorted[end++];
      if (sum.side > line) line = sum.side;
      for (; end < count && sorted[end].l == at->l && sorted[end].r == at->r && sorted[end].leaf == sum.leaf; end++) {
        sum.delta += sorted[end].delta;
        if (sorted[end].side > line) line = sorted[end].side;
      }
      if (sum.leaf != VS_NONE && sum.delta != 0) w->pieces.at[kept++] = sum;
    }
    if (w->c->sides.count && !VS_PUSH(k, w->line, line)) return false;
  }
  w->pieces.count = kept;
  return VS_PUSH(k, w->payload, (uint32_t)kept);
}

/* ---- step 4: faces ---- */

static bool name_faces(plane_work *w) {
  vs_kernel *k = w->k;
  size_t m = w->sweep.edges.count;
  if (!VS_ROOM(k, w->above.at, w->above.room, m) || !VS_ROOM(k, w->below.at, w->below.room, m) ||
      !vs_sweep_begin(k, &w->sweep))
    return false;
  w->face.count = 0;
  if (!VS_PUSH(k, w->face, 0u)) return false; /* face 0 is the unbounded area around all segments */
  vs_sweep_event e;
  while (vs_sweep_next(k, &w->sweep, &e)) {
    uint32_t low = e.below == VS_NONE ? 0 : w->above.at[e.below], high = e.above == VS_NONE ? 0 : w->below.at[e.above];
    if (e.left_count == 0) {
      if (vs_find(w->face.at, low) != vs_find(w->face.at, high)) return VS_BROKEN(k, "a face has two names");
    } else if (e.right_count == 0) {
      vs_unite(w->face.at, low, high);
    }
    for (uint32_t i = 0; i < e.right_count; i++) {
      w->below.at[e.rights[i]] = low;
      if (i + 1 < e.right_count) {
        low = (uint32_t)w->face.count;
        if (!VS_PUSH(k, w->face, low)) return false;
      } else {
        low = high;
      }
      w->above.at[e.rights[i]] = low;
    }
  }
  if (!vs_sweep_done(&w->sweep)) return false;
  uint32_t count = 0; /* Each set of united faces has its smallest number as its root. Therefore one pass numbers the
                       * faces without gaps and in order. */
  for (uint32_t f = 0; f < w->face.count; f++) w->face.at[f] = vs_find(w->face.at, f) == f ? f : vs_find(w->face.at, f);
  if (!VS_ROOM(k, w->list.at, w->list.room, w->face.count)) return false;
  for (uint32_t f = 0; f < w->face.count; f++) w->list.at[f] = w->face.at[f] == f ? count++ : w->list.at[w->face.at[f]];
  for (size_t i = 0; i < m; i++)
    w->above.at[i] = w->list.at[w->above.at[i]], w->below.at[i] = w->list.at[w->below.at[i]];
  w->face.count = count;
  return true;
}

/* ---- step 5: covers ---- */

/* Computes the winding changes of face `to` from the winding changes of its neighbour `from`. The two faces have `edge`
 * in common. sign: 1 if `to` is above the edge, -1 if it is below. */
static bool step_cover(plane_work *w, uint32_t from, uint32_t to, uint32_t edge, int sign) {
  VS_ASSERT(sign == 1 || sign == -1);
  w->cover_first.at[to] = (uint32_t)w->cover.count;
  uint32_t i = w->cover_first.at[from], i_end = i + w->cover_count.at[from], j = w->payload.at[edge],
           j_end = w->payload.at[edge + 1];
  while (i < i_end || j < j_end) {
    vs_cover next = { VS_NONE, 0 };
    uint32_t a = i < i_end ? w->cover.at[i].leaf : VS_NONE, b = j < j_end ? w->pieces.at[j].leaf : VS_NONE;
    next.leaf = a < b ? a : b;
    if (a == next.leaf) next.delta += w->cover.at[i++].delta;
    if (b == next.leaf) next.delta += sign * w->pieces.at[j++].delta;
    if (next.delta && !VS_PUSH(w->k, w->cover, next)) return false;
  }
  w->cover_count.at[to] = (uint32_t)w->cover.count - w->cover_first.at[to];
  return true;
}

static bool covers(plane_work *w) {
  vs_kernel *k = w->k;
  size_t m = w->sweep.edges.count, faces = w->face.count;
  if (!VS_ROOM(k, w->face_first.at, w->face_first.room, faces + 2) ||
      !VS_ROOM(k, w->face_edges.at, w->face_edges.room, 2 * m + 1) ||
      !VS_ROOM(k, w->cover_first.at, w->cover_first.room, faces) ||
      !VS_ROOM(k, w->cover_count.at, w->cover_count.room, faces) || !VS_ROOM(k, w->queue.at, w->queue.room, faces))
    return false;
  uint32_t *first = w->face_first.at;
  memset(first, 0, (faces + 2) * sizeof *first);
  for (size_t e = 0; e < m; e++) first[w->above.at[e] + 2]++, first[w->below.at[e] + 2]++;
  for (size_t f = 2; f < faces + 2; f++) first[f] += first[f - 1];
  for (uint32_t e = 0; e < m; e++) {
    w->face_edges.at[first[w->above.at[e] + 1]++] = e;
    w->face_edges.at[first[w->below.at[e] + 1]++] = e;
  }
  for (size_t f = 0; f < faces; f++) w->cover_count.at[f] = VS_NONE;
  w->cover.count = 0;
  w->cover_first.at[0] = w->cover_count.at[0] = 0;
  size_t head = 0, tail = 0;
  w->queue.at[tail++] = 0;
  while (head < tail) {
    uint32_t f = w->queue.at[head++];
    for (uint32_t i = first[f]; i < first[f + 1]; i++) {
      uint32_t e = w->face_edges.at[i], up = w->above.at[e], down = w->below.at[e], other = up == f ? down : up;
      if (w->cover_count.at[other] != VS_NONE) continue;
      if (!step_cover(w, f, other, e, other == up ? 1 : -1)) return false;
      w->queue.at[tail++] = other;
    }
  }
  return tail == faces || VS_BROKEN(k, "a face cannot be reached");
}

static bool give_faces(plane_work *w) {
  vs_kernel *k = w->k;
  findings *to = w->to;
  for (uint32_t f = 0; f < w->face.count; f++) {
    w->queue.at[f] = VS_NONE;
    if (w->cover_count.at[f] == 0) continue;
    w->queue.at[f] = (uint32_t)to->faces.count;
    uint32_t begin = w->face_first.at[f], end = w->face_first.at[f + 1];
    vs_face face = { w->plane_id, (uint32_t)to->covers.count, w->cover_count.at[f], VS_NONE,
                     0,           (uint32_t)to->uses.count,   end - begin };
    if (!VS_PUSH(k, to->faces, face) || !VS_ROOM(k, to->uses.at, to->uses.room, to->uses.count + face.use_count))
      return false;
    for (uint32_t i = 0; i < w->cover_count.at[f]; i++)
      if (!VS_PUSH(k, to->covers, w->cover.at[w->cover_first.at[f] + i])) return false;
    for (uint32_t i = begin; i < end; i++) {
      uint32_t e = w->face_edges.at[i];
      uint32_t l = w->global.at[w->sweep.vertices.at[w->sweep.edges.at[e].l]],
               r = w->global.at[w->sweep.vertices.at[w->sweep.edges.at[e].r]];
      bool second = i > begin && w->face_edges.at[i - 1] == e; /* true if the face lies on both sides of edge e, which
                                                                * then occurs twice in its list */
      vs_use use = w->above.at[e] == f && !second ? (vs_use){ l, r, w->queue.at[f] } : (vs_use){ r, l, w->queue.at[f] };
      to->uses.at[to->uses.count++] = use;
      if (w->c->sides.count && !VS_PUSH(k, to->lines, w->line.at[e])) return false;
    }
  }
  return true;
}

/* ---- groups ---- */

static bool give_facet(plane_work *w, uint32_t facet) { /* copies the triangles of a facet that touches no other facet;
                                                         * together they form one face */
  const vs_cluster *c = w->c;
  findings *to = w->to;
  const vs_facet *f = &c->facets.at[facet];
  bool sided = c->sides.count > 0;
  vs_face face = { f->plane, (uint32_t)to->covers.count, 1, sided ? VS_NONE : facet, 0, (uint32_t)to->uses.count, 0 };
  vs_cover cover = { f->leaf, f->flip ? -1 : 1 };
  for (uint32_t i = f[0].first; sided && i < f[1].first; i++) {
    const vs_facet_side *s = &c->sides.at[i];
    vs_use use = { f->flip ? s->to : s->from, f->flip ? s->from : s->to, (uint32_t)to->faces.count };
    if (!VS_PUSH(w->k, to->uses, use) || !VS_PUSH(w->k, to->lines, s->line)) return false;
  }
  for (uint32_t i = f[0].first; !sided && i < f[1].first; i++) {
    const vs_grid_triangle *t = &c->triangles.at[c->facet_triangles.at[i]];
    for (int j = 0; j < 3; j++) {
      uint32_t a = t->v[j], b = t->v[(j + 1) % 3];
      if (t->inner >> j & 1) continue;
      if (!VS_PUSH(w->k, to->uses, ((vs_use){ f->flip ? b : a, f->flip ? a : b, (uint32_t)to->faces.count })))
        return false;
    }
  }
  face.use_count = (uint32_t)to->uses.count - face.use;
  return VS_PUSH(w->k, to->covers, cover) && VS_PUSH(w->k, to->faces, face);
}

typedef struct { uint32_t from, end; } chunk; /* a range of groups of facets, from the union-find root `from` to the
                                               * root `end` - 1 */

/* Facets and cuts sorted by their group of touching coplanar facets, and the groups divided into chunks for the
 * threads. */
typedef struct {
  vs_cluster *c;
  VS_LIST(uint32_t) facets, cuts;  /* indices of all facets, and of all cuts through facets; both lists are sorted by
                                    * group of touching facets */
  VS_LIST(uint32_t) facet_first, cut_first; /* facet_first[r]: position in `facets` of the first facet of group r;
                                             * cut_first[r]: position in `cuts` of its first cut; an extra element of
                                             * each array marks the end */
  VS_LIST(chunk) chunks;
  findings found[VS_PIPELINE_WINDOW];
  plane_work *works;               /* array with the working memory of each thread */
  vs_points_table points;          /* table of the new points of all chunks (tasks), which get numbers after those of
                                    * the cluster's points */
  VS_LIST(uint32_t) numbers;       /* numbers[i]: number in the cluster of the chunk's new point i */
  size_t tried, crossed, hidden;   /* sums, over the chunks so far, of their members `cuts`, `crossed` and `hidden` */
} arranging;

static bool arrange_group(plane_work *w, const arranging *a, uint32_t root) {
  const vs_cluster *c = w->c;
  uint32_t begin = a->facet_first.at[root], end = a->facet_first.at[root + 1];
  const uint32_t *cuts = a->cuts.at + a->cut_first.at[root];
  uint32_t cut_count = a->cut_first.at[root + 1] - a->cut_first.at[root];
  if (begin == end) return true;
  if (end == begin + 1 && !c->facets.at[root].touched) return give_facet(w, root);
  w->place = c->facets.at[root].place;
  w->to->cuts += cut_count;
  w->plane_id = c->facets.at[root].plane;
  w->plane = c->planes.all.at[w->plane_id];
  w->segments.count = w->points.count = w->global.count = w->more.count = w->heads.count = w->on.count = 0;
  for (uint32_t f = begin; f < end; f++)
    if (!add_facet(w, &c->facets.at[a->facets.at[f]])) return false;
  if (!VS_ROOM(w->k, w->keyed.at, w->keyed.room, 2 * (size_t)cut_count + 1)) return false;
  enum { AHEAD = 12, NEAR = 6 };
  vs_keyed *at = w->keyed.at;
  size_t left = c->cuts.count - a->cut_first.at[root];
  for (uint32_t j = 0; j < cut_count; j++) {
    const vs_facet_cut *cut = &c->cuts.at[cuts[j]];
    if (j + AHEAD < left) { /* prefetches memory of the next cuts through facets and of their points, beyond the end of
                             * this group, too */
      __builtin_prefetch(&c->cuts.at[cuts[j + AHEAD]]);
      const vs_facet_cut *near = &c->cuts.at[cuts[j + NEAR]];
      __builtin_prefetch(&c->points.all.at[near->p]);
      __builtin_prefetch(&c->points.all.at[near->q]);
      __builtin_prefetch(&w->known.at[near->p], 1);
      __builtin_prefetch(&w->known.at[near->q], 1);
    }
    /* Point numbers are below 2^30, so two of them fit into the 64-bit key of a sort. */
    at[j] = (vs_keyed){ cut->p < cut->q ? (int64_t)cut->p << 32 | cut->q : (int64_t)cut->q << 32 | cut->p, cut->plane };
  }
  vs_sort_keyed(at, at + cut_count, cut_count);
  uint32_t kept = 0, tried = 0;
  for (uint32_t j = 0, stop; j < cut_count; j = stop) { /* keeps a single segment of each set of equal segments that cut
                                                         * through facets */
    uint32_t plane = at[j].item, p, q;
    for (stop = j + 1; stop < cut_count && at[stop].key == at[j].key; stop++)
      if (at[stop].item < plane) plane = at[stop].item;
    if (!own_point(w, (uint32_t)(at[j].key >> 32), &p) || !own_point(w, (uint32_t)at[j].key, &q)) return false;
    at[kept++] = (vs_keyed){ (int64_t)p << 32 | q, plane };
  }
  if (end > begin + 1) { /* Solids that touch side by side have many cuts that lie on a facet's edge, between points
                          * that edges already connect. Such cuts are not needed. */
    if (!crossings(w, 0) || !index_points(w)) return false;
    tried = (uint32_t)w->segments.count;
  }
  for (uint32_t j = 0; j < kept; j++) {
    uint32_t p = (uint32_t)(at[j].key >> 32), q = (uint32_t)at[j].key;
    if (!vs_kernel_poll(w->k, 0.5) || ((!tried || !joined(w, p, q)) && !add_segment(w, p, q, VS_NONE, at[j].item)))
      return false;
  }
  return crossings(w, tried) && split(w) && name_faces(w) && covers(w) && give_faces(w);
}

static bool arrange_chunk(vs_kernel *k, void *context, size_t index) {
  arranging *a = context;
  plane_work *w = &a->works[k->worker];
  findings *to = &a->found[index % VS_PIPELINE_WINDOW];
  w->k = k;
  w->c = a->c;
  w->to = to;
  to->faces.count = to->covers.count = to->uses.count = to->lines.count = to->fresh.count = to->cuts = to->crossed =
      to->hidden = 0;
  if (w->known.count < a->c->points.all.count) {
    if (!VS_ROOM(k, w->known.at, w->known.room, a->c->points.all.count)) return false;
    for (size_t i = w->known.count; i < w->known.room; i++) w->known.at[i] = 0;
    w->known.count = w->known.room;
  }
  chunk part = a->chunks.at[index];
  for (uint32_t root = part.from; root < part.end; root++)
    if (!vs_kernel_poll(k, 0.2 + 0.5 * (double)index / (double)a->chunks.count) || !arrange_group(w, a, root))
      return false;
  return true;
}

static bool absorb(vs_kernel *k, void *context, size_t index) {
  arranging *a = context;
  vs_cluster *c = a->c;
  const findings *from = &a->found[index % VS_PIPELINE_WINDOW];
  a->tried += from->cuts;
  a->crossed += from->crossed;
  a->hidden += from->hidden;
  if (vs_too_hidden(c, a->tried, a->crossed, a->hidden) ||
      !vs_kernel_on_the_way(k, c->faces.count + from->faces.count))
    return false;
  uint32_t faces = (uint32_t)c->faces.count, covers = (uint32_t)c->covers.count, uses = (uint32_t)c->uses.count;
  if (!VS_ROOM(k, a->numbers.at, a->numbers.room, from->fresh.count + 1) ||
      !vs_points_add_all(k, &a->points, &c->points, from->fresh.at, from->fresh.count, a->numbers.at))
    return false;
  const uint32_t *numbers = a->numbers.at;
  if (!VS_ROOM(k, c->faces.at, c->faces.room, faces + from->faces.count) ||
      !VS_ROOM(k, c->covers.at, c->covers.room, covers + from->covers.count) ||
      !VS_ROOM(k, c->uses.at, c->uses.room, c->uses.count + from->uses.count))
    return false;
  for (size_t i = 0; i < from->faces.count; i++) {
    vs_face f = from->faces.at[i];
    f.cover += covers;
    f.use += uses;
    c->faces.at[c->faces.count++] = f;
  }
  for (size_t i = 0; i < from->covers.count; i++) c->covers.at[c->covers.count++] = from->covers.at[i];
  for (size_t i = 0; i < from->uses.count; i++) {
    vs_use u = from->uses.at[i];
    if (u.from & VS_POINT_MORE) u.from = numbers[u.from & ~VS_POINT_MORE];
    if (u.to & VS_POINT_MORE) u.to = numbers[u.to & ~VS_POINT_MORE];
    u.face += faces;
    c->uses.at[c->uses.count++] = u;
  }
  if (!VS_ROOM(k, c->use_line.at, c->use_line.room, c->use_line.count + from->lines.count)) return false;
  for (size_t i = 0; i < from->lines.count; i++) c->use_line.at[c->use_line.count++] = from->lines.at[i];
  return true;
}

static bool bucket(vs_kernel *k, arranging *a) {
  enum { CHUNK = 2048, LARGE = 4 * CHUNK }; /* CHUNK: number of facets and cuts that one task handles; LARGE: least
                                             * number of facets and cuts of a large chunk, which is started before the
                                             * other chunks */
  const vs_cluster *c = a->c;
  uint32_t n = (uint32_t)c->facets.count, m = (uint32_t)c->cuts.count, *first;
  if (!VS_ROOM(k, a->facets.at, a->facets.room, (size_t)n + 1) ||
      !VS_ROOM(k, a->cuts.at, a->cuts.room, (size_t)m + 1) ||
      !VS_ROOM(k, a->facet_first.at, a->facet_first.room, (size_t)n + 2) ||
      !VS_ROOM(k, a->cut_first.at, a->cut_first.room, (size_t)n + 2))
    return false;
  first = a->facet_first.at;
  memset(first, 0, ((size_t)n + 2) * sizeof *first);
  for (uint32_t i = 0; i < n; i++) first[c->facets.at[i].group + 2]++;
  for (uint32_t i = 2; i < n + 2; i++) first[i] += first[i - 1];
  for (uint32_t i = 0; i < n; i++) a->facets.at[first[c->facets.at[i].group + 1]++] = i;
  first = a->cut_first.at;
  if (!vs_kernel_report(k, k->part)) return false;
  memset(first, 0, ((size_t)n + 2) * sizeof *first);
  for (uint32_t i = 0; i < m; i++) first[c->facets.at[c->cuts.at[i].facet].group + 2]++;
  for (uint32_t i = 2; i < n + 2; i++) first[i] += first[i - 1];
  for (uint32_t i = 0; i < m; i++) a->cuts.at[first[c->facets.at[c->cuts.at[i].facet].group + 1]++] = i;
  if (!vs_kernel_report(k, k->part)) return false;
  for (int large = 1; large >= 0; large--) /* The first pass lists the large chunks, so that threads start with them.
                                            * The second pass lists the remaining chunks. */
    for (uint32_t i = 0, end; i < n; i = end) {
      uint32_t size = 0;
      for (end = i; end < n && size < CHUNK; end++) {
        uint32_t more =
            a->facet_first.at[end + 1] - a->facet_first.at[end] + a->cut_first.at[end + 1] - a->cut_first.at[end] + 1;
        if (more >= LARGE && end > i) break;
        size += more;
      }
      if ((size >= LARGE) == large && !VS_PUSH(k, a->chunks, ((chunk){ i, end }))) return false;
    }
  return true;
}

static void work_free(vs_kernel *k, plane_work *w) {
  VS_DROP(k, w->points);
  VS_DROP(k, w->global);
  VS_DROP(k, w->more);
  VS_DROP(k, w->known);
  VS_DROP(k, w->heads);
  VS_DROP(k, w->segments);
  VS_DROP(k, w->on);
  VS_DROP(k, w->families);
  VS_DROP(k, w->through);
  VS_DROP(k, w->holds);
  VS_DROP(k, w->boxes);
  vs_bvh_free(k, &w->bvh);
  VS_DROP(k, w->list);
  VS_DROP(k, w->scratch);
  VS_DROP(k, w->local);
  VS_DROP(k, w->pieces);
  VS_DROP(k, w->sorted);
  VS_DROP(k, w->on_first);
  VS_DROP(k, w->keyed);
  VS_DROP(k, w->payload);
  VS_DROP(k, w->line);
  VS_DROP(k, w->above);
  VS_DROP(k, w->below);
  VS_DROP(k, w->face);
  VS_DROP(k, w->face_first);
  VS_DROP(k, w->face_edges);
  VS_DROP(k, w->queue);
  VS_DROP(k, w->cover);
  VS_DROP(k, w->cover_first);
  VS_DROP(k, w->cover_count);
  vs_sweep_free(k, &w->sweep);
}

bool vs_arrange_planes(vs_kernel *k, vs_cluster *c) {
  arranging a = { .c = c };
  size_t work_room = 0;
  bool ok = VS_ROOM(k, a.works, work_room, k->threads);
  if (ok) memset(a.works, 0, work_room * sizeof *a.works);
  size_t least = c->facets.count; /* estimated minimum of the number of faces, for the size of the arrays; there are
                                   * about as many faces as facets */
  ok = ok && bucket(k, &a) && VS_ROOM(k, c->faces.at, c->faces.room, least) &&
       VS_ROOM(k, c->covers.at, c->covers.room, least) && VS_ROOM(k, c->uses.at, c->uses.room, 3 * least) &&
       vs_kernel_pipeline(k, a.chunks.count, arrange_chunk, absorb, &a);
  vs_points_forget(k, &c->points);
  vs_points_forget(k, &a.points);
  ok = ok && vs_points_append(k, &c->points, &a.points);
  if (!ok && k->error->status == VS_KERNEL_FINE && !c->layered) c->crowded = c->crowd > 0; /* Too many crossings of cuts
                                                                                            * are hidden inside solids.
                                                                                            * The caller will unite the
                                                                                            * solids two by two, and
                                                                                            * then arrange the cluster
                                                                                            * again. */
  for (size_t i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(k, a.found[i].faces);
    VS_DROP(k, a.found[i].covers);
    VS_DROP(k, a.found[i].uses);
    VS_DROP(k, a.found[i].lines);
    VS_DROP(k, a.found[i].fresh);
  }
  for (size_t i = 0; i < work_room; i++) work_free(k, &a.works[i]);
  VS_FREE(k, a.works, work_room);
  vs_points_free(k, &a.points);
  VS_DROP(k, a.facets);
  VS_DROP(k, a.cuts);
  VS_DROP(k, a.facet_first);
  VS_DROP(k, a.cut_first);
  VS_DROP(k, a.chunks);
  VS_DROP(k, a.numbers);
  return ok;
}
