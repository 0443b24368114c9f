/* Implements the bending of objects (bending.h).
 *
 * Whether an edge is cut depends only on its ends and its midpoint. Therefore both triangles at an edge agree, and a
 * closed mesh stays closed. In each round, the caller computes the images (positions after the bending) of all new
 * midpoints, and then edges are cut. */
#include "geometry/shapes/bending.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/files/polyface.h"
#include "model/store/array.h"

enum { CORNERS_MOST = 4000000 };

/* ---- the leaves of the object ---- */

void vs_bend_drop(vs_bend_leaves *leaves) {
  for (size_t i = 0; i < leaves->count; i++) {
    vs_mesh_free(&leaves->at[i].mesh);
    for (int k = 0; k < leaves->at[i].look_count; k++) vs_node_release(leaves->at[i].looks[k]);
  }
  free(leaves->at);
  *leaves = (vs_bend_leaves){ 0 };
}

/* ---- cutting edges in half ---- */

static const uint32_t STAYS = UINT32_MAX, ASKED = UINT32_MAX - 1;
typedef struct {
  uint64_t edge;   /* key of the edge, computed from its two vertex numbers (edge_key); 0: this slot of the hash table
                    * is free */
  uint32_t middle; /* vertex in the middle of the edge; STAYS: the edge is not cut; ASKED: the caller is to compute the
                    * position of the edge's midpoint after the bending */
} half;
typedef struct {
  uint32_t a, b;
} asked_edge;

struct vs_bending {
  vs_mesh mesh;   /* mesh of the leaf, with positions before the bending */
  vs_vec3 *image; /* image[v]: position of vertex v after the bending */
  size_t image_count, image_room;
  uint32_t *line; /* indices of a curve's vertices in order; unused for a mesh with triangles */
  size_t line_count, line_room;
  bool curve, closed, bent;
  double tolerance, longest;
  int rounds;
  half *table;
  size_t size, used;
  vs_vec3 *wanted; /* points for which the caller is to compute positions after the bending: first the vertices, in
                    * later rounds midpoints of edges */
  size_t wanted_count, wanted_room, edge_room;
  asked_edge *edges; /* edges[i]: the edge whose midpoint is wanted[i] */
};

void vs_bending_free(vs_bending *b) {
  if (!b) return;
  vs_mesh_free(&b->mesh);
  free(b->image), free(b->line), free(b->table), free(b->wanted), free(b->edges);
  free(b);
}

vs_bending *vs_bending_new(const vs_bend_leaf *leaf, double tolerance, double longest, int rounds) {
  vs_bending *b = NULL;
  const vs_mesh *m = &leaf->mesh;
  if (!VS_FRESH(b, 1)) return NULL;
  *b = (vs_bending){ .tolerance = tolerance, .longest = longest, .rounds = rounds };
  b->curve = leaf->curve, b->closed = leaf->closed;
  bool ok = vs_mesh_reserve(&b->mesh, m->vertex_count, m->triangle_count) &&
            VS_GROW(b->wanted, b->wanted_room, m->vertex_count + 1);
  if (ok && leaf->curve) ok = VS_GROW(b->line, b->line_room, m->vertex_count + 1);
  if (!ok) return vs_bending_free(b), NULL;
  if (m->vertex_count > 0) {
    memcpy(b->mesh.vertices, m->vertices, m->vertex_count * sizeof *m->vertices);
    memcpy(b->wanted, m->vertices, m->vertex_count * sizeof *m->vertices);
  }
  if (m->triangle_count) memcpy(b->mesh.triangles, m->triangles, m->triangle_count * sizeof *m->triangles);
  b->mesh.vertex_count = b->wanted_count = m->vertex_count, b->mesh.triangle_count = m->triangle_count;
  for (size_t i = 0; leaf->curve && i < m->vertex_count; i++) b->line[b->line_count++] = (uint32_t)i;
  return b;
}

const vs_vec3 *vs_bending_wanted(const vs_bending *b, size_t *count) { return *count = b->wanted_count, b->wanted; }

