/* Owns the patches: what of a facet is tested against other facets' in one piece.
 *
 * A facet that is convex is one patch, whatever triangles it came in: the wall of a box meets another in one segment instead of up to four, and none
 * of them ends in a new point on a diagonal that nobody asked for. */
#include "kernel/cluster.h"

typedef struct {
  vs_kernel *k;
  vs_cluster *c;
  VS_LIST(uint32_t) next;   /* of a point on the facet's border; VS_NONE outside of facet_patch */
  VS_LIST(uint32_t) border; /* points where borders begin */
} building;

static bool add_patch(building *b, uint32_t facet, uint32_t first, uint8_t inner) {
  vs_cluster *c = b->c;
  const vs_facet *f = &c->facets.at[facet];
  vs_patch p = { facet, f->place, f->plane, first, (uint32_t)c->patch_corners.count - first, f->flip, inner };
  vs_box box = { { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
  for (uint32_t i = first; i < c->patch_corners.count; i++)
    for (int a = 0; a < 3; a++) {
      int32_t x = c->patch_corners.at[i].at[a];
      if (x < box.min[a]) box.min[a] = x;
      if (x > box.max[a]) box.max[a] = x;
    }
  if (c->placed.at[p.place].lids_count) vs_cull_box(c, p.place, c->patch_corners.at + first, p.count, &box);
  return VS_PUSH(b->k, c->patches, p) && VS_PUSH(b->k, c->boxes, box);
}

static bool add_corner(building *b, uint32_t point) {
  vs_patch_corner corner = { { 0 }, point };
  vs_points_grid(&b->c->points, point, corner.at);
  return VS_PUSH(b->k, b->c->patch_corners, corner);
}

/* Is the ring of corners from `first` on convex? Corners in one line are allowed, turning back is not, and it goes around once. */
static bool convex(const vs_cluster *c, const vs_facet *f, uint32_t first) {
  const vs_plane *p = &c->planes.all.at[f->plane];
  uint32_t n = (uint32_t)c->patch_corners.count - first;
  int falls = 0;
  for (uint32_t i = 0; i < n; i++) {
    const int32_t *x = c->patch_corners.at[first + i].at, *y = c->patch_corners.at[first + (i + 1) % n].at, *z = c->patch_corners.at[first + (i + 2) % n].at;
    int64_t ax = (int64_t)y[p->u] - x[p->u], ay = (int64_t)y[p->v] - x[p->v], bx = (int64_t)z[p->u] - y[p->u], by = (int64_t)z[p->v] - y[p->v];
    int64_t turn = ax * by - ay * bx;
    if (f->flip ? turn > 0 : turn < 0) return false;
    bool down = ax < 0 || (ax == 0 && ay < 0), then = bx < 0 || (bx == 0 && by < 0);
    falls += down && !then;
  }
  return falls == 1;
}

static bool facet_patch(building *b, uint32_t facet, bool *whole) {
  vs_cluster *c = b->c;
  const vs_facet *f = &c->facets.at[facet];
  uint32_t first = (uint32_t)c->patch_corners.count;
  bool simple = true;
  b->border.count = 0;
  for (uint32_t i = f[0].first; i < f[1].first; i++) {
    const vs_soup_triangle *t = &c->triangles.at[c->facet_triangles.at[i]];
    for (int j = 0; j < 3; j++) {
      if (t->inner >> j & 1) continue;
      if (b->next.at[t->v[j]] != VS_NONE) simple = false;
      b->next.at[t->v[j]] = t->v[(j + 1) % 3];
      if (!VS_PUSH(b->k, b->border, t->v[j])) return false;
    }
  }
  uint32_t at = b->border.count ? b->border.at[0] : 0;
  for (size_t i = 0; simple && i < b->border.count; i++) {
    if (!add_corner(b, at)) return false;
    at = b->next.at[at];
    if (at == VS_NONE || (at == b->border.at[0] && i + 1 < b->border.count)) simple = false;
  }
  for (size_t i = 0; i < b->border.count; i++) b->next.at[b->border.at[i]] = VS_NONE;
  *whole = simple && b->border.count >= 3 && at == b->border.at[0] && convex(c, f, first);
  if (*whole) return add_patch(b, facet, first, 0);
  c->patch_corners.count = first;
  return true;
}

bool vs_patches_build(vs_kernel *k, vs_cluster *c) {
  building b = { .k = k, .c = c };
  uint32_t points = (uint32_t)c->points.all.count;
  bool ok = VS_ROOM(k, b.next.at, b.next.room, (size_t)points + 1);
  for (uint32_t i = 0; ok && i < points; i++) b.next.at[i] = VS_NONE;
  for (uint32_t i = 0; ok && i < c->facets.count; i++) {
    uint32_t first = c->facets.at[i].first, end = c->facets.at[i + 1].first;
    bool whole = false;
    ok = vs_kernel_poll(k, 0.1) && (end - first < 2 || facet_patch(&b, i, &whole));
    for (uint32_t t = first; ok && !whole && t < end; t++) {
      const vs_soup_triangle *triangle = &c->triangles.at[c->facet_triangles.at[t]];
      uint32_t at = (uint32_t)c->patch_corners.count;
      for (int j = 0; ok && j < 3; j++) ok = add_corner(&b, triangle->v[j]);
      ok = ok && add_patch(&b, i, at, triangle->inner);
    }
  }
  ok = ok && c->patch_corners.count < UINT32_MAX && vs_bvh_build(k, &c->bvh, c->boxes.at, (uint32_t)c->patches.count);
  VS_DROP(k, b.next);
  VS_DROP(k, b.border);
  return ok;
}
