/* Computes Voronoi cells (voronoi.h). The cell of a point is the box, cut by the bisectors to the point's neighbours in
 * the Delaunay triangulation. Thus each cell belongs to a known point, and neighbouring cells share their corners. */
#include "geometry/plane/voronoi.h"

#include <stdlib.h>
#include <string.h>

#include "model/store/array.h"


void vs_voronoi_free(vs_voronoi *v) {
  free(v->at), free(v->start);
  *v = (vs_voronoi){ 0 };
}

typedef struct {
  uint32_t from, to;
} link;

static int compare_links(const void *p, const void *q) {
  const link *a = p, *b = q;
  if (a->from != b->from) return a->from < b->from ? -1 : 1;
  return a->to < b->to ? -1 : a->to > b->to;
}

static int compare_along(const void *p, const void *q) { /* orders points for qsort by x, then by y */
  const vs_vec3 *a = p, *b = q;
  if (a->x != b->x) return a->x < b->x ? -1 : 1;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  return a->z < b->z ? -1 : a->z > b->z;
}

/* Called if all points lie on one line, so that there are no triangles. Makes each point a neighbour of the next point
 * along this line. */
static bool links_along(const vs_vec2 *points, size_t n, link *links, size_t *count) {
  vs_vec3 *sorted = NULL;
  if (!VS_FRESH(sorted, n + 1)) return false;
  for (size_t i = 0; i < n; i++) sorted[i] = vs_v3(points[i].x, points[i].y, (double)i);
  qsort(sorted, n, sizeof *sorted, compare_along);
  size_t last = 0;
  for (size_t i = 1; i < n; i++) {
    if (sorted[i].x == sorted[last].x && sorted[i].y == sorted[last].y) continue;
    uint32_t a = (uint32_t)sorted[last].z, b = (uint32_t)sorted[i].z;
    links[(*count)++] = (link){ a, b };
    links[(*count)++] = (link){ b, a };
    last = i;
  }
  free(sorted);
  return true;
}

/* Cuts a convex polygon of n corners: keeps the part that is nearer to p than to q. Returns its number of corners; out
 * has room for n + 1. p and q differ. */
static size_t cut(const vs_vec2 *at, size_t n, vs_vec2 p, vs_vec2 q, vs_vec2 *out) {
  double nx = q.x - p.x, ny = q.y - p.y, mx = (p.x + q.x) / 2, my = (p.y + q.y) / 2;
  size_t count = 0;
  VS_ASSERT(p.x != q.x || p.y != q.y);
  for (size_t i = 0; i < n; i++) {
    vs_vec2 a = at[i], b = at[(i + 1) % n];
    double da = (a.x - mx) * nx + (a.y - my) * ny, db = (b.x - mx) * nx + (b.y - my) * ny;
    if (da <= 0) out[count++] = a;
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      double t = da / (da - db);
      out[count++] = (vs_vec2){ a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t };
    }
  }
  return count < 3 ? 0 : count;
}

bool vs_voronoi_make(const vs_vec2 *points, size_t n, const vs_vec2 box[2], vs_voronoi *out, vs_error *e) {
  uint32_t(*triangles)[3] = NULL;
  size_t triangle_count = 0, link_count = 0;
  link *links = NULL;
  vs_vec2 *cell = NULL, *next = NULL;
  uint8_t *known = NULL; /* known[i]: 1 if point i has a neighbour, or is the only position; a point without one repeats
                          * the position of an earlier point */
  *out = (vs_voronoi){ 0 };
  if (n > 1 && !vs_points_delaunay(points, n, &triangles, &triangle_count, e)) return false;
  size_t most = 6 * triangle_count + 2 * n;
  bool ok = VS_FRESH(links, most + 1) && VS_FRESH(out->start, n + 1) && VS_FRESH(known, n + 1);
  if (ok) memset(known, 0, n + 1);
  for (size_t i = 0; ok && i < triangle_count; i++)
    for (int k = 0; k < 3; k++) {
      uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      links[link_count++] = (link){ a, b };
      links[link_count++] = (link){ b, a };
    }
  if (ok && !triangle_count) ok = links_along(points, n, links, &link_count);
  if (ok) qsort(links, link_count, sizeof *links, compare_links);
  for (size_t i = 0; i < link_count; i++) known[links[i].from] = 1;
  if (ok && !link_count) known[0] = 1; /* all points have one position, so only the first has a cell */
  ok = ok && VS_FRESH(cell, link_count + 8) && VS_FRESH(next, link_count + 8);
  size_t at = 0;
  for (uint32_t i = 0; ok && i < n; i++) {
    out->start[i] = out->count;
    size_t corners = known[i] ? 4 : 0;
    cell[0] = box[0], cell[1] = (vs_vec2){ box[1].x, box[0].y }, cell[2] = box[1];
    cell[3] = (vs_vec2){ box[0].x, box[1].y };
    for (; at < link_count && links[at].from == i; at++) {
      if (at && links[at - 1].from == i && links[at - 1].to == links[at].to) continue;
      corners = cut(cell, corners, points[i], points[links[at].to], next);
      vs_vec2 *swap = cell;
      cell = next, next = swap;
    }
    ok = VS_GROW(out->at, out->room, out->count + corners + 1);
    if (ok && corners) memcpy(out->at + out->count, cell, corners * sizeof *cell), out->count += corners;
  }
  if (ok) out->start[n] = out->count;
  free(links), free(cell), free(next), free(known), free(triangles);
  if (ok) return true;
  vs_voronoi_free(out);
  return vs_error_memory(e, NULL);
}
