/* Finds the shells that need no search for self-contacts (stars.h).
 *
 * Let c be a point that is not on a closed shell. Count the triangles in one direction from c, negatively if seen from
 * their outer side. This number is the same in all directions. If c sees every triangle from its inner side, and
 * exactly one triangle in some direction, it sees one in every direction. Then no two triangles share more than corners
 * and edges: the shell is a star and does not intersect itself. The test uses the rounded corners, with c in the middle
 * of their box. Most separate parts of models are convex, and stars from there. If the boxes of two shells are further
 * apart than the margin, their triangles do not touch.
 *
 * A shell is closed if each edge is used as often in one direction as in the other. Each edge has a pseudorandom number
 * of 64 bits, which is added for uses in one direction and subtracted for the others. The sum is 0 for closed shells,
 * and for others with a probability of 2^-64. */
#include "kernel/round/stars.h"

#include <math.h>

#include "kernel/mesh/bvh.h"

typedef struct {
  vs_vec3 middle, way; /* middle: middle of the shell's bounding box; way: direction from there to one of its
                        * triangles */
  vs_bounds box;
  uint32_t seen;       /* number of the shell's triangles that a ray from `middle` in the direction `way` crosses */
  uint64_t edges;      /* sum of the pseudorandom numbers of all edges, each with the sign of its direction; 0 if the
                        * shell is closed */
  double least;        /* least volume of a tetrahedron that exceeds rounding errors, in cubic units */
  bool is_star, has_way;
} star;

static double volume(vs_vec3 a, vs_vec3 b, vs_vec3 c) { return vs_v3_dot(vs_v3_cross(a, b), c); } /* returns six
                                                                                                   * times the volume
                                                                                                   * of the
                                                                                                   * tetrahedron of
                                                                                                   * a, b, c and the
                                                                                                   * origin */

static uint64_t number_of(uint32_t from, uint32_t to) { /* returns the pseudorandom number of an edge: the finalizer of
                                                         * splitmix64 */
  uint64_t x = (from < to ? (uint64_t)from << 32 | to : (uint64_t)to << 32 | from) + UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
  x ^= x >> 31;
  return from < to ? x : -x;
}

typedef struct { star *all; uint32_t one; } asking;

static bool stands_alone(void *context, uint32_t other) { /* called for each box that intersects the shell's box;
                                                           * returns false, which ends the search, if the box belongs to
                                                           * another shell */
  asking *a = context;
  if (other == a->one) return true;
  a->all[a->one].is_star = a->all[other].is_star = false;
  return false;
}

/* Returns true if the triangle p, q, r is seen from its inner side, and rounding errors cannot affect whether the ray
 * in the direction of->way crosses it. */
static bool fits(star *of, vs_vec3 p, vs_vec3 q, vs_vec3 r) {
  vs_vec3 a = vs_v3_sub(p, of->middle), b = vs_v3_sub(q, of->middle), c = vs_v3_sub(r, of->middle);
  if (!(volume(a, b, c) > of->least)) return false;
  if (!of->has_way) {
    of->way = vs_v3_scale(vs_v3_add(vs_v3_add(a, b), c), 1.0 / 3);
    of->has_way = true;
    of->seen = 1;
    return true;
  }
  double x = volume(a, b, of->way), y = volume(b, c, of->way), z = volume(c, a, of->way);
  if (x < -of->least || y < -of->least || z < -of->least) return true;
  of->seen++;
  return x > of->least && y > of->least && z > of->least;
}

/* Excludes shells (connected parts of the mesh) whose boxes are closer than the margin to another shell's box. Boxes in
 * the tree have coordinates rounded outwards. */
