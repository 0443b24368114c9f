/* Cuts leaves that are far larger than the region where they matter: for example, a ground of a kilometre that cuts a
 * ball of a centimetre.
 *
 * All coordinates of a cluster share one grid, so a leaf that is far larger than the others would make the grid coarse.
 * The expression determines the region where a leaf matters. An operand of an intersection matters within the bounds of
 * the other operands. A subtracted operand matters within the bounds of the first operand. These rules apply to nested
 * terms, too. The kernel keeps the part of the leaf in a box: the region, and a margin around it that is as wide as the
 * region. Outside of the region, the result does not depend on the leaf. Each of the six planes of the box cuts the
 * triangles that cross it, and removes the triangles beyond it. The remaining mesh has a border in the plane. A cone
 * from this border to any point of the plane closes the mesh again. Two chains of triangles in one plane that have the
 * same border enclose no volume. Therefore winding numbers are right even if the cone overlaps itself. */
#include "kernel/clip.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The kernel cuts a leaf that is more than this many times as large as the region where it matters. A smaller leaf
 * costs the grid at most 6 of its 32 bits. */
static const double FAR = 64;

/* An edge and its two vertices. In cut_edges, `number` is the new vertex where the cutting plane cuts the edge. In
 * close_border, it is 1 if the edge leads from `low` to `high`, else -1. */
typedef struct { uint32_t low, high; int32_t number; } edge;
typedef struct {
  vs_kernel *k;
  VS_LIST(vs_vec3) vertices;
  VS_LIST(uint32_t) corners, kept;
  VS_LIST(double) beyond;     /* beyond[v]: distance of vertex v from the cutting plane, positive on the side that is
                               * removed */
  VS_LIST(edge) edges;
} clipper;

static int edge_order(const void *a, const void *b) {
  const edge *x = a, *y = b;
  if (x->low != y->low) return x->low < y->low ? -1 : 1;
  return x->high < y->high ? -1 : x->high > y->high;
}

static edge edge_of(uint32_t a, uint32_t b) { return (edge){ a < b ? a : b, a < b ? b : a, a < b ? 1 : -1 }; }

static bool keep(clipper *c, uint32_t a, uint32_t b, uint32_t d) {
  return VS_PUSH(c->k, c->kept, a) && VS_PUSH(c->k, c->kept, b) && VS_PUSH(c->k, c->kept, d);
}

/* Makes a vertex on each edge that crosses the cutting plane; both triangles at the edge use this vertex. Returns false
 * when memory is out or the caller interrupts. */
static bool cut_edges(clipper *c) {
  c->edges.count = 0;
  for (size_t t = 0; t < c->corners.count; t += 3)
    for (size_t j = 0; j < 3; j++) {
      uint32_t a = c->corners.at[t + j], b = c->corners.at[t + (j + 1) % 3];
      if (c->beyond.at[a] < 0 && c->beyond.at[b] > 0 && !VS_PUSH(c->k, c->edges, edge_of(a, b))) return false;
      if (c->beyond.at[a] > 0 && c->beyond.at[b] < 0 && !VS_PUSH(c->k, c->edges, edge_of(a, b))) return false;
    }
  if (c->edges.count) qsort(c->edges.at, c->edges.count, sizeof *c->edges.at, edge_order);
  size_t n = 0;
  for (size_t i = 0; i < c->edges.count; i++) {
    edge e = c->edges.at[i];
    if (n && c->edges.at[n - 1].low == e.low && c->edges.at[n - 1].high == e.high) continue;
    vs_vec3 p = c->vertices.at[e.low], q = c->vertices.at[e.high];
    double t = c->beyond.at[e.low] / (c->beyond.at[e.low] - c->beyond.at[e.high]);
    e.number = (int32_t)c->vertices.count;
    if (c->vertices.count >= INT32_MAX)
      return vs_kernel_fail(c->k, VS_KERNEL_LIMIT, 0, "a solid has too many triangles");
    if (!VS_PUSH(c->k, c->vertices, vs_v3_add(p, vs_v3_scale(vs_v3_sub(q, p), t))) || !VS_PUSH(c->k, c->beyond, 0.0))
      return false;
    c->edges.at[n++] = e;
  }
  c->edges.count = n;
  return true;
}

