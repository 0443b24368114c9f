/* Makes triangles and facets (connected coplanar triangles) from the corners on the grid. It omits culled, untouched
 * and flat triangles, and joins coplanar neighbours. It also checks that each leaf is closed.
 *
 * Leaves are processed in batches, and a batch in spans of triangles that threads share. They compute (1) the planes of
 * the remaining triangles, and (2) neighbours in one plane. Then the triangles get the numbers of their points, planes
 * and facets one after another, so that the numbers do not depend on the threads. Points are one task, and planes and
 * facets another. Culled and flat triangles have no points or planes. */
#include "kernel/arrange/facets.h"

#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <math.h>
#include <string.h>

enum { SPAN = 1 << 12, BATCH = 1 << 17 /* SPAN: number of triangles that one task handles; BATCH: number of triangles
                                        * that are handled before the next batch begins */ };
#define FLAT UINT32_MAX
#define GONE (UINT32_MAX - 1) /* value in the array `number` for a triangle that gets no facet, because it was removed
                               * as hidden or no other triangle touches it */

typedef struct {
  vs_plane plane;
  uint64_t hash;   /* hash of the equation of the triangle's plane */
  uint32_t source; /* index of this triangle in the mesh of its leaf */
  bool flip;
  uint8_t inner;
} found_triangle;
typedef struct {
  uint32_t place, first, end; /* place: index of the leaf in the cluster; first, end: range of the leaf's triangles that
                               * one task handles */
  uint32_t base;              /* number, counted over the current batch, of the first triangle of this range */
  VS_LIST(found_triangle) found;
} span;
typedef struct {
  const uint32_t *twins;
  uint32_t triangles; /* index in the array `number` of the first triangle of the leaf */
  uint32_t span;      /* index of the first range (span) of the leaf's triangles */
  bool mirrored;
} batch_leaf;

typedef struct {
  vs_cluster *c;
  uint32_t first, end;          /* leaves of the batch: those with the indices `first` to `end` - 1 in the cluster */
  VS_LIST(batch_leaf) leaves;
  VS_LIST(span) spans;
  size_t span_count;            /* number of spans (ranges of triangles) that have memory; later batches use this memory
                                 * again */
  VS_LIST(uint32_t) number;     /* number[t]: index of the mesh's triangle t among the triangles kept in its span, or
                                 * FLAT or GONE */
  VS_LIST(_Atomic uint32_t) sets; /* union-find structure over the kept triangles; each set is one facet: connected
                                   * triangles in one plane */
  bool straight;                  /* true if facets are to be collected to sheets: the grid has split one planar facet
                                   * into the facets of a sheet */
  VS_LIST(_Atomic uint32_t) sheets; /* union-find structure over the kept triangles, filled only if `straight`; each set
                                     * is one sheet: connected triangles nearly in one plane */
  VS_LIST(uint32_t) facet;      /* facet[i]: number of the facet whose first triangle is the kept triangle i */
  VS_LIST(uint32_t) ids;        /* ids[v]: point number of vertex v of the current leaf, or VS_NONE */
  VS_LIST(uint32_t) twins;      /* pairs of corners with opposite edges (vs_twins_find); filled only if the leaf's mesh
                                 * has no such list */
  VS_LIST(uint32_t) fresh;      /* vertices, in the current range of triangles (span), that have no point number yet */
  size_t given;                 /* number of triangles in all batches before the current batch */
} facets;

static uint32_t turned(bool mirrored, uint32_t j) { return mirrored ? 2 - j : j; }
/* Converts the index of an edge from a mesh's triangle to the grid's triangle, or back. The corners of the grid's
 * triangle are in reverse order if the leaf is mirrored. */
static uint32_t turned_edge(bool mirrored, uint32_t j) { return mirrored ? (4 - j) % 3 : j; }

