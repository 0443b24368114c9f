/* Owns the triangles of one primitive as a good solid. */
#include "solids/primitive_meshes.h"
#include "geometry/tessellate.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/primitives/half_space.h"
#include "kernel/mesh/inspect.h"
#include "kernel/mesh/shells.h"
#include "model/store/array.h"
#include "model/tally.h"

/* Kinds whose meshes may overlap themselves; placements are looked through. */
static bool may_overlap(const vs_node *n) {
  if (n->class_ != VS_SOLID) return false;
  while (n->kind == VS_TRANSFORM || n->kind == VS_MATERIAL || n->kind == VS_LAYER) n = n->children[0].node;
  if (n->kind == VS_EXTRUDE) return VS_AS(extrude, n)->taper != 0 || n->child_count > 1;
  return vs_node_has(n, VS_IS_OVERLAPPING);
}

static bool failed(const vs_kernel_error *why, vs_error *e) {
  switch (why->status) {
  case VS_KERNEL_OUT_OF_MEMORY: return vs_error_memory(e, NULL);
  case VS_KERNEL_INTERRUPTED: return vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted");
  case VS_KERNEL_FINE:
  case VS_KERNEL_OPEN:
  case VS_KERNEL_INSIDE_OUT:
  case VS_KERNEL_NOT_FINITE:
  case VS_KERNEL_LIMIT:
  case VS_KERNEL_INTERNAL: break;
  }
  return vs_error_set(e, VS_ERROR_MODEL, NULL, "%s", why->message);
}

/* Leaves out shells that are nothing but a crack or a flake: where faces of a mesh that overlaps itself lie on one
 * another, rounding parts them by some steps of the kernel's grid. thickness: a shell that is thinner on the whole
 * goes. */
static bool drop_flakes(vs_mesh *m, double thickness, vs_error *e) {
  vs_shells shells;
  bool ok = vs_shells_find(m, &shells);
  uint8_t *gone = ok ? vs_fresh(m->triangle_count + 1, 1) : NULL;
  ok = gone || vs_error_memory(e, NULL);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    const vs_shell *s = &shells.at[shells.of[m->triangles[t][0]]];
    gone[t] = fabs(s->volume) <= thickness * s->area / 2;
  }
  if (ok) vs_mesh_squeeze(m, gone);
  vs_shells_free(&shells);
  free(gone);
  return ok;
}

bool vs_primitive_overlaps(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, bool *overlaps,
                           vs_error *e) {
  vs_mesh m = { 0 };
  vs_mesh_flaws flaws = { 0 };
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  bool ok = vs_tessellate(n, f, &m, e) &&
            (!m.triangle_count || vs_kernel_inspect(&m, options, &flaws, &why) || failed(&why, e));
  *overlaps = flaws.wound_count > 0;
  vs_mesh_free(&m);
  return ok;
}

bool vs_mesh_without_overlaps(vs_mesh *m, const vs_kernel_options *options, vs_error *e) {
  vs_mesh_flaws flaws;
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  vs_mesh whole = { 0 };
  if (!m->triangle_count) return true;
  if (!vs_kernel_inspect(m, options, &flaws, &why)) return failed(&why, e);
  if (flaws.wound_count == 0 && !flaws.touches) return true;
  if (!vs_kernel_resolve(m, 0, options, &whole, &why)) return vs_mesh_free(&whole), failed(&why, e);
  vs_bounds b = vs_mesh_bounds(m);
  vs_mesh_free(m);
  *m = whole;
  return flaws.wound_count == 0 || drop_flakes(m, 1e-6 * vs_bounds_diagonal(&b), e);
}

static bool primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                           vs_error *e) {
  size_t limit = options ? options->max_triangles : 0;
  out->most = limit * VS_ON_THE_WAY;
  if (!vs_tessellate(n, f, out, e)) {
    if (out->over) vs_error_set(e, VS_ERROR_MEMORY, NULL, VS_SHAPES_OVER, out->most, VS_ON_THE_WAY, limit);
    return false;
  }
  out->most = 0;
  return !may_overlap(n) || vs_mesh_without_overlaps(out, options, e);
}

bool vs_primitive_mesh(const vs_node *n, const vs_fineness *f, const vs_kernel_options *options, vs_mesh *out,
                       vs_error *e) {
  vs_tally *tally = vs_store_tally(n->store);
  vs_work_phase was = vs_tally_enter(tally, VS_WORK_MESH);
  bool ok = primitive_mesh(n, f, options, out, e);
  vs_tally_enter(tally, was);
  return ok;
}

/* ---- shared ---- */

/* then the vertices, then the corners, each at a sixteen (cache.c) */
typedef struct { uint64_t vertices, triangles; } header;

static void view(const vs_cached *held, vs_mesh *out) {
  header h;
  memcpy(&h, held->data, sizeof h);
  unsigned char *at = (unsigned char *)(uintptr_t)held->data + sizeof h;
  *out = (vs_mesh){ .vertex_count = (size_t)h.vertices, .triangle_count = (size_t)h.triangles };
  out->vertices = (vs_vec3 *)(void *)at;
  out->triangles = (uint32_t (*)[3])(void *)(at + ((h.vertices * sizeof *out->vertices + 15) & ~(size_t)15));
}

static bool find(const vs_kept_mesh *to, const vs_cache_key *key) {
  *to->held = to->cache ? vs_cache_find(to->cache, key) : NULL;
  if (*to->held) view(*to->held, to->mesh);
  return *to->held != NULL;
}

static void keep(const vs_kept_mesh *to, const vs_cache_key *key) {
  vs_mesh *m = to->mesh;
  header h = { m->vertex_count, m->triangle_count };
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
