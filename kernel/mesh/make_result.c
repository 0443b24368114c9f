/* Makes the mesh of the result. It merges coplanar faces with one paint, drops corners that are not needed,
 * triangulates the faces and orients them outwards.
 *
 * A corner is not needed if exactly two border edges of merged faces end there, in one line, with the same faces on
 * both sides. All faces at such a corner drop it, so no T-junction appears. A facet keeps its original triangles if
 * nothing touches it and it is merged with nothing. */
#include "kernel/mesh/make_result.h"

#include "kernel/arrange/cluster_frame.h"
#include "kernel/arrange/untouched_triangles.h"
#include "kernel/mesh/split_vertices.h"
#include "kernel/mesh/straighten.h"
#include "kernel/threads.h"

#include <string.h>

/* Returns true if the tags a and b have equal paints. While solids are united level by level (levels.c), tags are
 * numbers of leaves; then returns true only if a and b are equal. */
static bool same_paint(const vs_cluster *c, uint32_t a, uint32_t b) {
  const vs_kernel_problem *p = c->problem;
  return a == b || (!c->joining && p->paints && p->paints[a] == p->paints[b]);
}

/* Prefetches memory that merge_range will read soon. */
VS_AHEAD merge_ahead(const vs_cluster *c, uint32_t i, uint32_t stop) {
  enum { USE = 24, FACE = 12 };
  const vs_half *at = c->edges.at.at + i;
  if (i + USE >= stop) return;
  __builtin_prefetch(&c->uses.at[at[USE].item]);
  uint32_t face = c->uses.at[at[FACE].item].face;
  __builtin_prefetch(&c->kept.at[face]);
  __builtin_prefetch(&c->faces.at[face]);
}

/* Merges two coplanar faces of one paint and orientation across their common edge, if no other face has this edge.
 * Collects the edges that remain. */
static bool merge_range(vs_kernel *k, void *context, size_t range) {
  vs_result_state *w = context;
  const vs_cluster *c = w->c;
  const vs_halves *h = &c->edges;
  vs_found_edges *to = &w->found.at[range];
  uint32_t low = vs_halves_begin(h, range), stop = h->first.at[vs_halves_begin(h, range + 1)];
  for (uint32_t i = h->first.at[low], end; i < stop; i = end) {
    while (i >= h->first.at[low + 1]) low++;
    uint32_t first = (uint32_t)to->uses.count, high = h->at.at[i].high;
    for (end = i; end < h->first.at[low + 1] && h->at.at[end].high == high; end++) {
      merge_ahead(c, end, stop);
      if (c->kept.at[c->uses.at[h->at.at[end].item].face] && !VS_PUSH(k, to->uses, h->at.at[end].item)) return false;
    }
    size_t count = to->uses.count - first;
    if (count == 2) {
      const vs_use *a = &c->uses.at[to->uses.at[first]], *b = &c->uses.at[to->uses.at[first + 1]];
      const vs_face *f = &c->faces.at[a->face], *g = &c->faces.at[b->face];
      if (f->plane == g->plane && c->kept.at[a->face] == c->kept.at[b->face] && same_paint(c, f->tag, g->tag) &&
          a->from == b->to) {
        vs_unite_shared(w->sets.at, a->face, b->face);
        atomic_store_explicit(&w->whole.at[a->face], 0, memory_order_relaxed);
        atomic_store_explicit(&w->whole.at[b->face], 0, memory_order_relaxed);
        to->uses.count = first;
        continue;
      }
    }
    if (count == 2 && vs_sheets_seam(w, &c->uses.at[to->uses.at[first]], &c->uses.at[to->uses.at[first + 1]]) &&
        !VS_PUSH(k, to->seams, (uint32_t)to->firsts.count))
      return false;
    if (count && !VS_PUSH(k, to->firsts, first)) return false;
    if (!vs_kernel_poll(k, 0.9)) return false;
  }
  return true;
}

