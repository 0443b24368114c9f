/* Decides which faces of the arrangement bound the result.
 *
 * (1) The faces at every edge are sorted around it. Sides that face each other belong to one cell (union-find). (2) For
 * each connected set of cells, a line through one face and the input triangles determines the winding numbers of all
 * leaves on one side of the face. (3) A walk through the cells enters and leaves the leaves as it crosses their faces,
 * and evaluates the expression in each cell. (4) A face is kept if the values of its two cells differ. The walk also
 * sums a random number for each winding. If two ways into a cell give different sums, the arrangement is wrong and the
 * kernel fails with an error.
 *
 * The order around an edge is as follows. D is the direction from the smaller point number to the larger. A use that
 * runs along D has its face to the left, in the direction n x D. A use against D has it in the direction -n x D.
 * Therefore, with m = n or m = -n, the face lies in the direction m x D. A counter-clockwise turn about D leaves the
 * face through the side to which m points. Faces are in the order of the angle of m, as seen along any axis in which D
 * is not 0. */
#include "kernel/arrange/classify.h"

#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  vs_expression *e;
  VS_LIST(_Atomic uint32_t) sets; /* union-find structure whose elements are the sides of faces: 2 * face for the +
                                   * side, 2 * face + 1 for the - side */
  VS_LIST(uint32_t) side;         /* cell (connected piece of space) beside each side of a face: [2 * face] for the +
                                   * side, [2 * face + 1] for the - side */
  VS_LIST(uint32_t) first, borders; /* borders: sides of faces, grouped by the cell that they bound; first[c]: index in
                                     * `borders` of the first side of cell c */
  VS_LIST(uint64_t) sum;    /* sum[c]: sum of a random number for each winding around cell c; two paths to a cell must
                             * give equal sums, which checks the arrangement */
  VS_LIST(uint8_t) state;   /* state[c]: bits of cell c (piece of space). 1: visited; 2: the walk has passed through it;
                             * 4: inside the result; 8: one leaf alone decides the value here, so the walk ends here */
  VS_LIST(uint32_t) queue;
  struct { uint32_t cell, next, face; } *stack;
  size_t stack_room;
  VS_LIST(vs_cover) found;  /* winding numbers of the leaves at the place that a ray through a face has tested */
  VS_LIST(uint32_t) active; /* active: numbers of the leaves that contain the current cell; place[i]: index of leaf i in
                             * `active` */
  VS_LIST(uint32_t) place;
  VS_LIST(uint32_t) owner;  /* owner[c]: for a cell inside the result, the earliest leaf that makes the expression true
                             * there */
  uint32_t cells;
  size_t lids;              /* number of leaves that contain the current cell and alone decide the expression's value
                             * there */
  bool owned;               /* true if `owner` is needed, because some faces get the tag of the leaf that owns the cell
                             * beside them */
  /* the face through which the ray passes whose winding numbers are searched */
  uint32_t face;
  int axis;
  bool degenerate;
  vs_homogeneous at;
  int64_t u, v;
  vs_bvh_box column;
  vs_use probe[3];          /* boundary edges of one triangle of an untouched region, if the ray passes through such a
                             * region */
} walk;

/* The outline of a face through which a ray passes, or of one triangle of a region of untouched triangles. */
typedef struct {
  vs_plane plane;
  bool flip;                /* true if the face's + side is the - side of its plane, which is opposite to the plane's
                             * normal */
  const vs_use *uses;
  uint32_t count;
} outline;

/* ---- step 1: cells ---- */

bool vs_around_before(const vs_around *a, const vs_around *b) { /* returns true if a comes before b in the order of the
                                                                 * angle of (x, y), counted counter-clockwise from the
                                                                 * +x axis */
  bool lower_a = a->y < 0 || (a->y == 0 && a->x < 0), lower_b = b->y < 0 || (b->y == 0 && b->x < 0);
  if (lower_a != lower_b) return lower_b;
  return (vs_i128)a->x * b->y - (vs_i128)a->y * b->x > 0;
}

int vs_around_axes(vs_points_view view, uint32_t low, uint32_t high, int *x, int *y) {
  int axis = 0, sign = 0;
  int64_t best = -1;
  VS_ASSERT(low != high);
  for (int a = 0; a < 3; a++) {
    int64_t d = view.at[high].fixed[a] - view.at[low].fixed[a], size = d < 0 ? -d : d;
    if (size > best) best = size, axis = a;
  }
  sign = vs_compare(view, high, low, axis);
  for (int a = 0; sign == 0 && a < 3; a++) axis = a, sign = vs_compare(view, high, low, a);
  *x = (axis + 1) % 3;
  *y = (axis + 2) % 3;
  return sign;
}

