/* Unites the solids of a crowded cluster level by level. Where many solids overlap, the hidden parts are then never
 * arranged all at once.
 *
 * In a single arrangement of k solids at one place, each facet is cut k times, and its cuts cross k^2 times. Nearly all
 * of this is hidden in the result. Here the leaves that settle the result inside themselves are united two by two,
 * neighbours first. These leaves are operands of a union or holes of a difference. Then the border of such a union is
 * arranged with the border of the next. The expression has the same value inside any of these leaves. Therefore their
 * union replaces all of them in the expression, with the number of the first (vs_solid_of), and the terms do not
 * change. At the end, the union is arranged with all other leaves in the usual way.
 *
 * Nothing is rounded between levels. Facets keep the planes of the input, and their corners are exact points. Each side
 * keeps its line, an edge of the input or a second plane. Therefore a new point is an intersection of an edge and a
 * plane, or of three planes, of the input. Its numbers are no longer than in a single arrangement. A kept face has the
 * same leaf as without levels, the earliest leaf with this surface, and therefore the same paint. Faces of one leaf are
 * merged again after each level, and corners that are not needed are dropped.
 *
 * A level is a small cluster with separate points. Nothing is culled because it lies inside a lid, as the leaf that
 * covers it may be in another level. */
#include "kernel/arrange/levels.h"

#include "kernel/arrange/arrange_planes.h"
#include "kernel/arrange/classify.h"
#include "kernel/arrange/intersect_facets.h"
#include "kernel/cluster.h"
#include "kernel/mesh/make_result.h"

#include <string.h>

/* A shell: the border of the union of some leaves (placed meshes), as facets that are given by their border edges. */
typedef struct {
  vs_points_table points; /* points of the shell, without the hash table that finds a point by its coordinates */
  vs_outlines outlines;   /* facets of the shell and their border edges, which refer to elements of `points` */
  vs_bvh_box box;
  uint32_t solid;         /* number of one leaf (placed mesh) inside the shell, from which vs_solid_of finds the shell's
                           * solid */
} shell;

/* A range of leaves: order[first] to order[end - 1]. made: true if the shells of both halves of the range are already
 * on the stack. */
typedef struct { uint32_t first, end; bool made; } span;

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  vs_expression *e;
  VS_LIST(uint32_t) order;       /* indices of the leaves to unite, in an order in which leaves that are close in space
                                  * are neighbours */
  VS_LIST(uint64_t) weight;      /* weight[i]: number of facets of the first i leaves in `order`, plus 1 for each of
                                  * these leaves */
  VS_LIST(uint32_t) facet_first; /* facet_first[i]: index of the first facet of leaf i of the cluster; an extra element
                                  * marks the end */
  VS_LIST(span) spans;
  VS_LIST(shell) shells;
  /* number[p]: the shell's number of the cluster's point p, while points are copied from the cluster to a shell;
   * otherwise VS_NONE */
  VS_LIST(uint32_t) number;
  VS_LIST(uint32_t) taken;       /* numbers p of the points for which number[p] is set, so that these elements can be
                                  * reset */
  VS_LIST(uint32_t) moved;       /* moved[i]: number that point i of a shell received when the shell was copied to the
                                  * cluster */
  size_t done;
} levels;

static void shell_free(vs_kernel *k, shell *s) {
  vs_points_free(k, &s->points);
  VS_DROP(k, s->outlines.facets);
  VS_DROP(k, s->outlines.sides);
}

/* ---- copying of points between two tables ---- */

/* Copies a point into a shell, unless it was copied before, and sets *id to its number in the shell. */
static bool take_point(levels *l, shell *s, const vs_points_table *from, uint32_t *id) {
  uint32_t *number = &l->number.at[*id];
  if (*number == VS_NONE) {
    vs_point p = from->all.at[*id];
    if (!vs_point_exact(&p)) {
      if (!VS_PUSH(l->k, s->points.big, from->big.at[p.big])) return false;
      p.big = (uint32_t)s->points.big.count - 1;
    }
    p.next = VS_NONE;
    *number = (uint32_t)s->points.all.count;
    if (!VS_PUSH(l->k, s->points.all, p) || !VS_PUSH(l->k, l->taken, *id)) return false;
    vs_box_add_point(&s->box, &p);
  }
  *id = *number;
  return true;
}

static bool take_points(levels *l, shell *s, const vs_points_table *from) {
  size_t points = from->all.count;
  if (!VS_ROOM(l->k, l->number.at, l->number.room, points + 1)) return false;
  for (; l->number.count < points; l->number.count++) l->number.at[l->number.count] = VS_NONE;
  l->taken.count = 0;
  s->box = vs_box_nowhere;
  for (size_t i = 0; i < s->outlines.sides.count; i++)
    if (!take_point(l, s, from, &s->outlines.sides.at[i].from) ||
        !take_point(l, s, from, &s->outlines.sides.at[i].to)) return false;
  for (size_t i = 0; i < l->taken.count; i++) l->number.at[l->taken.at[i]] = VS_NONE;
  return true;
}