static bool merge(vs_result_state *w) {
  vs_cluster *c = w->c;
  vs_kernel *k = w->k;
  size_t faces = c->faces.count, ranges = c->edges.ranges, uses = 0, edges = 0;
  if (!VS_ROOM(k, w->sets.at, w->sets.room, faces + 1) || !VS_ROOM(k, w->whole.at, w->whole.room, faces + 1) ||
      !VS_ROOM(k, w->found.at, w->found.room, ranges))
    return false;
  memset(w->found.at, 0, ranges * sizeof *w->found.at);
  w->found.count = ranges;
  for (uint32_t f = 0; f < faces; f++) {
    atomic_init(&w->sets.at[f], f);
    atomic_init(&w->whole.at[f], c->faces.at[f].plane != VS_NONE && c->faces.at[f].facet != VS_NONE);
  }
  if (!vs_kernel_run(k, ranges, merge_range, w)) return false;
  for (size_t i = 0; i < ranges; i++) uses += w->found.at[i].uses.count, edges += w->found.at[i].firsts.count;
  if (!VS_ROOM(k, w->parent.at, w->parent.room, faces + 1) || !VS_ROOM(k, w->uses.at, w->uses.room, uses + 1) ||
      !VS_ROOM(k, w->edge_first.at, w->edge_first.room, edges + 1))
    return false;
  for (uint32_t f = 0; f < faces; f++) w->parent.at[f] = vs_find_shared(w->sets.at, f);
  for (size_t i = 0; i < ranges; i++) {
    vs_found_edges *from = &w->found.at[i];
    for (size_t e = 0; e < from->seams.count; e++)
      if (!VS_PUSH(k, w->seams, (uint32_t)w->edge_first.count + from->seams.at[e])) return false;
    for (size_t e = 0; e < from->firsts.count; e++)
      w->edge_first.at[w->edge_first.count++] = from->firsts.at[e] + (uint32_t)w->uses.count;
    for (size_t u = 0; u < from->uses.count; u++) w->uses.at[w->uses.count++] = from->uses.at[u];
    VS_DROP(k, from->uses);
    VS_DROP(k, from->firsts);
    VS_DROP(k, from->seams);
    if (!vs_kernel_report(k, 0.9)) return false;
  }
  vs_halves_free(k, &c->edges); /* the sorted boundary edges of the faces are no longer needed */
  return VS_PUSH(k, w->edge_first, (uint32_t)uses);
}

/* Returns true if the edges e and f have the same merged faces beside them. *flat: true if all these faces lie in one
 * plane. *bent: true if a merged face lies in one plane beside e and in another beside f. */
static bool same_faces(vs_result_state *w, uint32_t e, uint32_t f, bool *flat, bool *bent) {
  uint32_t eb = w->edge_first.at[e], ee = w->edge_first.at[e + 1], fb = w->edge_first.at[f],
           fe = w->edge_first.at[f + 1];
  if (ee - eb != fe - fb) return false;
  *flat = true;
  *bent = false;
  for (uint32_t i = eb; i < ee; i++) {
    uint32_t root = w->parent.at[vs_result_use(w, i)->face], here = 0, there = 0;
    for (uint32_t j = eb; j < ee; j++) here += w->parent.at[vs_result_use(w, j)->face] == root;
    for (uint32_t j = fb; j < fe; j++) there += w->parent.at[vs_result_use(w, j)->face] == root;
    if (here != there) return false;
    uint32_t plane = w->c->faces.at[vs_result_use(w, i)->face].plane;
    if (plane != w->c->faces.at[vs_result_use(w, eb)->face].plane) *flat = false;
    for (uint32_t j = fb; w->bent.count && j < fe; j++) {
      uint32_t face = vs_result_use(w, j)->face;
      if (w->parent.at[face] == root && w->c->faces.at[face].plane != plane) *bent = true;
    }
  }
  return true;
}

/* Returns true if the edge belongs to exactly two faces, and these are not merged with each other. */
static bool are_two(const vs_result_state *w, uint32_t e) {
  uint32_t begin = w->edge_first.at[e];
  VS_ASSERT(e + 1 < w->edge_first.count);
  return w->edge_first.at[e + 1] - begin == 2 &&
         w->parent.at[vs_result_use(w, begin)->face] != w->parent.at[vs_result_use(w, begin + 1)->face];
}