/* Returns the number of the vertex that cut_edges made on the edge from a to b. a and b differ. */
static uint32_t middle_of(const clipper *c, uint32_t a, uint32_t b) {
  edge wanted = edge_of(a, b);
  const edge *found = bsearch(&wanted, c->edges.at, c->edges.count, sizeof *c->edges.at, edge_order);
  VS_ASSERT(a != b);
  return (uint32_t)found->number;
}

static bool cut_triangles(clipper *c) {
  c->kept.count = 0;
  for (size_t t = 0; t < c->corners.count; t += 3) {
    uint32_t ring[4], n = 0;
    for (size_t j = 0; j < 3; j++) {
      uint32_t a = c->corners.at[t + j], b = c->corners.at[t + (j + 1) % 3];
      if (c->beyond.at[a] <= 0) ring[n++] = a;
      if ((c->beyond.at[a] < 0 && c->beyond.at[b] > 0) || (c->beyond.at[a] > 0 && c->beyond.at[b] < 0))
        ring[n++] = middle_of(c, a, b);
    }
    for (uint32_t i = 2; i < n; i++)
      if (!keep(c, ring[0], ring[i - 1], ring[i])) return false;
    if (!vs_kernel_poll(c->k, 0)) return false;
  }
  return true;
}

/* Closes the mesh with a cone over its border in the cutting plane. */
static bool close_border(clipper *c) {
  size_t triangles = c->kept.count, n = 0;
  c->edges.count = 0;
  for (size_t t = 0; t < triangles; t += 3)
    for (size_t j = 0; j < 3; j++) {
      uint32_t a = c->kept.at[t + j], b = c->kept.at[t + (j + 1) % 3];
      if (!(c->beyond.at[a] < 0) && !(c->beyond.at[b] < 0) && !VS_PUSH(c->k, c->edges, edge_of(a, b))) return false;
    }
  if (c->edges.count) qsort(c->edges.at, c->edges.count, sizeof *c->edges.at, edge_order);
  for (size_t i = 0, end; i < c->edges.count; i = end) { /* The border of the cut mesh consists of the edges that the
                                                          * triangles contain more often in one direction than in the
                                                          * other. */
    edge e = c->edges.at[i];
    for (e.number = 0, end = i; end < c->edges.count && edge_order(&c->edges.at[end], &e) == 0; end++)
      e.number += c->edges.at[end].number;
    if (e.number != 0) c->edges.at[n++] = e;
  }
  c->edges.count = n;
  if (n == 0) return true;
  vs_vec3 sum = { 0, 0, 0 };
  for (size_t i = 0; i < n; i++)
    sum = vs_v3_add(sum, vs_v3_scale(vs_v3_add(c->vertices.at[c->edges.at[i].low], c->vertices.at[c->edges.at[i].high]),
                                     0.5 / (double)n));
  uint32_t apex = (uint32_t)c->vertices.count;
  if (!VS_PUSH(c->k, c->vertices, sum) || !VS_PUSH(c->k, c->beyond, 0.0)) return false;
  for (size_t i = 0; i < n; i++)
    for (edge e = c->edges.at[i]; e.number != 0; e.number += e.number > 0 ? -1 : 1) {
      uint32_t from = e.number > 0 ? e.high : e.low, to = e.number > 0 ? e.low : e.high; /* the cone's triangle contains
                                                                                          * this edge in the opposite
                                                                                          * direction to the border */
      if (!keep(c, from, to, apex)) return false;
    }
  return true;
}

