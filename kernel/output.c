/* Owns the result's mesh: coplanar faces of one paint merged, needless corners dropped, what is left triangulated and turned to the outside.
 *
 * A corner is needless where exactly two borders of merged faces end, with the same faces beside both, in one line: every face there drops
 * it alike, so no T-junction appears. A facet that nothing touched and nothing merged with keeps its own triangles. */
#include "kernel/cluster.h"
#include "kernel/triangulate.h"

#include <string.h>

typedef struct { VS_LIST(uint32_t) uses, firsts; } found_edges; /* of a range */
typedef struct { /* what was triangulated: how many triangles of each face, and all of them */
  VS_LIST(uint32_t) counts;
  struct { uint32_t (*at)[3]; size_t count, room; } triangles;
} cut_chunk;

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(found_edges) found;
  VS_LIST(uint32_t) uses;            /* of kept faces, sorted by edge */
  VS_LIST(uint32_t) edge_first;      /* of edges that stay, into uses; one more */
  VS_LIST(_Atomic uint32_t) sets;    /* of faces, union-find */
  VS_LIST(uint32_t) parent;          /* of a face: the first of those it is merged with */
  VS_LIST(uint32_t) edges;           /* of a point: two numbers, the first edges that stay */
  VS_LIST(uint8_t) degree;           /* of a point: 0, 1, 2, 3 for more; 4: needless */
  VS_LIST(uint32_t) first, by_face;  /* sides of merged faces, bucketed by the face's root */
  struct { vs_border *at; size_t count, room; } sides;
  VS_LIST(uint32_t) side_face;
  VS_LIST(_Atomic uint8_t) whole;    /* a face: 1 still its own triangles */
  VS_LIST(uint32_t) out;             /* of a point: its vertex in the result */
  VS_LIST(uint32_t) points;          /* of the result's new vertices */
  VS_LIST(uint32_t) looks;           /* of its new triangles: 2 * plane + against its normal */
  VS_LIST(uint32_t) chunk_first;     /* of chunks of faces; one more */
  VS_LIST(cut_chunk) chunks;
  VS_LIST(vs_triangulation) cutters; /* one a thread */
  vs_mesh *mesh;
  size_t first_vertex;               /* of the mesh, that is ours */
} writer;

static const vs_use *use_at(const writer *w, size_t i) { return &w->c->uses.at[w->uses.at[i]]; }

static bool same_paint(const vs_kernel_problem *p, uint32_t a, uint32_t b) { return a == b || (p->paints && p->paints[a] == p->paints[b]); }

/* Merges over the edges between two coplanar faces of one paint that look the same way; the other edges stay. */
static bool merge_range(vs_kernel *k, void *context, size_t range) {
  writer *w = context;
  const vs_cluster *c = w->c;
  const vs_halves *h = &c->edges;
  found_edges *to = &w->found.at[range];
  uint32_t low = vs_halves_begin(h, range), stop = h->first.at[vs_halves_begin(h, range + 1)];
  for (uint32_t i = h->first.at[low], end; i < stop; i = end) {
    while (i >= h->first.at[low + 1]) low++;
    uint32_t first = (uint32_t)to->uses.count, high = h->at.at[i].high;
    for (end = i; end < h->first.at[low + 1] && h->at.at[end].high == high; end++)
      if (c->kept.at[c->uses.at[h->at.at[end].item].face] && !VS_PUSH(k, to->uses, h->at.at[end].item)) return false;
    size_t count = to->uses.count - first;
    if (count == 2) {
      const vs_use *a = &c->uses.at[to->uses.at[first]], *b = &c->uses.at[to->uses.at[first + 1]];
      const vs_face *f = &c->faces.at[a->face], *g = &c->faces.at[b->face];
      if (f->plane == g->plane && c->kept.at[a->face] == c->kept.at[b->face] && same_paint(c->problem, f->tag, g->tag) && a->from == b->to) {
        vs_unite_shared(w->sets.at, a->face, b->face);
        atomic_store_explicit(&w->whole.at[a->face], 0, memory_order_relaxed);
        atomic_store_explicit(&w->whole.at[b->face], 0, memory_order_relaxed);
        to->uses.count = first;
        continue;
      }
    }
    if (count && !VS_PUSH(k, to->firsts, first)) return false;
    if (!vs_kernel_poll(k, 0.9)) return false;
  }
  return true;
}