enum { POINTS = 1 << 14 };
static bool drop_some_corners(vs_kernel *k, void *context, size_t chunk) {
  vs_result_state *w = context;
  const vs_cluster *c = w->c;
  size_t n = c->points.all.count, begin = chunk * POINTS, end = n - begin < POINTS ? n : begin + POINTS;
  for (size_t p = begin; p < end; p++) {
    bool flat, bent;
    if (w->degree.at[p] != 2 || !same_faces(w, w->edges.at[2 * p], w->edges.at[2 * p + 1], &flat, &bent)) continue;
    const vs_use *a = vs_result_use(w, w->edge_first.at[w->edges.at[2 * p]]),
                 *b = vs_result_use(w, w->edge_first.at[w->edges.at[2 * p + 1]]);
    if (bent) { /* beside this corner, a merged face passes from one plane to another; straighten.c decides whether the
                 * corner can be dropped */
      if (flat || w->stays.at[p] || !are_two(w, w->edges.at[2 * p])) continue;
      w->bent.at[p] = 1;
    }
    if (flat) { /* The faces beside the two edges all lie in one plane, so the edges may still have different
                 * directions. */
      const vs_plane *plane = &c->planes.all.at[c->faces.at[a->face].plane];
      if (vs_orient2d(vs_points_of(&c->points), vs_result_other_end(a, (uint32_t)p), (uint32_t)p,
                      vs_result_other_end(b, (uint32_t)p), plane->u, plane->v) != 0)
        continue;
    }
    w->degree.at[p] = 4;
  }
  return vs_kernel_report(k, 0.9);
}

VS_AHEAD corners_ahead(const vs_result_state *w, uint32_t e, size_t edges) {
  enum { USE = 24, POINT = 12 };
  if (e + USE >= edges) return;
  __builtin_prefetch(vs_result_use(w, w->edge_first.at[e + USE]));
  const vs_use *u = vs_result_use(w, w->edge_first.at[e + POINT]);
  uint32_t p = u->from < u->to ? u->to : u->from; /* The loop visits edges in the order of their lower points. Therefore
                                                   * only the higher points need to be prefetched. */
  __builtin_prefetch(&w->degree.at[p], 1);
  __builtin_prefetch(&w->edges.at[2 * p], 1);
}

