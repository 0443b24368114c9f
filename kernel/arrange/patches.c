/* Makes patches: the parts of a facet that are tested against other facets as a unit.
 *
 * A convex facet is one patch, however it is triangulated. Therefore the wall of a box shares one segment with another
 * wall instead of up to four. No segment ends in a new point on a diagonal, which is not a part of the model. */
#include "kernel/arrange/patches.h"

#include "kernel/arrange/cull.h"
#include "kernel/cluster.h"
#include "kernel/threads.h"

#include <string.h>

/* Memory that one thread reuses for all its facets. */
typedef struct {
  vs_kernel *k;
  const vs_cluster *c;
  struct made *to;
  const uint32_t *alone;
  VS_LIST(uint32_t) next;   /* next[p]: point that follows p on the facet's border; VS_NONE for all points while no
                             * facet is processed */
  VS_LIST(uint32_t) border; /* for each loop of the facet's border: one point on it, where a walk along the loop
                             * begins */
} building;

typedef struct made { /* Patches of the facets that one task handles. Indices of corners count from the first corner of
                       * the task. */
  VS_LIST(vs_patch) patches;
  VS_LIST(vs_patch_corner) corners;
  VS_LIST(vs_bvh_box) boxes;
} made;

typedef struct {
  vs_cluster *c;
  made made[VS_PIPELINE_WINDOW];
  building *works; /* array with the working memory of each thread */
  VS_LIST(uint32_t) alone; /* alone[p]: index of the facet in plane p if there is only one, else SEVERAL */
} patching;

/* Appends a patch. Its corners are those of the chunk, from index `first` to the last. */
static bool add_patch(building *b, uint32_t facet, uint32_t first, uint8_t inner) {
  const vs_cluster *c = b->c;
  const vs_facet *f = &c->facets.at[facet];
  vs_patch p = { facet, f->place, f->plane, first, (uint32_t)b->to->corners.count - first, f->flip, inner };
  vs_bvh_box box = { { INT32_MAX, INT32_MAX, INT32_MAX }, { INT32_MIN, INT32_MIN, INT32_MIN } };
  VS_ASSERT(first <= b->to->corners.count);
  for (uint32_t i = first; i < b->to->corners.count; i++)
    for (int a = 0; a < 3; a++) {
      int32_t x = b->to->corners.at[i].at[a];
      if (x < box.min[a]) box.min[a] = x;
      if (x > box.max[a]) box.max[a] = x;
    }
  /* Reduces the box of the patch to the part that no convex leaf hides, if its facet is the only one in its plane.
   * Facets in a common plane must be cut by each other's borders even where they are hidden. */
  if (c->placed.at[p.place].lids_count && b->alone[p.plane] == facet)
    vs_cull_box(c, p.place, b->to->corners.at + first, p.count, &box);
  return VS_PUSH(b->k, b->to->patches, p) && VS_PUSH(b->k, b->to->boxes, box);
}

static bool add_corner(building *b, uint32_t point) {
  vs_patch_corner corner = { { 0 }, point };
  vs_points_grid(&b->c->points, point, corner.at);
  return VS_PUSH(b->k, b->to->corners, corner);
}

/* Returns true if the ring of corners from index `first` on is convex and goes around once. Corners on a straight line
 * are allowed, but no reversal. The ring has at least three corners. */
static bool convex(const building *b, const vs_facet *f, uint32_t first) {
  const vs_plane *p = &b->c->planes.all.at[f->plane];
  const vs_patch_corner *at = b->to->corners.at + first;
  uint32_t n = (uint32_t)b->to->corners.count - first;
  int falls = 0;
  VS_ASSERT(n >= 3);
  for (uint32_t i = 0; i < n; i++) {
    const int32_t *x = at[i].at, *y = at[(i + 1) % n].at, *z = at[(i + 2) % n].at;
    int64_t ax = (int64_t)y[p->u] - x[p->u], ay = (int64_t)y[p->v] - x[p->v], bx = (int64_t)z[p->u] - y[p->u],
            by = (int64_t)z[p->v] - y[p->v];
    vs_i128 turn = (vs_i128)ax * by - (vs_i128)ay * bx;
    if (f->flip ? turn > 0 : turn < 0) return false;
    bool down = ax < 0 || (ax == 0 && ay < 0), then = bx < 0 || (bx == 0 && by < 0);
    falls += down && !then;
  }
  return falls == 1;
}