/* Appends the facets of shell s to those of cluster `to`. Facets with the same number `family` are not tested against
 * each other (bvh.h). The caller appends an extra facet that marks the end of the last facet. */
static bool add_shell(levels *l, vs_cluster *to, const shell *s, uint32_t family) {
  vs_kernel *k = l->k;
  size_t points = s->points.all.count, facets = s->outlines.facets.count;
  uint32_t first = (uint32_t)to->sides.count;
  VS_ASSERT(facets > 0);
  if (!VS_ROOM(k, l->moved.at, l->moved.room, points + 1) || !vs_points_expect(k, &to->points, points)) return false;
  for (size_t i = 0; i < points; i++) {
    const vs_point *p = &s->points.all.at[i];
    if (!vs_points_add_fixed(k, &to->points, p->fixed, vs_point_exact(p) ? NULL : &s->points.big.at[p->big],
        &l->moved.at[i])) return false;
  }
  if (!VS_ROOM(k, to->facets.at, to->facets.room, to->facets.count + facets + 1) ||
      !VS_ROOM(k, to->sides.at, to->sides.room, first + s->outlines.sides.count)) return false;
  for (size_t i = 0; i < facets; i++) {
    vs_facet f = s->outlines.facets.at[i];
    f.first += first;
    f.place = family;
    to->facets.at[to->facets.count++] = f;
  }
  for (size_t i = 0; i < s->outlines.sides.count; i++) {
    vs_facet_side side = s->outlines.sides.at[i];
    side.from = l->moved.at[side.from];
    side.to = l->moved.at[side.to];
    to->sides.at[to->sides.count++] = side;
  }
  return vs_kernel_report(k, k->part);
}

static bool end_facets(vs_kernel *k, vs_cluster *c) {
  if (!VS_PUSH(k, c->facets, ((vs_facet){ .leaf = VS_NONE, .first = (uint32_t)c->sides.count }))) return false;
  c->facets.count--; /* the extra facet is not counted, but stays in memory: its `first` is the end of the last facet */
  return true;
}

/* Appends the facets of one leaf to `to`, defined by their border edges instead of triangles. Each border edge becomes
 * a line. place: index of the leaf in the cluster. */
static bool add_outlines(levels *l, uint32_t place, vs_outlines *to) {
  vs_cluster *c = l->c;
  vs_kernel *k = l->k;
  for (uint32_t i = l->facet_first.at[place]; i < l->facet_first.at[place + 1]; i++) {
    vs_facet f = c->facets.at[i];
    uint32_t begin = f.first, end = c->facets.at[i + 1].first;
    f.first = (uint32_t)to->sides.count;
    if (!VS_PUSH(k, to->facets, f)) return false;
    for (uint32_t j = begin; j < end; j++) {
      const vs_grid_triangle *t = &c->triangles.at[c->facet_triangles.at[j]];
      for (uint32_t n = 0; n < 3; n++) {
        if (t->inner >> n & 1) continue;
        vs_line line;
        vs_facet_side side = { t->v[n], t->v[n == 2 ? 0 : n + 1], VS_LINE | (uint32_t)c->lines.count };
        vs_points_grid(&c->points, side.from, line.at[0]);
        vs_points_grid(&c->points, side.to, line.at[1]);
        if (c->lines.count >= VS_LINE - 1)
          return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
        if (!VS_PUSH(k, c->lines, line) || !VS_PUSH(k, to->sides, side)) return false;
      }
    }
  }
  return true;
}

/* ---- levels ---- */

static bool make_leaf(levels *l, uint32_t place) {
  shell s = { .solid = l->c->leaves[place] };
  if (!add_outlines(l, place, &s.outlines) ||
      !VS_PUSH(l->k, s.outlines.facets, ((vs_facet){ .leaf = VS_NONE, .first = (uint32_t)s.outlines.sides.count })))
    return shell_free(l->k, &s), false;
  s.outlines.facets.count--;
  if (!take_points(l, &s, &l->c->points) || !VS_PUSH(l->k, l->shells, s)) return shell_free(l->k, &s), false;
  return true;
}