/* Finds the pairs of opposite edges (twins) of a leaf on the grid, see vs_twins_find. place: index of the leaf. */
static bool find_twins(vs_kernel *k, facets *f, uint32_t place) {
  vs_cluster *c = f->c;
  const vs_mesh *m = c->placed.at[place].part->mesh;
  uint32_t open, *twins = f->twins.at + f->twins.count;
  f->twins.count += 3 * m->triangle_count;
  for (size_t j = 0; j < m->vertex_count; j++) /* vertices with equal coordinates on the grid count as one corner */
    if (!vs_points_integer(k, &c->points, c->corners[c->placed.at[place].first + j], &f->ids.at[j])) return false;
  const vs_twins_input in = { (const uint32_t (*)[3])m->triangles, m->triangle_count, f->ids.at, c->points.all.count };
  if (!vs_twins_find(k, &in, twins, &open)) return false;
  return open == VS_NONE ||
         vs_kernel_fail(k, VS_KERNEL_OPEN, c->leaves[place],
                        "the solid is not closed: a face is missing, or turned the other way, along an edge");
}

/* ---- tasks for spans of triangles ---- */

static bool find_span(vs_kernel *k, void *context, size_t index) {
  facets *f = context;
  const vs_cluster *c = f->c;
  span *s = &f->spans.at[index];
  const batch_leaf *l = &f->leaves.at[s->place - f->first];
  const vs_placed *p = &c->placed.at[s->place];
  const _Atomic uint8_t *fate = c->fate.count ? c->fate.at + p->first_triangle : NULL;
  uint32_t *number = f->number.at + l->triangles;
  s->found.count = 0;
  for (uint32_t t = s->first; t < s->end; t++) {
    const uint32_t *v = p->part->mesh->triangles[t];
    number[t] = GONE;
    if (fate && atomic_load_explicit(&fate[t], memory_order_relaxed) != VS_ARRANGED) continue;
    const int32_t(*at)[3] = (const int32_t(*)[3])c->corners + p->first;
    found_triangle made = { .source = t };
    number[t] = FLAT;
    if (!vs_plane_through(at[v[turned(l->mirrored, 0)]], at[v[1]], at[v[turned(l->mirrored, 2)]], &made.plane,
                          &made.flip))
      continue;
    number[t] = (uint32_t)s->found.count;
    made.hash = vs_planes_hash(&made.plane);
    if (!VS_PUSH(k, s->found, made)) return false;
  }
  return vs_kernel_report(k, 0);
}

static bool same_plane(const found_triangle *a, const found_triangle *b) {
  return a->plane.n[0] == b->plane.n[0] && a->plane.n[1] == b->plane.n[1] && a->plane.n[2] == b->plane.n[2] &&
         a->plane.d == b->plane.d && a->flip == b->flip;
}

/* Returns true if the grid may have split the common plane of the neighbouring triangles a and b into two planes. at:
 * coordinates of the leaf's vertices; v, w: vertices of the two triangles. */
static bool nearly_one_plane(int32_t (*at)[3], const found_triangle *a, const uint32_t v[3], const found_triangle *b,
                             const uint32_t w[3]) {
  static const double OFF = 4, ALIKE = 0.999; /* OFF: greatest distance, in grid steps, of a fourth corner from the
                                               * plane of three others if all lay in one plane before rounding. ALIKE:
                                               * least cosine of the angle between the normals of two triangles that may
                                               * have been in one plane. */
  double n = 0, m = 0, both = 0, above = 0, below = 0;
  for (int i = 0; i < 3; i++) {
    double x = (double)a->plane.n[i], y = (double)b->plane.n[i];
    n += x * x, m += y * y, both += a->flip == b->flip ? x * y : -x * y;
  }
  if (!(both > 0) || both * both < ALIKE * ALIKE * n * m) return false;
  for (int j = 0; j < 3; j++) {
    double over = 0, under = 0;
    for (int i = 0; i < 3; i++) {
      over += (double)a->plane.n[i] * ((double)at[w[j]][i] - at[v[0]][i]);
      under += (double)b->plane.n[i] * ((double)at[v[j]][i] - at[w[0]][i]);
    }
    above = fmax(above, fabs(over)), below = fmax(below, fabs(under));
  }
  return above * above <= OFF * OFF * n && below * below <= OFF * OFF * m;
}

