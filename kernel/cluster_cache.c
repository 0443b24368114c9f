/* Implements the storage of evaluated clusters in the world cache (cluster_cache.h).
 *
 * A cached result must have the same bytes as one that a new process computes. The grid of a cluster depends on its
 * position. Therefore the key contains the absolute placements of the leaves, instead of their relative placements. The
 * key contains the serial number of each leaf's mesh. Tags and paints are numbered in the order in which the leaves use
 * them, because only their equality matters.
 *
 * A cached result consists of the counts of vertices, triangles and tags; the vertices; the corners of the triangles;
 * and the tag of each triangle if there are several tags. */
#include "kernel/cluster_cache.h"

#include <string.h>

#include "model/store/cache.h"

typedef struct { uint64_t vertices, triangles; } header;

/* Sets *place to the index that p stores for `number`, a tag or paint. If p has none yet, stores `next` as its
 * index. */
static bool place_of(vs_kernel *k, vs_places *p, uint32_t number, size_t next, uint32_t *place) {
  if (number >= p->count) {
    if (!VS_ROOM(k, p->at, p->room, (size_t)number + 1)) return false;
    for (; p->count < p->room; p->count++) p->at[p->count] = VS_NONE;
  }
  if (p->at[number] == VS_NONE) p->at[number] = (uint32_t)next;
  *place = p->at[number];
  return true;
}

static bool put(vs_kernel *k, vs_remember *r, uint64_t word) { return VS_PUSH(k, r->words, word); }

static bool put_real(vs_kernel *k, vs_remember *r, double d) { return put(k, r, vs_cache_real(d)); }

static bool put_leaf(vs_kernel *k, vs_remember *r, const vs_copies *c, uint32_t leaf) {
  const vs_kernel_leaf *l = &c->problem->leaves[leaf];
  uint32_t paint = c->problem->paints ? c->problem->paints[l->tag] : l->tag, tag_at, paint_at;
  if (!place_of(k, &r->tag_place, l->tag, r->tags.count, &tag_at) ||
      !place_of(k, &r->paint_place, paint, r->paints.count, &paint_at))
    return false;
  if (tag_at == r->tags.count && !VS_PUSH(k, r->tags, l->tag)) return false;
  if (paint_at == r->paints.count && !VS_PUSH(k, r->paints, paint)) return false;
  bool ok =
      put(k, r, c->problem->identities[leaf]) && put(k, r, (uint64_t)tag_at << 32 | paint_at) &&
      put(k, r,
          (uint64_t)c->expression->forces.at[leaf] << 2 | (uint64_t)c->expression->taken_off.at[leaf] << 1 | l->bare);
  for (int i = 0; ok && i < 12; i++) ok = put_real(k, r, l->placement.m[i / 4][i % 4]);
  return ok;
}

bool vs_remember_key(vs_kernel *k, vs_remember *r, vs_copies *c, vs_group leaves, const vs_bounds *gate, bool *known) {
  const vs_kernel_options *o = k->options;
  *known = o && vs_cache_asks(o->cache) && c->problem->identities;
  for (uint32_t i = 0; *known && i < leaves.count; i++) *known = c->problem->identities[leaves.at[i]] != 0;
  if (!*known) return true;
  r->words.count = r->tags.count = r->paints.count = 0;
  bool ok = put(k, r, (uint64_t)o->straight << 32 | leaves.count) && put(k, r, c->expression->forced);
  for (uint32_t i = 0; ok && i < leaves.count; i++) ok = put_leaf(k, r, c, leaves.at[i]) && vs_kernel_poll(k, 0);
  for (size_t i = 0; i < r->tags.count; i++) r->tag_place.at[r->tags.at[i]] = VS_NONE;
  for (size_t i = 0; i < r->paints.count; i++) r->paint_place.at[r->paints.at[i]] = VS_NONE;
  size_t first = c->keys.count;
  ok = ok && vs_copies_put_terms(k, c, leaves);
  for (size_t i = first; ok && i < c->keys.count; i++) ok = put(k, r, c->keys.at[i]) && vs_kernel_poll(k, 0);
  c->keys.count = first;
  return ok && (!gate || (put_real(k, r, gate->min.x) && put_real(k, r, gate->min.y) && put_real(k, r, gate->min.z) &&
                          put_real(k, r, gate->max.x) && put_real(k, r, gate->max.y) && put_real(k, r, gate->max.z)));
}