/* Computes the part of the leaf's mesh that lies within `box`. The box is in the leaf's coordinates. */
static bool cut_leaf(vs_kernel *k, clipper *c, const vs_kernel_leaf *leaf, const vs_bounds *box, vs_clip *out) {
  const vs_mesh *m = leaf->mesh;
  double low[3] = { box->min.x, box->min.y, box->min.z }, high[3] = { box->max.x, box->max.y, box->max.z };
  c->vertices.count = c->corners.count = 0;
  if (!VS_ROOM(k, c->vertices.at, c->vertices.room, m->vertex_count + 1) ||
      !VS_ROOM(k, c->corners.at, c->corners.room, 3 * m->triangle_count + 1))
    return false;
  if (m->vertex_count) memcpy(c->vertices.at, m->vertices, m->vertex_count * sizeof *m->vertices);
  if (m->triangle_count) memcpy(c->corners.at, m->triangles, m->triangle_count * sizeof *m->triangles);
  c->vertices.count = m->vertex_count;
  c->corners.count = 3 * m->triangle_count;
  for (int side = 0; side < 6; side++) {
    int axis = side / 2;
    bool any = false;
    c->beyond.count = 0;
    if (!VS_ROOM(k, c->beyond.at, c->beyond.room, c->vertices.count + 1)) return false;
    for (size_t i = 0; i < c->vertices.count; i++) {
      vs_vec3 p = vs_affine_point(&leaf->placement, c->vertices.at[i]);
      double x = axis == 0 ? p.x : axis == 1 ? p.y : p.z, beyond = side % 2 ? x - high[axis] : low[axis] - x;
      c->beyond.at[c->beyond.count++] = beyond;
      any = any || beyond > 0;
    }
    if (!any) continue;
    if (!cut_edges(c) || !cut_triangles(c) || !close_border(c) || !vs_kernel_report(k, 0)) return false;
    uint32_t *swap = c->corners.at;
    size_t room = c->corners.room;
    c->corners.at = c->kept.at, c->corners.count = c->kept.count, c->corners.room = c->kept.room;
    c->kept.at = swap, c->kept.room = room, c->kept.count = 0;
  }
  uint32_t *number = NULL, count = 0; /* Removes vertices that no triangle has. They would enlarge the bounds of the
                                       * leaf. */
  size_t room = 0;
  bool ok = VS_ROOM(k, number, room, c->vertices.count + 1);
  if (ok) memset(number, 0xff, c->vertices.count * sizeof *number);
  for (size_t i = 0; ok && i < c->corners.count; i++) {
    uint32_t *at = &number[c->corners.at[i]];
    if (*at == UINT32_MAX) ok = VS_PUSH(k, out->vertices, c->vertices.at[c->corners.at[i]]), *at = count++;
    ok = ok && VS_PUSH(k, out->corners, *at);
  }
  VS_FREE(k, number, room);
  out->mesh = (vs_mesh){ .vertices = out->vertices.at,
                         .vertex_count = out->vertices.count,
                         .triangles = (uint32_t(*)[3])(void *)out->corners.at,
                         .triangle_count = out->corners.count / 3 };
  return ok;
}

/* Computes, for each leaf, the region in which it can influence the result; the region is empty if there is none.
 * bounds[i]: the bounds of leaf i. */
static bool find_regions(vs_kernel *k, const vs_kernel_problem *p, const vs_bounds *bounds, vs_bounds *regions) {
  VS_LIST(vs_bounds) terms = { 0 }, matters = { 0 };
  bool ok = VS_ROOM(k, terms.at, terms.room, (size_t)p->term_count + 1) &&
            VS_ROOM(k, matters.at, matters.room, (size_t)p->term_count + 1);
  for (uint32_t i = 0; ok && i < p->leaf_count; i++) regions[i] = vs_bounds_empty();
  for (uint32_t i = 0; ok && i < p->term_count; i++) {
    const vs_kernel_term *t = &p->terms[i];
    vs_bounds b = t->kind == VS_TERM_LEAF ? bounds[t->first] : vs_bounds_empty();
    for (uint32_t j = 0; t->kind != VS_TERM_LEAF && j < t->count && (j == 0 || t->kind != VS_TERM_DIFFERENCE); j++) {
      const vs_bounds *o = &terms.at[p->operands[t->first + j]];
      if (j == 0) b = *o;
      else if (t->kind == VS_TERM_UNION) vs_bounds_unite(&b, o);
      else vs_bounds_meet(&b, o);
    }
    terms.at[i] = b;
    matters.at[i] = i + 1 == p->term_count
                        ? (vs_bounds){ vs_v3(-INFINITY, -INFINITY, -INFINITY), vs_v3(INFINITY, INFINITY, INFINITY) }
                        : vs_bounds_empty();
  }
  for (uint32_t i = ok ? p->term_count : 0; i-- > 0;) {
    const vs_kernel_term *t = &p->terms[i];
    vs_bounds here = matters.at[i];
    if (vs_bounds_is_empty(&here)) continue;
    if (t->kind == VS_TERM_LEAF) {
      vs_bounds_unite(&regions[t->first], &here);
      continue;
    }
    if (t->kind == VS_TERM_INTERSECTION) vs_bounds_meet(&here, &terms.at[i]);
    for (uint32_t j = 0; j < t->count; j++) {
      if (j == 1 && t->kind == VS_TERM_DIFFERENCE) vs_bounds_meet(&here, &terms.at[p->operands[t->first]]);
      if (!vs_bounds_is_empty(&here)) vs_bounds_unite(&matters.at[p->operands[t->first + j]], &here);
    }
  }
  VS_DROP(k, terms);
  VS_DROP(k, matters);
  return ok;
}

