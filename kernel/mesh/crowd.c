/* Counts the pairs of triangles whose bounding boxes intersect. */
#include "kernel/mesh/crowd.h"

#include <math.h>

#include "kernel/mesh/bvh.h"

typedef struct {
  vs_kernel *k;
  size_t pairs, most;
} count;

static bool count_pair(void *context, uint32_t a, uint32_t b) {
  count *c = context;
  (void)a;
  (void)b;
  return ++c->pairs < c->most && vs_kernel_poll(c->k, 0);
}

static int32_t step_of(double x, double from, double step) { return (int32_t)floor((x - from) / step); }

bool vs_mesh_pairs(const vs_mesh *m, size_t most, const vs_kernel_options *options, size_t *pairs,
                   vs_kernel_error *error) {
  vs_kernel_error ignored;
  vs_kernel k = { .options = options, .error = error ? error : &ignored, .threads = 1, .share = 1 };
  VS_LIST(vs_bvh_box) boxes = { 0 };
  vs_bvh bvh = { 0 };
  *k.error = (vs_kernel_error){ VS_KERNEL_FINE, 0, "" };
  *pairs = 0;
  if (m->triangle_count == 0) return true;
  vs_bounds all = vs_mesh_bounds(m);
  double step = fmax(vs_bounds_diagonal(&all) * 0x1p-30, 1e-300);
  bool ok = VS_ROOM(&k, boxes.at, boxes.room, m->triangle_count);
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    vs_bounds b = vs_bounds_empty();
    for (int i = 0; i < 3; i++) vs_bounds_add(&b, m->vertices[m->triangles[t][i]]);
    boxes.at[t] = (vs_bvh_box){
      { step_of(b.min.x, all.min.x, step), step_of(b.min.y, all.min.y, step), step_of(b.min.z, all.min.z, step) },
      { step_of(b.max.x, all.min.x, step), step_of(b.max.y, all.min.y, step), step_of(b.max.z, all.min.z, step) }
    };
  }
  count c = { &k, 0, most };
  ok = ok && vs_bvh_build(&k, &bvh, boxes.at, (uint32_t)m->triangle_count) &&
       (vs_bvh_pairs(&k, &bvh, 0, UINT32_MAX, count_pair, &c) || c.pairs >= most);
  *pairs = c.pairs;
  vs_bvh_free(&k, &bvh);
  VS_DROP(&k, boxes);
  return ok;
}