static void level_free(vs_kernel *k, vs_cluster *c) { /* Frees the cluster in which two shells were united, except the
                                                       * members that belong to the enclosing cluster. */
  vs_points_free(k, &c->points);
  VS_DROP(k, c->facets);
  VS_DROP(k, c->sides);
  VS_DROP(k, c->use_line);
  VS_DROP(k, c->cuts);
  VS_DROP(k, c->faces);
  VS_DROP(k, c->covers);
  VS_DROP(k, c->uses);
  vs_halves_free(k, &c->edges);
  VS_DROP(k, c->kept);
}

/* Appends the facets of shell b to shell a, without intersecting the two. */
static bool append(levels *l, shell *a, const shell *b) {
  vs_cluster both = { .points = { .all = { 0 } } };
  vs_kernel *k = l->k;
  bool ok = add_shell(l, &both, a, 0) && add_shell(l, &both, b, 0) && end_facets(k, &both);
  if (ok) {
    shell_free(k, a);
    VS_DROP(k, both.points.slots);
    a->points.all.at = both.points.all.at, a->points.all.count = both.points.all.count,
        a->points.all.room = both.points.all.room;
    a->points.big.at = both.points.big.at, a->points.big.count = both.points.big.count,
        a->points.big.room = both.points.big.room;
    a->outlines.facets.at = both.facets.at, a->outlines.facets.count = both.facets.count,
        a->outlines.facets.room = both.facets.room;
    a->outlines.sides.at = both.sides.at, a->outlines.sides.count = both.sides.count,
        a->outlines.sides.room = both.sides.room;
    for (int i = 0; i < 3; i++) {
      if (b->box.min[i] < a->box.min[i]) a->box.min[i] = b->box.min[i];
      if (b->box.max[i] > a->box.max[i]) a->box.max[i] = b->box.max[i];
    }
  } else {
    level_free(k, &both);
  }
  return ok;
}

/* Replaces the last two shells on the stack by their union. The stack has at least two shells. */
static bool unite_last(levels *l) {
  enum { SERIAL = 10000 }; /* number of facets below which a single thread is faster than several */
  vs_kernel *k = l->k;
  const vs_cluster *c = l->c;
  shell *a = &l->shells.at[l->shells.count - 2], *b = &l->shells.at[l->shells.count - 1], made = { .solid = a->solid };
  uint32_t roots[2] = { vs_solid_of(c, a->solid), vs_solid_of(c, b->solid) }, threads = k->threads;
  bool ok;
  VS_ASSERT(l->shells.count >= 2);
  if (!vs_box_meet(&a->box, &b->box)) {
    ok = append(l, a, b);
  } else {
    vs_cluster level = { .problem = c->problem, .parts = c->parts, .expression = c->expression, .leaves = c->leaves,
                         .leaf_count = c->leaf_count, .grid = c->grid, .corners = c->corners, .leaf_bvh = c->leaf_bvh,
                         .solid = c->solid, .layered = c->layered, .joining = roots, .joining_count = 2 };
    memcpy(&level.placed, &c->placed, sizeof level.placed);
    memcpy(&level.planes, &c->planes, sizeof level.planes);
    memcpy(&level.lines, &c->lines, sizeof level.lines);
    ok = add_shell(l, &level, a, 0) && add_shell(l, &level, b, 1) && end_facets(k, &level);
    if (ok && level.facets.count < SERIAL) k->threads = 1;
    ok = ok && vs_meet_facets(k, &level) && vs_arrange_planes(k, &level) && vs_classify_faces(k, &level, l->e) &&
        vs_output_outlines(k, &level, &made.outlines) &&
         take_points(l, &made, &level.points);
    k->threads = threads;
    level_free(k, &level);
    shell_free(k, ok ? a : &made);
    if (ok) *a = made;
  }
  vs_unite(c->solid, roots[0], roots[1]);
  shell_free(k, b);
  l->shells.count--;
  return ok;
}

static uint64_t spread(uint64_t x) { /* moves the 21 bits of x to every third position, for a Morton code (an order in
                                      * which points close in space are mostly close) */
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  return (x | x << 2) & 0x1249249249249249u;
}

static uint64_t code_of(const vs_placed *p) { /* returns the Morton code of the middle of the leaf's box */
  uint64_t code = 0;
  for (int a = 0; a < 3; a++) {
    int64_t twice = (int64_t)p->box.min[a] + p->box.max[a] + ((int64_t)4 << VS_GRID_BITS);
    code |= spread((uint64_t)twice >> (VS_GRID_BITS + 3 - 21)) << a;
  }
  return code;
}

static bool before(const void *context, uint32_t x, uint32_t y) {
  const levels *l = context;
  uint64_t a = code_of(&l->c->placed.at[x]), b = code_of(&l->c->placed.at[y]);
  return a != b ? a < b : x < y;
}

