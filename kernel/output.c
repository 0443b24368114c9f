/* Owns the result's mesh: coplanar faces of one paint merged, needless corners dropped, what is left triangulated and turned to the outside.
 *
 * A corner is needless where exactly two borders of merged faces end, with the same faces beside both, in one line: every face there drops
 * it alike, so no T-junction appears. A facet that nothing touched and nothing merged with keeps its own triangles. */
#include "kernel/cluster.h"
#include "kernel/triangulate.h"

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(uint32_t) uses;            /* of kept faces, sorted by edge */
  VS_LIST(uint32_t) edge_first;      /* of edges that stay, into uses; one more */
  VS_LIST(uint32_t) parent;          /* of faces, union-find */
  VS_LIST(uint32_t) edges;           /* of a point: two numbers, the first edges that stay */
  VS_LIST(uint8_t) degree;           /* of a point: 0, 1, 2, 3 for more; 4: needless */
  VS_LIST(uint32_t) first, by_face;  /* sides of merged faces, bucketed by the face's root */
  struct { vs_border *at; size_t count, room; } sides;
  VS_LIST(uint32_t) side_face;
  VS_LIST(uint8_t) whole;            /* a face: 1 still its own triangles */
  VS_LIST(uint32_t) out;             /* of a point: its vertex in the result */
  VS_LIST(uint32_t) points;          /* of the result's new vertices */
  VS_LIST(uint32_t) looks;           /* of its new triangles: 2 * plane + against its normal */
  vs_triangulation triangulation;
} writer;

static const vs_use *use_at(const writer *w, size_t i) { return &w->c->uses.at[w->uses.at[i]]; }

static bool same_paint(const vs_kernel_problem *p, uint32_t a, uint32_t b) { return a == b || (p->paints && p->paints[a] == p->paints[b]); }

/* Merges over the edges between two coplanar faces of one paint that look the same way; the other edges stay. */
static bool merge(writer *w) {
  vs_cluster *c = w->c;
  vs_kernel *k = w->k;
  for (uint32_t i = 0; i < c->uses.count; i++)
    if (c->kept.at[c->uses.at[i].face] && !VS_PUSH(k, w->uses, i)) return false;
  size_t n = w->uses.count, stay = 0;
  if (!VS_ROOM(k, w->parent.at, w->parent.room, c->faces.count + 1) ||
      !VS_ROOM(k, w->whole.at, w->whole.room, c->faces.count + 1))
    return false;
  if (!vs_uses_sort(k, c->uses.at, w->uses.at, n, c->points.all.count)) return false;
  for (uint32_t f = 0; f < c->faces.count; f++) w->parent.at[f] = f, w->whole.at[f] = c->faces.at[f].facet != VS_NONE;
  for (size_t i = 0, end; i < n; i = end) {
    const vs_use *a = use_at(w, i);
    for (end = i + 1; end < n; end++) {
      const vs_use *b = use_at(w, end);
      if (!vs_use_same_edge(a, b)) break;
    }
    if (end - i == 2) {
      const vs_use *b = use_at(w, i + 1);
      const vs_face *f = &c->faces.at[a->face], *g = &c->faces.at[b->face];
      if (f->plane == g->plane && c->kept.at[a->face] == c->kept.at[b->face] && same_paint(c->problem, f->tag, g->tag) && a->from == b->to) {
        vs_unite(w->parent.at, a->face, b->face);
        w->whole.at[a->face] = w->whole.at[b->face] = 0;
        continue;
      }
    }
    if (!VS_PUSH(k, w->edge_first, (uint32_t)stay)) return false;
    for (size_t j = i; j < end; j++) w->uses.at[stay++] = w->uses.at[j];
  }
  w->uses.count = stay;
  return VS_PUSH(k, w->edge_first, (uint32_t)stay);
}