static bool facet_patch(building *b, uint32_t facet, bool *whole) {
  const vs_cluster *c = b->c;
  const vs_facet *f = &c->facets.at[facet];
  uint32_t first = (uint32_t)b->to->corners.count;
  bool simple = true;
  b->border.count = 0;
  for (uint32_t i = f[0].first; i < f[1].first; i++) {
    const vs_grid_triangle *t = &c->triangles.at[c->facet_triangles.at[i]];
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
  *whole = simple && b->border.count >= 3 && at == b->border.at[0] && convex(b, f, first);
  if (*whole) return add_patch(b, facet, first, 0);
  b->to->corners.count = first;
  return true;
}

enum { CHUNK = 4096 }; /* number of facets that one task handles */
#define SEVERAL (UINT32_MAX - 1)

static bool make_chunk(vs_kernel *k, void *context, size_t index) {
  patching *p = context;
  const vs_cluster *c = p->c;
  building *b = &p->works[k->worker];
  made *to = &p->made[index % VS_PIPELINE_WINDOW];
  b->k = k;
  b->c = c;
  b->to = to;
  b->alone = p->alone.at;
  to->patches.count = to->corners.count = to->boxes.count = 0;
  if (!b->next.count) {
    if (!VS_ROOM(k, b->next.at, b->next.room, c->points.all.count + 1)) return false;
    for (size_t i = 0; i < c->points.all.count; i++) b->next.at[i] = VS_NONE;
    b->next.count = c->points.all.count;
  }
  for (size_t i = index * CHUNK; i < (index + 1) * CHUNK && i < c->facets.count; i++) {
    uint32_t first = c->facets.at[i].first, end = c->facets.at[i + 1].first;
    bool whole = false;
    if (!vs_kernel_poll(k, 0.1) || (end - first > 1 && !facet_patch(b, (uint32_t)i, &whole))) return false;
    for (uint32_t t = first; !whole && t < end; t++) {
      const vs_grid_triangle *triangle = &c->triangles.at[c->facet_triangles.at[t]];
      uint32_t at = (uint32_t)to->corners.count;
      for (int j = 0; j < 3; j++)
        if (!add_corner(b, triangle->v[j])) return false;
      if (!add_patch(b, (uint32_t)i, at, triangle->inner)) return false;
    }
  }
  return true;
}

static bool take_chunk(vs_kernel *k, void *context, size_t index) {
  patching *p = context;
  vs_cluster *c = p->c;
  const made *from = &p->made[index % VS_PIPELINE_WINDOW];
  size_t corners = c->patch_corners.count, patches = c->patches.count;
  if (!VS_ROOM(k, c->patches.at, c->patches.room, patches + from->patches.count) ||
      !VS_ROOM(k, c->boxes.at, c->boxes.room, patches + from->patches.count) ||
      !VS_ROOM(k, c->patch_corners.at, c->patch_corners.room, corners + from->corners.count))
    return false;
  if (corners + from->corners.count >= UINT32_MAX)
    return vs_kernel_fail(k, VS_KERNEL_LIMIT, 0, "the solids have too many faces");
  for (size_t i = 0; i < from->patches.count; i++) {
    c->patches.at[patches + i] = from->patches.at[i];
    c->patches.at[patches + i].first += (uint32_t)corners;
    c->boxes.at[patches + i] = from->boxes.at[i];
  }
  if (from->corners.count)
    memcpy(c->patch_corners.at + corners, from->corners.at, from->corners.count * sizeof *from->corners.at);
  c->patches.count = c->boxes.count = patches + from->patches.count;
  c->patch_corners.count = corners + from->corners.count;
  return vs_kernel_report(k, 0.1);
}

bool vs_patches_build(vs_kernel *k, vs_cluster *c) {
  patching p = { .c = c };
  uint32_t *families = NULL;
  size_t room = 0, family_room = 0;
  bool ok = VS_ROOM(k, p.works, room, k->threads);
  if (ok) memset(p.works, 0, room * sizeof *p.works);
  ok = ok && VS_ROOM(k, p.alone.at, p.alone.room, c->planes.all.count + 1);
  if (ok) memset(p.alone.at, 0xff, (c->planes.all.count + 1) * sizeof *p.alone.at);
  for (uint32_t i = 0; ok && i < c->facets.count; i++) {
    uint32_t *of = &p.alone.at[c->facets.at[i].plane];
    *of = *of == VS_NONE ? i : SEVERAL;
  }
  size_t least = c->facets.count; /* estimated minimum of the number of patches and of corners, for the size of the
                                   * arrays */
  ok = ok && VS_ROOM(k, c->patches.at, c->patches.room, least) && VS_ROOM(k, c->boxes.at, c->boxes.room, least) &&
       VS_ROOM(k, c->patch_corners.at, c->patch_corners.room, 3 * least);
  ok = ok && vs_kernel_pipeline(k, (c->facets.count + CHUNK - 1) / CHUNK, make_chunk, take_chunk, &p) &&
       VS_ROOM(k, families, family_room, c->patches.count + 1);
  for (size_t i = 0; ok && i < c->patches.count; i++) { /* Patches of one family are not tested against each other. The
                                                         * triangles of a star (a mesh whose middle sees every triangle
                                                         * from inside) do not intersect. Therefore its patches form one
                                                         * family. */
    uint32_t place = c->patches.at[i].place;
    families[i] = c->placed.at[place].star ? place : UINT32_MAX;
  }
  c->bvh.families = families;
  ok = ok && vs_bvh_build(k, &c->bvh, c->boxes.at, (uint32_t)c->patches.count);
  VS_DROP(k, c->boxes); /* frees the boxes, because the tree of boxes contains a copy of them */
  VS_FREE(k, families, family_room);
  for (size_t i = 0; i < room; i++) {
    VS_DROP(k, p.works[i].next);
    VS_DROP(k, p.works[i].border);
  }
  VS_FREE(k, p.works, room);
  VS_DROP(k, p.alone);
  for (size_t i = 0; i < VS_PIPELINE_WINDOW; i++) {
    VS_DROP(k, p.made[i].patches);
    VS_DROP(k, p.made[i].corners);
    VS_DROP(k, p.made[i].boxes);
  }
  return ok;
}
