/* Implements the search for boxes that are near each other (near_boxes.h), by a tree of boxes on a grid of whole
 * numbers. Each box is enlarged by half of the distance. */
#include "solids/near_boxes.h"

#include <math.h>
#include <stdlib.h>

#include "kernel/memory.h"
#include "model/store/array.h"

bool vs_near_boxes(const vs_bounds *boxes, uint32_t count, double apart, const vs_kernel_options *options,
                   vs_bvh_pair_fn *visit, void *context, vs_error *e) {
  vs_kernel_error why = { VS_KERNEL_FINE, 0, "" };
  vs_kernel k = { .options = options, .error = &why, .threads = 1 };
  vs_bvh tree = { 0 };
  vs_bvh_box *on_grid = vs_fresh(count, sizeof *on_grid);
  vs_bounds all = vs_bounds_empty();
  for (uint32_t i = 0; i < count; i++) vs_bounds_unite(&all, &boxes[i]);
  double low[3] = { all.min.x, all.min.y, all.min.z }, size = vs_bounds_diagonal(&all) + apart;
  double step = size > 0 ? size * 0x1p-28 : 1;
  for (uint32_t i = 0; on_grid && i < count; i++) {
    const vs_bounds *b = &boxes[i];
    double from[3] = { b->min.x, b->min.y, b->min.z }, to[3] = { b->max.x, b->max.y, b->max.z };
    on_grid[i] = vs_box_nowhere;
    for (int a = 0; !vs_bounds_is_empty(b) && a < 3; a++) {
      on_grid[i].min[a] = (int32_t)floor((from[a] - apart / 2 - low[a]) / step);
      on_grid[i].max[a] = (int32_t)ceil((to[a] + apart / 2 - low[a]) / step);
    }
  }
  bool ok = on_grid && vs_bvh_build(&k, &tree, on_grid, count) &&
            vs_bvh_pairs(&k, &tree, 0, UINT32_MAX, visit, context);
  vs_bvh_free(&k, &tree);
  free(on_grid);
  if (ok) return true;
  return why.status == VS_KERNEL_INTERRUPTED ? vs_error_set(e, VS_ERROR_INTERRUPT, NULL, "interrupted")
                                             : vs_error_memory(e, NULL);
}