static bool sort_edge(vs_kernel *k, walk *w, const vs_half *halves, size_t count) {
  enum { MANY = 64 };
  const vs_cluster *c = w->c;
  vs_around few[MANY], *all = few;
  size_t room = 0;
  if (count > MANY) {
    all = NULL;
    if (!VS_ROOM(k, all, room, count)) return false;
  }
  const vs_use *use = &c->uses.at[halves[0].item];
  uint32_t low = use->from < use->to ? use->from : use->to, high = use->from < use->to ? use->to : use->from;
  vs_points_view view = vs_points_of(&c->points);
  int x, y, sign = vs_around_axes(view, low, high, &x, &y);
  for (size_t i = 0; i < count; i++) {
    use = &c->uses.at[halves[i].item];
    const vs_plane *p = &c->planes.all.at[c->faces.at[use->face].plane];
    int64_t s = use->from == low ? 1 : -1;
    vs_around a = { s * p->n[sign > 0 ? x : y], s * p->n[sign > 0 ? y : x], 2 * use->face + (s < 0),
                    2 * use->face + (s > 0) };
    size_t j = i;
    for (; j > 0 && vs_around_before(&a, &all[j - 1]); j--) all[j] = all[j - 1];
    all[j] = a;
  }
  bool ok = true;
  for (size_t i = 0; i < count; i++) {
    const vs_around *a = &all[i], *b = &all[(i + 1) % count];
    if (i + 1 < count && !vs_around_before(a, b)) ok = VS_BROKEN(k, "two faces lie on each other");
    vs_unite_shared(w->sets.at, a->ccw, b->cw);
  }
  if (all != few) VS_FREE(k, all, room);
  return ok;
}

/* Prefetches memory for the uses (boundary edges) from i on: first each use, then its face, and last the plane of the
 * face. */
VS_AHEAD look_ahead(const vs_cluster *c, uint32_t i, uint32_t stop) {
  enum { USE = 36, FACE = 24, PLANE = 12 };
  const vs_half *at = c->edges.at.at + i;
  if (i + USE >= stop) return;
  __builtin_prefetch(&c->uses.at[at[USE].item]);
  __builtin_prefetch(&c->faces.at[c->uses.at[at[FACE].item].face]);
  __builtin_prefetch(&c->planes.all.at[c->faces.at[c->uses.at[at[PLANE].item].face].plane]);
}

/* Unites two sides of faces into one cell if they face each other at an edge. The function handles the edges whose
 * smaller point number is in range number `range` of the edge table. */
static bool join_range(vs_kernel *k, void *context, size_t range) {
  walk *w = context;
  const vs_cluster *c = w->c;
  const vs_halves *h = &c->edges;
  for (uint32_t i = h->first.at[vs_halves_begin(h, range)], low = vs_halves_begin(h, range),
                stop = h->first.at[vs_halves_begin(h, range + 1)], end;
       i < stop; i = end) {
    while (i >= h->first.at[low + 1]) low++;
    const vs_half *at = h->at.at + i;
    for (end = i + 1; end < h->first.at[low + 1] && h->at.at[end].high == at->high;) end++;
    for (uint32_t j = i; j < end; j++) look_ahead(c, j, stop);
    if (end - i == 1) { /* Only one face is left at this edge, because the kernel has removed the other face early as
                         * hidden. */
      uint32_t face = c->uses.at[at->item].face;
      vs_unite_shared(w->sets.at, 2 * face, 2 * face + 1);
    } else if (end - i == 2) {
      const vs_use *a = &c->uses.at[at[0].item], *b = &c->uses.at[at[1].item];
      uint32_t a_ccw = 2 * a->face + (a->from != low), b_ccw = 2 * b->face + (b->from != low);
      vs_unite_shared(w->sets.at, a_ccw, b_ccw ^ 1);
      vs_unite_shared(w->sets.at, b_ccw, a_ccw ^ 1);
    } else if (!sort_edge(k, w, at, end - i)) {
      return false;
    }
    if (!vs_kernel_poll(k, 0.7)) return false;
  }
  return true;
}

static void ends_of_uses(const void *context, uint32_t begin, uint32_t count, uint32_t (*ends)[2]) {
  const vs_use *use = (const vs_use *)context + begin;
  for (uint32_t i = 0; i < count; i++) ends[i][0] = use[i].from, ends[i][1] = use[i].to;
}

static bool make_cells(walk *w) {
  vs_cluster *c = w->c;
  vs_kernel *k = w->k;
  size_t n = c->uses.count, f = c->faces.count;
  if (f >= UINT32_MAX / 2 || n >= UINT32_MAX)
    return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  if (!VS_ROOM(k, w->sets.at, w->sets.room, 2 * f + 1)) return false;
  for (uint32_t i = 0; i < 2 * f; i++) atomic_init(&w->sets.at[i], i);
  if (!vs_halves_sort(k, &c->edges, (uint32_t)c->points.all.count, (uint32_t)n, ends_of_uses, c->uses.at) ||
      !vs_kernel_run(k, c->edges.ranges, join_range, w) || !VS_ROOM(k, w->side.at, w->side.room, 2 * f + 1))
    return false;
  for (size_t i = 0; i < c->regions.count; i++)
    if (c->regions.at[i].open) vs_unite_shared(w->sets.at, 2 * c->regions.at[i].face, 2 * c->regions.at[i].face + 1);
  w->cells = 0;
  for (uint32_t i = 0; i < 2 * f; i++) { /* The root of each set of united sides is its smallest number. Therefore one
                                          * pass can number the cells. */
    uint32_t root = vs_find_shared(w->sets.at, i);
    w->side.at[i] = root == i ? w->cells++ : w->side.at[root];
  }
  VS_DROP(k, w->sets);

  uint32_t cells = w->cells;
  if (!VS_ROOM(k, w->first.at, w->first.room, (size_t)cells + 2) ||
      !VS_ROOM(k, w->borders.at, w->borders.room, 2 * f + 1) ||
      !VS_ROOM(k, w->sum.at, w->sum.room, (size_t)cells + 1) ||
      !VS_ROOM(k, w->state.at, w->state.room, (size_t)cells + 1) ||
      !VS_ROOM(k, w->queue.at, w->queue.room, (size_t)cells + 1))
    return false;
  memset(w->first.at, 0, ((size_t)cells + 2) * sizeof(uint32_t));
  memset(w->state.at, 0, (size_t)cells + 1);
  for (size_t i = 0; i < 2 * f; i++) w->first.at[w->side.at[i] + 2]++;
  for (size_t i = 2; i < (size_t)cells + 2; i++) w->first.at[i] += w->first.at[i - 1];
  for (uint32_t i = 0; i < 2 * f; i++) w->borders.at[w->first.at[w->side.at[i] + 1]++] = i / 2;
  return true;
}