static bool find_order(levels *l) {
  vs_kernel *k = l->k;
  vs_cluster *c = l->c;
  VS_LIST(uint32_t) scratch = { 0 };
  if (!VS_ROOM(k, l->facet_first.at, l->facet_first.room, (size_t)c->leaf_count + 2)) return false;
  uint32_t *first = l->facet_first.at;
  memset(first, 0, ((size_t)c->leaf_count + 2) * sizeof *first);
  for (size_t i = 0; i < c->facets.count; i++) first[c->facets.at[i].place + 1]++; /* the facets of the cluster are
                                                                                    * sorted by leaf, so counts give the
                                                                                    * range of each leaf */
  for (uint32_t i = 0; i <= c->leaf_count; i++) first[i + 1] += first[i];
  for (uint32_t i = 0; i < c->leaf_count; i++)
    if (c->layered[c->leaves[i]] && !VS_PUSH(k, l->order, i)) return false;
  bool ok = VS_ROOM(k, scratch.at, scratch.room, l->order.count + 1) &&
      VS_ROOM(k, l->weight.at, l->weight.room, l->order.count + 1);
  if (ok) vs_kernel_sort(l->order.at, scratch.at, l->order.count, before, l);
  VS_DROP(k, scratch);
  uint64_t sum = 0;
  for (size_t i = 0; ok && i < l->order.count; i++) {
    l->weight.at[i] = sum;
    sum += first[l->order.at[i] + 1] - first[l->order.at[i]] + 1;
  }
  if (ok) l->weight.at[l->order.count] = sum;
  return ok;
}

/* Returns the index in `order` that divides the leaves of the span into two halves with about equal numbers of facets.
 * The span has at least two leaves. */
static uint32_t middle_of(const levels *l, const span *s) {
  uint64_t half = (l->weight.at[s->first] + l->weight.at[s->end]) / 2;
  uint32_t low = s->first + 1, high = s->end - 1;
  VS_ASSERT(s->end - s->first >= 2);
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (l->weight.at[middle] < half) low = middle + 1;
    else high = middle;
  }
  return low;
}

static bool unite_all(levels *l) {
  vs_kernel *k = l->k;
  if (!VS_PUSH(k, l->spans, ((span){ 0, (uint32_t)l->order.count, false }))) return false;
  while (l->spans.count) {
    span *s = &l->spans.at[l->spans.count - 1], whole = *s;
    if (!vs_kernel_report(k, 0.1 + 0.6 * (double)l->done / (2.0 * (double)l->order.count))) return false;
    if (!s->made && whole.end - whole.first > 1) {
      uint32_t middle = middle_of(l, &whole);
      s->made = true;
      if (!VS_PUSH(k, l->spans, ((span){ middle, whole.end, false })) ||
          !VS_PUSH(k, l->spans, ((span){ whole.first, middle, false }))) return false;
      continue;
    }
    l->spans.count--;
    l->done++;
    if (!(whole.made ? unite_last(l) : make_leaf(l, l->order.at[whole.first]))) return false;
  }
  return true;
}

/* Collects the facets of the united solid and the facets of all other leaves, with their border edges. */
static bool gather(levels *l) {
  vs_cluster *c = l->c;
  vs_kernel *k = l->k;
  vs_outlines rest = { .facets = { 0 } };
  bool ok = true;
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) {
    size_t from = rest.facets.count;
    if (c->layered[c->leaves[i]]) continue;
    ok = add_outlines(l, i, &rest);
    for (size_t f = from; ok && f < rest.facets.count; f++)
      rest.facets.at[f].place = c->placed.at[i].star ? i : VS_NONE;
  }
  VS_DROP(k, c->triangles);
  VS_DROP(k, c->facet_triangles);
  VS_DROP(k, c->facets);
  VS_DROP(k, c->cuts);
  memcpy(&c->facets, &rest.facets, sizeof c->facets);
  memcpy(&c->sides, &rest.sides, sizeof c->sides);
  for (size_t i = 0; ok && i < l->shells.count; i++)
    ok = add_shell(l, c, &l->shells.at[i], c->leaf_count + (uint32_t)i);
  return ok && end_facets(k, c);
}

bool vs_unite_levels(vs_kernel *k, vs_cluster *c, vs_expression *e) {
  levels l = { .k = k, .c = c, .e = e };
  bool ok = find_order(&l) && unite_all(&l) && gather(&l);
  for (size_t i = 0; i < l.shells.count; i++) shell_free(k, &l.shells.at[i]);
  VS_DROP(k, l.shells);
  VS_DROP(k, l.spans);
  VS_DROP(k, l.order);
  VS_DROP(k, l.weight);
  VS_DROP(k, l.facet_first);
  VS_DROP(k, l.number);
  VS_DROP(k, l.taken);
  VS_DROP(k, l.moved);
  return ok && vs_meet_facets(k, c);
}