/* Have two edges the same merged faces beside them? */
static bool same_faces(writer *w, uint32_t e, uint32_t f, bool *flat) {
  uint32_t eb = w->edge_first.at[e], ee = w->edge_first.at[e + 1], fb = w->edge_first.at[f], fe = w->edge_first.at[f + 1];
  if (ee - eb != fe - fb) return false;
  *flat = true;
  for (uint32_t i = eb; i < ee; i++) {
    uint32_t root = vs_find(w->parent.at, use_at(w, i)->face), here = 0, there = 0;
    for (uint32_t j = eb; j < ee; j++) here += vs_find(w->parent.at, use_at(w, j)->face) == root;
    for (uint32_t j = fb; j < fe; j++) there += vs_find(w->parent.at, use_at(w, j)->face) == root;
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
    for (int i = 0; i < 2; i++) {
      uint32_t p = i ? u->to : u->from;
      if (w->degree.at[p] < 2) w->edges.at[2 * p + w->degree.at[p]] = e;
      if (w->degree.at[p] < 3) w->degree.at[p]++;
    }
  }
  for (uint32_t p = 0; p < n; p++) {
    bool flat;
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
      uint32_t at = u->to, edge = e, root = vs_find(w->parent.at, u->face);
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

static bool vertex(writer *w, vs_mesh *out, uint32_t point, uint32_t *index) {
  if (w->out.at[point] == VS_NONE) {
    if (!vs_mesh_add_vertex(out, vs_grid_world(&w->c->grid, &w->c->points.all.at[point]), &w->out.at[point]))
      return vs_kernel_fail(w->k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids");
    if (!VS_PUSH(w->k, w->points, point)) return false;
  }
  *index = w->out.at[point];
  return true;
}

static bool triangle(writer *w, vs_mesh *out, const uint32_t v[3], bool turned, const vs_face *face, bool against) {
  uint32_t i[3];
  for (int j = 0; j < 3; j++)
    if (!vertex(w, out, v[turned ? 2 - j : j], &i[j])) return false;
  size_t limit = w->k->options ? w->k->options->max_triangles : 0;
  if (limit && out->triangle_count >= limit) return vs_kernel_fail(w->k, VS_KERNEL_LIMIT, 0, "the result has more than %zu triangles, the limit", limit);
  if (!vs_mesh_add_triangle(out, i[0], i[1], i[2])) return vs_kernel_fail(w->k, VS_KERNEL_OUT_OF_MEMORY, 0, "out of memory while combining solids");
  out->tags[out->triangle_count - 1] = face->tag;
  return VS_PUSH(w->k, w->looks, face->plane * 2 + against);
}

static bool write(writer *w, vs_mesh *out) {
  vs_cluster *c = w->c;
  vs_triangulation *t = &w->triangulation;
  if (!VS_ROOM(w->k, w->out.at, w->out.room, c->points.all.count + 1)) return false;
  for (size_t p = 0; p < c->points.all.count; p++) w->out.at[p] = VS_NONE;
  for (uint32_t f = 0; f < c->faces.count; f++) {
    const vs_face *face = &c->faces.at[f];
    if (!c->kept.at[f] || vs_find(w->parent.at, f) != f) continue;
    bool turned = c->kept.at[f] == 2;
    if (w->whole.at[f]) {
      const vs_facet *facet = &c->facets.at[face->facet];
      for (uint32_t i = facet[0].first; i < facet[1].first; i++)
        if (!triangle(w, out, c->triangles.at[c->facet_triangles.at[i]].v, turned != facet->flip, face, turned)) return false;
      continue;
    }
    t->sides.count = 0;
    for (uint32_t i = w->first.at[f]; i < w->first.at[f + 1]; i++)
      if (!VS_PUSH(w->k, t->sides, w->sides.at[w->by_face.at[i]])) return false;
    if (!vs_plane_triangulate(w->k, t, &c->points, &c->planes.all.at[face->plane])) return false;
    for (size_t i = 0; i < t->triangles.count; i++)
      if (!triangle(w, out, t->triangles.at[i], turned, face, turned)) return false;
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  return true;
}

bool vs_output_faces(vs_kernel *k, vs_cluster *c, vs_mesh *out) {
  writer w = { .k = k, .c = c };
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  bool ok = merge(&w) && drop_corners(&w) && make_sides(&w) && write(&w, out) && vs_kernel_report(k, 0.95) &&
            vs_split_touching(k, c, out, vertices, triangles, w.looks.at, w.points.at);
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
  vs_triangulation_free(k, &w.triangulation);
  return ok;
}