/* ---- step 2: the line ---- */

/* Makes the outline of a face. For a region of untouched triangles, it temporarily appends the corners of one triangle
 * to the cluster's points. */
static bool outline_of(walk *w, uint32_t face, outline *o) {
  vs_cluster *c = w->c;
  const vs_face *f = &c->faces.at[face];
  *o = (outline){ .uses = c->uses.at + f->use, .count = f->use_count };
  if (f->plane != VS_NONE) {
    o->plane = c->planes.all.at[f->plane];
    return true;
  }
  const vs_region *r = &c->regions.at[f->facet];
  const vs_placed *p = &c->placed.at[r->place];
  bool mirrored = vs_affine_determinant(&c->problem->leaves[c->leaves[r->place]].placement) < 0;
  const uint32_t *v = p->part->mesh->triangles[r->triangle];
  const int32_t *at[3] = { c->corners[p->first + v[0]], c->corners[p->first + v[mirrored ? 2 : 1]],
                           c->corners[p->first + v[mirrored ? 1 : 2]] };
  if (!vs_plane_through(at[0], at[1], at[2], &o->plane, &o->flip)) return VS_BROKEN(w->k, "a plain triangle is flat");
  o->uses = w->probe;
  o->count = 3;
  for (uint32_t j = 0; j < 3; j++) {
    vs_point corner = { .big = VS_POINT_EXACT, .next = VS_NONE };
    for (int a = 0; a < 3; a++) corner.fixed[a] = (int64_t)at[j][a] * ((int64_t)1 << VS_FIXED_BITS);
    w->probe[j] =
        (vs_use){ (uint32_t)c->points.all.count, (uint32_t)c->points.all.count + (j == 2 ? (uint32_t)-2 : 1), face };
    if (!VS_PUSH(w->k, c->points.all, corner)) return false;
  }
  return true;
}

/* Returns true if the point `probe` is strictly inside the outline as seen along the axis perpendicular to (au, av).
 * The test is exact. probe: number of the last point in the table. */
static bool strictly_inside(vs_points_view view, const outline *o, uint32_t probe, int au, int av) {
  bool inside = false;
  for (uint32_t i = 0; i < o->count; i++) {
    const vs_use *use = &o->uses[i];
    bool up_a = vs_compare(view, use->from, probe, av) > 0, up_b = vs_compare(view, use->to, probe, av) > 0;
    int turn = vs_orient2d(view, use->from, use->to, probe, au, av);
    if (turn == 0) return false;
    if (up_a != up_b && (turn > 0) == up_b) inside = !inside;
  }
  return inside;
}

/* Chooses a place inside the outline for a ray along w->axis. Seen along this axis, the place is on a line v = const,
 * in the middle of the longest interval between two crossings of the line with the boundary. `attempt`: number of the
 * trial, which selects the line. */
static bool aim(walk *w, const outline *o, int attempt) {
  vs_cluster *c = w->c;
  int au = (w->axis + 1) % 3, av = (w->axis + 2) % 3;
  /* Coordinates are relative to a point of the outline, so that their doubles are exact. */
  int64_t low = INT64_MAX, high = INT64_MIN, origin = c->points.all.at[o->uses[0].from].fixed[au];
  for (uint32_t i = 0; i < o->count; i++) {
    int64_t y = c->points.all.at[o->uses[i].from].fixed[av];
    if (y < low) low = y;
    if (y > high) high = y;
  }
  if (high - low < 4) return false;
  static const double parts[] = { 0.4871, 0.2613, 0.7382, 0.1137, 0.8891, 0.3719, 0.6323, 0.0523, 0.9467 };
  w->v = low + (int64_t)((double)(high - low) * parts[attempt]);
  w->found.count = 0;
  double best = -1, from = 0;
  VS_LIST(double) at = { 0 };
  bool ok = true;
  for (uint32_t i = 0; ok && i < o->count; i++) {
    const vs_use *use = &o->uses[i];
    const vs_point *a = &c->points.all.at[use->from], *b = &c->points.all.at[use->to];
    if ((a->fixed[av] > w->v) == (b->fixed[av] > w->v)) continue;
    double t = (double)(w->v - a->fixed[av]) / (double)(b->fixed[av] - a->fixed[av]);
    double x = (double)(a->fixed[au] - origin) + t * (double)(b->fixed[au] - a->fixed[au]);
    ok = VS_PUSH(w->k, at, x);
    for (size_t j = at.count - 1; ok && j > 0 && at.at[j - 1] > at.at[j]; j--) {
      double swap = at.at[j];
      at.at[j] = at.at[j - 1];
      at.at[j - 1] = swap;
    }
  }
  for (size_t i = 0; ok && i + 1 < at.count; i += 2)
    if (at.at[i + 1] - at.at[i] > best) best = at.at[i + 1] - at.at[i], from = at.at[i];
  VS_DROP(w->k, at);
  if (!ok || best < 4) return false;
  w->u = origin + (int64_t)(from + best * 0.4937);
  vs_plane_lift(&o->plane, w->axis, w->u, w->v, &w->at);
  return true;
}