static bool join_span(vs_kernel *k, void *context, size_t index) {
  facets *f = context;
  const span *s = &f->spans.at[index];
  const batch_leaf *l = &f->leaves.at[s->place - f->first];
  const vs_placed *p = &f->c->placed.at[s->place];
  const uint32_t(*corners)[3] = (const uint32_t(*)[3])p->part->mesh->triangles;
  for (uint32_t i = 0; i < s->found.count; i++) {
    found_triangle *a = &s->found.at[i];
    for (uint32_t j = 0; j < 3; j++) {
      uint32_t twin = l->twins[3 * (size_t)a->source + turned_edge(l->mirrored, j)];
      if (twin == VS_NONE || twin / 3 == a->source) continue;
      uint32_t number = f->number.at[l->triangles + twin / 3];
      /* The grid has moved the corners of the neighbouring triangle onto one line. Therefore this triangle may have to
       * be split along that line. */
      if (number == FLAT) a->inner |= VS_BESIDE_FLAT;
      if (number >= GONE) continue;
      const span *other = &f->spans.at[l->span + twin / 3 / SPAN];
      const found_triangle *b = &other->found.at[number];
      bool same = same_plane(a, b);
      if (f->straight && a->source < b->source &&
          (same || nearly_one_plane(f->c->corners + p->first, a, corners[a->source], b, corners[b->source])))
        vs_unite_shared(f->sheets.at, s->base + i, other->base + number);
      if (!same) continue;
      a->inner |= (uint8_t)(1u << j); /* the task that handles the neighbouring triangle sets the bit in that triangle's
                                       * `inner` */
      if (a->source < b->source) vs_unite_shared(f->sets.at, s->base + i, other->base + number);
    }
  }
  return vs_kernel_report(k, 0);
}

/* ---- steps in a fixed order ---- */

/* Sets the point numbers of the triangles of all spans. Points are numbered in the order in which triangles first refer
 * to them. Within a span, memory for the searches is prefetched. */
static bool give_points(vs_kernel *k, facets *f) {
  vs_cluster *c = f->c;
  vs_grid_triangle *to = c->triangles.at; /* `to` may be NULL if there are no triangles, and adding an offset to NULL is
                                           * undefined. */
  if (f->given > 0) to += f->given;
  for (size_t index = 0; index < f->spans.count; index++) {
    const span *s = &f->spans.at[index];
    const batch_leaf *l = &f->leaves.at[s->place - f->first];
    const vs_placed *p = &c->placed.at[s->place];
    const uint32_t (*corners)[3] = (const uint32_t (*)[3])p->part->mesh->triangles;
    if (s->first == 0) memset(f->ids.at, 0xff, p->part->mesh->vertex_count * sizeof *f->ids.at);
    f->fresh.count = 0;
    if (!VS_ROOM(k, f->fresh.at, f->fresh.room, 3 * s->found.count)) return false;
    for (uint32_t i = 0; i < s->found.count; i++)
      for (uint32_t j = 0; j < 3; j++) {
        uint32_t v = corners[s->found.at[i].source][turned(l->mirrored, j)];
        if (f->ids.at[v] != VS_NONE) continue;
        f->ids.at[v] = 0;
        f->fresh.at[f->fresh.count++] = v;
      }
    if (!vs_points_add_corners(k, &c->points, c->corners + p->first, f->fresh.at, f->fresh.count, f->ids.at))
      return false;
    for (size_t i = 0; c->point_of.count && i < f->fresh.count; i++)
      c->point_of.at[p->first + f->fresh.at[i]] = f->ids.at[f->fresh.at[i]];
    for (uint32_t i = 0; i < s->found.count; i++, to++)
      for (uint32_t j = 0; j < 3; j++) to->v[j] = f->ids.at[corners[s->found.at[i].source][turned(l->mirrored, j)]];
    if (!vs_kernel_report(k, 0)) return false;
  }
  return true;
}