static bool merge(writer *w) {
  vs_cluster *c = w->c;
  vs_kernel *k = w->k;
  size_t faces = c->faces.count, ranges = c->edges.ranges, uses = 0, edges = 0;
  if (!VS_ROOM(k, w->sets.at, w->sets.room, faces + 1) || !VS_ROOM(k, w->whole.at, w->whole.room, faces + 1) || !VS_ROOM(k, w->found.at, w->found.room, ranges))
    return false;
  memset(w->found.at, 0, ranges * sizeof *w->found.at);
  w->found.count = ranges;
  for (uint32_t f = 0; f < faces; f++) {
    atomic_init(&w->sets.at[f], f);
    atomic_init(&w->whole.at[f], c->faces.at[f].facet != VS_NONE);
  }
  if (!vs_kernel_run(k, ranges, merge_range, w)) return false;
  for (size_t i = 0; i < ranges; i++) uses += w->found.at[i].uses.count, edges += w->found.at[i].firsts.count;
  if (!VS_ROOM(k, w->parent.at, w->parent.room, faces + 1) || !VS_ROOM(k, w->uses.at, w->uses.room, uses + 1) || !VS_ROOM(k, w->edge_first.at, w->edge_first.room, edges + 1))
    return false;
  for (uint32_t f = 0; f < faces; f++) w->parent.at[f] = vs_find_shared(w->sets.at, f);
  for (size_t i = 0; i < ranges; i++) {
    found_edges *from = &w->found.at[i];
    for (size_t e = 0; e < from->firsts.count; e++) w->edge_first.at[w->edge_first.count++] = from->firsts.at[e] + (uint32_t)w->uses.count;
    for (size_t u = 0; u < from->uses.count; u++) w->uses.at[w->uses.count++] = from->uses.at[u];
    VS_DROP(k, from->uses);
    VS_DROP(k, from->firsts);
    if (!vs_kernel_report(k, 0.9)) return false;
  }
  return VS_PUSH(k, w->edge_first, (uint32_t)uses);
}

/* Have two edges the same merged faces beside them? */
static bool same_faces(writer *w, uint32_t e, uint32_t f, bool *flat) {
  uint32_t eb = w->edge_first.at[e], ee = w->edge_first.at[e + 1], fb = w->edge_first.at[f], fe = w->edge_first.at[f + 1];
  if (ee - eb != fe - fb) return false;
  *flat = true;
  for (uint32_t i = eb; i < ee; i++) {
    uint32_t root = w->parent.at[use_at(w, i)->face], here = 0, there = 0;
    for (uint32_t j = eb; j < ee; j++) here += w->parent.at[use_at(w, j)->face] == root;
    for (uint32_t j = fb; j < fe; j++) there += w->parent.at[use_at(w, j)->face] == root;
    if (here != there) return false;
    if (w->c->faces.at[use_at(w, i)->face].plane != w->c->faces.at[use_at(w, eb)->face].plane) *flat = false;
  }
  return true;
}

static uint32_t other_end(const vs_use *u, uint32_t p) { return u->from == p ? u->to : u->from; }

