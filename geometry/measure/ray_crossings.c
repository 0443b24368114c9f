/* Tests whether a point is inside a closed mesh. It counts the triangles that an upward ray crosses, with a sign that
 * depends on the side that the ray enters.
 *
 * As seen from above, one comparison determines whether an edge is to the right of p. Both triangles at the edge make
 * the same comparison, so a ray through an edge or a corner is counted once. A grid of cells lists the triangles whose
 * boxes intersect each cell. Its size is chosen so that there are at most some ten entries for each triangle. */
#include "geometry/measure/ray_crossings.h"
#include "model/store/array.h"

#include <stdlib.h>

typedef struct { size_t x0, y0, x1, y1; } facet_cells;

void vs_facet_index_free(vs_facet_index *x) {
  vs_mesh_free(&x->mesh);
  free(x->starts);
  free(x->triangles);
  *x = (vs_facet_index){ 0 };
}

size_t vs_facet_index_bytes(const vs_facet_index *x) {
  return x->mesh.vertex_count * sizeof(vs_vec3) + x->mesh.triangle_count * 3 * sizeof(uint32_t) +
         (x->starts ? (x->cells * x->cells + 1 + x->starts[x->cells * x->cells]) * sizeof(uint32_t) : 0);
}

/* Returns the index of the cell that contains `at`, among `cells` >= 1 equal cells from min to max. */
static size_t facet_cell(double at, double min, double max, size_t cells) {
  double k = max > min ? floor((at - min) / (max - min) * (double)cells) : 0;
  VS_ASSERT(cells > 0);
  return k < 0 ? 0 : k >= (double)cells ? cells - 1 : (size_t)k;
}

static facet_cells facet_span(const vs_facet_index *x, size_t triangle) {
  vs_bounds b = vs_bounds_empty();
  for (int k = 0; k < 3; k++) vs_bounds_add(&b, x->mesh.vertices[x->mesh.triangles[triangle][k]]);
  const vs_bounds *all = &x->bounds;
  return (facet_cells){ facet_cell(b.min.x, all->min.x, all->max.x, x->cells),
                        facet_cell(b.min.y, all->min.y, all->max.y, x->cells),
                        facet_cell(b.max.x, all->min.x, all->max.x, x->cells),
                        facet_cell(b.max.y, all->min.y, all->max.y, x->cells) };
}

bool vs_facet_index_make(vs_facet_index *x) {
  size_t n = x->mesh.triangle_count, total;
  x->bounds = vs_mesh_bounds(&x->mesh);
  x->cells = (size_t)ceil(sqrt((double)n / 2 + 1));
  if (x->cells > 1024) x->cells = 1024;
  for (;; x->cells = (x->cells + 1) / 2) {
    total = 0;
    for (size_t i = 0; i < n; i++) {
      facet_cells c = facet_span(x, i);
      total += (c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1);
    }
    if (total <= 10 * n + 64 || x->cells == 1) break;
  }
  size_t cells = x->cells * x->cells;
  x->starts = vs_zeros(cells + 2, sizeof *x->starts);
  x->triangles = vs_fresh(total + 1, sizeof *x->triangles);
  if (!x->starts || !x->triangles || total >= UINT32_MAX) return false;
  for (int pass = 0; pass < 2; pass++) { /* The first pass counts the triangles of each cell. The second pass lists
                                          * them, and moves starts[c + 1] from the beginning to the end of cell c's
                                          * list. */
    for (size_t i = 0; i < n; i++) {
      facet_cells c = facet_span(x, i);
      for (size_t v = c.y0; v <= c.y1; v++)
        for (size_t u = c.x0; u <= c.x1; u++) {
          if (pass) x->triangles[x->starts[v * x->cells + u + 1]++] = (uint32_t)i;
          else x->starts[v * x->cells + u + 2]++;
        }
    }
    for (size_t c = 2; !pass && c < cells + 2; c++) x->starts[c] += x->starts[c - 1];
  }
  return true;
}

/* Tests, as seen from above, whether the ray from p towards +X crosses the edge from a to b. Returns 1 if the edge goes
 * towards +Y there, -1 if it goes towards -Y, 0 if the ray does not cross it. */
static int facet_crosses(vs_vec3 a, vs_vec3 b, vs_vec3 p) {
  if ((a.y > p.y) == (b.y > p.y)) return 0;
  bool up = b.y > a.y;
  vs_vec3 low = up ? a : b, high = up ? b : a;
  double x = low.x + (p.y - low.y) / (high.y - low.y) * (high.x - low.x);
  return p.x < x ? up ? 1 : -1 : 0;
}

bool vs_facet_index_holds(const vs_facet_index *x, vs_vec3 p) {
  const vs_bounds *b = &x->bounds;
  if (!x->mesh.triangle_count || p.x < b->min.x || p.x > b->max.x || p.y < b->min.y || p.y > b->max.y ||
      p.z < b->min.z || p.z > b->max.z)
    return false;
  size_t cell =
      facet_cell(p.y, b->min.y, b->max.y, x->cells) * x->cells + facet_cell(p.x, b->min.x, b->max.x, x->cells);
  double near = 1e-12 * vs_bounds_diagonal(b);
  long winding = 0;
  for (uint32_t i = x->starts[cell]; i < x->starts[cell + 1]; i++) {
    const uint32_t *t = x->mesh.triangles[x->triangles[i]];
    vs_vec3 a = x->mesh.vertices[t[0]], c = x->mesh.vertices[t[1]], d = x->mesh.vertices[t[2]];
    vs_vec3 normal = vs_v3_cross(vs_v3_sub(c, a), vs_v3_sub(d, a));
    int sides = facet_crosses(a, c, p) + facet_crosses(c, d, p) + facet_crosses(d, a, p);
    if (sides == 0) continue;
    double above = vs_v3_dot(normal, vs_v3_sub(a, p)); /* above 0 if the triangle's plane lies above p, in the direction
                                                        * of its normal */
    if (fabs(above) <= near * vs_v3_length(normal)) return true;
    if (sides > 0 ? above > 0 : above < 0) winding += sides;
  }
  return winding > 0;
}