/* Sets the members `plane` and `facet` of the triangles of all spans (ranges of triangles). */
static bool give_facets(vs_kernel *k, facets *f) {
  vs_cluster *c = f->c;
  vs_grid_triangle *to = c->triangles.at + f->given;
  for (size_t index = 0; index < f->spans.count; index++) {
    const span *s = &f->spans.at[index];
    uint32_t leaf = c->leaves[s->place];
    for (uint32_t i = 0; i < s->found.count; i++, to++) {
      const found_triangle *from = &s->found.at[i];
      if (i + VS_AHEAD_FAR < s->found.count) vs_planes_ahead(&c->planes, from[VS_AHEAD_FAR].hash, false);
      if (i + VS_AHEAD_NEAR < s->found.count) vs_planes_ahead(&c->planes, from[VS_AHEAD_NEAR].hash, true);
      uint32_t root = vs_find_shared(f->sets.at, s->base + i);
      if (root == s->base + i) { /* this triangle is the first one of its facet, so it begins a new facet */
        vs_facet made = { .leaf = leaf, .place = s->place, .group = (uint32_t)c->facets.count, .flip = from->flip };
        f->facet.at[root] = (uint32_t)c->facets.count;
        if (!vs_planes_add(k, &c->planes, &from->plane, from->hash, &made.plane) || !VS_PUSH(k, c->facets, made))
          return false;
        /* The first triangle of a sheet (facets nearly in one plane) is also the first of its facet. */
        if (f->straight && !VS_PUSH(k, c->sheets, f->facet.at[vs_find_shared(f->sheets.at, root)])) return false;
      }
      to->leaf = leaf;
      to->source = from->source;
      to->flip = from->flip;
      to->inner = from->inner;
      to->facet = f->facet.at[root];
      to->plane = c->facets.at[to->facet].plane;
      if (to->inner & VS_BESIDE_FLAT) c->facets.at[to->facet].touched = true;
    }
    if (!vs_kernel_report(k, 0)) return false;
  }
  return true;
}

/* Runs task 0, which numbers the points, or task 1, which makes planes and facets. They write different tables, so they
 * can run at the same time. */
static bool give(vs_kernel *k, void *context, size_t index) {
  return index ? give_facets(k, context) : give_points(k, context);
}

static bool plan_leaf(vs_kernel *k, facets *f, uint32_t place, size_t *triangles, size_t *vertices) {
  vs_cluster *c = f->c;
  const vs_part *part = c->placed.at[place].part;
  batch_leaf l = { part->twins, (uint32_t)*triangles, (uint32_t)f->spans.count,
                   vs_affine_determinant(&c->problem->leaves[c->leaves[place]].placement) < 0 };
  uint32_t n = (uint32_t)part->mesh->triangle_count;
  if (part->volume < -1e-13 * part->outer * part->outer * part->outer && !c->inspect)
    return vs_kernel_fail(k, VS_KERNEL_INSIDE_OUT, c->leaves[place],
                          "the solid is inside out: its faces should run counter-clockwise seen from outside");
  for (uint32_t t = 0; t < n; t += SPAN) {
    span made = { .place = place, .first = t, .end = n - t < SPAN ? n : t + SPAN };
    if (f->spans.count < f->span_count) { /* reuses the memory of a range of triangles (span) of an earlier batch */
      span *s = &f->spans.at[f->spans.count++];
      s->place = place;
      s->first = made.first;
      s->end = made.end;
    } else {
      if (!VS_PUSH(k, f->spans, made)) return false;
      f->span_count = f->spans.count;
    }
  }
  *triangles += n;
  *vertices += part->mesh->vertex_count;
  return VS_PUSH(k, f->leaves, l);
}

