/* Implements the copying of meshes into the kernel's results (assemble.h). */
#include "kernel/assemble.h"

#include <string.h>

#include "kernel/threads.h"

enum {
  SERIAL = 10000, /* number of triangles below which a single thread copies all */
  CHUNK = 16      /* number of placements that one task copies */
};

bool vs_placing_room(vs_kernel *k, vs_mesh *out, size_t vertices, size_t triangles) {
  size_t limit = k->options ? k->options->max_triangles : 0, more_vertices = out->vertex_count + vertices,
         more = out->triangle_count + triangles;
  if (limit && more > limit)
    return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the result has more than %zu triangles, the limit", limit);
  if (more_vertices > UINT32_MAX) return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the result has too many corners");
  if ((more_vertices > out->vertex_room || more > out->triangle_room) && /* reserves room for half as many more
                                                                          * elements, because thousands of placements
                                                                          * may follow */
      !vs_mesh_reserve(out, more_vertices + more_vertices / 2, more + more / 2) &&
      !vs_mesh_reserve(out, more_vertices, more))
    return vs_kernel_no_memory(k);
  out->vertex_count = more_vertices;
  out->triangle_count = more;
  return true;
}

typedef struct {
  const vs_placement *list;
  size_t count;
  const vs_kernel_leaf *leaves;
  vs_mesh *results;
  struct { VS_LIST(uint32_t) at; } tags[VS_THREADS_MOST]; /* tags[i] belongs to thread i: at[t] is the tag that a
                                                           * triangle gets in the copy if its tag in the original is
                                                           * t */
} placing;

/* Fills the calling thread's element of all->tags, which maps each tag of the original to the tag in the copy. */
static bool find_tags(vs_kernel *k, placing *all, const vs_placement *p) {
  VS_ASSERT(k->worker < VS_THREADS_MOST);
  for (uint32_t i = 0; i < p->leaf_count; i++) {
    uint32_t was = all->leaves[p->were[i]].tag;
    if (!VS_ROOM(k, all->tags[k->worker].at.at, all->tags[k->worker].at.room, (size_t)was + 1)) return false;
    all->tags[k->worker].at.at[was] = all->leaves[p->leaves[i]].tag;
  }
  return true;
}

/* Copies the range of vertices and triangles that placement p describes. In the source and in the destination, the
 * range must lie within the mesh. */
static bool place_one(vs_kernel *k, placing *all, const vs_placement *p) {
  vs_mesh *to = &all->results[p->into];
  const vs_mesh *m = p->mesh ? p->mesh : to;
  bool mirrors = vs_affine_determinant(&p->map) < 0;
  uint32_t shift = (uint32_t)(p->vertex - p->from.vertex);
  VS_ASSERT(p->from.vertex + p->from.vertices <= m->vertex_count && p->vertex + p->from.vertices <= to->vertex_count);
  VS_ASSERT(p->from.triangle + p->from.triangles <= m->triangle_count &&
            p->triangle + p->from.triangles <= to->triangle_count);
  if (p->were && !find_tags(k, all, p)) return false;
  for (size_t i = 0; i < p->from.vertices; i++)
    to->vertices[p->vertex + i] = vs_affine_point(&p->map, m->vertices[p->from.vertex + i]);
  for (size_t i = 0; i < p->from.triangles; i++) {
    const uint32_t *v = m->triangles[p->from.triangle + i];
    uint32_t *now = to->triangles[p->triangle + i];
    now[0] = v[0] + shift, now[1] = v[mirrors ? 2 : 1] + shift, now[2] = v[mirrors ? 1 : 2] + shift;
    to->tags[p->triangle + i] =
        p->were ? all->tags[k->worker].at.at[to->tags[p->from.triangle + i]] : all->leaves[p->leaves[0]].tag;
  }
  return vs_kernel_report(k, k->part);
}

static bool place_some(vs_kernel *k, void *context, size_t index) {
  placing *all = context;
  size_t begin = index * CHUNK, end = all->count - begin < CHUNK ? all->count : begin + CHUNK;
  for (size_t i = begin; i < end; i++)
    if (!place_one(k, all, &all->list[i])) return false;
  return true;
}

static bool place_all(vs_kernel *k, placing *all, const vs_placement *list, size_t count) {
  uint32_t threads = k->threads;
  size_t triangles = 0;
  for (size_t i = 0; i < count; i++) triangles += list[i].from.triangles;
  if (triangles < SERIAL) k->threads = 1;
  all->list = list;
  all->count = count;
  bool ok = vs_kernel_run(k, (count + CHUNK - 1) / CHUNK, place_some, all);
  k->threads = threads;
  return ok;
}

bool vs_placing_finish(vs_kernel *k, vs_placing *p, const vs_kernel_leaf *leaves, vs_mesh *results) {
  placing all = { .leaves = leaves, .results = results };
  bool ok = place_all(k, &all, p->meshes.at, p->meshes.count) && place_all(k, &all, p->again.at, p->again.count);
  for (int i = 0; i < VS_THREADS_MOST; i++) VS_DROP(k, all.tags[i].at);
  return ok;
}

void vs_placing_free(vs_kernel *k, vs_placing *p) {
  VS_DROP(k, p->meshes);
  VS_DROP(k, p->again);
}