/* Tests whether the ray crosses a triangle of the leaf, and adds the crossing to the leaf's winding number. The
 * triangle's corners are grid points. */
static bool shoot(walk *w, const vs_placed *p, uint32_t leaf, bool mirrored, size_t triangle) {
  const uint32_t *id = p->part->mesh->triangles[triangle];
  const int32_t *at[3] = { w->c->corners[p->first + id[0]], w->c->corners[p->first + id[mirrored ? 2 : 1]],
                           w->c->corners[p->first + id[mirrored ? 1 : 2]] };
  int au = (w->axis + 1) % 3, av = (w->axis + 2) % 3, turns = 0;
  int32_t u = (int32_t)(w->u >> VS_FIXED_BITS), v = (int32_t)(w->v >> VS_FIXED_BITS);
  if ((at[0][au] > u && at[1][au] > u && at[2][au] > u) || (at[0][au] < u && at[1][au] < u && at[2][au] < u) ||
      (at[0][av] > v && at[1][av] > v && at[2][av] > v) || (at[0][av] < v && at[1][av] < v && at[2][av] < v))
    return true;
  for (int i = 0; i < 3; i++) {
    const int32_t *a = at[i], *b = at[i == 2 ? 0 : i + 1];
    vs_i128 s = (vs_i128)((int64_t)b[au] - a[au]) * (w->v - (int64_t)a[av] * ((int64_t)1 << VS_FIXED_BITS)) -
                (vs_i128)((int64_t)b[av] - a[av]) * (w->u - (int64_t)a[au] * ((int64_t)1 << VS_FIXED_BITS));
    turns |= s > 0 ? 1 : s < 0 ? 2 : 4;
  }
  if ((turns & 3) == 3) return true;
  vs_plane plane;
  bool flip;
  if (!vs_plane_through(at[0], at[1], at[2], &plane, &flip) || plane.n[w->axis] == 0) return true;
  if (turns & 4) {
    w->degenerate = true; /* the ray passes through an edge of the triangle, so the caller must choose another place */
    return false;
  }
  int64_t n = plane.n[w->axis];
  int side = vs_homogeneous_side(&plane, &w->at);
  if (side == 0 || (side > 0) == (n > 0)) return true; /* the triangle is not above the ray's start */
  return VS_PUSH(w->k, w->found, ((vs_cover){ leaf, (n > 0) != flip ? 1 : -1 }));
}

typedef struct { walk *w; vs_placed *placed; uint32_t leaf; bool mirrored; } shot;

static bool shoot_one(void *context, uint32_t triangle) {
  shot *s = context;
  return shoot(s->w, s->placed, s->leaf, s->mirrored, triangle);
}

static bool index_leaf(walk *w, vs_placed *p) {
  const vs_mesh *m = p->part->mesh;
  if (!VS_ROOM(w->k, p->bvh_boxes, p->bvh_box_room, m->triangle_count)) return false;
  for (size_t t = 0; t < m->triangle_count; t++) {
    vs_bvh_box *b = &p->bvh_boxes[t];
    for (int a = 0; a < 3; a++) {
      b->min[a] = INT32_MAX;
      b->max[a] = INT32_MIN;
      for (int j = 0; j < 3; j++) {
        int32_t x = w->c->corners[p->first + m->triangles[t][j]][a];
        if (x < b->min[a]) b->min[a] = x;
        if (x > b->max[a]) b->max[a] = x;
      }
    }
  }
  return vs_bvh_build(w->k, &p->bvh, p->bvh_boxes, (uint32_t)m->triangle_count);
}

static bool shoot_leaf(void *context, uint32_t place) {
  enum { MANY = 2048, OFTEN = 16 }; /* A leaf with at least MANY triangles gets a tree of its triangles' boxes when
                                     * OFTEN rays have been tested against it. */
  walk *w = context;
  vs_placed *p = &w->c->placed.at[place];
  uint32_t leaf = w->c->leaves[place];
  bool counts = !w->c->joining;
  for (uint32_t i = 0; !counts && i < w->c->joining_count; i++) counts = w->c->joining[i] == vs_solid_of(w->c, leaf);
  if (!counts) return true;
  shot s = { w, p, leaf, vs_affine_determinant(&w->c->problem->leaves[leaf].placement) < 0 };
  size_t n = p->part->mesh->triangle_count;
  if (n > MANY && p->lines++ >= OFTEN)
    return (p->bvh.level_count || index_leaf(w, p)) && vs_bvh_query(&p->bvh, &w->column, shoot_one, &s);
  for (size_t t = 0; t < n; t++)
    if (!shoot(w, p, leaf, s.mirrored, t) || !vs_kernel_poll(w->k, 0.8)) return false;
  return true;
}

static int by_leaf(const void *a, const void *b) {
  uint32_t x = ((const vs_cover *)a)->leaf, y = ((const vs_cover *)b)->leaf;
  return (x > y) - (x < y);
}