static bool part(vs_rounding *s, star *all, uint32_t count, double margin) {
  VS_LIST(vs_bvh_box) boxes = { 0 };
  vs_bvh bvh = { 0 };
  vs_vec3 size = vs_v3_sub(s->bounds.max, s->bounds.min),
          middle = vs_v3_scale(vs_v3_add(s->bounds.min, s->bounds.max), 0.5);
  double step = (fmax(fmax(size.x, size.y), size.z) + 4 * margin) * 0x1p-28;
  bool ok = VS_ROOM(s->k, boxes.at, boxes.room, count + 1);
  for (uint32_t i = 0; ok && i < count; i++) {
    vs_vec3 low = vs_v3_sub(all[i].box.min, middle), high = vs_v3_sub(all[i].box.max, middle);
    boxes.at[i] = vs_bounds_is_empty(&all[i].box)
        ? vs_box_nowhere
        : (vs_bvh_box){ { (int32_t)floor((low.x - margin) / step), (int32_t)floor((low.y - margin) / step),
                          (int32_t)floor((low.z - margin) / step) },
                        { (int32_t)ceil((high.x + margin) / step), (int32_t)ceil((high.y + margin) / step),
                          (int32_t)ceil((high.z + margin) / step) } };
  }
  ok = ok && vs_bvh_build(s->k, &bvh, boxes.at, count);
  for (uint32_t i = 0; ok && i < count; i++) {
    if (all[i].is_star) vs_bvh_query(&bvh, &boxes.at[i], stands_alone, &(asking){ all, i });
    ok = vs_kernel_poll(s->k, 1);
  }
  vs_bvh_free(s->k, &bvh);
  VS_DROP(s->k, boxes);
  return ok;
}

bool vs_rounding_find_alone(vs_rounding *s, double margin) {
  const vs_mesh *m = s->m;
  VS_ASSERT(margin >= 0);
  VS_LIST(star) all = { 0 };
  bool ok = vs_rounding_find_shells(s) && VS_ROOM(s->k, all.at, all.room, s->shells.count + 1) &&
            VS_ROOM(s->k, s->alone.at, s->alone.room, m->vertex_count + 1);
  const uint32_t *shell = s->shells.of, count = s->shells.count;
  for (uint32_t i = 0; ok && i < count; i++) all.at[i] = (star){ .box = vs_bounds_empty(), .is_star = true };
  for (uint32_t v = 0; ok && v < m->vertex_count; v++) {
    vs_bounds_add(&all.at[shell[v]].box, m->vertices[v]);
    ok = vs_kernel_poll(s->k, 1);
  }
  ok = ok && (count < 2 || part(s, all.at, count, margin + s->coarsest));
  for (uint32_t i = 0; ok && i < count; i++) {
    star *of = &all.at[i];
    vs_vec3 c = vs_v3_scale(vs_v3_add(of->box.min, of->box.max), 0.5);
    double size = vs_bounds_diagonal(&of->box) + 2 * s->coarsest,
           reach = fmax(vs_rounding_reach(of->box.min), vs_rounding_reach(of->box.max)) + s->coarsest;
    of->middle = vs_v3(vs_single(c.x), vs_single(c.y), vs_single(c.z)); /* rounds the middle to 32-bit numbers, so
                                                                         * that its differences from corners are
                                                                         * nearly exact */
    of->least = size * size * (1e-14 * size + 0x1p-50 * reach);
  }
  for (size_t t = 0; ok && t < m->triangle_count; t++) {
    const uint32_t *v = m->triangles[t];
    star *of = &all.at[shell[v[0]]];
    ok = vs_kernel_poll(s->k, 1);
    if (s->gone.at[t] || !of->is_star) continue;
    of->is_star = fits(of, vs_rounding_corner(s, v[0]), vs_rounding_corner(s, v[1]), vs_rounding_corner(s, v[2]));
    of->edges += number_of(v[0], v[1]) + number_of(v[1], v[2]) + number_of(v[2], v[0]);
  }
  bool any = false;
  for (uint32_t i = 0; ok && i < count; i++) {
    all.at[i].is_star = all.at[i].is_star && all.at[i].seen == 1 && all.at[i].edges == 0;
    any = any || all.at[i].is_star;
  }
  for (uint32_t v = 0; ok && any && v < m->vertex_count; v++) s->alone.at[v] = all.at[shell[v]].is_star;
  s->alone.count = ok && any ? m->vertex_count : 0;
  VS_DROP(s->k, all);
  return ok;
}