static bool do_batch(vs_kernel *k, facets *f) {
  vs_cluster *c = f->c;
  size_t triangles = 0, vertices = 0, bare = 0, most = 0, found = 0, roots = 0;
  for (uint32_t i = f->first; i < f->end; i++) {
    const vs_part *part = c->placed.at[i].part;
    if (!part->twins) bare += 3 * part->mesh->triangle_count;
    if (part->mesh->vertex_count > most) most = part->mesh->vertex_count;
    if (!plan_leaf(k, f, i, &triangles, &vertices)) return false;
  }
  f->twins.count = 0;
  if (!VS_ROOM(k, f->number.at, f->number.room, triangles + 1) ||
      !VS_ROOM(k, f->ids.at, f->ids.room, most + 1) || !VS_ROOM(k, f->twins.at, f->twins.room, bare + 1))
    return false;
  for (uint32_t i = f->first; i < f->end; i++) {
    batch_leaf *l = &f->leaves.at[i - f->first];
    if (l->twins) continue;
    l->twins = f->twins.at + f->twins.count;
    if (!find_twins(k, f, i)) return false;
  }
  if (!vs_kernel_run(k, f->spans.count, find_span, f)) return false;
  for (size_t i = 0; i < f->spans.count; i++) {
    f->spans.at[i].base = (uint32_t)found;
    found += f->spans.at[i].found.count;
  }
  if (!VS_ROOM(k, f->sets.at, f->sets.room, found + 1) || !VS_ROOM(k, f->facet.at, f->facet.room, found + 1) ||
      (f->straight && !VS_ROOM(k, f->sheets.at, f->sheets.room, found + 1)))
    return false;
  for (uint32_t i = 0; i < found; i++) atomic_init(&f->sets.at[i], i);
  for (uint32_t i = 0; f->straight && i < found; i++) atomic_init(&f->sheets.at[i], i);
  f->given = c->triangles.count;
  if (!vs_kernel_run(k, f->spans.count, join_span, f)) return false;
  for (uint32_t i = 0; i < found; i++) roots += vs_find_shared(f->sets.at, i) == i;
  if (!vs_planes_expect(k, &c->planes, roots) ||
      !vs_points_expect(k, &c->points, vertices < found ? vertices : found) ||
      !VS_ROOM(k, c->triangles.at, c->triangles.room, f->given + found) ||
      !VS_ROOM(k, c->facets.at, c->facets.room, c->facets.count + roots + 1) || !vs_kernel_run(k, 2, give, f))
    return false;
  c->triangles.count = f->given + found;
  return true;
}

/* Makes c->facet_triangles: indices of all triangles, grouped by the facet that contains them. */
static bool index_facets(vs_kernel *k, vs_cluster *c) {
  size_t n = c->triangles.count, f = c->facets.count;
  vs_facet last = { .leaf = VS_NONE };
  if (!VS_PUSH(k, c->facets, last) || !VS_ROOM(k, c->facet_triangles.at, c->facet_triangles.room, n + 1)) return false;
  for (size_t t = 0; t < n; t++) c->facets.at[c->triangles.at[t].facet + 1].first++;
  for (size_t i = 1; i <= f; i++) c->facets.at[i].first += c->facets.at[i - 1].first;
  for (size_t t = n; t-- > 0;) { /* facets[i].first begins as the end of the facet's range in facet_triangles. It
                                  * decreases with each triangle that is entered, and so ends as the beginning of the
                                  * range. */
    uint32_t facet = c->triangles.at[t].facet;
    c->facet_triangles.at[--c->facets.at[facet + 1].first] = (uint32_t)t;
  }
  for (size_t i = 0; i < f; i++) c->facets.at[i].first = c->facets.at[i + 1].first;
  c->facets.at[f].first = (uint32_t)n;
  c->facet_triangles.count = n;
  c->facets.count = f; /* one more facet than the count stays in memory; its `first` marks the end of the last facet's
                        * triangles */
  return true;
}

bool vs_facets_build(vs_kernel *k, vs_cluster *c) {
  facets f = { .c = c, .straight = k->options && k->options->straight && !c->layered };
  bool ok = true;
  size_t triangles = 0;
  c->sheets.count = 0;
  for (uint32_t i = 0; ok && i < c->leaf_count; i++) {
    triangles += c->placed.at[i].part->mesh->triangle_count;
    f.end = i + 1;
    if (triangles < BATCH && i + 1 < c->leaf_count) continue;
    ok = do_batch(k, &f);
    f.first = f.end;
    f.leaves.count = f.spans.count = triangles = 0;
  }
  for (size_t i = 0; i < f.span_count; i++) VS_DROP(k, f.spans.at[i].found);
  VS_DROP(k, f.leaves);
  VS_DROP(k, f.spans);
  VS_DROP(k, f.number);
  VS_DROP(k, f.sets);
  VS_DROP(k, f.sheets);
  VS_DROP(k, f.facet);
  VS_DROP(k, f.ids);
  VS_DROP(k, f.fresh);
  VS_DROP(k, f.twins);
  c->corner_points = (uint32_t)c->points.all.count;
  return ok && index_facets(k, c);
}