/* In w->found, replaces the winding numbers of all leaves that were united to one solid by a single number for the
 * solid: 1 if the place is inside any of these leaves, else 0. */
static void find_solids(walk *w) {
  vs_cover *at = w->found.at;
  size_t n = w->found.count, kept = 0;
  if (!w->c->solid) return;
  for (size_t i = 0, end; i < n; i = end) { /* entries of `found` that belong to one leaf are consecutive */
    vs_cover sum = at[i];
    for (end = i + 1; end < n && at[end].leaf == sum.leaf; end++) sum.delta += at[end].delta;
    if (w->c->layered && w->c->layered[sum.leaf]) {
      if (sum.delta <= 0) continue;
      sum = (vs_cover){ vs_solid_of(w->c, sum.leaf), 1 };
    }
    at[kept++] = sum;
  }
  if (kept) qsort(at, kept, sizeof *at, by_leaf);
  n = kept;
  kept = 0;
  for (size_t i = 0; i < n; i++)
    if (!kept || at[kept - 1].leaf != at[i].leaf) at[kept++] = at[i];
  w->found.count = kept;
}

/* Sets w->found to the winding numbers just above the face, along an axis. *side: the side of the face that is above.
 * *done: false if no ray through the face gave a clear result. Returns false on an error. */
static bool look_through(walk *w, uint32_t face, const outline *o, uint32_t *side, bool *done) {
  vs_cluster *c = w->c;
  w->axis = o->plane.k;
  *side = 2 * face + ((o->plane.n[w->axis] < 0) != o->flip);
  *done = false;
  for (int attempt = 0; attempt < 9 && !*done; attempt++) {
    if (!aim(w, o, attempt)) {
      if (w->k->error->status != VS_KERNEL_FINE) return false;
      continue;
    }
    vs_point probe = { .big = VS_POINT_EXACT, .next = VS_NONE };
    int au = (w->axis + 1) % 3, av = (w->axis + 2) % 3;
    probe.fixed[au] = w->u;
    probe.fixed[av] = w->v;
    if (!VS_PUSH(w->k, c->points.all, probe)) return false; /* the test point is temporarily appended to the cluster's
                                                             * points, but not entered in their hash table */
    bool inside = strictly_inside(vs_points_of(&c->points), o, (uint32_t)c->points.all.count - 1, au, av);
    c->points.all.count--;
    if (!inside) continue;
    vs_bvh_box *box = &w->column;
    box->min[w->axis] = INT32_MIN;
    box->max[w->axis] = INT32_MAX;
    box->min[au] = (int32_t)(w->u >> VS_FIXED_BITS);
    box->max[au] = box->min[au] + 1;
    box->min[av] = (int32_t)(w->v >> VS_FIXED_BITS);
    box->max[av] = box->min[av] + 1;
    w->degenerate = false;
    w->found.count = 0;
    if (vs_bvh_query(&c->leaf_bvh, box, shoot_leaf, w)) *done = true;
    else if (!w->degenerate) return false;
  }
  if (*done) find_solids(w);
  return true;
}

static bool look(walk *w, uint32_t face, uint32_t *side, bool *done) {
  size_t points = w->c->points.all.count;
  outline o;
  bool ok = outline_of(w, face, &o) && look_through(w, face, &o, side, done);
  w->c->points.all.count = points;
  return ok;
}

/* ---- step 3: the walk ---- */

static uint64_t leaf_key(uint32_t leaf) {
  uint64_t h = ((uint64_t)leaf + 1) * 0x9e3779b97f4a7c15u;
  h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
  return (h ^ h >> 27) | 1;
}

static bool turn_leaf(walk *w, uint32_t leaf, int32_t delta) {
  bool before = w->e->winding.at[leaf] > 0;
  if (!vs_expression_add(w->k, w->e, leaf, delta)) return false;
  bool now = w->e->winding.at[leaf] > 0;
  if (before != now && w->e->forces.at[leaf]) w->lids += now ? 1 : SIZE_MAX;
  if (before == now || w->e->taken_off.at[leaf]) return true;
  if (now) {
    w->place.at[leaf] = (uint32_t)w->active.count;
    return VS_PUSH(w->k, w->active, leaf);
  }
  uint32_t last = w->active.at[--w->active.count];
  w->active.at[w->place.at[leaf]] = last;
  w->place.at[last] = w->place.at[leaf];
  return true;
}

/* Finds the owner of a cell: the leaf with the lowest number that makes the expression true there. A leaf does not
 * count if another operand subtracts it again. */
static bool find_owner(walk *w, uint32_t cell) {
  uint32_t owner = VS_NONE, first = VS_NONE;
  for (size_t i = 0; i < w->active.count; i++) {
    uint32_t leaf = w->active.at[i];
    bool upholds = w->active.count == 1;
    if (leaf < first) first = leaf;
    if (leaf > owner) continue;
    if (!upholds && !vs_expression_upholds(w->k, w->e, leaf, &upholds)) return false;
    if (upholds) owner = leaf;
  }
  w->owner.at[cell] = owner != VS_NONE ? owner : first;
  return true;
}