static uint64_t edge_key(uint32_t a, uint32_t b) { /* returns the key of the edge from a to b, which is never 0 because
                                                    * a and b differ */
  return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

/* Returns the slot of the edge in the hash table, or a free slot if it does not contain the edge. size is a power of
 * two. */
static half *half_of(half *table, size_t size, uint64_t edge) {
  size_t k = (size_t)((edge * UINT64_C(0x9E3779B97F4A7C15)) >> 20) & (size - 1);
  VS_ASSERT(size > 0 && (size & (size - 1)) == 0);
  while (table[k].edge && table[k].edge != edge) k = (k + 1) & (size - 1);
  return &table[k];
}

static bool table_room(vs_bending *b) {
  if (2 * (b->used + 4) < b->size) return true;
  size_t size = b->size ? 2 * b->size : 1024;
  half *table = NULL;
  if (!VS_FRESH(table, size)) return false;
  memset(table, 0, size * sizeof *table);
  for (size_t i = 0; i < b->size; i++)
    if (b->table[i].edge) *half_of(table, size, b->table[i].edge) = b->table[i];
  free(b->table);
  b->table = table, b->size = size;
  return true;
}

/* If the edge between vertices p and q is not in the hash table yet, adds it, and its midpoint to the wanted points.
 * Returns false when memory is out. */
static bool ask(vs_bending *b, uint32_t p, uint32_t q) {
  if (p == q) return true;
  if (!table_room(b)) return false;
  half *h = half_of(b->table, b->size, edge_key(p, q));
  if (h->edge) return true;
  h->edge = edge_key(p, q), h->middle = ASKED, b->used++;
  size_t n = b->wanted_count;
  if (!VS_GROW(b->wanted, b->wanted_room, n + 1) || !VS_GROW(b->edges, b->edge_room, n + 1)) return false;
  b->wanted[n] = vs_v3_scale(vs_v3_add(b->mesh.vertices[p], b->mesh.vertices[q]), .5);
  b->edges[n] = (asked_edge){ p, q };
  b->wanted_count++;
  return true;
}

static uint32_t middle_of(const vs_bending *b, uint32_t p, uint32_t q) {
  return p == q ? STAYS : half_of(b->table, b->size, edge_key(p, q))->middle;
}

/* Cuts the triangles whose edges are cut in this round: a triangle with one, two or three cut edges becomes two, three
 * or four triangles. Returns false when memory is out. */
static bool cut_triangles(vs_bending *b) {
  vs_mesh *m = &b->mesh;
  size_t n = m->triangle_count;
  bool ok = true;
  for (size_t i = 0; ok && i < n; i++) {
    uint32_t t[3], e[3];
    memcpy(t, m->triangles[i], sizeof t);
    for (int k = 0; k < 3; k++) e[k] = middle_of(b, t[k], t[(k + 1) % 3]);
    int cuts = (e[0] != STAYS) + (e[1] != STAYS) + (e[2] != STAYS);
    if (!cuts) continue;
    while ((cuts == 1 && e[0] == STAYS) || (cuts == 2 && e[2] != STAYS)) { /* rotates the triangle's corners, so that
                                                                            * its only cut edge is edge 0, or its two
                                                                            * cut edges are edges 0 and 1 */
      uint32_t t0 = t[0], e0 = e[0];
      t[0] = t[1], t[1] = t[2], t[2] = t0;
      e[0] = e[1], e[1] = e[2], e[2] = e0;
    }
    uint32_t *self = m->triangles[i];
    if (cuts == 1) {
      self[0] = t[0], self[1] = e[0], self[2] = t[2];
      ok = vs_mesh_add_triangle(m, e[0], t[1], t[2]);
    } else if (cuts == 2) {
      self[0] = e[0], self[1] = t[1], self[2] = e[1];
      ok = vs_mesh_add_triangle(m, t[0], e[0], e[1]) && vs_mesh_add_triangle(m, t[0], e[1], t[2]);
    } else {
      self[0] = e[0], self[1] = e[1], self[2] = e[2];
      ok = vs_mesh_add_triangle(m, t[0], e[0], e[2]) && vs_mesh_add_triangle(m, e[0], t[1], e[1]) &&
           vs_mesh_add_triangle(m, e[2], e[1], t[2]);
    }
  }
  return ok;
}

static bool cut_line(vs_bending *b) {
  uint32_t *line = NULL;
  size_t count = 0, n = b->line_count;
  if (!VS_FRESH(line, 2 * n + 1)) return false;
  for (size_t i = 0; i < n; i++) {
    line[count++] = b->line[i];
    if (i + 1 == n && !b->closed) break;
    uint32_t middle = middle_of(b, b->line[i], b->line[(i + 1) % n]);
    if (middle != STAYS) line[count++] = middle;
  }
  free(b->line);
  b->line = line, b->line_count = count, b->line_room = 2 * n + 1;
  return true;
}

/* Adds the midpoints of all edges that the last round has made to the wanted points. Returns false when memory is
 * out. */
static bool next_round(vs_bending *b) {
  bool ok = true;
  b->wanted_count = 0;
  if (b->rounds-- <= 0 || b->mesh.vertex_count >= CORNERS_MOST) return true;
  for (size_t i = 0; ok && i < b->mesh.triangle_count; i++) {
    const uint32_t *t = b->mesh.triangles[i];
    ok = ask(b, t[0], t[1]) && ask(b, t[1], t[2]) && ask(b, t[2], t[0]);
  }
  for (size_t i = 0; ok && b->line_count > 1 && i + !b->closed < b->line_count; i++)
    ok = ask(b, b->line[i], b->line[(i + 1) % b->line_count]);
  return ok;
}

static bool keep_image(vs_bending *b, vs_vec3 p) {
  if (!VS_GROW(b->image, b->image_room, b->image_count + 1)) return false;
  b->image[b->image_count++] = p;
  return true;
}

bool vs_bending_give(vs_bending *b, const vs_vec3 *images) {
  bool ok = true;
  VS_ASSERT(b->wanted_count > 0);
  if (b->image_count == 0) {
    for (size_t i = 0; ok && i < b->wanted_count; i++) ok = keep_image(b, images[i]);
    return ok && next_round(b);
  }
  bool any = false;
  for (size_t i = 0; ok && i < b->wanted_count; i++) {
    asked_edge e = b->edges[i];
    vs_vec3 chord = vs_v3_scale(vs_v3_add(b->image[e.a], b->image[e.b]), .5);
    double length = vs_v3_length(vs_v3_sub(b->mesh.vertices[e.b], b->mesh.vertices[e.a]));
    half *h = half_of(b->table, b->size, edge_key(e.a, e.b));
    h->middle = STAYS;
    if (vs_v3_length(vs_v3_sub(images[i], chord)) <= b->tolerance && length <= b->longest) continue;
    any = true;
    ok = vs_mesh_add_vertex(&b->mesh, b->wanted[i], &h->middle) && keep_image(b, images[i]);
  }
  b->wanted_count = 0;
  if (!ok || !any) return ok;
  return (b->curve ? cut_line(b) : cut_triangles(b)) && next_round(b);
}

vs_mesh *vs_bending_mesh(vs_bending *b) {
  if (!b->bent) { /* at the first call, replaces the mesh's vertices by their positions after the bending */
    if (b->image_count > 0) memcpy(b->mesh.vertices, b->image, b->image_count * sizeof *b->image);
    for (size_t i = 0; b->curve && i < b->line_count; i++) b->mesh.vertices[i] = b->image[b->line[i]];
    if (b->curve) b->mesh.vertex_count = b->line_count;
    b->bent = true;
  }
  return &b->mesh;
}

/* ---- nodes ---- */

static vs_node *mesh_node(vs_store *s, const vs_mesh *m, bool closed) {
  uint32_t *place = NULL, *number = NULL, *start = NULL, *corner = NULL;
  vs_vec3 *kept = NULL;
  vs_node *n = NULL;
  size_t faces = 0, points = 0;
  vs_points *p = NULL;
  vs_faces *f = NULL;
  if (!VS_FRESH(place, m->vertex_count + 1) || !vs_polyface_merge(m->vertices, m->vertex_count, place)) goto done;
  if (!VS_FRESH(number, m->vertex_count + 1) || !VS_FRESH(start, m->triangle_count + 1)) goto done;
  if (!VS_FRESH(corner, 3 * m->triangle_count + 1) || !VS_FRESH(kept, m->vertex_count + 1)) goto done;
  memset(number, 0xFF, (m->vertex_count + 1) * sizeof *number);
  for (size_t i = 0; i < m->triangle_count; i++) {
    const uint32_t *t = m->triangles[i];
    uint32_t c[3] = { place[t[0]], place[t[1]], place[t[2]] };
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (int k = 0; k < 3; k++) {
      if (number[c[k]] == UINT32_MAX) number[c[k]] = (uint32_t)points, kept[points++] = m->vertices[c[k]];
      corner[3 * faces + (size_t)k] = number[c[k]];
    }
    faces++;
  }
  for (size_t i = 0; i <= faces; i++) start[i] = (uint32_t)(3 * i);
  if (!faces) {
    n = vs_node_new(s, VS_EMPTY, &(struct vs_empty){ 0 }, NULL, 0);
    goto done;
  }
  p = vs_points_new(s, kept, points);
  f = p ? vs_faces_new(s, start, faces, corner, 3 * faces) : NULL;
  struct vs_polyface_mesh d = { .points = p, .faces = f, .closed = closed };
  if (f) n = vs_node_new(s, VS_POLYFACE_MESH, &d, NULL, 0);
done:
  if (f) vs_faces_release(s, f);
  if (p) vs_points_release(s, p);
  free(place), free(number), free(start), free(corner), free(kept);
  return n;
}

vs_node *vs_bend_node(vs_store *s, const vs_bend_leaf *leaf, const vs_mesh *mesh) {
  vs_node *n = NULL;
  if (leaf->curve) {
    vs_points *p = vs_points_new(s, mesh->vertices, mesh->vertex_count);
    if (p) {
      n = vs_node_new(s, VS_LINE, &(struct vs_line){ .points = p, .closed = leaf->closed }, NULL, 0);
      vs_points_release(s, p);
    }
  } else {
    n = mesh_node(s, mesh, leaf->closed);
  }
  for (int i = leaf->look_count; n && i-- > 0;) {
    vs_ref child = { n, leaf->origin };
    vs_node *wrapped = vs_node_new(s, (vs_kind)leaf->looks[i]->kind, vs_node_data(leaf->looks[i]), &child, 1);
    vs_node_release(n);
    n = wrapped;
  }
  return n;
}