static bool drop_corners(writer *w) {
  vs_cluster *c = w->c;
  size_t n = c->points.all.count, edges = w->edge_first.count - 1;
  if (!VS_ROOM(w->k, w->edges.at, w->edges.room, 2 * n + 1) || !VS_ROOM(w->k, w->degree.at, w->degree.room, n + 1)) return false;
  for (size_t p = 0; p < n; p++) w->degree.at[p] = 0;
  for (uint32_t e = 0; e < edges; e++) {
    const vs_use *u = use_at(w, w->edge_first.at[e]);
    if (!vs_kernel_poll(w->k, 0.9)) return false;
    for (int i = 0; i < 2; i++) {
      uint32_t p = i ? u->to : u->from;
      if (w->degree.at[p] < 2) w->edges.at[2 * p + w->degree.at[p]] = e;
      if (w->degree.at[p] < 3) w->degree.at[p]++;
    }
  }
  for (uint32_t p = 0; p < n; p++) {
    bool flat;
    if (!vs_kernel_poll(w->k, 0.9)) return false;
    if (w->degree.at[p] != 2 || !same_faces(w, w->edges.at[2 * p], w->edges.at[2 * p + 1], &flat)) continue;
    const vs_use *a = use_at(w, w->edge_first.at[w->edges.at[2 * p]]), *b = use_at(w, w->edge_first.at[w->edges.at[2 * p + 1]]);
    if (flat) { /* not on the line of two planes */
      const vs_plane *plane = &c->planes.all.at[c->faces.at[a->face].plane];
      if (vs_orient2d(vs_points_of(&c->points), other_end(a, p), p, other_end(b, p), plane->u, plane->v) != 0) continue;
    }
    w->degree.at[p] = 4;
  }
  return true;
}

/* Borders from corner to corner, for every use that begins at a corner. */
static bool make_sides(writer *w) {
  vs_cluster *c = w->c;
  vs_kernel *k = w->k;
  size_t edges = w->edge_first.count - 1, faces = c->faces.count;
  for (uint32_t e = 0; e < edges; e++)
    for (uint32_t i = w->edge_first.at[e]; i < w->edge_first.at[e + 1]; i++) {
      const vs_use *u = use_at(w, i);
      if (!vs_kernel_poll(k, 0.9)) return false;
      uint32_t at = u->to, edge = e, root = w->parent.at[u->face];
      if (w->degree.at[u->from] == 4 || w->degree.at[at] == 4) w->whole.at[u->face] = 0;
      if (w->degree.at[u->from] == 4) continue;
      while (w->degree.at[at] == 4) {
        edge = w->edges.at[2 * at] == edge ? w->edges.at[2 * at + 1] : w->edges.at[2 * at];
        at = other_end(use_at(w, w->edge_first.at[edge]), at);
      }
      if (!VS_PUSH(k, w->sides, ((vs_border){ u->from, at })) || !VS_PUSH(k, w->side_face, root)) return false;
    }
  if (!VS_ROOM(k, w->first.at, w->first.room, faces + 2) || !VS_ROOM(k, w->by_face.at, w->by_face.room, w->sides.count + 1)) return false;
  for (size_t f = 0; f < faces + 2; f++) w->first.at[f] = 0;
  for (size_t i = 0; i < w->sides.count; i++) w->first.at[w->side_face.at[i] + 2]++;
  for (size_t f = 2; f < faces + 2; f++) w->first.at[f] += w->first.at[f - 1];
  for (uint32_t i = 0; i < w->sides.count; i++) w->by_face.at[w->first.at[w->side_face.at[i] + 1]++] = i;
  return true;
}

/* ---- triangles ---- */

static bool is_shown(const writer *w, uint32_t f) { return w->c->kept.at[f] && w->parent.at[f] == f; }

/* Faces that need triangulating, in chunks of about so many borders. */
static bool make_chunks(writer *w) {
  enum { CHUNK = 4096 };
  uint32_t sum = 0, faces = (uint32_t)w->c->faces.count;
  for (uint32_t f = 0; f < faces; f++) {
    if (sum == 0 && !VS_PUSH(w->k, w->chunk_first, f)) return false;
    sum += is_shown(w, f) && !w->whole.at[f] ? w->first.at[f + 1] - w->first.at[f] : 0;
    if (sum >= CHUNK) sum = 0;
  }
  size_t n = w->chunk_first.count;
  if (!VS_PUSH(w->k, w->chunk_first, faces) || !VS_ROOM(w->k, w->chunks.at, w->chunks.room, n + 1) || !VS_ROOM(w->k, w->cutters.at, w->cutters.room, w->k->threads)) return false;
  memset(w->chunks.at, 0, (n + 1) * sizeof *w->chunks.at);
  memset(w->cutters.at, 0, w->k->threads * sizeof *w->cutters.at);
  w->chunks.count = n;
  w->cutters.count = w->k->threads;
  return true;
}