/* Enters a cell with the sum of the random numbers of its windings, and evaluates the expression there. */
static bool arrive(walk *w, uint32_t cell, uint64_t sum) {
  bool joining = w->c->joining != NULL, settled = w->lids > 0 || (!joining && vs_expression_gated(w->e));
  bool inside = joining ? settled : vs_expression_value(w->e);
  VS_ASSERT(cell < w->cells);
  w->sum.at[cell] = sum;
  w->state.at[cell] = (uint8_t)(3 | (inside ? 4 : 0) | (settled ? 8 : 0));
  if (w->c->inspect) w->c->wound.at[cell] = w->e->winding.at[w->c->leaves[0]];
  w->owner.at[cell] = VS_NONE;
  return !inside || !w->owned || find_owner(w, cell);
}

/* Returns by how much the sum of random numbers for the windings changes from the + side of the face to its - side. */
static uint64_t change(const walk *w, uint32_t face) {
  const vs_face *f = &w->c->faces.at[face];
  uint64_t sum = 0;
  VS_ASSERT(face < w->c->faces.count);
  for (uint32_t i = 0; i < f->cover_count; i++) {
    vs_cover cover = w->c->covers.at[f->cover + i];
    sum += leaf_key(vs_solid_of(w->c, cover.leaf)) * (uint64_t)(int64_t)cover.delta;
  }
  return sum;
}

static bool pass(walk *w, uint32_t face, int32_t sign) { /* updates the winding numbers of all leaves for a step through
                                                          * the face; sign: 1 from the + side to the - side, -1 in the
                                                          * opposite direction */
  const vs_face *f = &w->c->faces.at[face];
  for (uint32_t i = 0; i < f->cover_count; i++) {
    vs_cover cover = w->c->covers.at[f->cover + i];
    if (!turn_leaf(w, vs_solid_of(w->c, cover.leaf), sign * cover.delta)) return false;
  }
  return true;
}

static bool walk_from(walk *w, uint32_t cell) {
  uint64_t sum = 0;
  for (size_t i = 0; i < w->found.count; i++) {
    sum += leaf_key(w->found.at[i].leaf) * (uint64_t)(int64_t)w->found.at[i].delta;
    if (!turn_leaf(w, w->found.at[i].leaf, w->found.at[i].delta)) return false;
  }
  size_t depth = 0;
  if (!VS_ROOM(w->k, w->stack, w->stack_room, 1)) return false;
  w->stack[depth].cell = cell;
  w->stack[depth].face = VS_NONE;
  w->stack[depth++].next = w->first.at[cell];
  if (!arrive(w, cell, sum)) return false;
  while (depth) {
    uint32_t here = w->stack[depth - 1].cell;
    if (w->state.at[here] & 8) w->stack[depth - 1].next = w->first.at[here + 1]; /* one leaf alone decides the value in
                                                                                  * this cell, so the walk does not
                                                                                  * continue from the cell */
    if (w->stack[depth - 1].next == w->first.at[here + 1]) {
      uint32_t back = w->stack[--depth].face; /* goes back through the face through which the walk entered the current
                                               * cell */
      if (back != VS_NONE && !pass(w, back, w->side.at[2 * back] == here ? 1 : -1)) return false;
      continue;
    }
    uint32_t face = w->borders.at[w->stack[depth - 1].next++];
    uint32_t plus = w->side.at[2 * face], minus = w->side.at[2 * face + 1];
    if (plus == minus) return VS_BROKEN(w->k, "a face has one side");
    uint32_t other = plus == here ? minus : plus;
    if (w->state.at[other] & 2) {
      if (!(w->state.at[other] & 8) && plus == here && w->sum.at[minus] != w->sum.at[plus] + change(w, face))
        return VS_BROKEN(w->k, "two ways into a cell disagree");
      continue;
    }
    if (!pass(w, face, plus == here ? 1 : -1)) return false;
    if (!arrive(w, other, w->sum.at[here] + (plus == here ? change(w, face) : (uint64_t)0 - change(w, face))))
      return false;
    if (!VS_ROOM(w->k, w->stack, w->stack_room, depth + 1)) return false;
    w->stack[depth].cell = other;
    w->stack[depth].face = face;
    w->stack[depth++].next = w->first.at[other];
    if (!vs_kernel_poll(w->k, 0.8)) return false;
  }
  for (size_t i = 0; i < w->found.count; i++)
    if (!turn_leaf(w, w->found.at[i].leaf, -w->found.at[i].delta)) return false;
  return true;
}

/* Returns twice the approximate area of the face, as seen along the main axis of its plane, in squares of fixed-point
 * units. Returns infinity for a region of untouched triangles, of which a large one is chosen. */
static double about_area(const walk *w, uint32_t face) {
  const vs_cluster *c = w->c;
  if (c->faces.at[face].plane == VS_NONE) return INFINITY;
  const vs_plane *p = &c->planes.all.at[c->faces.at[face].plane];
  uint32_t begin = c->faces.at[face].use, end = begin + c->faces.at[face].use_count;
  if (begin == end) return 0;
  const vs_point *o = &c->points.all.at[c->uses.at[begin].from];
  double sum = 0;
  for (uint32_t i = begin; i < end; i++) {
    const vs_use *use = &c->uses.at[i];
    const vs_point *a = &c->points.all.at[use->from], *b = &c->points.all.at[use->to];
    sum += (double)(a->fixed[p->u] - o->fixed[p->u]) * (double)(b->fixed[p->v] - o->fixed[p->v]) -
           (double)(a->fixed[p->v] - o->fixed[p->v]) * (double)(b->fixed[p->u] - o->fixed[p->u]);
  }
  return sum;
}