/* Returns true if the leaf must be cut because it is far larger than the region where it can influence the result.
 * *box: the part of space to keep. */
static bool is_far_larger(const vs_bounds *leaf, const vs_bounds *region, vs_bounds *box) {
  if (vs_bounds_is_empty(leaf) || vs_bounds_is_empty(region)) return false;
  vs_bounds here = *region;
  vs_bounds_meet(&here, leaf);
  if (vs_bounds_is_empty(&here)) return false;
  double reach = vs_bounds_diagonal(&here),
         size = fmax(leaf->max.x - leaf->min.x, fmax(leaf->max.y - leaf->min.y, leaf->max.z - leaf->min.z));
  vs_vec3 around = vs_v3(reach, reach, reach);
  *box = (vs_bounds){ vs_v3_sub(here.min, around), vs_v3_add(here.max, around) };
  return reach > 0 && isfinite(size) && size > FAR * reach;
}

bool vs_clip_leaves(vs_kernel *k, const vs_kernel_problem *p, vs_bounds *bounds, vs_clipped *out) {
  *out = (vs_clipped){ .problem = *p };
  bool any = false, ok = true;
  for (uint32_t i = 0; !any && i < p->term_count; i++)
    any = (p->terms[i].kind == VS_TERM_INTERSECTION || p->terms[i].kind == VS_TERM_DIFFERENCE) && p->terms[i].count > 1;
  if (!any) return true;
  VS_LIST(vs_bounds) regions = { 0 };
  clipper c = { .k = k };
  ok = VS_ROOM(k, regions.at, regions.room, (size_t)p->leaf_count + 1) && find_regions(k, p, bounds, regions.at);
  for (uint32_t i = 0; ok && i < p->leaf_count; i++) {
    vs_bounds box;
    if (!is_far_larger(&bounds[i], &regions.at[i], &box)) continue;
    if (!out->leaves.count) { /* this is the first leaf to be cut: copies the caller's list of leaves, which must stay
                               * unchanged */
      ok = VS_ROOM(k, out->leaves.at, out->leaves.room, (size_t)p->leaf_count + 1) &&
           VS_ROOM(k, out->identities.at, out->identities.room, (size_t)p->leaf_count + 1) &&
           VS_ROOM(k, out->clips.at, out->clips.room, (size_t)p->leaf_count + 1); /* Reserves memory for all elements
                                                                                   * at once, because the leaves
                                                                                   * contain pointers to elements of
                                                                                   * this array. */
      if (!ok) break;
      memcpy(out->leaves.at, p->leaves, p->leaf_count * sizeof *p->leaves);
      for (uint32_t j = 0; j < p->leaf_count; j++) out->identities.at[j] = p->identities ? p->identities[j] : 0;
      out->leaves.count = p->leaf_count;
      out->problem.leaves = out->leaves.at;
      if (p->identities) out->problem.identities = out->identities.at;
    }
    vs_clip *clip = &out->clips.at[out->clips.count++];
    *clip = (vs_clip){ .mesh = { .vertex_count = 0 } };
    ok = cut_leaf(k, &c, &p->leaves[i], &box, clip);
    out->leaves.at[i].mesh = &clip->mesh;
    out->identities.at[i] = 0; /* serial number 0: the cache does not store results of this mesh */
    bounds[i] = vs_mesh_placed_bounds(&clip->mesh, &p->leaves[i].placement);
  }
  VS_DROP(k, regions);
  VS_DROP(k, c.vertices);
  VS_DROP(k, c.corners);
  VS_DROP(k, c.kept);
  VS_DROP(k, c.beyond);
  VS_DROP(k, c.edges);
  return ok;
}

void vs_clipped_free(vs_kernel *k, vs_clipped *c) {
  for (size_t i = 0; i < c->clips.count; i++) {
    VS_DROP(k, c->clips.at[i].vertices);
    VS_DROP(k, c->clips.at[i].corners);
  }
  VS_DROP(k, c->clips);
  VS_DROP(k, c->leaves);
  VS_DROP(k, c->identities);
}