static bool triangulate_chunk(vs_kernel *k, void *context, size_t index) {
  writer *w = context;
  cut_chunk *to = &w->chunks.at[index];
  vs_triangulation *t = &w->cutters.at[k->worker];
  for (uint32_t f = w->chunk_first.at[index]; f < w->chunk_first.at[index + 1]; f++) {
    if (!is_shown(w, f) || w->whole.at[f]) continue;
    t->sides.count = 0;
    for (uint32_t i = w->first.at[f]; i < w->first.at[f + 1]; i++)
      if (!VS_PUSH(k, t->sides, w->sides.at[w->by_face.at[i]])) return false;
    if (!vs_plane_triangulate(k, t, &w->c->points, &w->c->planes.all.at[w->c->faces.at[f].plane])) return false;
    size_t n = t->triangles.count;
    if (!VS_PUSH(k, to->counts, (uint32_t)n) || !VS_ROOM(k, to->triangles.at, to->triangles.room, to->triangles.count + n)) return false;
    if (n) memcpy(to->triangles.at + to->triangles.count, t->triangles.at, n * sizeof *t->triangles.at);
    to->triangles.count += n;
    if (!vs_kernel_poll(k, 0.9)) return false;
  }
  return true;
}

static bool no_room(writer *w) { return vs_kernel_fail(w->k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids"); }

static void triangle(writer *w, vs_mesh *out, const uint32_t v[3], bool turned, const vs_face *face, bool against) {
  uint32_t *to = out->triangles[out->triangle_count];
  for (int j = 0; j < 3; j++) {
    uint32_t point = v[turned ? 2 - j : j], *index = &w->out.at[point];
    if (*index == VS_NONE) {
      *index = (uint32_t)(w->first_vertex + w->points.count);
      w->points.at[w->points.count++] = point;
    }
    to[j] = *index;
  }
  out->tags[out->triangle_count++] = face->tag;
  w->looks.at[w->looks.count++] = face->plane * 2 + against;
}

enum { PLACES = 1 << 14 };
static bool place_chunk(vs_kernel *k, void *context, size_t index) {
  writer *w = context;
  size_t begin = index * PLACES, end = w->points.count - begin < PLACES ? w->points.count : begin + PLACES;
  for (size_t i = begin; i < end; i++) w->mesh->vertices[w->first_vertex + i] = vs_grid_world(&w->c->grid, &w->c->points.all.at[w->points.at[i]]);
  return vs_kernel_report(k, k->part);
}

/* Room for all there will be: in large steps, since clusters come one after the other into one mesh. */
static bool make_room(writer *w, vs_mesh *out, size_t triangles) {
  size_t limit = w->k->options ? w->k->options->max_triangles : 0, all = out->triangle_count + triangles;
  if (limit && all > limit) return vs_kernel_fail(w->k, VS_KERNEL_LIMIT, 0, "the result has more than %zu triangles, the limit", limit);
  if (all >= UINT32_MAX) return vs_kernel_fail(w->k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  if (all > out->triangle_room && !vs_mesh_reserve(out, 0, out->triangle_count ? all + all / 2 : all)) return no_room(w);
  return VS_ROOM(w->k, w->looks.at, w->looks.room, triangles + 1);
}

static bool write(writer *w, vs_mesh *out) {
  vs_cluster *c = w->c;
  size_t triangles = 0, points = c->points.all.count;
  if (!make_chunks(w) || !vs_kernel_run(w->k, w->chunks.count, triangulate_chunk, w)) return false;
  for (uint32_t f = 0; f < c->faces.count; f++)
    if (is_shown(w, f) && w->whole.at[f]) triangles += c->facets.at[c->faces.at[f].facet + 1].first - c->facets.at[c->faces.at[f].facet].first;
  for (size_t i = 0; i < w->chunks.count; i++) triangles += w->chunks.at[i].triangles.count;
  if (!make_room(w, out, triangles) || !VS_ROOM(w->k, w->out.at, w->out.room, points + 1) || !VS_ROOM(w->k, w->points.at, w->points.room, points + 1)) return false;
  for (size_t p = 0; p < points; p++) w->out.at[p] = VS_NONE;
  w->mesh = out;
  w->first_vertex = out->vertex_count;
  for (size_t i = 0; i < w->chunks.count; i++) {
    cut_chunk *from = &w->chunks.at[i];
    uint32_t (*cut)[3] = from->triangles.at, *count = from->counts.at;
    for (uint32_t f = w->chunk_first.at[i]; f < w->chunk_first.at[i + 1]; f++) {
      if (!is_shown(w, f)) continue;
      const vs_face *face = &c->faces.at[f];
      bool turned = c->kept.at[f] == 2;
      if (w->whole.at[f]) {
        const vs_facet *facet = &c->facets.at[face->facet];
        for (uint32_t t = facet[0].first; t < facet[1].first; t++) triangle(w, out, c->triangles.at[c->facet_triangles.at[t]].v, turned != facet->flip, face, turned);
      } else {
        for (uint32_t n = *count++; n > 0; n--) triangle(w, out, *cut++, turned, face, turned);
      }
      if (!vs_kernel_poll(w->k, 0.9)) return false;
    }
    VS_DROP(w->k, from->triangles);
    VS_DROP(w->k, from->counts);
  }
  size_t vertices = w->first_vertex + w->points.count;
  if (vertices > out->vertex_room && !vs_mesh_reserve(out, w->first_vertex ? vertices + vertices / 2 : vertices, 0)) return no_room(w);
  out->vertex_count = vertices;
  return vs_kernel_run(w->k, (w->points.count + PLACES - 1) / PLACES, place_chunk, w);
}

bool vs_output_faces(vs_kernel *k, vs_cluster *c, vs_mesh *out) {
  writer w = { .k = k, .c = c };
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  bool ok = merge(&w) && drop_corners(&w) && make_sides(&w) && write(&w, out) && vs_kernel_report(k, 0.95) &&
            vs_split_touching(k, c, out, vertices, triangles, w.looks.at, w.points.at);
  for (size_t i = 0; i < w.found.count; i++) {
    VS_DROP(k, w.found.at[i].uses);
    VS_DROP(k, w.found.at[i].firsts);
  }
  VS_DROP(k, w.found);
  VS_DROP(k, w.sets);
  VS_DROP(k, w.uses);
  VS_DROP(k, w.edge_first);
  VS_DROP(k, w.parent);
  VS_DROP(k, w.edges);
  VS_DROP(k, w.degree);
  VS_DROP(k, w.first);
  VS_DROP(k, w.by_face);
  VS_DROP(k, w.sides);
  VS_DROP(k, w.side_face);
  VS_DROP(k, w.whole);
  VS_DROP(k, w.out);
  VS_DROP(k, w.points);
  VS_DROP(k, w.looks);
  for (size_t i = 0; i < w.chunks.count; i++) {
    VS_DROP(k, w.chunks.at[i].counts);
    VS_DROP(k, w.chunks.at[i].triangles);
  }
  for (size_t i = 0; i < w.cutters.count; i++) vs_triangulation_free(k, &w.cutters.at[i]);
  VS_DROP(k, w.chunk_first);
  VS_DROP(k, w.chunks);
  VS_DROP(k, w.cutters);
  return ok;
}