/* The result of a search for a face through which a ray can pass, near a given cell. */
typedef struct {
  uint32_t side;  /* side of the face for which winding numbers were found; valid if `done` is true */
  bool done;      /* false if the faces near the start are too small for a ray */
  size_t cells;   /* number of cells (connected pieces of space) in w->queue whose faces were searched */
} sighting;

/* Searches the faces of the cell `start` and of cells connected to it: at most `most` cells and `faces` faces. Sends a
 * ray through the largest face found. *a: the result. */
static bool look_around(walk *w, uint32_t start, size_t most, size_t faces, sighting *a) {
  size_t head = 0, tail = 0, seen = 0;
  double best = -1;
  uint32_t face = VS_NONE;
  w->queue.at[tail++] = start;
  w->state.at[start] |= 1;
  while (head < tail && seen < faces) {
    uint32_t cell = w->queue.at[head++];
    for (uint32_t i = w->first.at[cell]; i < w->first.at[cell + 1] && seen < faces; i++) {
      uint32_t f = w->borders.at[i], plus = w->side.at[2 * f], other = plus == cell ? w->side.at[2 * f + 1] : plus;
      double area = about_area(w, f);
      seen++;
      if (area > best) best = area, face = f;
      if (w->state.at[other] || tail >= most) continue;
      w->state.at[other] = 1;
      w->queue.at[tail++] = other;
    }
  }
  for (size_t i = 1; i < tail; i++) w->state.at[w->queue.at[i]] = 0;
  a->cells = tail;
  return look(w, face, &a->side, &a->done);
}

/* Returns the approximate thickness of a face perpendicular to its longest side, in fixed-point units. */
static double about_thickness(const walk *w, uint32_t face) {
  const vs_cluster *c = w->c;
  const vs_face *f = &c->faces.at[face];
  const int64_t *from = c->points.all.at[c->uses.at[f->use].from].fixed;
  double longest = 1;
  for (uint32_t u = f->use; u < f->use + f->use_count; u++)
    for (int a = 0; a < 3; a++) {
      double reach = fabs((double)(c->points.all.at[c->uses.at[u].from].fixed[a] - from[a]));
      if (reach > longest) longest = reach;
    }
  return fabs(about_area(w, face)) / longest;
}

/* Gives the first `cells` cells in w->queue the known value of a cell beside them, if all of them are too thin for a
 * ray. Returns false if they are not, or no such value is known. The result is closed for any value. */
static bool settle_crumbs(walk *w, size_t cells) {
  static const double CRUMB = 64; /* greatest thickness of a face, in fixed-point units, at which a ray cannot be aimed
                                   * at the face */
  uint32_t known = VS_NONE;
  for (size_t i = 0; i < cells; i++)
    for (uint32_t cell = w->queue.at[i], j = w->first.at[cell]; j < w->first.at[cell + 1]; j++) {
      if (!(about_thickness(w, w->borders.at[j]) <= CRUMB)) return false;
      for (uint32_t side = 0; side < 2; side++) {
        uint32_t other = w->side.at[2 * w->borders.at[j] + side];
        if (w->state.at[other] & 2) known = other;
      }
    }
  for (size_t i = 0; known != VS_NONE && i < cells; i++) {
    w->state.at[w->queue.at[i]] = (uint8_t)(2 | 8 | (w->state.at[known] & 4));
    w->owner.at[w->queue.at[i]] = VS_NONE;
  }
  return known != VS_NONE;
}

/* Finds the winding numbers of one cell with a ray, and walks from there to all connected cells. most: number of cells
 * in which to search for a face. */
static bool walk_component(walk *w, uint32_t start, size_t most) {
  enum { FACES = 256 };
  sighting a = { .done = false };
  if (!look_around(w, start, most, FACES, &a)) return false;
  /* A solid that nearly touches itself at one place has thousands of tiny cells there. Therefore all cells are
   * searched. */
  if (!a.done && most > 1 && !look_around(w, start, w->cells, SIZE_MAX, &a)) return false;
  for (size_t i = 0; !a.done && i < a.cells; i++) /* The ray through the largest face failed. Therefore all faces are
                                                   * tried. */
    for (uint32_t j = w->first.at[w->queue.at[i]]; !a.done && j < w->first.at[w->queue.at[i] + 1]; j++)
      if (!look(w, w->borders.at[j], &a.side, &a.done)) return false;
  if (!a.done) return settle_crumbs(w, a.cells) || VS_BROKEN(w->k, "no face to look through");
  uint32_t above = w->side.at[a.side], below = w->side.at[a.side ^ 1], through = a.side / 2;
  if (!(w->state.at[above] & 2) && !walk_from(w, above)) return false;
  if (w->state.at[below] & 2) return true;
  const vs_face *f = &w->c->faces.at[through]; /* In the cell above the face, a single leaf decides the value, so the
                                                * walk cannot start there. It starts in the cell below the face. */
  for (uint32_t i = 0; i < f->cover_count; i++) {
    vs_cover cover = w->c->covers.at[f->cover + i];
    vs_cover across = { vs_solid_of(w->c, cover.leaf), a.side & 1 ? -cover.delta : cover.delta };
    if (!VS_PUSH(w->k, w->found, across)) return false;
  }
  return walk_from(w, below);
}