bool vs_remember_find(vs_kernel *k, vs_remember *r, vs_mesh *out, bool *found) {
  const vs_cached *known =
      vs_cache_find(k->options->cache, &(vs_cache_key){ VS_CACHED_CLUSTER, NULL, r->words.at, r->words.count, 0 });
  *found = known != NULL;
  if (!known) return true;
  header h;
  memcpy(&h, known->data, sizeof h);
  const unsigned char *from = (const unsigned char *)known->data + 16; /* the arrays of a cached result begin at
                                                                        * multiples of 16 bytes (cache.c) */
  size_t vertices = out->vertex_count, triangles = out->triangle_count, limit = k->options->max_triangles;
  bool ok = (!limit || triangles + h.triangles <= limit) ||
            vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the result has more than %zu triangles, the limit", limit);
  if (ok && (vertices + h.vertices > out->vertex_room || triangles + h.triangles > out->triangle_room))
    ok = vs_mesh_reserve(out, vertices + vertices / 2 + h.vertices, triangles + triangles / 2 + h.triangles) ||
         vs_kernel_no_memory(k);
  if (ok && h.triangles) {
    memcpy(out->vertices + vertices, from, h.vertices * sizeof *out->vertices);
    from += (h.vertices * sizeof *out->vertices + 15) & ~(size_t)15;
    memcpy(out->triangles + triangles, from, h.triangles * sizeof *out->triangles);
    from += (h.triangles * sizeof *out->triangles + 15) & ~(size_t)15;
    for (size_t i = triangles; vertices && i < triangles + h.triangles; i++)
      for (int j = 0; j < 3; j++) out->triangles[i][j] += (uint32_t)vertices;
    for (size_t i = 0; i < h.triangles; i++) {
      uint32_t place = 0;
      if (r->tags.count > 1) memcpy(&place, from + i * sizeof place, sizeof place);
      out->tags[triangles + i] = r->tags.at[place];
    }
    out->vertex_count = vertices + h.vertices;
    out->triangle_count = triangles + h.triangles;
  }
  vs_cache_let_go(k->options->cache, known);
  return ok && vs_kernel_report(k, 1);
}

bool vs_remember_keep(vs_kernel *k, vs_remember *r, const vs_mesh *out, size_t first_vertex, size_t first_triangle) {
  header h = { out->vertex_count - first_vertex, out->triangle_count - first_triangle };
  bool several = r->tags.count > 1;
  vs_cache *cache = k->options->cache;
  VS_ASSERT(first_vertex <= out->vertex_count && first_triangle <= out->triangle_count);
  if (!vs_cache_keeps(cache)) return true;
  if (!VS_ROOM(k, r->scratch.at, r->scratch.room, (size_t)h.triangles * (several ? 4 : 3) + 1)) return false;
  uint32_t *corners = r->scratch.at, *places = corners + 3 * h.triangles;
  for (size_t i = 0; i < h.triangles; i++)
    for (int j = 0; j < 3; j++)
      corners[3 * i + (size_t)j] = out->triangles[first_triangle + i][j] - (uint32_t)first_vertex;
  for (uint32_t i = 0; i < r->tags.count; i++) r->tag_place.at[r->tags.at[i]] = i;
  for (size_t i = 0; several && i < h.triangles; i++) places[i] = r->tag_place.at[out->tags[first_triangle + i]];
  for (size_t i = 0; i < r->tags.count; i++) r->tag_place.at[r->tags.at[i]] = VS_NONE;
  const vs_cache_piece pieces[] = { { &h, sizeof h },
                                    { out->vertices + first_vertex, (size_t)h.vertices * sizeof *out->vertices },
                                    { corners, (size_t)h.triangles * 3 * sizeof *corners },
                                    { places, several ? (size_t)h.triangles * sizeof *places : 0 } };
  vs_cache_let_go(
      cache,
      vs_cache_keep(cache, &(vs_cache_key){ VS_CACHED_CLUSTER, NULL, r->words.at, r->words.count, 0 }, pieces, 4));
  return true;
}

void vs_remember_free(vs_kernel *k, vs_remember *r) {
  VS_DROP(k, r->words);
  VS_DROP(k, r->tags);
  VS_DROP(k, r->tag_place);
  VS_DROP(k, r->paint_place);
  VS_DROP(k, r->paints);
  VS_DROP(k, r->scratch);
}
