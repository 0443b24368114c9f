/* Makes the triangles of a primitive, without overlaps, and stores them in the cache. */
#include "solids/primitive_meshes.h"
#include "geometry/tessellate.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/primitives/half_space.h"
#include "model/job.h"
#include "solids/overlaps.h"

bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e) {
  vs_tally *tally = vs_store_tally(n->store);
  vs_work_phase was = vs_tally_enter(tally, VS_WORK_MESH);
  bool ok = vs_primitive_tessellated(n, f, options, out, e) && vs_primitive_freed(n, f, options, out, e);
  vs_tally_enter(tally, was);
  return ok;
}

/* ---- meshes in the cache ---- */

/* The vertices and the corners in a cache entry each begin at a multiple of APART bytes, after the header. */
enum { APART = 16 };
typedef struct { uint64_t vertices, triangles, settled; } header;

static size_t next(size_t bytes) { return (bytes + APART - 1) / APART * APART; }

static void view(const vs_cached *held, vs_mesh *out) {
  header h;
  memcpy(&h, held->data, sizeof h);
  unsigned char *at = (unsigned char *)(uintptr_t)held->data + next(sizeof h);
  *out = (vs_mesh){ .vertex_count = (size_t)h.vertices,
                    .triangle_count = (size_t)h.triangles,
                    .settled = h.settled != 0 };
  out->vertices = (vs_vec3 *)(void *)at;
  out->triangles = (uint32_t (*)[3])(void *)(at + next(h.vertices * sizeof *out->vertices));
}

static bool find(const vs_kept_mesh *to, const vs_cache_key *key) {
  *to->held = to->cache ? vs_cache_find(to->cache, key) : NULL;
  if (*to->held) view(*to->held, to->mesh);
  return *to->held != NULL;
}

static void keep(const vs_kept_mesh *to, const vs_cache_key *key) {
  vs_mesh *m = to->mesh;
  header h = { m->vertex_count, m->triangle_count, m->settled };
  const vs_cache_piece pieces[] = { { &h, sizeof h },
                                    { m->vertices, m->vertex_count * sizeof *m->vertices },
                                    { m->triangles, m->triangle_count * sizeof *m->triangles } };
  if (!to->cache) return;
  *to->held = vs_cache_keep(to->cache, key, pieces, 3);
  if (!*to->held) return;
  vs_mesh_free(m);
  view(*to->held, m);
}

bool vs_primitive_find(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f) {
  const uint64_t words[] = { vs_cache_real(f->tolerance), (uint64_t)(int64_t)f->segments };
  return find(to, &(vs_cache_key){ VS_CACHED_PRIMITIVE, n, words, 2, 0 });
}

void vs_primitive_keep(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f) {
  const uint64_t words[] = { vs_cache_real(f->tolerance), (uint64_t)(int64_t)f->segments };
  keep(to, &(vs_cache_key){ VS_CACHED_PRIMITIVE, n, words, 2, 0 });
}

bool vs_primitive_shared(const vs_kept_mesh *to, vs_node *n, const vs_fineness *f, const vs_kernel_options *options,
                         vs_error *e) {
  if (vs_primitive_find(to, n, f)) return true;
  if (!vs_primitive_mesh(n, f, options, to->mesh, e)) return false;
  vs_primitive_keep(to, n, f);
  return true;
}

bool vs_half_space_shared(const vs_kept_mesh *to, vs_node *n, const vs_bounds *reach) {
  const double sides[] = { reach->min.x, reach->min.y, reach->min.z, reach->max.x, reach->max.y, reach->max.z };
  uint64_t words[6];
  for (int i = 0; i < 6; i++) words[i] = vs_cache_real(sides[i]);
  const vs_cache_key key = { VS_CACHED_PRIMITIVE, n, words, 6, 0 };
  if (find(to, &key)) return true;
  if (!vs_half_space_triangles(to->mesh, VS_AS(half_space, n)->point, VS_AS(half_space, n)->normal, reach))
    return false;
  keep(to, &key);
  return true;
}