/* Marks cells inside a star (leaf whose middle sees every triangle from inside) that alone decides the expression's
 * value there. These cells need no ray. They lie beside a face where the leaf's winding number changes between 0 and
 * 1. */
static bool mark_settled(walk *w) {
  const vs_cluster *c = w->c;
  bool value = c->joining || w->e->forced;
  uint8_t *settles = NULL; /* settles[i]: 1 if leaf i of the problem alone decides the expression's value inside it */
  size_t room = 0;
  bool any = false;
  for (uint32_t i = 0; i < c->leaf_count; i++) any = any || (c->placed.at[i].star && w->e->forces.at[c->leaves[i]]);
  if (!any) return true;
  if (!VS_ROOM(w->k, settles, room, (size_t)c->problem->leaf_count + 1)) return false;
  /* Only leaves (placed meshes) of this cluster have faces in its arrangement. */
  for (uint32_t i = 0; i < c->leaf_count; i++)
    settles[c->leaves[i]] = c->placed.at[i].star && w->e->forces.at[c->leaves[i]];
  for (uint32_t f = 0; f < c->faces.count; f++)
    for (uint32_t i = 0; i < c->faces.at[f].cover_count; i++) {
      vs_cover cover = c->covers.at[c->faces.at[f].cover + i];
      if (!settles[cover.leaf]) continue;
      uint32_t cell = w->side.at[2 * f + (cover.delta > 0)];
      w->state.at[cell] = (uint8_t)(2 | 8 | (value ? 4 : 0));
      w->owner.at[cell] = VS_NONE;
    }
  VS_FREE(w->k, settles, room);
  return true;
}

/* Returns the leaf whose tag the face gets: the first leaf with this surface. If that leaf is `bare` and subtracted,
 * returns the owner of the cell on the inner side of the face instead. */
static uint32_t painter(const walk *w, uint32_t face, uint32_t cell) {
  const vs_cluster *c = w->c;
  const vs_face *f = &c->faces.at[face];
  uint32_t leaf = c->covers.at[f->cover].leaf;
  if (!c->kept.at[face] || !c->problem->leaves[leaf].bare || !w->e->taken_off.at[leaf]) return leaf;
  if (!(w->state.at[cell] & 8)) return w->owner.at[cell] == VS_NONE ? leaf : w->owner.at[cell];
  for (uint32_t i = 0; i < f->cover_count; i++) /* the cell is inside the result because of a leaf that has this face in
                                                 * its surface */
    if (!w->e->taken_off.at[c->covers.at[f->cover + i].leaf]) return c->covers.at[f->cover + i].leaf;
  return leaf;
}

bool vs_classify_faces(vs_kernel *k, vs_cluster *c, vs_expression *e) {
  walk w = { .k = k, .c = c, .e = e };
  bool ok = make_cells(&w) && VS_ROOM(k, w.place.at, w.place.room, (size_t)c->problem->leaf_count + 1) &&
            VS_ROOM(k, w.owner.at, w.owner.room, (size_t)w.cells + 1) &&
            (!c->inspect || VS_ROOM(k, c->wound.at, c->wound.room, (size_t)w.cells + 1));
  for (uint32_t i = 0; i < c->leaf_count && !c->joining; i++)
    w.owned |= c->problem->leaves[c->leaves[i]].bare && e->taken_off.at[c->leaves[i]];
  ok = ok && mark_settled(&w);
  for (uint32_t i = 0; ok && i < w.cells; i++) {
    enum { AROUND = 1000 };
    if (w.state.at[i] & 2) continue;
    /* The ray may not reach all connected cells, because the walk ends at cells that one leaf decides. If it does not
     * reach cell i, another ray starts at that cell. */
    ok = walk_component(&w, i, AROUND) && (w.state.at[i] & 2 || walk_component(&w, i, 1)) && vs_kernel_poll(k, 0.8);
  }
  ok = ok && VS_ROOM(k, c->kept.at, c->kept.room, c->faces.count + 1);
  if (ok) c->kept.count = c->faces.count;
  for (uint32_t f = 0; ok && f < c->faces.count; f++) {
    bool plus = w.state.at[w.side.at[2 * f]] & 4, minus = w.state.at[w.side.at[2 * f + 1]] & 4;
    c->kept.at[f] = plus == minus ? 0 : plus ? 2 : 1;
    uint32_t leaf = painter(&w, f, w.side.at[2 * f + minus]);
    c->faces.at[f].tag = c->joining ? leaf : c->problem->leaves[leaf].tag;
  }
  if (ok && c->inspect) {
    c->wound.count = w.cells;
    c->side_cell.count = 2 * c->faces.count;
    c->side_cell.room = w.side.room;
    c->side_cell.at = w.side.at; /* these arrays now belong to the cluster, which frees them */
    w.side.at = NULL;
    w.side.room = 0;
  }
  VS_DROP(k, w.sets);
  VS_DROP(k, w.side);
  VS_DROP(k, w.first);
  VS_DROP(k, w.borders);
  VS_DROP(k, w.sum);
  VS_DROP(k, w.state);
  VS_DROP(k, w.queue);
  VS_FREE(k, w.stack, w.stack_room);
  VS_DROP(k, w.found);
  VS_DROP(k, w.active);
  VS_DROP(k, w.place);
  VS_DROP(k, w.owner);
  return ok;
}