static bool drop_corners(vs_result_state *w) {
  vs_cluster *c = w->c;
  size_t n = c->points.all.count, edges = w->edge_first.count - 1;
  if (!VS_ROOM(w->k, w->edges.at, w->edges.room, 2 * n + 1) || !VS_ROOM(w->k, w->degree.at, w->degree.room, n + 1))
    return false;
  if (!vs_kernel_report(w->k, 0.9)) return false;
  memset(w->degree.at, 0, n);
  if (w->bent.count) memset(w->bent.at, 0, n);
  w->rim_edges = 0;
  if (c->regions.count) {
    if (!VS_ROOM(w->k, w->rim.at, w->rim.room, n + 1)) return false;
    memset(w->rim.at, 0, n + 1);
    w->rim.count = n;
  }
  for (uint32_t e = 0; e < edges; e++) {
    corners_ahead(w, e, edges);
    if (w->gone.count && w->gone.at[e]) continue;
    const vs_use *u = vs_result_use(w, w->edge_first.at[e]);
    /* Corners of untouched triangles must stay, because triangles that are not in `uses` share them. */
    for (uint32_t i = w->edge_first.at[e]; w->rim.count && i < w->edge_first.at[e + 1]; i++)
      if (c->faces.at[vs_result_use(w, i)->face].plane == VS_NONE)
        w->degree.at[u->from] = w->degree.at[u->to] = 3, w->rim.at[u->from] = w->rim.at[u->to] = 1, w->rim_edges++;
    for (int i = 0; i < 2; i++) {
      uint32_t p = i ? u->to : u->from;
      if (w->degree.at[p] < 2) w->edges.at[2 * p + w->degree.at[p]] = e;
      if (w->degree.at[p] < 3) w->degree.at[p]++;
    }
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  if (!vs_kernel_report(w->k, 0.9)) return false;
  return vs_kernel_run(w->k, (n + POINTS - 1) / POINTS, drop_some_corners, w);
}

enum { EDGES = 1 << 14 };
static bool name_edges(vs_kernel *k, void *context, size_t chunk) {
  vs_result_state *w = context;
  size_t n = w->edge_first.count - 1, begin = chunk * EDGES, end = n - begin < EDGES ? n : begin + EDGES;
  for (size_t e = begin; e < end; e++)
    for (uint32_t i = w->edge_first.at[e]; !(w->gone.count && w->gone.at[e]) && i < w->edge_first.at[e + 1]; i++)
      w->edge_of.at[w->uses.at[i]] = (uint32_t)e;
  return vs_kernel_report(k, 0.9);
}

/* Links the faces of each merged face in a list, and each boundary edge of a face to its entry in edge_first. */
static bool link_faces(vs_result_state *w) {
  const vs_cluster *c = w->c;
  size_t faces = c->faces.count, uses = c->uses.count;
  if (!VS_ROOM(w->k, w->edge_of.at, w->edge_of.room, uses + 1) || !VS_ROOM(w->k, w->next.at, w->next.room, faces + 1))
    return false;
  if (!vs_kernel_report(w->k, 0.9)) return false;
  memset(w->edge_of.at, 0xff, uses * sizeof *w->edge_of.at); /* sets every element to VS_NONE */
  memset(w->next.at, 0xff, faces * sizeof *w->next.at);
  if (!vs_kernel_report(w->k, 0.9)) return false;
  for (size_t f = faces; f-- > 0;) {
    uint32_t root = w->parent.at[f];
    if (root != f) w->next.at[f] = w->next.at[root], w->next.at[root] = (uint32_t)f;
    if (!vs_kernel_poll(w->k, 0.9)) return false;
  }
  return vs_kernel_run(w->k, (w->edge_first.count - 1 + EDGES - 1) / EDGES, name_edges, w);
}

/* Returns true if no corner on the border of face f has been dropped. */
static bool has_all_corners(const vs_result_state *w, uint32_t f) {
  const vs_face *face = &w->c->faces.at[f];
  for (uint32_t i = face->use; i < face->use + face->use_count; i++)
    if (w->degree.at[w->c->uses.at[i].from] == 4) return false;
  return true;
}

/* Returns true if face f belongs to a sheet (planar facet that the grid has split) and the outward direction of its
 * leaf is opposite to the normal of f's plane. */
static bool is_turned(const vs_result_state *w, uint32_t f) {
  uint32_t facet = vs_result_facet(w, &w->c->faces.at[f]);
  return facet != VS_NONE && w->c->facets.at[facet].flip;
}

/* Collects the border of the merged face f as sides from corner to corner, without dropped corners. Collects the lines
 * that contain the sides, too, if the cluster has them. */
static bool gather_sides(vs_kernel *k, const vs_result_state *w, uint32_t f, vs_triangulation *t) {
  const vs_cluster *c = w->c;
  t->sides.count = t->list.count = 0;
  bool turned = is_turned(w, f);
  for (; f != VS_NONE; f = w->next.at[f]) {
    bool reverse = is_turned(w, f) != turned; /* the planes into which the grid has split a planar facet may have
                                               * opposite normals */
    if (!vs_kernel_poll(k, 0.9)) return false;
    for (uint32_t i = c->faces.at[f].use, end = i + c->faces.at[f].use_count; i < end; i++) {
      const vs_use *u = &c->uses.at[i];
      uint32_t edge = w->edge_of.at[i], at = u->to;
      if (edge == VS_NONE || w->degree.at[u->from] == 4) continue;
      while (w->degree.at[at] == 4) {
        edge = w->edges.at[2 * at] == edge ? w->edges.at[2 * at + 1] : w->edges.at[2 * at];
        at = vs_result_other_end(vs_result_use(w, w->edge_first.at[edge]), at);
      }
      if (!VS_PUSH(k, t->sides, (reverse ? (vs_border){ at, u->from } : (vs_border){ u->from, at })) ||
          (c->use_line.count && !VS_PUSH(k, t->list, c->use_line.at[i])))
        return false;
    }
  }
  return true;
}

/* ---- triangles ---- */

static bool is_shown(const vs_result_state *w, uint32_t f) {
  return w->c->kept.at[f] && w->parent.at[f] == f && w->c->faces.at[f].plane != VS_NONE;
}

static size_t facet_size(const vs_result_state *w, uint32_t f) {
  const vs_facet *facet = &w->c->facets.at[w->c->faces.at[f].facet];
  return facet[1].first - facet[0].first;
}

/* Divides the faces into chunks, which tasks triangulate, with about equal numbers of border edges. */
static bool make_chunks(vs_result_state *w) {
  enum { CHUNK = 8192 };
  size_t sum = 0;
  uint32_t faces = (uint32_t)w->c->faces.count;
  for (uint32_t f = 0; f < faces; f++) {
    if (sum == 0 && !VS_PUSH(w->k, w->chunk_first, f)) return false;
    if (w->c->kept.at[f]) sum += w->c->faces.at[f].use_count;
    if (sum >= CHUNK) sum = 0;
  }
  if (!VS_PUSH(w->k, w->chunk_first, faces)) return false;
  if (w->cutters.count) return true;
  if (!VS_ROOM(w->k, w->cutters.at, w->cutters.room, w->k->threads)) return false;
  memset(w->cutters.at, 0, w->k->threads * sizeof *w->cutters.at);
  w->cutters.count = w->k->threads;
  return true;
}

static bool triangulate_chunk(vs_kernel *k, void *context, size_t index) {
  vs_result_state *w = context;
  const vs_cluster *c = w->c;
  vs_cut_chunk *to = &w->chunks[index % VS_PIPELINE_WINDOW];
  vs_triangulation *t = &w->cutters.at[k->worker];
  to->at.count = 0;
  for (uint32_t f = w->chunk_first.at[index]; f < w->chunk_first.at[index + 1]; f++) {
    if (!is_shown(w, f)) continue;
    const vs_face *face = &c->faces.at[f];
    bool against = c->kept.at[f] == 2, whole = w->whole.at[f] && has_all_corners(w, f), turned = against;
    size_t n;
    if (whole) {
      turned = against != c->facets.at[face->facet].flip;
      n = facet_size(w, f);
    } else {
      bool simple = true;
      if (!gather_sides(k, w, f, t) || (w->sheets && !vs_sheets_simple(w, f, k, t, &simple))) return false;
      if (!simple) continue; /* The border of a merged face intersects itself, so its triangles are not made. The caller
                              * then makes the whole result again. */
      if (!vs_plane_triangulate(k, t, &c->points, &c->planes.all.at[face->plane])) return false;
      if (w->sheets) vs_sheets_mend(w, f, t);
      n = t->triangles.count;
    }
    if (!VS_ROOM(k, to->at.at, to->at.room, to->at.count + n)) return false;
    for (size_t i = 0; i < n; i++) {
      const uint32_t *v =
          whole ? c->triangles.at[c->facet_triangles.at[c->facets.at[face->facet].first + i]].v : t->triangles.at[i];
      to->at.at[to->at.count++] =
          (vs_cut_triangle){ { v[turned ? 2 : 0], v[1], v[turned ? 0 : 2] }, face->tag, face->plane * 2 + against };
    }
    if (!vs_kernel_poll(k, 0.9)) return false;
  }
  return true;
}

static bool no_room(const vs_result_state *w) {
  return vs_kernel_no_memory(w->k);
}

enum { PLACES = 1 << 14 };
static bool place_chunk(vs_kernel *k, void *context, size_t index) {
  vs_result_state *w = context;
  size_t begin = index * PLACES, end = w->points.count - begin < PLACES ? w->points.count : begin + PLACES;
  for (size_t i = begin; i < end; i++)
    w->mesh->vertices[w->first_vertex + i] = vs_grid_world(&w->c->grid, &w->c->points.all.at[w->points.at[i]]);
  return vs_kernel_report(k, k->part);
}

/* Reserves memory for `triangles` more triangles in large steps, because many clusters may be appended to one mesh. */
static bool reserve(const vs_result_state *w, vs_mesh *out, size_t triangles) {
  return triangles <= out->triangle_room ||
         vs_mesh_reserve(out, 0, out->triangle_count ? triangles + triangles / 2 : triangles) || no_room(w);
}

static bool make_room(const vs_result_state *w, vs_mesh *out, size_t more) {
  size_t limit = w->k->options ? w->k->options->max_triangles : 0, all = out->triangle_count + more;
  if (limit && all > limit)
    return vs_kernel_fail(w->k, VS_KERNEL_LIMIT, 0, "the result has more than %zu triangles, the limit", limit);
  if (all >= UINT32_MAX) return vs_kernel_fail(w->k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  return reserve(w, out, all);
}

/* Appends the triangles of a chunk of faces to the mesh. Points get vertex numbers in the order in which triangles
 * first use them. */
static bool take_chunk(vs_kernel *k, void *context, size_t index) {
  vs_result_state *w = context;
  const vs_cut_chunk *from = &w->chunks[index % VS_PIPELINE_WINDOW];
  vs_mesh *out = w->mesh;
  if (!make_room(w, out, from->at.count) ||
      !VS_ROOM(k, w->looks.at, w->looks.room, w->looks.count + from->at.count + 1))
    return false;
  for (size_t i = 0; i < from->at.count; i++) {
    const vs_cut_triangle *t = &from->at.at[i];
    uint32_t *to = out->triangles[out->triangle_count];
    for (int j = 0; j < 3; j++) {
      uint32_t *number = &w->out.at[t->v[j]];
      if (*number == VS_NONE) {
        *number = (uint32_t)(w->first_vertex + w->points.count);
        w->points.at[w->points.count++] = t->v[j];
      }
      to[j] = *number;
    }
    out->tags[out->triangle_count++] = t->tag;
    w->looks.at[w->looks.count++] = t->look;
  }
  return vs_kernel_report(k, 0.9);
}

static bool write(vs_result_state *w, vs_mesh *out) {
  size_t points = w->c->points.all.count, corners = 0;
  size_t limit = w->k->options ? w->k->options->max_triangles : 0;
  for (size_t p = 0; p < points; p++) corners += w->degree.at[p] % 4 != 0;
  size_t about = limit && limit < 2 * corners ? limit : 2 * corners; /* estimated number of triangles: about two for
                                                                      * each corner, as on a sphere (Euler's formula) */
  if (!make_chunks(w) || !reserve(w, out, out->triangle_count + about) ||
      !VS_ROOM(w->k, w->looks.at, w->looks.room, about + 1) || !VS_ROOM(w->k, w->out.at, w->out.room, points + 1) ||
      !VS_ROOM(w->k, w->points.at, w->points.room, points + 1))
    return false;
  memset(w->out.at, 0xff, points * sizeof *w->out.at); /* sets every element to VS_NONE */
  w->mesh = out;
  w->first_vertex = out->vertex_count;
  if (!vs_kernel_pipeline(w->k, w->chunk_first.count - 1, triangulate_chunk, take_chunk, w)) return false;
  size_t vertices = w->first_vertex + w->points.count;
  if (vertices > out->vertex_room && !vs_mesh_reserve(out, w->first_vertex ? vertices + vertices / 2 : vertices, 0))
    return no_room(w);
  out->vertex_count = vertices;
  return vs_kernel_run(w->k, (w->points.count + PLACES - 1) / PLACES, place_chunk, w);
}

static bool copy_plain(vs_result_state *w, vs_mesh *out) {
  size_t more = vs_plain_kept(w->c);
  return more == 0 || (make_room(w, out, more) && vs_plain_copy(w->k, w->c, out, w->out.at));
}

static void writer_free(vs_kernel *k, vs_result_state *w) {
  for (size_t i = 0; i < w->found.count; i++) {
    VS_DROP(k, w->found.at[i].uses);
    VS_DROP(k, w->found.at[i].firsts);
    VS_DROP(k, w->found.at[i].seams);
  }
  VS_DROP(k, w->found);
  VS_DROP(k, w->sets);
  VS_DROP(k, w->uses);
  VS_DROP(k, w->edge_first);
  VS_DROP(k, w->parent);
  VS_DROP(k, w->edges);
  VS_DROP(k, w->degree);
  VS_DROP(k, w->rim);
  VS_DROP(k, w->edge_of);
  VS_DROP(k, w->next);
  VS_DROP(k, w->whole);
  VS_DROP(k, w->out);
  VS_DROP(k, w->points);
  VS_DROP(k, w->looks);
  for (size_t i = 0; i < VS_PIPELINE_WINDOW; i++) VS_DROP(k, w->chunks[i].at);
  for (size_t i = 0; i < w->cutters.count; i++) vs_triangulation_free(k, &w->cutters.at[i]);
  VS_DROP(k, w->chunk_first);
  VS_DROP(k, w->cutters);
  vs_sheets_free(k, w);
}

/* Merges the faces of sheets (planar facets that the grid has split) and drops their bends, repeatedly, until all
 * remaining merges are safe. */
static bool merge_sheets(vs_result_state *w) {
  enum { TIMES = 8 };
  bool again = true;
  for (int i = 0; again; i++) {
    if (i == TIMES) vs_sheets_give_up(w);
    if (!vs_sheets_merge(w, &again) || !drop_corners(w) || (again && !vs_sheets_check(w, &again))) return false;
  }
  return true;
}

static bool write_all(vs_result_state *w, vs_mesh *out) {
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  w->c->straightened = 0;
  if (w->sheets ? !merge_sheets(w) : !drop_corners(w)) return false;
  if (!link_faces(w) || !write(w, out) || !vs_kernel_report(w->k, 0.95)) return false;
  if (vs_sheets_spoiled(w)) return true;
  const vs_fresh_result fresh = { .c = w->c,
                                  .m = out,
                                  .first_vertex = vertices,
                                  .first_triangle = triangles,
                                  .sides = w->looks.at,
                                  .points = w->points.at,
                                  .rim = w->rim.count ? w->rim.at : NULL,
                                  .rim_edges = w->rim_edges };
  return vs_split_touching(w->k, &fresh) && copy_plain(w, out);
}

bool vs_output_faces(vs_kernel *k, vs_cluster *c, vs_mesh *out) {
  enum { TIMES = 3 };
  vs_result_state w = { .k = k, .c = c };
  size_t vertices = out->vertex_count, triangles = out->triangle_count;
  bool ok = vs_sheets_begin(&w) && merge(&w) && vs_sheets_plan(&w);
  for (int i = 0; ok; i++) {
    ok = write_all(&w, out);
    bool failed = !ok && w.sheets && k->error->status == VS_KERNEL_INTERNAL;
    if (ok && !vs_sheets_spoiled(&w)) break;
    if (!ok && !failed) break;
    if (failed) { /* makes the result again with all its corners, after which no check is needed */
      k->error->status = VS_KERNEL_FINE;
      atomic_store(&k->stop, false);
    }
    if (failed || i == TIMES) vs_sheets_give_up(&w);
    ok = true;
    out->vertex_count = vertices, out->triangle_count = triangles;
    w.points.count = w.looks.count = w.chunk_first.count = 0;
  }
  writer_free(k, &w);
  return ok;
}

bool vs_output_outlines(vs_kernel *k, vs_cluster *c, vs_outlines *out) {
  vs_result_state w = { .k = k, .c = c };
  vs_triangulation t = { .sides = { 0 } };
  bool ok = merge(&w) && drop_corners(&w) && link_faces(&w);
  for (uint32_t f = 0; ok && f < c->faces.count; f++) {
    if (!is_shown(&w, f)) continue;
    bool against = c->kept.at[f] == 2;
    uint32_t leaf = c->faces.at[f].tag;
    vs_facet made = { .leaf = leaf, .plane = c->faces.at[f].plane, .first = (uint32_t)out->sides.count,
        .flip = against };
    ok = gather_sides(k, &w, f, &t) && VS_PUSH(k, out->facets, made);
    for (size_t i = 0; ok && i < t.sides.count; i++) {
      vs_facet_side s = { against ? t.sides.at[i].to : t.sides.at[i].from,
          against ? t.sides.at[i].from : t.sides.at[i].to, t.list.at[i] };
      ok = VS_PUSH(k, out->sides, s);
    }
  }
  ok = ok && VS_PUSH(k, out->facets, ((vs_facet){ .leaf = VS_NONE, .first = (uint32_t)out->sides.count }));
  if (ok) out->facets.count--;
  vs_triangulation_free(k, &t);
  writer_free(k, &w);
  return ok;
}
